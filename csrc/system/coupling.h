/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Outside influences on a system: holds, which place its nodes, and couplings (contact), which add
 * forces in every iteration. */
#ifndef SW_SYSTEM_COUPLING_H
#define SW_SYSTEM_COUPLING_H

#include <stddef.h>

#include "base/status.h"
#include "base/vec.h"
#include "system/body.h"

typedef struct sw_system sw_system;

/* Where a hold is, for all nodes it holds. */
typedef struct sw_hold_state {
  sw_pose pose;              /* [m], [-] */
  sw_vec v, a, omega, alpha; /* [m/s], [m/s2], [rad/s], [rad/s2] */
} sw_hold_state;

/* A node that follows a hold: x = pose * local. */
typedef struct sw_held_node {
  size_t node; /* in the system's arrays */
  size_t body;
  int hold;
  size_t rail;      /* number of its rail + 1, or 0 (see system/rail.h) */
  int slides;       /* wire slides through: the wire's velocity differs from the node's */
  sw_vec local;     /* [m] */
  double saved[36]; /* its matrix couplings to the nodes -2 -1 +1 +2 [N/m] */
  double own[6];    /* and to itself, upper half: in statics the update moves it too [N/m] */
  sw_vec own_force; /* inertia minus forces before the last solve [N] */
  sw_vec reaction;  /* force on the wire needed to hold it [N] */
  size_t kept;      /* its place in the system's strains, or 0: it is not there */
  size_t next;      /* number of its body's next one + 1, or 0; as of a stage */
} sw_held_node;

enum { SW_BOOK_STAGES = 2 };

/* Impulse of outside forces from a step's start up to a stage, as a sum of forces and earlier
 * impulses: the same sum as the stage's velocity. */
typedef struct sw_booking {
  int stage;     /* number; what it had before is replaced [-] */
  double own;    /* share of the forces of the last evaluation [s] */
  double start;  /* share of those at the step's start, with which the last step ended [s] */
  double first;  /* share of the impulse up to stage 0 [-] */
  double before; /* of that of the step before, backwards [-] */
} sw_booking;

/* A coupling: forces besides the wires' own. Every function may be NULL. All get user first. */
typedef struct sw_coupling {
  void *user;
  /* Pose of hold number k at a time. */
  sw_status (*place)(void *user, int hold, double time, sw_hold_state *out, sw_error *err);
  /* A stage begins; first: the share of the step's first stage at which it begins [-]. */
  sw_status (*begin_stage)(void *user, sw_system *system, double time, double first, sw_error *err);
  /* The coupling joins no bodies. From now on it acts on system->part alone; parts come in their
   * order, each once in a stage, and then all again. NULL: it acts on all together. */
  void (*part)(void *user, sw_system *system);
  /* Add forces and matrix rows at y to the bodies' fields. */
  sw_status (*eval)(void *user, sw_system *system, double time, double hbar, const double *y,
                    unsigned want, sw_error *err);
  /* Before eval at y: out = 1, the stiffness of the last eval serves again, but for small turns.
   * NULL: never. */
  sw_status (*keeps)(void *user, sw_system *system, const double *y, int *out, sw_error *err);
  /* delta solves the last eval's linearisation. Make it fit forces that depend on it in other ways,
   * by more solves with the same factors. Returns the share of delta that is to be made: 1, or less
   * where forces do not agree with it [-]. */
  double (*refine)(void *user, sw_system *system);
  /* After an update y was reached by the solved delta: 1 = converged. */
  int (*settled)(void *user, sw_system *system, const double *y, const double *delta);
  /* A stage was solved, or an explicit method has evaluated: book the impulse. */
  void (*book)(void *user, const sw_booking *booking);
} sw_coupling;

/* --- while the coupling refines a solution ----------------------------------- */

/* 1: the body's equations can be solved again by the factors that there are (system/body.h). */
int sw_body_solves_again(const sw_system *system, const sw_body *body);
/* The same of all bodies that bridges tie together; by how much forces (of the system's nodes x 3)
 * change the solution, those of other bodies to zero; the system's delta is the last one. */
int sw_bridges_solves_again(const sw_system *system);
void sw_bridges_solve_again(sw_system *system, double *more);
void sw_bridges_take_solution(sw_system *system);
/* Their right-hand sides times their solution, without spins [J]. */
double sw_bridges_work(const sw_system *system);

#endif
