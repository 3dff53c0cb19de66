/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the memory of earlier steps with which a touch goes on. */
#include "contact/recall.h"

#include <math.h>

const sw_memory *sw_contact_remembered(const sw_contact *c, const sw_candidate *k,
                                       const sw_closest *place) {
  const sw_memory *best = NULL;
  double nearest = sw_contact_within(k, HUGE_VAL);
  for (size_t i = k->memory; c->memory && i < k->memory_end; i++) {
    const sw_memory *m = &c->memory[i];
    const double d = fabs(m->at - place->at) + sw_contact_apart(m->feature == place->feature,
                                                                sw_dot(m->normal, place->normal));
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

/* 1 if the memory is that of a node that still touches the obstacle at positions y. A new touch
 * beside it, such as that of a chord which begins there, then begins without force: the same force
 * twice would make energy at any size of step. A place on a segment slides over to the next one and
 * leaves nothing behind. The answer must not depend on the order along the wire. Only in adaptive
 * steps, which follow the force down to any size: in fixed ones a cable that is drawn off a peg
 * would make energy more often (spec/scene/ledger_drawn_spec). */
static int goes_on_beside(const sw_contact *c, const sw_candidate *k, const sw_memory *m,
                          const double *y) {
  sw_closest near;
  if (!c->adaptive || c->regime != SW_CONTACT_IMPLICIT || m->segment) return 0;
  const sw_vec local = sw_pose_local(c->now[k->obstacle].pose, sw_vec_at(y, m->node));
  return sw_shape_point(c->obstacles[k->obstacle].shape, local, k->skin, &near) &&
         near.gap < k->skin;
}

/* Returns the memory of a pressing touch, on this or a neighbouring part of the wire, or NULL. */
const sw_memory *sw_contact_recalled(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                                     const sw_closest *place, const double *y) {
  const double at = place->at;
  const sw_memory *own = sw_contact_remembered(c, k, place);
  const int pressed = own && own->kept.normal_force > 0;
  if (pressed && !(k->smooth && k->segment)) return own;
  if (s->bodies[k->body].plan->web || k->samples) return NULL;
  const sw_memory *other = inherited(c, k, at);
  if (!pressed) return other && !goes_on_beside(c, k, other, y) ? other : NULL;
  return other && other->segment && away(other, k, at) < away(own, k, at) ? other : own;
}
