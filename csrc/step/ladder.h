/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ladder of a step of motion. A step of size h is tried by rungs, listed in stages.def: each
 * tries it by those below, and again in another way until what it looks after is right. The last
 * one computes a trial. Shared by the files of this room only. */
#ifndef SW_STEP_LADDER_H
#define SW_STEP_LADDER_H

#include "step/step.h"

/* How a step that made energy is redone where something touches: by the method's start, which takes
 * no acceleration from before and is of second order too; then with implicit Euler, which makes
 * none but where touches go wrong. What a method makes by itself a smaller step mends. */
enum { SW_AS_IS, SW_BY_START, SW_DULLY, SW_GIVE_UP };

typedef struct sw_ladder {
  sw_scene *s;
  const sw_run_args *args;
  sw_run_report *report;
  double *v_start; /* velocities at the step's start, which impacts change */
  int smallest;    /* 1: the step tried now is as small as it may be */
  int redo;        /* SW_AS_IS, or how the step is redone, for it made energy */
  double soonest;  /* a rebound asks the step to end then, after its start; 0 = none does [s] */
  int cuts;        /* of this step, at rebounds [-] */
  double asked;    /* the part that a step is to be taken in: shorter ones are so for they were
                      refused, or are its end; 0: dt [s] */
  sw_error held;   /* what the last rejected part was rejected for */
  int smooth;      /* 1: the step that was rejected last made energy where nothing touches */
  int changed;     /* 1: the scene was, since the last step: its energy is not judged */
  int (*interrupted)(void);
  sw_observer *observer; /* or NULL */
} sw_ladder;

/* A step of size h, by the rungs below. On failure the state is as before. */
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

/* Try a step of size h on all rungs; smallest: 1 when no smaller one will be tried. */
sw_status sw_ladder_try(sw_ladder *p, double h, int smallest, sw_error *err);
/* Forget a trial that went well. */
void sw_ladder_undo(sw_ladder *p);
/* Make the trial of size h the state, at time t. Observe and book it; SW_ELIMIT: steps have
 * collapsed. */
void sw_ladder_accept(sw_ladder *p, double h, double t);
sw_status sw_ladder_record(sw_ladder *p, double h, sw_error *err);
/* Errors that a smaller step cannot mend. */
int sw_ladder_hopeless(sw_status status);

/* Full step to time t1, of fixed size, in parts where needed; an adaptive one of at most left [s];
 * one of slow handling; one of any kind where there is no wire. */
sw_status sw_step_fixed(sw_ladder *p, double h, double t1, sw_error *err);
sw_status sw_step_adaptive(sw_ladder *p, double left, double t1, sw_error *err);
sw_status sw_step_poses(sw_ladder *p, double t1, sw_error *err);
sw_status sw_step_empty(sw_ladder *p, double t1, sw_error *err);

static const double SW_SMALLEST_SHARE = 1.0 / 4096; /* of a step, before giving up [-] */

/* The method of the run's arguments, for the system as it is. */
sw_status sw_ladder_method(sw_scene *scene, const sw_run_args *args, sw_error *err);
/* Nodes for the wire that a step up to h feeds; shortens the step to what nodes can
 * follow. The system may be a new one afterwards. */
sw_status sw_ladder_make_room(sw_ladder *p, double *h, sw_error *err);

/* A hold may turn by this much in a step: at half a turn and more its wire would not know
 * which way [rad]. */
static const double SW_WIDEST_TURN = 2.5;

/* Steps are cut down to this share of dt to find the moment at which a tie breaks [-]. */
static const double SW_SHORTEST_BREAK = 1.0 / 1024;

#endif
