/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Data and functions of the search for an equilibrium, used by its parts only: rest.c, before.c,
 * equilibrium.c, continuation.c, attempt.c. */
#ifndef SW_STEP_STATICS_H
#define SW_STEP_STATICS_H

#include "scene/parts.h"
#include "step/step.h"
#include "system/system.h"

typedef struct sw_statics {
  sw_scene *s;
  const sw_settle_args *args;
  sw_settle_report *report;
  int (*interrupted)(void);
  int rests;      /* 1: the search began in equilibrium, except for the motions of this pose */
  int most_far;   /* see sw_newton */
  int slides;     /* 1: holds or feeds draw wires that something rubs */
  int may_divide; /* 1: a part of the holds' path, or a feed's pose, is divided if no stable
                     equilibrium follows directly */
  int divides;    /* 1: this part must be divided */
  int rubs;       /* 1: wires may drag each other along */
  int left_alone; /* 1: in this part no hold, feed or jaw moves a wire */
  double fed;     /* longest way of fed wire in this pose; 0 where wires may drag each other [m] */
  double drawn;   /* in this part, shift of holds that draw wires which something rubs [m] */
  double leads;   /* shift of the holds by which wires may drag each other along; 0 from the first
                     accepted step on [m] */
  int leapt;      /* 1: in a part of the path a wire that rubs on something snapped */
  int keeps;      /* 1: continuation keeps what friction slid since the pose's start */
  int holds;      /* 1: contact keeps it in the coming commit */
  int slow;       /* 1: continuation begins with a step as long as the slowest growth */
  double passing; /* accuracy before the last part of the holds' path: largest shift of a node, over
                     an edge [-] */
  double edge;    /* length of the shortest edge [m] */
  double fall;    /* wires that move further fall without limit; 0: not known yet [m] */
  double touched; /* time up to which contact has followed the obstacles [s] */
  int *too_far;   /* see sw_scene_rest; or NULL */
  double *zero, *from, *y, *v; /* (freedoms) */
  double *way;                 /* (freedoms) last step of continuation */
  double *tension;             /* (edges) at the start of an attempt */
  double *kept, *begun;        /* a stored state; the state at the beginning of the search */
  size_t before;               /* iterations of earlier parts of the holds' path [-] */
  sw_pose *from_poses;         /* (holds) poses of the holds at the start */
} sw_statics;

/* Returns the room that a stored state takes [numbers]. */
size_t sw_rest_room(const sw_scene *scene);
/* Stores the state during a solve, and what slipped in grippers before; restores both. */
void sw_rest_put_aside(const sw_scene *scene, double *kept);
void sw_rest_take_back(sw_scene *scene, const double *kept);

enum { SW_REST_ITERATIONS = 60 }; /* usual limit of Newton iterations [-] */
/* An unstable direction counts as neutral if its disturbance needs longer than this to grow, over
 * sw_rest_time_scale [-]. */
#define SW_REST_SLOWEST_GROWTH 30.0

/* Returns sqrt(length/g) [s]. For weightless scenes any scale will do. */
double sw_rest_time_scale(const sw_scene *scene);
/* Returns the first step of continuation [s]. */
double sw_rest_first_step(const sw_scene *scene);
/* Shift of obstacles since contact last followed them. Friction then drags the wires [m]. */
double sw_rest_dragged(const sw_statics *p);
/* Returns the holds' largest shift; a turn counts as the shift of half a wire by it [m]. */
double sw_rest_driven(const sw_statics *p);
/* 1 if this part of the path has taken more than this share of the iterations that it may take. */
int sw_rest_is_late(const sw_statics *p, double share);
/* Finds y from the present state, with a step hbar of implicit Euler or (HUGE_VAL) at rest. */
sw_status sw_rest_solve(sw_statics *p, double hbar, const sw_newton *newton, sw_error *err);
/* Returns the largest shift of a node from the state to y [m]. */
double sw_rest_shift(const sw_statics *p);
/* Makes y the state; contact commits it unless trial is 1. Returns the largest shift [m]. */
double sw_rest_take(sw_statics *p, int trial);
/* Shifts the state by `times` p->way; its twist and frames go along. */
void sw_rest_go_on(sw_statics *p, double times);
/* Continuation until the wires rest. */
sw_status sw_rest_transient(sw_statics *p, sw_error *err);
/* Returns the length of the longest wire [m]. */
double sw_rest_longest(const sw_scene *scene);
/* Returns the largest distance of a node from its place in an earlier state [m]. */
double sw_rest_shift_from(const sw_statics *p, const double *before);
/* 1 if a wire has fallen so far since the beginning of the search that nothing can hold it. */
int sw_rest_falls(const sw_statics *p);
/* Fails with the name of the wire that has moved furthest since then. */
sw_status sw_rest_fail_fall(const sw_statics *p, sw_error *err);
/* 1 for errors that no other search can avoid. */
int sw_rest_stops(sw_status status);
/* Finds the equilibrium from the present state by Newton's iteration alone; it becomes the state.
 * report->negative: its number of unstable directions. */
sw_status sw_rest_newton(sw_statics *p, int iterations, sw_error *err);
/* Finds the equilibrium from the present state, by Newton's iteration or by continuation. */
sw_status sw_rest_find(sw_statics *p, sw_error *err);
/* Finds the equilibrium by continuation, which follows the path that the wires would take. */
sw_status sw_rest_continue(sw_statics *p, sw_error *err);
/* Takes a few short steps towards the equilibrium, which bring all stiff modes to rest. */
sw_status sw_rest_relax(sw_statics *p, sw_error *err);
/* Brings wires to rest before obstacles move, if they do not rest at the start of a pose; *fell is
 * then 1. */
sw_status sw_rest_before(sw_statics *p, int *fell, sw_error *err);

#endif
