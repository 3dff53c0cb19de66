/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statics: a first guess for wires that a gripper's pads hold, or that stick on a moving obstacle.
 * The iteration starts with this part of a wire where they carry it. From the place of the pose
 * before, pads that move across the wire press on it from one side only, by many times their depth,
 * and the iteration loses their friction; then the wire falls out of them. On a turning drum with
 * facets it found no rest, and the wire slid on the drum (spec/contact/wound_poses_spec). */
#include <stdint.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "contact/contact.h"
#include "contact/touch.h"

/* Returns the number of the pad, or of the moving obstacle on which it stuck, that a remembered
 * touch pressed on, or -1. */
static int holds(const sw_contact *c, const sw_memory *m) {
  if (!(m->kept.normal_force > 0)) return -1;
  const size_t o = sw_contact_index(c, m->obstacle);
  if (o == c->count) return -1;
  return c->obstacles[o].grips > 0 || (c->broad.moves[o] && !m->kept.sliding) ? (int)o : -1;
}

/* Nodes at such touches, from low to high; low > high: there are none. */
typedef struct reach {
  size_t low, high;
} reach;

static reach reach_of(const sw_contact *c) {
  reach r = {SIZE_MAX, 0};
  SW_ITEMS(const sw_memory, m, c->memory, c->memory_count) {
    if (holds(c, m) < 0) continue;
    const size_t end = m->node + (m->segment > 0);
    r.low = m->node < r.low ? m->node : r.low;
    r.high = end > r.high ? end : r.high;
  }
  return r;
}

/* Where a node goes with its pads: sum of the places, and their number. */
typedef struct goal {
  double sum[3], count;
} goal;

static void add(const sw_contact *c, int o, const double *x, goal *to) {
  const sw_vec p = sw_pose_point(c->now[o].pose, sw_pose_local(c->start[o].pose, sw_load(x)));
  to->sum[0] += p.x, to->sum[1] += p.y, to->sum[2] += p.z, to->count += 1;
}

/* Nodes that lie open between two that stick on one moving obstacle go with it as well, as those on
 * its facets between two corners. */
static void fill(const sw_contact *c, const sw_system *s, const double *x, reach r, goal *goals) {
  const sw_memory *before = NULL;
  SW_ITEMS(const sw_memory, m, c->memory, c->memory_count) {
    const int o = holds(c, m);
    if (o < 0 || c->obstacles[o].grips > 0) continue;
    const int same = before && before->obstacle == m->obstacle &&
                     sw_system_body_of(s, before->node) == sw_system_body_of(s, m->node);
    for (size_t i = same ? before->node : m->node; i < m->node; i++)
      if (!(goals[i - r.low].count > 0)) add(c, o, x + 3 * i, &goals[i - r.low]);
    before = m;
  }
}

/* Leaves out held nodes, and meshes: only their surface touches the pads. */
static void leave_out(const sw_system *s, reach r, goal *goals) {
  SW_ITEMS(const sw_held_node, h, s->held, s->held_count) {
    if (h->node >= r.low && h->node <= r.high) goals[h->node - r.low].count = 0;
  }
  SW_ITEMS(const sw_body, b, s->bodies, s->body_count) {
    for (size_t i = r.low; b->plan->web && i <= r.high; i++)
      if (i >= b->first_node && i < b->first_node + b->plan->nodes) goals[i - r.low].count = 0;
  }
}

sw_status sw_contact_carry(sw_contact *c, const sw_system *s, double time, double *x,
                           sw_error *err) {
  if (!(c->pad_count || c->broad.mover_count) || !s->poses) return SW_OK;
  const reach r = reach_of(c);
  if (r.low > r.high) return SW_OK;
  SW_TRY(sw_broad_place(c, time, c->now, err));
  const size_t n = r.high - r.low + 1;
  goal *goals SW_LOCAL = sw_alloc(n, sizeof *goals);
  if (!goals) return SW_ENOMEM;
  memset(goals, 0, n * sizeof *goals);
  SW_ITEMS(const sw_memory, m, c->memory, c->memory_count) {
    const int o = holds(c, m);
    if (o < 0) continue;
    for (size_t i = m->node; i <= m->node + (m->segment > 0); i++)
      add(c, o, x + 3 * i, &goals[i - r.low]);
  }
  fill(c, s, x, r, goals);
  leave_out(s, r, goals);
  for (size_t k = 0; k < n; k++)
    for (size_t i = 0; i < 3 && goals[k].count > 0; i++)
      x[3 * (r.low + k) + i] = goals[k].sum[i] / goals[k].count;
  return SW_OK;
}
