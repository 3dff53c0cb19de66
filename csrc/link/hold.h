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

/* The wire of a link, as the scene has it. */
typedef struct sw_link_wire {
  const char *name;
  sw_mesh *mesh;
  const sw_beam *beam;
  int bends;   /* 1: it resists bending; of joints only */
  double time; /* of the scene [s] */
  /* while it is built */
  sw_system *system;
  size_t body;
  void *user;
  void (*reshaped)(void *user, size_t body, size_t node); /* another unloaded shape at a node */
} sw_link_wire;

/* Where something driven is: at rest at a pose or following a motion. */
typedef struct sw_drive {
  sw_pose pose;      /* at rest */
  sw_motion *motion; /* NULL = at rest */
  double start;      /* scene time of the motion's zero [s] */
  size_t tool;       /* 1 + slot of the tool that carries it, in whose frame pose is; 0 = none */
  sw_vec opens;      /* how it moves in that frame with the jaws' opening [m/m] */
} sw_drive;

typedef struct sw_crash {
  double time, depth;    /* when a part ran into an obstacle, how far then [s], [m] */
  size_t part, obstacle; /* slots */
} sw_crash;

/* Is it driven into an obstacle? */
typedef struct sw_hold_watch {
  int looking;    /* 1: it has been looked at */
  int crashing;   /* 1: it is driven into one now */
  double looked;  /* when last [s] */
  double given;   /* how deep it was in one to begin with [m] */
  sw_crash crash; /* the last one, of no part; depth 0: none */
} sw_hold_watch;

/* Impulse and its moment that a hold bears up to each stage of a trial step [N s], [N m s]. */
typedef struct sw_hold_sums {
  sw_vec force[SW_BOOK_STAGES], moment[SW_BOOK_STAGES];
  int last;  /* stage booked last */
  int known; /* 1: they belong to the step that led here */
} sw_hold_sums;

typedef struct sw_hold {
  uint32_t generation;
  int alive;
  char name[SW_NAME_SIZE];
  const sw_link_class *cls;
  size_t wire;
  sw_hold_args args; /* as asked for */
  double scale;      /* of the wire's mesh when it was asked for [-] */
  uint32_t shape;    /* another number when s1 .. frame are others */
  int formed;        /* 1: between its ends the wire is as long without force as it lies */
  double s1, s2;     /* held interval, nodes of the mesh [m] */
  sw_drive drive;
  size_t count;                 /* held places */
  double *s;                    /* (count) arc lengths when taken hold of [m] */
  double *local;                /* (count x 3) in the hold's frame [m] */
  uint32_t *particle;           /* (count) which ones of a mesh; NULL on other wires */
  sw_vec director[2];           /* arriving, leaving; in the hold's frame [-] */
  sw_mesh_frame frame[2];       /* the wire's there, with directions as held; if it has frames */
  sw_clamp_give give[2];        /* likewise */
  sw_quat turn;                 /* orientation that goes with the wire's twist, while not built */
  size_t node, number;          /* first node in the wire's plan, among the system's; while built */
  size_t rail;                  /* among the system's rails, if its class has one; while built */
  sw_feed feed;                 /* of a class that feeds */
  sw_slider slider;             /* of one with a rail */
  sw_vec force, moment;         /* last, kept after release [N], [N m] */
  sw_vec end_force, end_moment; /* of the stage that the last step ended with, which the next one
                                 * goes on from [N], [N m] */
  sw_hold_watch watch;
  sw_hold_sums sums; /* of the present step */
  sw_pose last_pose;
  sw_log log;
} sw_hold;

/* A way of its own that a hold lets the wire go, and the force along it. */
typedef struct sw_hold_way {
  double way, speed; /* [m], [m/s] */
  double force;      /* that moves the wire along it [N] */
  double stage;   /* the same of the last stage, and what a drive that obeys a force is to obey, */
  double obeys;   /* which differ where the method's are off (sw_system_bears) [N] */
  double slipped; /* of the way, what was not asked for [m] */
  sw_vec direction; /* in which that force acts, where the wire's place is known [-] */
} sw_hold_way;

/* What a user may ask of a hold at any time. */
typedef struct sw_hold_order {
  const char *name; /* NULL ends a list */
  int jumps;        /* 1: the wire's velocity jumps */
  /* With the scene at the time of the wire; motion: where value is the end of one, or NULL. */
  sw_status (*give)(sw_hold *hold, const sw_link_wire *wire, double value, sw_motion *motion,
                    sw_error *err);
} sw_hold_order;

/* What a hold does; functions may be NULL. */
typedef struct sw_hold_acts {
  const sw_hold_order *orders; /* or NULL */
  const char *const *outputs;  /* names of what read gives, NULL-terminated, or NULL */
  void (*read)(const sw_hold *hold, double t, double *out);
  int direction; /* 1: it keeps the wire's direction too */
  int lines;     /* 1: only of wires that are lines, not meshes of particles */
  /* Before anything is changed; arguments become what they mean for this wire. SW_EINVAL. */
  sw_status (*check)(const sw_link_wire *wire, sw_hold_args *args, sw_error *err);
  /* A new hold, its nodes in place. SW_ENOMEM. */
  sw_status (*begin)(sw_hold *hold, const sw_link_wire *wire);
  void (*clear)(sw_hold *hold);
  /* At time t: adds what the wire does in the frame of the hold to its state. */
  void (*place)(sw_hold *hold, const sw_link_wire *wire, double t, sw_hold_state *state);
  /* A state was accepted, and the scene has its time: mesh and hold follow. 1: velocities jumped.
   */
  int (*follow)(sw_hold *hold, const sw_link_wire *wire);
  /* The plan back to the mesh, before this is read. */
  void (*undo)(sw_hold *hold, const sw_link_wire *wire);
  /* Wire goes through it: its way at time t, with nodes at x (NULL: the force as it was last). */
  sw_hold_way (*passes)(const sw_hold *hold, const sw_link_wire *wire, double t, const double *x);
  /* Of one that wire goes through: where nodes come and go; and what gives way to a force, NULL:
   * nothing does now. */
  sw_guide *(*guide)(sw_hold *hold);
  sw_slip *(*slips)(sw_hold *hold);
  /* It keeps its node on a curve, as a rail of the system; place and force of that. */
  void (*rail)(const sw_hold *hold, sw_rail *out);
  /* Arguments as they are now; those that change from now on. */
  void (*get)(const sw_hold *hold, sw_hold_args *args);
  void (*set)(sw_hold *hold, const sw_hold_args *args);
  /* 1: what came from a tape goes with the wire. */
  int (*fits)(const sw_hold *hold, const sw_link_wire *wire);
  /* Puts its own state on a tape, besides the fields that all holds have. */
  void (*tape)(sw_tape *tape, sw_hold *hold);
} sw_hold_acts;

/* 1: wire goes through the hold. */
static inline int sw_hold_passes(const sw_hold *hold) { return hold->cls->hold->passes != NULL; }

void sw_hold_clear(sw_hold *hold); /* what it owns */
/* Arguments that are not kept with the others. */
void sw_hold_forget(sw_hold_args *args);

#endif
