/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Advances a scene: steps of motion up to a time, equilibria, and poses from one equilibrium to the
 * next. stages.def lists the stages of each in their order. */
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
  long max_steps;   /* stop after this many steps [-] */
  double window;    /* peaks are of means over this time; 0: of single steps [s] */
  int unstable;     /* 1: an explicit method may take steps above its stable step */
  int parts;        /* 1: steps too coarse for the motion of the wires are divided */
  int wear;         /* 1: wear of wires is recorded; passed on when the run begins */
  int unsettled;    /* 1: in poses, wires move where no equilibrium is found */
} sw_run_args;
extern const sw_params sw_run_params;

/* Begins a run: extremes of wires and of penetration start anew. wear: 1 = wear of wires is
 * recorded. */
sw_status sw_scene_begin_run(sw_scene *scene, int wear, sw_error *err);

/* Ends the run: logs its final events. SW_EDIVERGED when it made too much energy to be believed;
 * the scene then refuses to be read. */
sw_status sw_scene_end_run(sw_scene *scene, sw_error *why);

typedef struct sw_run_report {
  sw_status status; /* SW_OK, SW_EDIVERGED, SW_EINTR, SW_ECALLBACK, ... */
  double time;      /* reached time [s] */
  size_t steps, rejected, iterations, evaluations; /* [-] */
  size_t solves;                                   /* solves of single bodies' matrices [-] */
  size_t looks;       /* searches for possible touches, at obstacles and in lists [-] */
  double smallest_dt; /* [s] */
  size_t jumps;       /* quasi-static steps in which wires jumped [-] */
  double last_jump;   /* time of the last jump [s] */
  sw_error reason;    /* why the run stopped, unless status is SW_OK */
} sw_run_report;

/* An observer reads the scene between two steps. It must not change it. */
typedef struct sw_observer {
  double at;   /* due at the end of the first step that reaches this time [s] */
  double wall; /* or once sw_wall_clock() reaches this [s] */
  int stop;    /* 1: advance no further; not an error */
  /* Called when due; sets stop and when it is due next. Any failure ends the run. */
  sw_status (*look)(struct sw_observer *observer, sw_error *err);
  void *user;
} sw_observer;

/* Returns the time of a monotonic clock [s]. */
double sw_wall_clock(void);

/* Advances to the time `until`. interrupted (may be NULL) is polled between steps; observer may be
 * NULL. After a divergence the function returns SW_OK and the report tells it. A returned error
 * means that nothing was done. */
sw_status sw_scene_advance(sw_scene *scene, const sw_run_args *args, double until,
                           int (*interrupted)(void), sw_observer *observer, sw_run_report *report,
                           sw_error *err);

typedef struct sw_settle_args {
  double tolerance;    /* largest node shift of the last iteration [m] */
  long max_iterations; /* [-] */
  int stays;   /* 1: give up if there is no equilibrium near by, because a shorter path may have one
                */
  int relaxes; /* 1: stiff modes come to rest first, and keep that if the full equilibrium is not
                  found */
  int poses;   /* 1: one of many poses, between which jaws need not be exact */
  int tight;   /* 1: wires drawn taut may be in each other only a little */
  double farthest; /* largest allowed shift of a node on the way to rest; 0: any [m] */
  int holds;       /* 1: a wire leaves pads that hold it only by short steps of continuation */
  int passing; /* 1: a pose on the way to the next one that is asked for; it need not be exact */
} sw_settle_args;
extern const sw_params sw_settle_params;

typedef struct sw_settle_report {
  int ok;
  size_t iterations; /* matrix solves [-] */
  size_t negative;   /* unstable directions of the equilibrium found [-] */
  int transient;     /* 1: pseudo-transient continuation was needed */
  int relaxed;       /* 1: stiff modes are at rest, even if slow ones are not */
  double residual;   /* largest node shift of the last iteration [m] */
  int far;           /* 1: the wires moved far */
  int jumped;        /* 1: the wires moved much further than their holds and obstacles */
  int falls;         /* 1: a wire falls without limit */
  sw_error reason;
  double rubbed; /* lost by friction on the way, before the last part of the holds' path [J] */
} sw_settle_report;

sw_status sw_scene_settle(sw_scene *scene, const sw_settle_args *args, int (*interrupted)(void),
                          sw_settle_report *report, sw_error *err);

/* Brings the built scene to rest at its time, without events or records. If it fails, the scene is
 * as before. */
sw_status sw_scene_balance(sw_scene *scene, double tolerance, long most, sw_error *err);

/* Largest stable step of leapfrog [s]. */
sw_status sw_scene_stable_dt(sw_scene *scene, double *dt, sw_error *err);

#endif
