/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Crossing wires touch at their smooth curves. Chords would stop a wire that slides over another
 * one, as on pegs (spec/contact/crossing_spec). */
#ifndef SW_MUTUAL_PAIRS_CURVE_H
#define SW_MUTUAL_PAIRS_CURVE_H

#include "mutual/pair.h"

/* Decides at the step's start whether the wires of a new pair touch with curves or chords. */
void sw_pair_find_curves(const sw_pairs *p, const sw_system *s, sw_pair *k);
/* Largest distance of the edge's nodes from the middles between their neighbours, times two [m].
 * node: the edge's first node. */
double sw_pair_off_middle(const sw_body *b, uint32_t node, const double *x);
/* Sum of the largest distances of two segments' smooth curves from the segments; 0 where they touch
 * with chords [m]. */
double sw_pair_bulge(const sw_pairs *p, const sw_system *s, const sw_near *n);

/* Returns a place along one of a pair's segments. */
sw_bow sw_pair_bow(const sw_system *s, const sw_pair *k, int side, double at);
/* Finds the crossing of the curves, starting from `at`: both places, and whether they may slide. 0:
 * the curves cross beside the pair. */
int sw_pair_crossing(const sw_system *s, const sw_pair *k, const double *y, double at[2],
                     int slides[2]);
/* Normal at a crossing: towards wire one, perpendicular to the curves whose places slide. */
sw_vec sw_pair_normal(const double *y, const sw_bow bow[2], const int slides[2]);
/* The normal with the lean of a touch that has had this normal force for a while [N]. */
sw_vec sw_pair_leaning(const sw_system *s, const sw_pair *k, const double *y, const sw_meet *t,
                       sw_vec normal, double steady);

#endif
