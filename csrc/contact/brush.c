/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Brushes: a fast wire passes an edge within a long step. Its surface overlaps the edge in between,
 * although it is clear of the obstacle at both ends of the step. */
#include <math.h>

#include "base/each.h"
#include "contact/cross.h"
#include "touch/same.h"

/* 1 if a body presses on an obstacle, or did at the step's start. Straight paths of its nodes may
 * then cut a corner round which the wire itself goes. */
static int is_pressed(const sw_contact *c, const sw_body *b, int obstacle) {
  const int id = c->obstacles[obstacle].id;
  SW_ITEMS(const sw_touch, t, c->touches, c->touch_count) {
    if (t->obstacle == obstacle && t->node - b->first_node < b->plan->nodes &&
        t->press.normal_force > 0)
      return 1;
  }
  SW_ITEMS(const sw_memory, m, c->memory, c->memory_count) {
    if (m->obstacle == id && m->node - b->first_node < b->plan->nodes && m->kept.normal_force > 0)
      return 1;
  }
  return 0;
}

static int overlap(double a, double b, double c, double d, double low, double high) {
  return fmin(fmin(a, b), fmin(c, d)) <= high && fmax(fmax(a, b), fmax(c, d)) >= low;
}

/* 1 if the candidate's segment, on a straight path, comes nearer to the obstacle than the
 * margin. */
static int comes_near(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                      const double *x1, double margin) {
  const sw_pose *p0 = &c->start[k->obstacle].pose, *p1 = &c->now[k->obstacle].pose;
  const sw_vec a0 = sw_pose_local(*p0, sw_contact_where(c, s->x, k->node, k->node, 0));
  const sw_vec b0 = sw_pose_local(*p0, sw_contact_where(c, s->x, k->other, k->other, 0));
  const sw_vec a1 = sw_pose_local(*p1, sw_contact_where(c, x1, k->node, k->node, 0));
  const sw_vec b1 = sw_pose_local(*p1, sw_contact_where(c, x1, k->other, k->other, 0));
  const double way2 = fmax(sw_norm2(sw_sub(a1, a0)), sw_norm2(sw_sub(b1, b0)));
  const sw_shape *shape = c->obstacles[k->obstacle].shape;
  if (way2 < SW_MISSED_WAY * SW_MISSED_WAY * k->skin * k->skin) return 0;
  const sw_bounds box = sw_shape_bounds(shape);
  if (!overlap(a0.x, b0.x, a1.x, b1.x, box.min.x - margin, box.max.x + margin) ||
      !overlap(a0.y, b0.y, a1.y, b1.y, box.min.y - margin, box.max.y + margin) ||
      !overlap(a0.z, b0.z, a1.z, b1.z, box.min.z - margin, box.max.z + margin))
    return 0;
  sw_closest hit;
  double when;
  return sw_shape_sweep(shape, a0, b0, a1, b1, margin, &hit, &when);
}

int sw_contact_brushes(const sw_contact *c, const sw_system *s, const double *x1) {
  SW_ITEMS(const sw_candidate, k, c->candidates, c->candidate_count) {
    const sw_body *b = &s->bodies[k->body];
    if (!k->segment || b->plan->web || sw_contact_is_held(s, k)) continue;
    /* the straight path past a turning obstacle may lead through it */
    if (c->broad.moves[k->obstacle] && sw_contact_stays_away(c, s, k, x1)) continue;
    if (comes_near(c, s, k, x1, (1.0 - SW_MISSED) * k->skin) && !is_pressed(c, b, k->obstacle))
      return 1;
  }
  return 0;
}
