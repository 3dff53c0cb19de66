/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact between wires: creation, and the memory of its touches. */
#include <math.h>

#include "base/alloc.h"
#include "mutual/pair.h"
#include "system/part.h"
#include "touch/lean.h"

/* Adds the steady force; its time constant is that of the slower wire. */
static void note(const sw_mutual *m, const sw_system *s, const sw_meet *t, sw_met *out) {
  const sw_pair *k = &((const sw_pairs *)(const void *)m)->pairs[t->pair];
  const sw_body *one = &s->bodies[k->body[0]], *two = &s->bodies[k->body[1]];
  const double N = t->press.normal_force;
  out->smooth = k->smooth;
  if (!k->smooth) return;
  out->kept.steady = fmin(sw_lean_steady(one, k->one - one->first_node, t->steady, N, m->h),
                          sw_lean_steady(two, k->two - two->first_node, t->steady, N, m->h));
}

static void forget(sw_mutual *m) { sw_pairs_of(m)->listed_nodes = 0; }

static void free_own(sw_mutual *m) {
  const sw_pairs *p = sw_pairs_of(m);
  SW_FREE_ALL(p->edge, p->near, p->listed_at, p->pairs, p->barriers);
}

static const sw_finder wires = {
    .name = "contact of wires",
    .too_many =
        "too many pairs of segments are near each other; give fewer segments, not much shorter "
        "than the wire's diameter",
    .make = sw_pairs_new,
    .free = free_own,
    .forget = forget,
    .choose = sw_pairs_choose,
    .wake = sw_pairs_wake,
    .find = sw_pairs_find,
    .widen = sw_pairs_widen,
    .cross = sw_pairs_cross,
    .cuts = sw_pairs_cuts,
    .note = note,
};

sw_status sw_pairs_new(const sw_system *s, const sw_pair_rule *rules, sw_mutual **out) {
  sw_pairs *p = sw_alloc(1, sizeof *p);
  if (!p) return SW_ENOMEM;
  p->edge = sw_alloc(s->body_count, sizeof *p->edge);
  if (sw_mutual_start(&p->m, &wires, rules, s->body_count) == SW_OK && p->edge) {
    *out = &p->m;
    return SW_OK;
  }
  sw_mutual_free(&p->m);
  return SW_ENOMEM;
}

int sw_pairs_meet_waiting(const sw_mutual *m, const sw_system *s) {
  const sw_pairs *p = (const sw_pairs *)(const void *)m;
  for (size_t i = 0; i < m->pair_count; i++)
    for (int k = 0; k < 2; k++)
      if (s->bodies[p->pairs[i].body[k]].waits) return 1;
  return 0;
}

void sw_pairs_mark(const sw_mutual *m, sw_system *s) {
  const sw_pairs *p = (const sw_pairs *)(const void *)m;
  for (size_t i = 0; i < m->pair_count; i++)
    for (int k = 0; k < 2; k++) s->bodies[p->pairs[i].body[k]].coupled |= SW_TOUCHING;
}

int sw_mutual_crowded(const sw_mutual *m, size_t most) {
  uint32_t seen[SW_NEAR_MOST];
  size_t count = 0;
  for (size_t i = 0; i < 2 * m->touch_count; i++) {
    const uint32_t body = m->touches[i / 2].of.body[i % 2];
    size_t k = 0;
    while (k < count && seen[k] != body) k++;
    if (k < count) continue;
    if (count == most || count == SW_NEAR_MOST) return 1;
    seen[count++] = body;
  }
  return 0;
}
