/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What drives things, and grippers: their jaws, pads and frozen grips. Of this room and
 * of steps. */
#ifndef SW_SCENE_JAWS_H
#define SW_SCENE_JAWS_H

#include "base/root.h"
#include "base/tape.h"
#include "link/hold.h"
#include "scene/scene.h"
#include "scene/tool.h"

/* The jaws of a tool. Their opening at time t is opening + speed (t - since). */
typedef struct sw_jaw {
  int mode;         /* SW_JAW_STILL, ... */
  int status;       /* SW_JAW_RESTS, ... */
  double opening;   /* [m] */
  double since;     /* [s] */
  double step;      /* the present one [s] */
  double speed;     /* of this step; below 0 they close [m/s] */
  double most;      /* highest speed [m/s] */
  double goal;      /* opening to go to [m] */
  double force;     /* per finger: wanted, or at which they stop [N] */
  double now;       /* force per finger of the accepted state [N] */
  double stiffness; /* of what they hold, last found; 0 = not known [N/m] */
  sw_bracket found; /* speeds with too little force and with too much [m/s], [N] */
  int trials, guessed;
} sw_jaw;

/* How far they are open at time t [m]. */
static inline double sw_jaw_at(const sw_jaw *jaw, double t) {
  return jaw->opening + jaw->speed * (t - jaw->since);
}

typedef struct sw_tool_pad {
  size_t obstacle; /* slot */
  int finger;      /* [-] */
} sw_tool_pad;

typedef struct sw_frozen sw_frozen; /* what pads held, see frozen_inner.h; shared and immutable */
void sw_frozen_retain(sw_frozen *frozen);
void sw_frozen_release(sw_frozen *frozen);
/* What a force on the wire and its moment about the tool's centre, in the tool's axes, are of what
 * the pads could bear in place of the rigid grip [-]. */
double sw_frozen_margin(const sw_frozen *frozen, sw_vec force, sw_vec moment);

/* What a gripper is to the core: a frame that moves, with jaws and pads in it. */
typedef struct sw_tool {
  uint32_t generation;
  int alive;
  char name[SW_NAME_SIZE];
  sw_drive drive;
  sw_jaw jaw;
  sw_tool_pad pad[SW_TOOL_PADS];
  size_t pads;
  int fingers;
  sw_frozen *frozen; /* or NULL */
  double limit;      /* margin at which a frozen grip is lost [-] */
  sw_tool_state now; /* of the accepted state */
  double tolerance;  /* slip that is an event [m] */
  int stops;         /* 1: a run ends with the step in which the wire slips */
  sw_crash crash;    /* the last one */
  int crashing;      /* 1: it goes on */
  sw_log log;
} sw_tool;

/* Where the drive is at time t. The scene refuses to be changed meanwhile, for
 * the motion may be a user's function. */
sw_status sw_drive_eval(sw_scene *scene, const sw_drive *drive, double t, sw_motion_state *out,
                        sw_error *err);
/* Follow the motion from the scene's time on. */
sw_status sw_drive_follow(sw_scene *scene, sw_drive *drive, const char *object, sw_motion *motion,
                          int relative, sw_error *err);
void sw_drive_free(sw_drive *drive);
void sw_tape_drive(sw_tape *tape, sw_scene *scene, sw_drive *drive);
/* 1: it may be elsewhere later without anyone changing it. */
static inline int sw_drive_moves(const sw_drive *drive) { return drive->motion || drive->tool; }

void sw_scene_clear_tool(sw_tool *tool);
sw_tool *sw_scene_find_tool(const sw_scene *scene, sw_handle h, sw_error *err);
/* 1: the obstacle of this number is one of its pads. */
static inline int sw_tool_is_pad(const sw_tool *t, int obstacle) {
  for (size_t k = 0; k < t->pads; k++)
    if (t->pad[k].obstacle == (size_t)obstacle) return 1;
  return 0;
}
/* Force per finger as of the last trial, which ended at time t [N]. */
double sw_tool_squeeze(sw_scene *scene, const sw_tool *tool, double t);
/* What tools hold at the accepted state; their logs. */
sw_status sw_tool_observe(sw_scene *scene, sw_error *err);
/* Does the tool run into obstacles? */
sw_status sw_tool_look_out(sw_scene *scene, size_t tool, sw_error *err);
/* 1: one slipped in the last step that ends a run with it. */
int sw_tool_slipped(const sw_scene *scene);

void sw_tape_tool(sw_tape *tape, sw_scene *scene, sw_tool *tool);
void sw_tape_jaw(sw_tape *tape, sw_jaw *jaw);
void sw_tape_frozen(sw_tape *tape, sw_frozen **frozen); /* or NULL */
int sw_frozen_fits(const sw_frozen *frozen, const sw_scene *scene);

#endif
