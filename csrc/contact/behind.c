/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds wires at the back of a sheet. */
#include "contact/behind.h"

#include "contact/touch.h"

/* A wire is at the back if its axis is there, by a depth between these shares of its radius: it
 * touches the sheet from there [-]. */
static const double LEAST = 0.1, MOST = 1.0;
/* Sheets at most this many radii away are looked at [-]. */
static const double REACH = 100.0;

static int is_open(const sw_contact *c, int obstacle) {
  return sw_shape_is_open(c->obstacles[obstacle].shape);
}

static int touches_back(double depth, double radius) {
  return depth > LEAST * radius && depth < MOST * radius;
}

static double arc_at(const sw_system *s, const sw_candidate *k, double at) {
  const sw_body *b = &s->bodies[k->body];
  const double *arc = b->plan->s;
  const size_t i = k->node - b->first_node, j = k->other - b->first_node;
  return arc[i] + (k->segment ? at : 0.0) * (arc[j] - arc[i]) - arc[0];
}

static void note(sw_contact *c, const sw_system *s, const sw_candidate *k, double at,
                 double depth) {
  c->behind = (sw_behind){.found = 1,
                          .obstacle = c->obstacles[k->obstacle].id,
                          .body = k->body,
                          .place = arc_at(s, k, at),
                          .depth = depth};
}

/* A candidate's place at the step's start, in the obstacle's coordinates. */
static sw_vec start_of(const sw_contact *c, const sw_system *s, const sw_candidate *k, double at) {
  const sw_mean spot = sw_contact_spot(s, k, k->segment ? at : 0.0);
  return sw_pose_local(c->start[k->obstacle].pose, sw_mean_place(c, s->x, &spot));
}

void sw_contact_note_crossing(sw_contact *c, const sw_system *s, const sw_candidate *k,
                              const sw_closest *hit) {
  if (!is_open(c, k->obstacle)) return;
  const double depth = sw_dot(hit->normal, sw_sub(hit->point, start_of(c, s, k, hit->at)));
  if (depth > LEAST * k->radius) note(c, s, k, hit->at, depth);
}

void sw_contact_note_inside(sw_contact *c, const sw_system *s, const sw_candidate *k,
                            const sw_closest *near) {
  const sw_shape *shape = c->obstacles[k->obstacle].shape;
  sw_closest before;
  if (!is_open(c, k->obstacle) || !touches_back(-near->gap, k->radius)) return;
  const sw_vec start = start_of(c, s, k, near->at);
  if (sw_shape_point(shape, start, REACH * k->radius, &before) && before.gap < 0)
    note(c, s, k, near->at, -near->gap);
}

sw_behind sw_contact_behind(sw_contact *c, const sw_system *s, size_t body) {
  sw_behind found = {.found = 0};
  const sw_body *b = &s->bodies[body];
  size_t k, end;
  if (!c->open_count) return found;
  if (c->behind.found && c->behind.body == body) {
    found = c->behind, c->behind.found = 0;
    return found;
  }
  sw_contact_touches_of(c, b->first_node, b->first_node + b->plan->nodes, &k, &end);
  for (; k < end && k < c->touch_count; k++) {
    const sw_touch *t = &c->touches[k];
    sw_touch_fetch(t, SW_FETCH_ALL);
    const sw_vec seen = sw_pose_point(c->now[t->obstacle].pose, t->seen);
    const double depth = sw_dot(t->press.normal, sw_sub(t->point, seen));
    if (!(depth > found.depth) || !touches_back(depth, b->plan->beam.radius)) continue;
    if (!is_open(c, t->obstacle)) continue;
    found = (sw_behind){1, c->obstacles[t->obstacle].id, body, sw_touch_arc(s, t), depth};
  }
  return found;
}
