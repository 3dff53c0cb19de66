/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which touch of the iterate before, or of the step before, goes on in one of this iterate. Nodes
 * of wires that lie along each other are often beside nodes, and the last nanometre says which of
 * two segments has the nearest place: the touch of a node is the same one on either. */
#include <math.h>

#include "contact/pair.h"
#include "contact/same.h"

/* --- of the step before ------------------------------------------------------------ */

/* Memory is in the order of the segments: the first of these from number i on, or what comes after.
 */
static uint32_t first_memory(const sw_pairs *p, uint32_t i, uint32_t one, uint32_t two) {
  const sw_pair_memory *m = p->memory;
  while (i < p->memory_count && (m[i].one < one || (m[i].one == one && m[i].two < two))) i++;
  return i;
}

void sw_pairs_match(sw_pairs *p) {
  size_t before = 0;
  uint32_t from[3] = {0, 0, 0}; /* pairs are in that order too */
  for (size_t i = 0; i < p->pair_count; i++) {
    sw_pair *k = &p->pairs[i];
    for (uint32_t row = 0; row < 3; row++)
      k->memory[row] = k->one + row > 0
                           ? (from[row] = first_memory(p, from[row], k->one + row - 1, k->two - 1))
                           : (uint32_t)p->memory_count;
    while (p->pairs[before].one + 1 < k->one ||
           (p->pairs[before].one + 1 == k->one && p->pairs[before].two < k->two))
      before++;
    const sw_pair *b = &p->pairs[before];
    k->before = b->one + 1 == k->one && b->two == k->two ? (uint32_t)before : SW_NO_PAIR;
    k->after = SW_NO_PAIR;
    if (k->before != SW_NO_PAIR) p->pairs[before].after = (uint32_t)i;
  }
}

const sw_pair_memory *sw_pair_recall(const sw_pairs *p, const sw_pair *k, const double at[2],
                                     sw_pair_kind kind) {
  const sw_pair_memory *best = NULL;
  const double one = k->one + at[0], two = k->two + at[1];
  double nearest = HUGE_VAL;
  for (uint32_t row = 0; row < 3; row++) /* and segments beside */
    for (size_t j = k->memory[row]; j < p->memory_count; j++) {
      const sw_pair_memory *m = &p->memory[j];
      if (m->one + 1 != k->one + row || m->two > k->two + 1) break;
      const double d = fmax(fabs(m->one + m->at[0] - one), fabs(m->two + m->at[1] - two));
      const double worse = d + (m->kind != kind); /* what was another one serves as well */
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

static void look_in(const sw_pairs *p, const sw_pair *in, const sw_pair *k, const double at[2],
                    sw_pair_kind kind, double *nearest, const sw_pair_touch **best) {
  for (size_t i = in->last; i < in->last_end; i++) {
    const sw_pair_touch *t = &p->last[i];
    const double d = sw_pair_between(k, at, in, t->at);
    if (t->kind == kind && d < *nearest) *best = t, *nearest = d;
  }
}

/* Places on curves go from one segment to the next. */
static const sw_pair_touch *last_around(const sw_pairs *p, const sw_pair *k, const double at[2],
                                        const sw_pair_touch *best, double nearest) {
  const sw_pair *end = p->pairs + p->pair_count, *row[3] = {k, NULL, NULL};
  if (k->before != SW_NO_PAIR) row[1] = &p->pairs[k->before];
  if (k->after != SW_NO_PAIR) row[2] = &p->pairs[k->after];
  for (int i = 0; i < 3; i++) {
    const sw_pair *m = row[i];
    if (!m) continue;
    if (i > 0) look_in(p, m, k, at, SW_CROSSING, &nearest, &best);
    if (m > p->pairs && m[-1].one == m->one && m[-1].two + 1 == m->two)
      look_in(p, m - 1, k, at, SW_CROSSING, &nearest, &best);
    if (m + 1 < end && m[1].one == m->one && m[1].two == m->two + 1)
      look_in(p, m + 1, k, at, SW_CROSSING, &nearest, &best);
  }
  return best;
}

const sw_pair_touch *sw_pair_last(const sw_pairs *p, const sw_pair *k, const double at[2],
                                  sw_pair_kind kind) {
  const sw_pair_touch *best = NULL;
  double nearest = SW_SAME_TOUCH;
  look_in(p, k, k, at, kind, &nearest, &best);
  if (k->smooth) return last_around(p, k, at, best, nearest);
  if (best || kind == SW_CROSSING) return best;
  if (kind == SW_NODE_OF_TWO) {
    if (k->before != SW_NO_PAIR) look_in(p, &p->pairs[k->before], k, at, kind, &nearest, &best);
    if (k->after != SW_NO_PAIR) look_in(p, &p->pairs[k->after], k, at, kind, &nearest, &best);
    return best;
  }
  const sw_pair *end = p->pairs + p->pair_count; /* neighbours in the list */
  if (k > p->pairs && k[-1].one == k->one && k[-1].two + 1 == k->two)
    look_in(p, k - 1, k, at, kind, &nearest, &best);
  if (k + 1 < end && k[1].one == k->one && k[1].two == k->two + 1)
    look_in(p, k + 1, k, at, kind, &nearest, &best);
  return best;
}
