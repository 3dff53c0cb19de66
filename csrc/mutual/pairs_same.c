/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the touch of the last iterate or step that continues in a touch of this iterate. Nodes of
 * parallel wires often lie beside nodes, and rounding decides which of two segments has the nearest
 * place. A node's touch on either segment is the same touch. */
#include <math.h>

#include "mutual/pair.h"
#include "touch/same.h"

/* --- of the step before ------------------------------------------------------------ */

/* Returns the first memory, from number i on, of these segments or later ones. Memory is in the
 * order of the segments. */
static uint32_t first_memory(const sw_pairs *p, uint32_t i, uint32_t one, uint32_t two) {
  const sw_met *m = p->m.memory;
  while (i < p->m.memory_count &&
         (m[i].of.node[0] < one || (m[i].of.node[0] == one && m[i].of.node[1] < two)))
    i++;
  return i;
}

void sw_pairs_match(sw_pairs *p) {
  size_t before = 0;
  uint32_t from[3] = {0, 0, 0}; /* pairs have the same order */
  for (size_t i = 0; i < p->m.pair_count; i++) {
    sw_pair *k = &p->pairs[i];
    for (uint32_t row = 0; row < 3; row++)
      k->memory[row] = k->one + row > 0
                           ? (from[row] = first_memory(p, from[row], k->one + row - 1, k->two - 1))
                           : (uint32_t)p->m.memory_count;
    while (p->pairs[before].one + 1 < k->one ||
           (p->pairs[before].one + 1 == k->one && p->pairs[before].two < k->two))
      before++;
    const sw_pair *b = &p->pairs[before];
    k->before = b->one + 1 == k->one && b->two == k->two ? (uint32_t)before : SW_NO_PAIR;
    k->after = SW_NO_PAIR;
    if (k->before != SW_NO_PAIR) p->pairs[before].after = (uint32_t)i;
  }
}

const sw_met *sw_pair_recall(const sw_pairs *p, const sw_pair *k, const double at[2],
                             sw_meet_kind kind) {
  const sw_met *best = NULL;
  const double one = k->one + at[0], two = k->two + at[1];
  double nearest = HUGE_VAL;
  for (uint32_t row = 0; row < 3; row++) /* segments one - 1, one, one + 1 */
    for (size_t j = k->memory[row]; j < p->m.memory_count; j++) {
      const sw_met *m = &p->m.memory[j];
      const uint32_t *node = m->of.node;
      if (node[0] + 1 != k->one + row || node[1] > k->two + 1) break;
      const double d = fmax(fabs(node[0] + m->at[0] - one), fabs(node[1] + m->at[1] - two));
      const double worse = d + (m->kind != kind); /* another kind is second choice */
      if (d < 1.0 && worse < nearest) best = m, nearest = worse;
    }
  return best;
}

/* --- of the iterate before ---------------------------------------------------------- */

double sw_pair_between(const sw_pair *k, const double at[2], const sw_pair *other,
                       const double there[2]) {
  return fabs((double)k->one - other->one + at[0] - there[0]) +
         fabs((double)k->two - other->two + at[1] - there[1]);
}

int sw_pair_is_same(const sw_pair *k, const double at[2], const sw_pair *other,
                    const double there[2]) {
  return sw_pair_between(k, at, other, there) < SW_SAME_TOUCH;
}

/* A search for the touch of the previous iterate. */
typedef struct search {
  const sw_pairs *p;
  const sw_pair *k;
  const double *at;
  sw_meet_kind kind;
  double nearest;
  const sw_meet *best;
} search;

static void look_in(search *f, const sw_pair *in) {
  for (size_t i = in->last; i < in->last_end; i++) {
    const sw_meet *t = &f->p->m.last[i];
    const double d = sw_pair_between(f->k, f->at, in, t->at);
    if (t->kind == f->kind && d < f->nearest) f->best = t, f->nearest = d;
  }
}

/* Searches the pairs of segment one with the neighbours of segment two, which are next in the
 * list. */
static void look_beside(search *f, const sw_pair *in) {
  const sw_pair *first = f->p->pairs, *end = first + f->p->m.pair_count;
  if (in > first && in[-1].one == in->one && in[-1].two + 1 == in->two) look_in(f, in - 1);
  if (in + 1 < end && in[1].one == in->one && in[1].two == in->two + 1) look_in(f, in + 1);
}

const sw_meet *sw_pair_last(const sw_pairs *p, const sw_pair *k, const double at[2],
                            sw_meet_kind kind) {
  search f = {p, k, at, kind, SW_SAME_TOUCH, NULL};
  look_in(&f, k);
  if (!k->smooth && (f.best || kind == SW_CROSSING)) return f.best;
  if (k->smooth || kind == SW_NODE_OF_ONE) look_beside(&f, k);
  if (!k->smooth && kind == SW_NODE_OF_ONE) return f.best;
  const uint32_t rows[2] = {k->before, k->after};
  for (int i = 0; i < 2; i++) {
    if (rows[i] == SW_NO_PAIR) continue;
    look_in(&f, &p->pairs[rows[i]]);
    if (k->smooth) look_beside(&f, &p->pairs[rows[i]]); /* curves continue on the next segment */
  }
  return f.best;
}
