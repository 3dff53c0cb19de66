/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nodes that stay on curves. The place p on the curve c (arc length) is a freedom of the system
 * like the nodes' coordinates, so every implicit method advances it with its own order. The node is
 * held on the curve, in a frame with place X, rotation R and rates V, w: x = X + R c, v = V + w x R
 * c + R c' p., a = ... + R c' p.. + R c'' p.^2, exact to rounding. The equation for p: the
 * component c'.F of the reaction F on the node along the curve equals the friction of the component
 * across. A Schur complement solves it together with the other unknowns: a shift of the node moves
 * them by K^-1 times its column. This takes one more solve with the same factors. */
#ifndef SW_SYSTEM_RAIL_H
#define SW_SYSTEM_RAIL_H

#include "system/system.h"

/* Place on a curve at arc length p and its derivatives by p, in the axes of its frame. */
typedef struct sw_rail_point {
  sw_vec x, along, bend; /* [m], [-], [1/m] */
} sw_rail_point;

enum { SW_RAIL_GOES, SW_RAIL_STICKS, SW_RAIL_AT_FROM, SW_RAIL_AT_TO };

typedef struct sw_rail {
  size_t held; /* number of its held node */
  const void *curve;
  void (*at)(const void *curve, double p, sw_rail_point *out);
  double from, to;    /* stops at the ends; infinite: none [m] */
  double friction;    /* [-] */
  double p, v, a;     /* when the system is made [m], [m/s], [m/s2] */
  double rubs;        /* friction's part of force [N] */
  double force;       /* on the node along the curve, of the last stage [N] */
  int state;          /* of the iterate: SW_RAIL_GOES, ... */
  double way;         /* direction of motion, +1 or -1 [-] */
  double step;        /* change of p in the last update [m] */
  int open;           /* 1: the stage needs another update */
  double left;        /* share of the stiffness along the curve that friction leaves as the node
                         slides, in the last update. Below 0 friction grows faster than what drives
                         the node; infinite without friction [-] */
  double own[9];      /* the node's own block [N/m] */
  sw_vec along, bend; /* at the iterate, world axes [-], [1/m] */
  sw_vec before;      /* reaction after the update of the other unknowns alone [N] */
} sw_rail;

/* After the held nodes are set: sets the rails (count) and puts their places into the state.
 * SW_ENOMEM. */
sw_status sw_system_set_rails(sw_system *system, const sw_rail *rails, size_t count);
/* Returns the index of rail k's arc length in x, v and a. */
size_t sw_rail_freedom(const sw_system *system, size_t rail);
/* Places the rails' nodes for the arc lengths in x, into to. Reads rates and accelerations of the
 * arc lengths from v and a; writes those of the nodes there. to, v and a may be NULL. */
void sw_rails_place(const sw_system *system, const double *x, double *v, double *a, double *to);

/* The nodes of a body got the velocity v + omega x (x - about): sets the rates of its rails to the
 * component along their curves. */
void sw_rails_launch(sw_system *system, size_t body, sw_vec v, sw_vec omega, sw_vec about);

/* begin: a stage begins. follow: its iterate changed. velocity: sets the rail nodes' velocities for
 * forces. finish: the stage is solved. */
void sw_rails_begin(sw_system *system, const sw_stage *stage, int statics);
void sw_rails_follow(sw_system *system, const sw_stage *stage, int statics);
void sw_rails_velocity(const sw_system *system, const sw_stage *stage, double *velocity);
void sw_rails_finish(sw_system *system, const sw_stage *stage);
/* Keeps a rail node's own block before its row is taken out of the equations. */
void sw_rail_take(sw_rail *rail, const sw_body *body, size_t i);
/* solve: after the solve for the other unknowns, finds the rails' steps and adds their effect on
 * the others. apply: makes a share of these steps. */
void sw_rails_solve(sw_system *system, const sw_stage *stage, size_t *negative);
void sw_rails_apply(sw_system *system, const sw_stage *stage, double share);
/* struck: 1 if a moving rail node has stuck in the trial, or has reached or left an end. settled: 1
 * if the stage needs no other update. */
int sw_rails_struck(const sw_system *system);
int sw_rails_settled(const sw_system *system);

#endif
