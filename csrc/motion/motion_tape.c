/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Puts motions on a tape: the input of their plans, and views with the motion behind them. */
#include "base/alloc.h"
#include "motion/law.h"

enum { NOTHING, PLANNED, VIEW };

int sw_motion_is_function(const sw_motion *m) {
  return (m->inner ? m->inner : m)->law == &sw_motion_law_callback;
}

static void tape_point(sw_tape *t, sw_waypoint *p) {
  int facing = (int)p->facing;
  SW_TAPE_STRUCT(t, sw_waypoint, 96);
  sw_tape_vec(t, &p->p);
  sw_tape_int(t, &facing);
  sw_tape_quat(t, &p->q);
  sw_tape_vec(t, &p->turn);
  sw_tape_double(t, &p->t);
  p->facing = facing == SW_FACING_GIVEN    ? SW_FACING_GIVEN
              : facing == SW_FACING_TURNED ? SW_FACING_TURNED
                                           : SW_FACING_KEPT;
}

/* All numbers of a plan, without names and points. */
static void tape_numbers(sw_tape *t, sw_motion_plan *p) {
  SW_TAPE_STRUCT(t, sw_motion_plan, 160);
  sw_tape_vec(t, &p->turn);
  sw_tape_int(t, &p->about);
  sw_tape_vec(t, &p->centre);
  sw_tape_double(t, &p->speed);
  sw_tape_double(t, &p->angular_speed);
  sw_tape_double(t, &p->acceleration);
  sw_tape_double(t, &p->angular_acceleration);
  sw_tape_double(t, &p->duration);
  sw_tape_double(t, &p->blend);
  sw_tape_int(t, &p->stop);
  sw_tape_double(t, &p->start);
  sw_tape_int(t, &p->relative);
}

static void tape_plan(sw_tape *t, sw_motion **motion) {
  char name[SW_NAME_SIZE], law[SW_NAME_SIZE];
  sw_motion_plan plan = sw_motion_plan_empty();
  sw_waypoint *points = NULL;
  const sw_motion_given *given = !sw_tape_reads(t) && *motion ? (*motion)->given : NULL;
  if (given) plan = given->plan, points = given->points;
  plan.name = sw_tape_word(t, plan.name, name);
  plan.law = sw_tape_word(t, plan.law, law);
  tape_numbers(t, &plan);
  sw_tape_count(t, &plan.count, sizeof *points);
  if (sw_tape_reads(t) && sw_tape_good(t)) {
    points = sw_alloc(plan.count, sizeof *points);
    if (!points) sw_tape_fail(t, SW_ENOMEM);
  }
  for (size_t i = 0; points && i < plan.count && sw_tape_good(t); i++) tape_point(t, &points[i]);
  if (!sw_tape_reads(t)) return;
  plan.points = points;
  if (!name[0]) plan.name = NULL;
  if (sw_tape_good(t)) t->status = sw_motion_create(&plan, motion, t->err);
  sw_free(points);
}

static void tape_view(sw_tape *t, sw_motion **motion) {
  sw_motion *view = sw_tape_reads(t) ? NULL : *motion;
  sw_motion *inner = view ? view->inner : NULL;
  tape_plan(t, &inner);
  if (sw_tape_reads(t) && sw_tape_good(t)) {
    view = sw_motion_view(inner);
    if (!view) sw_tape_fail(t, SW_ENOMEM);
    sw_motion_release(inner);
    *motion = view;
  }
  if (!view) return;
  sw_tape_double(t, &view->start);
  sw_tape_int(t, &view->relative);
  sw_tape_pose(t, &view->base);
}

static void retain(void *motion) { sw_motion_retain(motion); }
static void release(void *motion) { sw_motion_release(motion); }

void sw_tape_motion(sw_tape *t, sw_motion **motion) {
  static const sw_sharing sharing = {retain, release};
  int kind = NOTHING;
  if (sw_tape_share(t, motion, &sharing)) return;
  if (sw_tape_reads(t))
    *motion = NULL;
  else if (*motion)
    kind = (*motion)->inner ? VIEW : PLANNED;
  sw_tape_int(t, &kind);
  if (kind == PLANNED) tape_plan(t, motion);
  if (kind == VIEW) tape_view(t, motion);
}
