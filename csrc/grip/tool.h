/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tools: grippers as the core sees them. A tool is a moving frame with jaws that open and close in
 * it, and pads: obstacles that move with the frame, and apart with the jaws. */
#ifndef SW_GRIP_TOOL_H
#define SW_GRIP_TOOL_H

#include "motion/motion.h"
#include "scene/gripper.h"
#include "scene/scene.h"
#include "scene/values.h"

typedef struct sw_tool_args {
  char name[SW_NAME_SIZE];
  sw_vec at;        /* [m] */
  sw_quat rotation; /* [-] */
  double opening;   /* between facing pads [m] */
} sw_tool_args;

sw_status sw_scene_add_tool(sw_scene *scene, const sw_tool_args *args, sw_handle *out,
                            sw_error *err);
/* The obstacle moves with the tool from its present place on. opens: how it moves in the tool's
 * axes while the opening grows [m/m]. finger: pads of the same number belong to one finger, which
 * sums their forces; -1: a part of the tool that is no pad. */
sw_status sw_scene_tool_pad(sw_scene *scene, sw_handle tool, sw_handle obstacle, int finger,
                            sw_vec opens, sw_error *err);
/* The hold moves with the tool from now on; its force counts as the tool's. */
sw_status sw_scene_tool_hold(sw_scene *scene, sw_handle tool, sw_handle hold, sw_error *err);
/* The same, but the tool takes over place and motion of the hold, which goes on at its centre. */
sw_status sw_scene_tool_take(sw_scene *scene, sw_handle tool, sw_handle hold, sw_error *err);
/* on: 1 = wires touch the pads; 0 = they pass through the pads. */
sw_status sw_scene_tool_pads_on(sw_scene *scene, sw_handle tool, int on, sw_error *err);

typedef struct sw_jaw_args {
  int mode;
  double opening; /* [m] */
  double speed;   /* highest speed of the opening [m/s] */
  double force;   /* per finger; INFINITY = no limit [N] */
} sw_jaw_args;
sw_status sw_scene_tool_jaws(sw_scene *scene, sw_handle tool, const sw_jaw_args *args,
                             sw_error *err);

/* Sets the margin above which a frozen grip counts as lost; a run ends with that step [-]. */
sw_status sw_scene_tool_limit(sw_scene *scene, sw_handle tool, double margin, sw_error *err);

sw_status sw_scene_tool_state(sw_scene *scene, sw_handle tool, sw_tool_state *out, sw_error *err);
/* Sets the slip that is an event [m]. stops = 1: a run ends with that step. The slip restarts at
 * 0. */
sw_status sw_scene_tool_watch(sw_scene *scene, sw_handle tool, double tolerance, int stops,
                              sw_error *err);
/* Force of pads and holds on wires, and its moment about a point; about = NULL: the tool's centre
 * [N], [N m]. */
sw_status sw_scene_tool_force(sw_scene *scene, sw_handle tool, const sw_vec *about, sw_vec *force,
                              sw_vec *moment, sw_error *err);
/* The same of one finger's pads. */
sw_status sw_scene_tool_finger(sw_scene *scene, sw_handle tool, int finger, const sw_vec *about,
                               sw_vec *force, sw_vec *moment, sw_error *err);

/* A place where a pad presses on a wire. */
typedef struct sw_tool_touch {
  int finger;
  sw_vec at;        /* on the pad, in the tool's axes [m] */
  sw_vec acts;      /* where the force acts on the wire, in the tool's axes [m] */
  sw_vec force;     /* on the wire, in the tool's axes [N] */
  double normal;    /* part of the force across the surface [N] */
  double s;         /* arc length [m] */
  double slid;      /* distance that the wire slid there since it began to press [m] */
  size_t wire;      /* number in frames [-] */
  const char *name; /* the wire's name in the scene */
} sw_tool_touch;
/* touches: count of all touches of the scene. touch: fills in touch k; 0 if it is not a pad's or
 * has no force. */
sw_status sw_scene_tool_touches(sw_scene *scene, sw_handle tool, size_t *count, sw_error *err);
int sw_scene_tool_touch(const sw_scene *scene, sw_handle tool, size_t k, sw_tool_touch *out);

/* Log rows: those of holds (see SW_LOG_SIZE), then opening, squeeze, margin, slip. */
enum { SW_LOG_OPENING = SW_LOG_SIZE, SW_LOG_SQUEEZE, SW_LOG_MARGIN, SW_LOG_SLIP, SW_LOG_TOOL_SIZE };

#endif
