/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Grippers as a scene keeps them: a frame that moves, jaws that open and close in it, and pads.
 * Pads are obstacles that move with the frame, and apart with the jaws. */
#ifndef SW_SCENE_GRIPPER_H
#define SW_SCENE_GRIPPER_H

#include "base/log.h"
#include "base/root.h"
#include "link/hold.h"

enum { SW_TOOL_PADS = 16 }; /* most obstacles of a tool [-] */

enum {
  SW_JAW_STILL, /* stay */
  SW_JAW_TO,    /* go to an opening, unless a force stops them */
  SW_JAW_FORCE  /* close until there is a force, and keep it */
};

enum {
  SW_JAW_RESTS,
  SW_JAW_MOVES,
  SW_JAW_HOLDS,   /* with the wanted force */
  SW_JAW_STOPPED, /* by the allowed force */
  SW_JAW_EMPTY    /* closed, without the wanted force */
};

/* State of the tool and its grip. */
typedef struct sw_tool_state {
  double opening;      /* [m] */
  int status;          /* of the jaws */
  double squeeze;      /* force per finger against opening [N] */
  double normal, most; /* normal force of the pads, friction that it allows [N] */
  double margin;  /* friction and its moment over the touches' resistance; of a frozen grip: force
                     and moment over those that its touches could balance [-] */
  double sliding; /* share of the force at touches that slide [-] */
  double slip;    /* longest way of a touch by `slipped` and `turned` [m] */
  sw_vec slipped; /* slip of the wires since the last order to the jaws, in the tool's axes
                     [m] */
  sw_vec turned;  /* turn of the wires between the pads since then, in the same axes [rad] */
  sw_vec centre;  /* of the tool, in the world [m] */
  sw_quat q;      /* its orientation [-] */
  double place;   /* arc length of the wire between the pads [m] */
  double slip_time, slip_place; /* when and where the slip exceeded the tolerance; NAN = it did not
                                   [s], [m] */
  int frozen;                   /* 1: a rigid grip stands for the pads */
  double crash_time;            /* last crash of a part into an obstacle; NAN = never [s] */
  double crash_depth;           /* depth of that crash [m] */
  const char *crash_part, *crash_obstacle; /* their names, owned by the scene */
  double lost_time; /* when the margin of a frozen grip was used up, or pads that pressed on
                       something lost it; NAN = neither [s] */
} sw_tool_state;

/* The jaws of a tool. Their opening at time t is opening + speed (t - since). */
typedef struct sw_jaw {
  int mode;         /* SW_JAW_STILL, ... */
  int status;       /* SW_JAW_RESTS, ... */
  double opening;   /* at the time `since` [m] */
  double since;     /* [s] */
  double step;      /* size of the present step; 0 = none [s] */
  double speed;     /* of this step; below 0 the jaws close [m/s] */
  double most;      /* highest speed [m/s] */
  double goal;      /* opening to go to [m] */
  double force;     /* per finger: wanted force, or limit at which the jaws stop [N] */
  double now;       /* force per finger of the accepted state [N] */
  double stiffness; /* stiffness of the wires between the jaws, found last; 0 = not known [N/m] */
  sw_bracket found; /* speeds with too little force and with too much [m/s], [N] */
  int trials, guessed;
} sw_jaw;

/* Returns the opening at time t [m]. */
static inline double sw_jaw_at(const sw_jaw *jaw, double t) {
  return jaw->opening + jaw->speed * (t - jaw->since);
}

typedef struct sw_tool_pad {
  size_t obstacle; /* slot */
  int finger;      /* [-] */
} sw_tool_pad;

typedef struct sw_frozen sw_frozen; /* what pads held, see grip/frozen.h; shared and immutable */

/* The core's gripper: a frame that moves, with jaws and pads in it. */
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
  sw_vec way, swing; /* slip and turn in the searches for the pose that is not accepted yet, in the
                        tool's axes; not stored [m], [rad] */
  int searched;      /* 1: those contain the slips of the present touches */
  double tolerance;  /* slip above this is an event [m] */
  int stops;         /* 1: a run ends with the step in which the wire slips */
  sw_crash crash;    /* the last one */
  int crashing;      /* 1: the last crash goes on */
  sw_log log;
  void *room; /* growing buffer for the touches of the pads */
  size_t room_size;
} sw_tool;

/* 1 if the obstacle of this number is one of the tool's pads. */
static inline int sw_tool_is_pad(const sw_tool *t, int obstacle) {
  for (size_t k = 0; k < t->pads; k++)
    if (t->pad[k].obstacle == (size_t)obstacle) return 1;
  return 0;
}

#endif
