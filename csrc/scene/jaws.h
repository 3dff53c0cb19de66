/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What drives things, and grippers: their jaws, pads and frozen grips. Shared by the files of this
 * room only. */
#ifndef SW_SCENE_JAWS_H
#define SW_SCENE_JAWS_H

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
  double tried[2];  /* speeds with too little force and with too much [m/s] */
  double off[2];    /* how far their forces were off; NAN = not tried [N] */
  int last_side, trials, guessed;
} sw_jaw;

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
/* 1: something that holds a wire starts, stops or turns a corner at once at the present time. */
int sw_scene_jerks(sw_scene *scene);
/* Follow the motion from the scene's time on. */
sw_status sw_drive_follow(sw_scene *scene, sw_drive *drive, const char *object, sw_motion *motion,
                          int relative, sw_error *err);
void sw_drive_free(sw_drive *drive);
/* 1: it may be elsewhere later without anyone changing it. */
static inline int sw_drive_moves(const sw_drive *drive) { return drive->motion || drive->tool; }

void sw_scene_clear_tool(sw_tool *tool);
sw_tool *sw_scene_find_tool(const sw_scene *scene, sw_handle h, sw_error *err);
/* Their jaws at the start of a step of size h; 1: a trial may have to be corrected. After a
 * trial: 1 = the forces are as wanted, or cannot be. After an accepted one, or one given up. */
int sw_jaw_begin(sw_scene *scene, double h);
int sw_jaw_correct(sw_scene *scene, int rests); /* rests: trials are equilibria */
/* How far the forces of a trial are off, the worst over what is wanted [-]. */
double sw_jaw_off(sw_scene *scene);
/* After an equilibrium that is taken: 1 = its force is not as wanted, for that jumped, and the jaws
 * have begun to look for it from there on. */
int sw_jaw_again(sw_scene *scene);
void sw_jaw_follow(sw_scene *scene);
/* The same of an equilibrium at the scene's time: jaws that hold with a force open or close at
 * once, by a small part of the wires' thickness. After it: 1 = they have to go further. */
int sw_jaw_begin_rest(sw_scene *scene);
int sw_jaw_end_rest(sw_scene *scene, int went_well);
/* The largest pose step up to h in which jaws that close with a force go no further than a small
 * part of the wires' thickness [s]. */
double sw_jaw_step(const sw_scene *scene, double h);
/* How far they are open at time t, and how fast that changes [m], [m/s]. */
double sw_jaw_at(const sw_jaw *jaw, double t);
/* 1: the obstacle of this number is one of its pads. */
int sw_tool_is_pad(const sw_tool *tool, int obstacle);
/* Force per finger as of the last trial, which ended at time t [N]. */
double sw_tool_squeeze(sw_scene *scene, const sw_tool *tool, double t);
/* What tools hold at the accepted state; their logs. */
sw_status sw_tool_observe(sw_scene *scene, sw_error *err);
/* Does the tool run into obstacles? */
sw_status sw_tool_look_out(sw_scene *scene, size_t tool, sw_error *err);
/* 1: one slipped in the last step that ends a run with it. */
int sw_tool_slipped(const sw_scene *scene);

#endif
