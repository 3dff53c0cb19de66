/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A thin round obstacle touches the wire's smooth curve, as edges and corners do. Its radius may be
 * up to four edges if the wire does not go round it. Chords would stop a wire that slides over a
 * peg (spec/contact/pegs_spec). */
#ifndef SW_CONTACT_ROUND_H
#define SW_CONTACT_ROUND_H

#include "contact/curve.h"

/* An obstacle is thick if its radius plus the wire's is more than this many edges. A wire that
 * begins to go round a thick obstacle touches it with its chords, with a stiffness of at least EA
 * over that radius [-]. */
#define SW_THICK 4.0

/* Finds the obstacles that a body goes round at the step's start. */
void sw_contact_find_wound(sw_contact *c, const sw_system *s, size_t body);
/* Decides at the step's start whether the wire's curve touches the candidate's obstacle, and how
 * firmly touches stay in the middle of edges. */
void sw_contact_find_round(const sw_contact *c, const sw_system *s, sw_candidate *k);

/* Returns the index of the first memory of this node or a later one. */
size_t sw_contact_first_memory(const sw_contact *c, size_t node);
/* Finds the obstacles on which a body presses with its curve at the step's start, or taut. */
void sw_contact_find_curved(sw_contact *c, const sw_system *s, size_t body);
/* 1 if the wire meets the candidate's obstacle, of facets, with its curve. */
int sw_contact_meets_curve(const sw_contact *c, const sw_system *s, const sw_candidate *k);

/* Lists the places of a piece less than reach away [m]. */
void sw_contact_round_places(const sw_piece *piece, double reach, sw_places *list);

/* 1 if a wire lies across the round side at this place of its chord a-b, in the obstacle's
 * coordinates. There the wire's curve touches. */
int sw_contact_is_rounds(const sw_contact *c, const sw_candidate *k, sw_vec a, sw_vec b, double at);
/* 1 if a node's nearest place is on the round side. *along: direction of the middle line there. */
int sw_contact_over_round(const sw_contact *c, const sw_candidate *k, const sw_closest *near,
                          sw_vec *along);

#endif
