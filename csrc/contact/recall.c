/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the memory of earlier steps with which a touch goes on. */
#include "contact/recall.h"

#include <math.h>

#include "touch/same.h"

const sw_memory *sw_contact_remembered(const sw_contact *c, const sw_candidate *k, double at,
                                       int feature) {
  const sw_memory *best = NULL;
  double nearest = sw_contact_within(k, HUGE_VAL);
  for (size_t i = k->memory; c->memory && i < k->memory_end; i++) {
    const sw_memory *m = &c->memory[i];
    const double d = fabs(m->at - at) + (m->feature == feature ? 0.0 : SW_ALMOST_THERE);
    if (d < nearest) best = m, nearest = d;
  }
  return best;
}

/* Distance along the wire between a memory and a candidate's place, in edges [-]. */
static double away(const sw_memory *m, const sw_candidate *k, double at) {
  return fabs(((double)m->node - (double)k->node) + m->at - at);
}

/* Finds the memory of a touch that slid from one segment to its neighbour, or to the node between
 * them: such a touch keeps its friction spring. */
static const sw_memory *inherited(const sw_contact *c, const sw_candidate *k, double at) {
  const int id = c->obstacles[k->obstacle].id;
  const sw_memory *best = NULL;
  double nearest = 1.0; /* at most one segment away */
  for (size_t i = k->memory; i-- > 0 && c->memory[i].node + 2 >= k->node;) {
    const double d = away(&c->memory[i], k, at);
    if (c->memory[i].obstacle == id && c->memory[i].kept.normal_force > 0 && d < nearest)
      best = &c->memory[i], nearest = d;
  }
  for (size_t i = k->memory_end; i < c->memory_count && c->memory[i].node <= k->node + 1; i++) {
    const double d = away(&c->memory[i], k, at);
    if (c->memory[i].obstacle == id && c->memory[i].kept.normal_force > 0 && d < nearest)
      best = &c->memory[i], nearest = d;
  }
  return best;
}

/* 1 if the touch is that of the memory and presses. */
static int presses(const sw_touch *t, int obstacle, const sw_memory *m) {
  return t->node == m->node && t->segment == m->segment && t->obstacle == obstacle &&
         t->press.active && fabs(t->at - m->at) < SW_SAME_TOUCH;
}

/* 1 if the touch of a neighbour's memory goes on at its own place, in the previous iterate. In a
 * step's first one it is assumed to. A new touch beside it, such as that of a chord which begins at
 * a node that presses, then begins without force: the same force twice would make energy at any
 * size of step. */
static int goes_on_beside(const sw_contact *c, const sw_candidate *k, const sw_memory *m) {
  if (c->regime != SW_CONTACT_IMPLICIT) return 0;
  if (c->last_count == 0) return 1;
  for (size_t i = k->last; i-- > 0 && c->last[i].node + 2 >= k->node;)
    if (presses(&c->last[i], k->obstacle, m)) return 1;
  for (size_t i = k->last; i < c->last_count && c->last[i].node <= k->node + 1; i++)
    if (presses(&c->last[i], k->obstacle, m)) return 1;
  return 0;
}

/* Returns the memory of a pressing touch, on this or a neighbouring part of the wire, or NULL. */
const sw_memory *sw_contact_recalled(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                                     double at, int feature) {
  const sw_memory *own = sw_contact_remembered(c, k, at, feature);
  const int pressed = own && own->kept.normal_force > 0;
  if (pressed && !(k->smooth && k->segment)) return own;
  if (s->bodies[k->body].plan->web || k->samples) return NULL;
  const sw_memory *other = inherited(c, k, at);
  if (!pressed) return other && !goes_on_beside(c, k, other) ? other : NULL;
  return other && other->segment && away(other, k, at) < away(own, k, at) ? other : own;
}
