/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Holds: links that impose a motion on part of one wire. */
#ifndef SW_LINK_HOLD_H
#define SW_LINK_HOLD_H

#include "base/log.h"
#include "link/curve.h"
#include "link/feeding.h"
#include "link/link.h"
#include "motion/motion.h"
#include "state/mesh.h"
#include "system/system.h"

/* The wire of a link, as seen by the link. */
typedef struct sw_link_wire {
  const char *name;
  sw_mesh *mesh;
  const sw_beam *beam;
  int bends;   /* 1: it resists bending; set for joints only */
  double time; /* of the scene [s] */
  /* only while the system is built: */
  sw_system *system;
  size_t body;
  void *user;
  void (*reshaped)(void *user, size_t body, size_t node); /* a node's unloaded shape changed */
} sw_link_wire;

/* Where a driven thing is: at rest at a pose or following a motion. */
typedef struct sw_drive {
  sw_pose pose;      /* at rest */
  sw_motion *motion; /* NULL = at rest */
  double start;      /* scene time of the motion's zero [s] */
  size_t tool;       /* 1 + slot of the tool that carries it, in whose frame pose is; 0 = none */
  sw_vec opens;      /* how it moves in that frame with the jaws' opening [m/m] */
} sw_drive;

typedef struct sw_crash {
  double time, depth;    /* when a part ran into an obstacle and how deep it was then [s], [m] */
  size_t part, obstacle; /* slots */
} sw_crash;

/* Watches whether the hold is driven into an obstacle (watch/hold_crash.c). */
typedef struct sw_hold_watch {
  int looking;    /* 1: it has been checked at least once */
  int crashing;   /* 1: it is in an obstacle too deep at present */
  double looked;  /* time of the last check [s] */
  double given;   /* depth in an obstacle at the first check [m] */
  sw_crash crash; /* the last one, with part unused; depth 0: none */
  int over;       /* what touches the held part, see watch/passed.c; not in files */
} sw_hold_watch;

/* Impulse, and its moment, that a hold bears up to each stage of a trial step [N s], [N m s]. */
typedef struct sw_hold_sums {
  sw_vec force[SW_BOOK_STAGES], moment[SW_BOOK_STAGES];
  int last;  /* stage booked last */
  int known; /* 1: they belong to the step that led to this state */
} sw_hold_sums;

typedef struct sw_hold {
  uint32_t generation;
  int alive;
  char name[SW_NAME_SIZE];
  const sw_link_class *cls;
  size_t wire;
  sw_hold_args args; /* as asked for */
  double scale;      /* of the wire's mesh when args were given [-] */
  uint32_t shape;    /* changes whenever s1 .. frame change */
  int formed;        /* 1: the wire between its ends is unstressed at the held distances */
  double s1, s2;     /* held interval, nodes of the mesh [m] */
  sw_drive drive;
  size_t count;                 /* held places */
  double *s;                    /* (count) arc lengths when grasped [m] */
  double *local;                /* (count x 3) in the hold's frame [m] */
  uint32_t *particle;           /* (count) particles of a mesh; NULL on other wires */
  sw_vec director[2];           /* where the wire arrives and leaves; in the hold's frame [-] */
  sw_mesh_frame frame[2];       /* the wire's frames there, as held, if it has frames */
  sw_clamp_give give[2];        /* give of the hold there, see state/plan.h */
  sw_quat turn;                 /* orientation that goes with the wire's twist, while not built */
  size_t node, number;          /* first node in the plan, number in the system; while built */
  size_t rail;                  /* number in the system, if the class has a rail; while built */
  sw_feed feed;                 /* of a class that feeds */
  sw_slider slider;             /* of a class with a rail */
  sw_vec force, moment;         /* last read-outs, kept after release [N], [N m] */
  sw_vec end_force, end_moment; /* the same of the stage that ended the last step, from which the
                                 * next step starts [N], [N m] */
  sw_hold_watch watch;
  sw_hold_sums sums; /* of the present step */
  sw_pose last_pose;
  sw_log log;
} sw_hold;

/* How wire moves through a hold, and the force along it. stage and obeys differ from force where
 * the method's axial forces are off (sw_system_bears). */
typedef struct sw_hold_way {
  double way, speed; /* [m], [m/s] */
  double force;      /* moves the wire along the way, as read out [N] */
  double stage;      /* the same by the last stage [N] */
  double obeys;      /* the same as a force-controlled drive compares it with its target [N] */
  double slipped;    /* part of the way that was not asked for [m] */
  sw_vec direction;  /* of the force; set only when nodes are given [-] */
} sw_hold_way;

/* A request to a hold that users may make at any time. */
typedef struct sw_hold_order {
  const char *name; /* NULL ends a list */
  int jumps;        /* 1: the wire's velocity jumps */
  /* The scene is at the wire's time. motion leads to value, or is NULL. */
  sw_status (*give)(sw_hold *hold, const sw_link_wire *wire, double value, sw_motion *motion,
                    sw_error *err);
} sw_hold_order;

/* Functions and properties of a hold class. Functions may be NULL. */
typedef struct sw_hold_acts {
  const sw_hold_order *orders; /* or NULL */
  const char *const *outputs;  /* names of the values of read, NULL-terminated, or NULL */
  void (*read)(const sw_hold *hold, double t, double *out);
  int direction; /* 1: it also holds the wire's direction */
  int lines;     /* 1: only on wires that are lines, not meshes of particles */
  /* Checks the arguments before anything changes, and adapts them to this wire. SW_EINVAL. */
  sw_status (*check)(const sw_link_wire *wire, sw_hold_args *args, sw_error *err);
  /* Begins a new hold whose nodes are in place. SW_ENOMEM. */
  sw_status (*begin)(sw_hold *hold, const sw_link_wire *wire);
  void (*clear)(sw_hold *hold);
  /* Adds the wire's motion in the hold's frame at time t to the hold's state. inner: see sw_stage
   * [s]. */
  void (*place)(sw_hold *hold, const sw_link_wire *wire, double t, double inner,
                sw_hold_state *state);
  /* A state was accepted and the scene has its time: updates mesh and hold. Returns 1 if velocities
   * jumped. */
  int (*follow)(sw_hold *hold, const sw_link_wire *wire);
  /* Sets the plan back to the mesh before the mesh is read. */
  void (*undo)(sw_hold *hold, const sw_link_wire *wire);
  /* Returns the way of passing wire at time t with nodes at x. x = NULL: with the last force. */
  sw_hold_way (*passes)(const sw_hold *hold, const sw_link_wire *wire, double t, const double *x);
  /* For classes through which wire passes. guide: where nodes come and go. slips: the drive that
   * yields to a force; NULL: none does at present. */
  sw_guide *(*guide)(sw_hold *hold);
  sw_slip *(*slips)(sw_hold *hold);
  /* Describes the rail of the system on which the node stays. */
  void (*rail)(const sw_hold *hold, sw_rail *out);
  /* get: the present arguments. set: takes over those that may change later. */
  void (*get)(const sw_hold *hold, sw_hold_args *args);
  void (*set)(sw_hold *hold, const sw_hold_args *args);
  /* 1 if the hold read from a tape fits the wire. */
  int (*fits)(const sw_hold *hold, const sw_link_wire *wire);
  /* Writes or reads the class's own state, in addition to the fields of all holds. */
  void (*tape)(sw_tape *tape, sw_hold *hold);
} sw_hold_acts;

/* 1 if wire passes through the hold. */
static inline int sw_hold_passes(const sw_hold *hold) { return hold->cls->hold->passes != NULL; }

void sw_hold_clear(sw_hold *hold); /* frees its memory */
/* Clears the arguments that are not kept with the others. */
void sw_hold_forget(sw_hold_args *args);

#endif
