/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Crossing wires meet by their smooth curves: chords would hold one that slides over another, as on
 * pegs (spec/contact/crossing_spec). */
#ifndef SW_CONTACT_PAIRS_CURVE_H
#define SW_CONTACT_PAIRS_CURVE_H

#include "contact/pair.h"

/* How the wires of a new pair meet, at the step's start. */
void sw_pair_find_curves(const sw_pairs *p, const sw_system *s, sw_pair *k);
/* How far the nodes at the ends of the edge that begins at a node are from the middles of their
 * neighbours, at most, twice [m]. */
double sw_pair_off_middle(const sw_body *b, uint32_t node, const double *x);
/* How far the smooth curves of two segments stand off them together, where they may meet by those
 * [m]. */
double sw_pair_bulge(const sw_pairs *p, const sw_system *s, const sw_near *n);

/* A place along one of a pair's segments. */
sw_bow sw_pair_bow(const sw_system *s, const sw_pair *k, int side, double at);
/* Where the curves cross, from at; both places, and whether they may slide. 0: beside the pair. */
int sw_pair_crossing(const sw_system *s, const sw_pair *k, const double *y, double at[2],
                     int slides[2]);
/* Towards wire one there, square to what may slide. */
sw_vec sw_pair_normal(const double *y, const sw_bow bow[2], const int slides[2]);
/* The same for a touch that has had this normal force for a while [N]. */
sw_vec sw_pair_leaning(const sw_system *s, const sw_pair *k, const double *y, const sw_meet *t,
                       sw_vec normal, double steady);

#endif
