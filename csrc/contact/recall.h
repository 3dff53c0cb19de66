/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The memory of earlier steps with which a touch goes on. */
#ifndef SW_CONTACT_RECALL_H
#define SW_CONTACT_RECALL_H

#include "contact/touch.h"

/* Returns the memory with which a touch of the candidate goes on, its own or that of a neighbour
 * from which it slid here, at positions y; or NULL. */
const sw_memory *sw_contact_recalled(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                                     const sw_closest *place, const double *y);
/* Returns the place of a touch, as far as its memory is found by it. */
static inline sw_closest sw_contact_spotted(const sw_contact *c, const sw_touch *t) {
  const sw_quat turn = c->now[t->obstacle].pose.q;
  return (sw_closest){
      .at = t->at, .normal = sw_unrotate(turn, t->press.normal), .feature = t->feature};
}

/* Largest distance along the segment between places of one touch: the given share, or half the
 * distance of samples [-]. */
static inline double sw_contact_within(const sw_candidate *k, double share) {
  return k->samples ? sw_smaller(share, 0.5 / k->samples) : share;
}
/* Of touches nearer to each other than this share of an edge the one with the same feature is
 * meant: an edge and the corner at its end may touch at the same place of the wire, and only one of
 * them presses [-]. */
#define SW_ALMOST_THERE 1e-3
/* Returns what is added to the distance of two touches. A node in a groove touches both flanks: of
 * several touches with other features the one on the same side is meant. cosine: of the angle
 * between both normals [-]. */
static inline double sw_contact_apart(int same_feature, double cosine) {
  return same_feature ? 0.0 : SW_ALMOST_THERE * (1.5 - 0.5 * cosine);
}

#endif
