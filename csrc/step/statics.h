/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What looks for an equilibrium shares. Of rest.c and equilibrium.c only. */
#ifndef SW_STEP_STATICS_H
#define SW_STEP_STATICS_H

#include <string.h>

#include "scene/parts.h"
#include "step/step.h"
#include "system/system.h"

typedef struct sw_statics {
  sw_scene *s;
  const sw_settle_args *args;
  sw_settle_report *report;
  int (*interrupted)(void);
  int rests;      /* 1: it began in equilibrium, but for what moves in this pose */
  int most_far;   /* see sw_newton */
  double passing; /* share of an edge that nodes of a place on the way may be off [-] */
  double edge;    /* the shortest [m] */
  double touched; /* time up to which contact has followed the obstacles [s] */
  int *too_far;   /* see sw_scene_rest; or NULL */
  double *zero, *from, *y, *v; /* (freedoms) */
  double *way;                 /* (freedoms) of continuation's last step */
  double *tension;             /* (edges) at the start of an attempt */
  double *kept, *begun;        /* (state) put aside; as settling found it */
  sw_pose *from_poses;         /* (holds) where the holds were */
} sw_statics;

/* Where the state is on its way through a solve: put aside, and back. */
static inline void sw_rest_put_aside(const sw_scene *s, double *kept) {
  memcpy(kept, sw_scene_system(s)->state, sw_scene_system(s)->state_size * sizeof(double));
}

static inline void sw_rest_take_back(sw_scene *s, const double *kept) {
  memcpy(sw_scene_system(s)->state, kept, sw_scene_system(s)->state_size * sizeof(double));
}

enum { SW_REST_ITERATIONS = 60 }; /* of Newton, usually [-] */
/* Length of the longest wire [m]. */
double sw_rest_longest(const sw_scene *scene);
/* Errors that no other way to the equilibrium can mend. */
int sw_rest_stops(sw_status status);
/* The equilibrium by Newton's iteration alone, from where the scene is, which is the state then.
 * report->negative: unstable directions of it. */
sw_status sw_rest_newton(sw_statics *p, int iterations, sw_error *err);
/* The equilibrium from where the scene is; in some way. */
sw_status sw_rest_find(sw_statics *p, sw_error *err);
/* The same by continuation, which goes where the wires would. */
sw_status sw_rest_continue(sw_statics *p, sw_error *err);
/* A few short steps towards it: all that is stiff is at rest then. */
sw_status sw_rest_relax(sw_statics *p, sw_error *err);
/* Wires that do not rest where a pose begins come to rest before obstacles move on: then *fell
 * is 1. */
sw_status sw_rest_before(sw_statics *p, int *fell, sw_error *err);

#endif
