/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How deep bodies are in each other. Wires that a join kept together lie in each other when it is
 * released. This depth is no error of the steps, and does not count until they have come out. */
#include <math.h>

#include "base/each.h"
#include "mutual/meet.h"
#include "system/join.h"

static int parts(const sw_system *s, const sw_meet *t) {
  return t->emerges && sw_joins_were_near(s, t->of.node[0], t->of.node[1]);
}

/* Wires whose axes are both within 45 degrees of the normal press on each other with their ends. */
static const double END_ON = 0.7;

int sw_meet_abuts(const sw_system *s, const sw_meet *t) {
  if (!parts(s, t)) return 0;
  for (int k = 0; k < 2; k++) {
    const sw_vec from = sw_vec_at(s->x, t->of.node[k]), to = sw_vec_at(s->x, t->of.end[k]);
    const sw_vec along = sw_unit_or(sw_sub(to, from), sw_v(0, 0, 0));
    if (fabs(sw_dot(along, t->square)) < END_ON) return 0;
  }
  return 1;
}

int sw_mutual_parts(const sw_mutual *m, const sw_system *s) {
  for (size_t i = 0; s->parted_count && i < m->touch_count; i++)
    if (parts(s, &m->touches[i])) return 1;
  return 0;
}

static void look_at(const sw_system *s, const sw_meet *t, double *deepest, size_t *node) {
  const double depth = t->forgiven - t->press.gap_after - t->aslant;
  if (depth <= *deepest || parts(s, t)) return;
  *deepest = depth;
  if (node) *node = t->of.node[0];
}

double sw_mutual_penetration(const sw_mutual *m, const sw_system *s, size_t *node) {
  double deepest = 0;
  SW_ITEMS(const sw_meet, t, m->touches, m->touch_count) {
    look_at(s, t, &deepest, node);
  }
  SW_ITEMS(const sw_meet, t, m->still.list, m->still.count) {
    look_at(s, t, &deepest, node);
  }
  return deepest;
}
