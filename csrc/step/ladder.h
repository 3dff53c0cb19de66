/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ladder of a step of motion. Each rung (listed in stages.def) is responsible for one quantity:
 * it tries the step with the rungs below it and repeats that until the quantity is right. The last
 * rung computes a trial. Private to this room. */
#ifndef SW_STEP_LADDER_H
#define SW_STEP_LADDER_H

#include "step/step.h"

/* How a step that made energy at touches is repeated: first by the method's start method, which
 * uses no earlier acceleration and is of second order too; then with implicit Euler, which makes
 * energy only if touches are wrong. Energy made by the method alone needs a smaller step. */
enum { SW_AS_IS, SW_BY_START, SW_DULLY, SW_GIVE_UP };

typedef struct sw_ladder {
  sw_scene *s;
  const sw_run_args *args;
  sw_run_report *report;
  double until;    /* end of the run [s] */
  double *v_start; /* velocities at the step's start, which impacts change */
  int smallest;    /* 1: no smaller part will be tried */
  int redo;        /* SW_AS_IS, or how a step that made energy is repeated */
  double soonest;  /* time after the start at which a rebound wants the step to end; 0 = none [s] */
  int halts;       /* 1: a drive comes to rest with a deceleration while wires slide */
  int turned;      /* 1: as `halts`, and the method carried wires past their place of rest */
  int brakes;      /* 1: a drive with which wires slide comes to rest soon */
  int cuts;        /* cuts at rebounds in this step [-] */
  double asked;  /* part (substep) that was first tried; later parts are shorter because of refusals
                    or the step's end; 0: dt [s] */
  sw_error held; /* why the last part was rejected */
  int lost;   /* 1: the step ended early, since a frozen grip would bear too much: it thaws first */
  int smooth; /* 1: the last rejected step made energy where nothing touches */
  double made_at; /* start of that step [s] */
  double made;    /* the energy that it made [J] */
  int changed;    /* 1: the scene was changed since the last step; the energy of this step is not
                     judged */
  int unsettled;  /* poses in a row in which no equilibrium was found [-] */
  int falls;      /* 1: because a wire falls without limit */
  double moves_until; /* no equilibrium is looked for until then [s] */
  int (*interrupted)(void);
  sw_observer *observer; /* or NULL */
} sw_ladder;

/* Tries a step of size h with the rungs below. If it fails, the state is as before. */
typedef struct sw_rung sw_rung;
struct sw_rung {
  sw_status (*go)(sw_ladder *p, const sw_rung *below, double h, sw_error *err);
};
static inline sw_status sw_rung_go(sw_ladder *p, const sw_rung *rung, double h, sw_error *err) {
  return rung->go(p, rung + 1, h, err);
}
#define SW_RUNG(name, file, what) \
  sw_status sw_rung_##name(sw_ladder *p, const sw_rung *below, double h, sw_error *err);
#include "step/stages.def"

/* Tries a step of size h on all rungs. smallest: 1 when no smaller step will be tried. */
sw_status sw_ladder_try(sw_ladder *p, double h, int smallest, sw_error *err);
/* Discards a trial that converged. */
void sw_ladder_undo(sw_ladder *p);
/* Makes the trial of size h the state, at time t. */
void sw_ladder_accept(sw_ladder *p, double h, double t);
/* Observes and books the accepted step. SW_ELIMIT: steps have collapsed. */
sw_status sw_ladder_record(sw_ladder *p, double h, sw_error *err);
/* 1 for errors that a smaller step cannot avoid. */
int sw_ladder_hopeless(sw_status status);

/* smallest share of a step [-] */
sw_status sw_step_fixed(sw_ladder *p, double h, double t1, sw_error *err);
sw_status sw_step_adaptive(sw_ladder *p, double left, double t1, sw_error *err);
sw_status sw_step_poses(sw_ladder *p, double t1, sw_error *err);
sw_status sw_step_empty(sw_ladder *p, double t1, sw_error *err);

static const double SW_SMALLEST_SHARE = 1.0 / 4096; /* smallest part tried, as a share of its step
                                                       [-] */

/* Makes the stepper of the run's method, for the present system. */
sw_status sw_ladder_method(sw_scene *scene, const sw_run_args *args, sw_error *err);
/* Makes nodes for the wire that feeds pay out in a step up to h. Shortens the step if nodes cannot
 * follow. The system may be a new one afterwards. */
sw_status sw_ladder_make_room(sw_ladder *p, double *h, sw_error *err);

/* Largest turn of a hold in a step. From half a turn on, the wire could not know the direction
 * [rad]. */
static const double SW_WIDEST_TURN = 2.5;

/* Shortest part, as a share of dt, for locating the moment at which a tie breaks [-]. */
static const double SW_SHORTEST_BREAK = 1.0 / 1024;

#endif
