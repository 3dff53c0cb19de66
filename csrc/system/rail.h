/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nodes that stay on curves. The place p on the curve c, by arc length, is a freedom of the system
 * like the nodes' coordinates, so every implicit method advances it with its own order. The node is
 * held on the curve in a frame with place X, rotation R and rates V, w: x = X + R c, v = V + w x R
 * c + R c' p., a = ... + R c' p.. + R c'' p.^2, exact to rounding. The equation for p: the reaction
 * F on the node has c'.F equal to the friction of its part across. It is solved with the others by
 * its Schur complement: they follow a shift of the node by K^-1 times its column, one more solve
 * with the same factors. */
#ifndef SW_SYSTEM_RAIL_H
#define SW_SYSTEM_RAIL_H

#include "system/system.h"

/* Place, and rates by p, of a curve at arc length p, in the axes of its frame. */
typedef struct sw_rail_point {
  sw_vec x, along, bend; /* [m], [-], [1/m] */
} sw_rail_point;

enum { SW_RAIL_GOES, SW_RAIL_STICKS, SW_RAIL_AT_FROM, SW_RAIL_AT_TO };

typedef struct sw_rail {
  size_t held; /* number of its held node */
  const void *curve;
  void (*at)(const void *curve, double p, sw_rail_point *out);
  double from, to;    /* ends that stop it; infinite: none [m] */
  double friction;    /* [-] */
  double p, v, a;     /* as it is when the system is made [m], [m/s], [m/s2] */
  double rubs;        /* friction alone, of it [N] */
  double force;       /* along the curve on the node, of the last stage [N] */
  int state;          /* of the iterate: SW_RAIL_GOES, ... */
  double way;         /* where it goes, +1 or -1 [-] */
  double step;        /* of the last update [m] */
  int open;           /* 1: the last update is not the stage's last */
  double own[9];      /* the node's own block [N/m] */
  sw_vec along, bend; /* at the iterate, world axes [-], [1/m] */
  sw_vec before;      /* reaction left by the update of the other unknowns alone [N] */
} sw_rail;

/* After the held nodes: the rails (count), their places into the state. SW_ENOMEM. */
sw_status sw_system_set_rails(sw_system *system, const sw_rail *rails, size_t count);
/* Where in x, v and a the place of rail k is. */
size_t sw_rail_freedom(const sw_system *system, size_t rail);
/* Rails' nodes for the places in x, with rates in v and a; each may be NULL, v and a go with x. */
void sw_rails_place(const sw_system *system, const double *x, double *v, double *a, double *to);

/* The nodes of a body are given the velocity v + omega x (x - about): its rails' places go on with
 * the part of it along their curves. */
void sw_rails_launch(sw_system *system, size_t body, sw_vec v, sw_vec omega, sw_vec about);

/* A stage begins; its iterate changed; velocities for forces; it was solved. */
void sw_rails_begin(sw_system *system, const sw_stage *stage, int statics);
void sw_rails_follow(sw_system *system, const sw_stage *stage, int statics);
void sw_rails_velocity(const sw_system *system, const sw_stage *stage, double *velocity);
void sw_rails_finish(sw_system *system, const sw_stage *stage);
/* A rail's row is about to be taken out of the equations. */
void sw_rail_take(sw_rail *rail, const sw_body *body, size_t i);
/* The other unknowns are solved for: the rails, and what follows them. */
void sw_rails_solve(sw_system *system, const sw_stage *stage, size_t *negative);
void sw_rails_apply(sw_system *system, const sw_stage *stage, double share);
/* 1: in the trial a moving one has stuck, or reached or left an end. */
int sw_rails_struck(const sw_system *system);
int sw_rails_settled(const sw_system *system);

#endif
