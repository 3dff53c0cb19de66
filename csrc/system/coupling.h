/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Outside influences on a system: holds place nodes, and couplings (contact) add forces in every
 * iteration. */
#ifndef SW_SYSTEM_COUPLING_H
#define SW_SYSTEM_COUPLING_H

#include <stddef.h>

#include "base/status.h"
#include "base/vec.h"
#include "system/body.h"

typedef struct sw_system sw_system;

/* Pose and motion of a hold, common to all its nodes. */
typedef struct sw_hold_state {
  sw_pose pose;              /* [m], [-] */
  sw_vec v, a, omega, alpha; /* [m/s], [m/s2], [rad/s], [rad/s2] */
  sw_vec ahead; /* in an inner stage: of wire that passes, by which it is ahead of its path [m] */
  double flow;  /* speed of wire that leaves the hold along the arc length, without load [m/s] */
} sw_hold_state;

/* Force and moment of a hold on its wire [N], [N m]. */
typedef struct sw_hold_load {
  sw_vec force, moment;
} sw_hold_load;

/* A hold of a wire that may wait (system/wait.h). */
typedef struct sw_standing {
  int stands;        /* 1: it does not move in this step */
  size_t body;       /* the wire */
  sw_hold_load load; /* at the end of the last step, about the hold's place */
} sw_standing;

/* A node that follows a hold: x = pose * local. */
typedef struct sw_held_node {
  size_t node; /* in the system's arrays */
  size_t body;
  int hold;
  size_t rail;      /* number of its rail + 1, or 0 (see system/rail.h) */
  int slides;       /* 1: the wire slides through, with another velocity than the node's */
  sw_vec local;     /* [m] */
  double saved[36]; /* its matrix blocks with the nodes -2 -1 +1 +2 [N/m] */
  double own[6];    /* its own matrix block, upper half: in statics the node moves too [N/m] */
  sw_vec own_force; /* inertia minus forces before the last solve [N] */
  sw_vec reaction;  /* force on the wire that holds the node [N] */
  size_t kept;      /* its place in the system's strains; 0: none */
  sw_vec shift;     /* in an inner stage: of its place, by which it is ahead of its path [m] */
  sw_pose exact;    /* in an inner stage: of its hold, on its path [m], [-] */
  size_t next;      /* number of its body's next held node + 1, or 0; set for each stage */
} sw_held_node;

enum { SW_BOOK_STAGES = 2 };

/* Impulse of outside forces from a step's start to a stage: the same weighted sum of forces and
 * earlier impulses as for the stage's velocity. */
typedef struct sw_booking {
  int stage;     /* number of the stage; replaces its earlier booking [-] */
  double own;    /* weight of the forces of the last evaluation [s] */
  double start;  /* weight of the forces at the step's start, which is the last step's end [s] */
  double first;  /* weight of the impulse up to stage 0 [-] */
  double before; /* weight of the previous step's impulse, counted backwards [-] */
} sw_booking;

/* A coupling: forces besides the wires' own. Every function may be NULL. The first argument of each
 * is user. */
typedef struct sw_coupling {
  void *user;
  /* Pose of hold number k at a time. */
  sw_status (*place)(void *user, int hold, double time, sw_hold_state *out, sw_error *err);
  /* A stage begins. first: weight of the step's first stage in xhat [-]. */
  sw_status (*begin_stage)(void *user, sw_system *system, double time, double first, sw_error *err);
  /* Bodies are solved in parts (system/part.h): first those without coupling, one by one; then the
   * coupled ones, marked by begin_stage, together. Until the next call the coupling acts on the
   * bodies of this part only. Each part comes once per stage, single bodies in order; then all
   * bodies again. NULL: it always acts on all together. */
  void (*part)(void *user, sw_system *system);
  /* Adds forces and matrix rows at y to the bodies' fields. */
  sw_status (*eval)(void *user, sw_system *system, double time, double hbar, const double *y,
                    unsigned want, sw_error *err);
  /* Before eval at y: out = 1 if the stiffness of the last eval still holds, apart from small
   * rotations. NULL: never. */
  sw_status (*keeps)(void *user, sw_system *system, const double *y, int *out, sw_error *err);
  /* delta solves the last eval's linearisation. Corrects delta for forces that depend on it
   * nonlinearly, by more solves with the same factors. Returns the share of delta to apply: 1, or
   * less where the forces do not agree with delta [-]. */
  double (*refine)(void *user, sw_system *system);
  /* After the update delta, which reached y: 1 = converged. */
  int (*settled)(void *user, sw_system *system, const double *y, const double *delta);
  /* Books the impulse after a solved stage or an explicit method's evaluation. */
  void (*book)(void *user, const sw_booking *booking);
} sw_coupling;

/* --- while the coupling refines a solution ----------------------------------- */

/* 1 if the body's equations can be solved again with the present factors (system/body.h). */
int sw_body_solves_again(const sw_system *system, const sw_body *body);
/* 1 if sw_body_solve_rolling_again works for the body. */
int sw_body_rolls_again(const sw_system *system, const sw_body *body);
/* Similar functions for all bodies with bridges. solve_again: turns forces on the system's nodes
 * (nodes x 3) into the change of the solution by these forces, zero for other bodies.
 * take_solution: the system's delta is the last solution. */
int sw_bridges_solves_again(const sw_system *system);
void sw_bridges_solve_again(sw_system *system, double *more);
void sw_bridges_take_solution(sw_system *system);
/* Sum over bridged bodies of right-hand side times solution, without spins [J]. */
double sw_bridges_work(const sw_system *system);

#endif
