/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How a scene goes on: steps of motion up to a time, equilibria at rest, and poses from one to the
 * next. What happens in which order is listed in stages.def. */
#ifndef SW_STEP_STEP_H
#define SW_STEP_STEP_H

#include "scene/scene.h"

/* --- running ---------------------------------------------------------------- */

typedef struct sw_run_args {
  double duration;  /* [s] */
  double dt;        /* step, or largest step with a tolerance [s] */
  double tolerance; /* on the step error; NAN = fixed steps [m] */
  int integrator;   /* index into sw_integrator_all() */
  double frame;     /* time between stored frames; NAN = none [s] */
  int quasistatic;  /* 1: equilibrium at every step's end instead of motion */
  long max_steps;   /* stop after this many [-] */
  double window;    /* peaks are of means over this time; 0: of values of single steps [s] */
  int unstable;     /* 1: an explicit method may take steps above its limit */
  int parts;        /* 1: steps too coarse for how wires move are taken in parts */
  int wear;         /* 1: what wears wires is kept; told when the run begins */
} sw_run_args;
extern const sw_params sw_run_params;

/* A run begins: extremes of wires and of penetration start anew. wear: is that of wires kept? */
sw_status sw_scene_begin_run(sw_scene *scene, int wear, sw_error *err);

/* The run has ended: tell what there is to tell. SW_EDIVERGED when it made too much energy to be
 * believed; the scene then refuses to be read. */
sw_status sw_scene_end_run(sw_scene *scene, sw_error *why);

typedef struct sw_run_report {
  sw_status status; /* SW_OK, SW_EDIVERGED, SW_EINTR, SW_ECALLBACK, ... */
  double time;      /* reached [s] */
  size_t steps, rejected, iterations, evaluations; /* [-] */
  size_t solves;                                   /* of each body's own matrix [-] */
  size_t looks;       /* of contact at obstacles and lists, to find what may touch [-] */
  double smallest_dt; /* [s] */
  size_t jumps;       /* quasi-static steps in which wires jumped [-] */
  double last_jump;   /* time of the last one [s] */
  sw_error reason;    /* why it stopped, when not SW_OK */
} sw_run_report;

/* Somebody who looks at the scene between two steps: it can be read then, and not be changed. */
typedef struct sw_observer {
  double at;   /* due at the first step's end from then on [s] */
  double wall; /* or once sw_wall_clock() is there [s] */
  int stop;    /* 1: advance no further, all is well */
  /* Called when it is due; sets what is due next, and stop. Any failure ends the run. */
  sw_status (*look)(struct sw_observer *observer, sw_error *err);
  void *user;
} sw_observer;

/* A clock that is never set [s]. */
double sw_wall_clock(void);

/* Advance to time until. interrupted (may be NULL) is polled between steps; observer may be NULL.
 * A divergence is told in the report and the function returns SW_OK; a returned
 * error means that nothing was done. */
sw_status sw_scene_advance(sw_scene *scene, const sw_run_args *args, double until,
                           int (*interrupted)(void), sw_observer *observer, sw_run_report *report,
                           sw_error *err);

typedef struct sw_settle_args {
  double tolerance;    /* largest node shift of the last iteration [m] */
  long max_iterations; /* [-] */
  int stays;   /* 1: wires that find no rest near by go nowhere, for a shorter way may have one */
  int relaxes; /* 1: what is stiff comes to rest first, and stays so if nothing else does */
} sw_settle_args;
extern const sw_params sw_settle_params;

typedef struct sw_settle_report {
  int ok;
  size_t iterations; /* matrix solves [-] */
  size_t negative;   /* unstable directions of the equilibrium found [-] */
  int transient;     /* 1: pseudo-transient continuation was needed */
  int relaxed;       /* 1: what is stiff is at rest, if nothing else */
  double residual;   /* largest node shift of the last iteration [m] */
  int jumped;        /* 1: the wires moved much further than what drives them */
  sw_error reason;
} sw_settle_report;

sw_status sw_scene_settle(sw_scene *scene, const sw_settle_args *args, int (*interrupted)(void),
                          sw_settle_report *report, sw_error *err);

/* The built scene comes to rest where it is: nothing is told or observed. On failure it is as
 * before. */
sw_status sw_scene_balance(sw_scene *scene, double tolerance, long most, sw_error *err);

/* Largest stable step of leapfrog [s]. */
sw_status sw_scene_stable_dt(sw_scene *scene, double *dt, sw_error *err);

#endif
