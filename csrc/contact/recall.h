/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The memory of earlier steps with which a touch goes on. */
#ifndef SW_CONTACT_RECALL_H
#define SW_CONTACT_RECALL_H

#include "contact/touch.h"

/* Returns the memory with which a touch of the candidate goes on, its own or that of a neighbour
 * from which it slid here, at positions y; or NULL. */
const sw_memory *sw_contact_recalled(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                                     double at, int feature, const double *y);
/* Largest distance along the segment between places of one touch: the given share, or half the
 * distance of samples [-]. */
static inline double sw_contact_within(const sw_candidate *k, double share) {
  return k->samples ? sw_smaller(share, 0.5 / k->samples) : share;
}
/* Of touches nearer to each other than this share of an edge the one with the same feature is
 * meant: an edge and the corner at its end may touch at the same place of the wire, and only one of
 * them presses [-]. */
#define SW_ALMOST_THERE 1e-3

#endif
