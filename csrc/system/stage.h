/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An implicit stage of a system: what a method gives and gets (sw_system_stage). */
#ifndef SW_SYSTEM_STAGE_H
#define SW_SYSTEM_STAGE_H

#include <stddef.h>

/* Newton controls, all [-] unless noted. */
typedef struct sw_newton {
  int max_iterations;
  int keeps_energy;       /* 1: updates may leave little energy in taut edges */
  double accept_rotation; /* largest edge rotation of the last update [rad] */
  double limit_rotation;  /* larger updates are shortened to this [rad] */
  int statics;            /* 1: no inertia */
  int counts;             /* 1: the number of negative pivots must be that of the whole stiffness */
  int most_far; /* statics: number of updates beyond limit_rotation, made or not, after which a
                   solve of touching wires ends; 0: no limit [-] */
  double accept_shift; /* statics: largest node shift of the last update [m] */
} sw_newton;

typedef struct sw_stage {
  double time; /* at the stage's end [s] */
  /* to > from: the state lies beyond the stage, extrapolated from `from` through the stage to `to`.
   * Holds are then placed on the straight line between their poses at `from` and `to`, so that
   * wires end at the holds. The pose of an accelerating hold at the stage's time would bend a stiff
   * wire [s]. */
  double from, to;
  /* > 0: an inner stage of first order, this long. Wires move in it by its length times their
   * velocity at its end, and so do holds and obstacles: see system/inner.h [s]. */
  double inner;
  double hbar;    /* [s] */
  double inertia; /* factor of the mass, for methods that take forces and accelerations at different
                     times; 0 means 1 [-] */
  double first;   /* weight of the step's first stage in xhat [-] */
  const double *xhat; /* (freedoms): velocity = (y - xhat)/hbar [m], [rad] */
  const double *vhat; /* (freedoms): acceleration = inertia (velocity - vhat)/hbar [m/s] */
  double *y;          /* out: positions [m] */
  double *v;          /* out: velocities [m/s] */
  double *a;          /* out: accelerations, or NULL [m/s2] */
  /* with dashpots (strains): strain rate = (strain - strain_past)/hbar; NULL without them, and in
   * statics [-] */
  const double *strain_past;
  double *strain; /* in: a guess, out: the solved stage's [-] */
} sw_stage;

typedef struct sw_stage_report {
  int iterations;
  double rotation; /* of the last update [rad] */
  double share;    /* share of it that the coupling allows [-] */
  size_t negative; /* negative pivots of the last matrix */
} sw_stage_report;

/* 1 if a drive goes ahead of its path in an inner stage: its way differs from the mean of both
 * speeds times the stage by `off`, less than a share of the shift. At the start of a minimum-jerk
 * motion it does by 0.25; where a motion starts or stops within the stage, by more [m]. */
static inline int sw_inner_goes_ahead(double off, double shift) {
  const double even = 0.3; /* [-] */
  return off < even * shift;
}

#endif
