/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A thin round obstacle meets the wire's smooth curve, as edges and corners do; up to four edges
 * thick if the wire does not go round it. Chords would hold a wire that slides over a peg
 * (spec/contact/pegs_spec). */
#ifndef SW_CONTACT_ROUND_H
#define SW_CONTACT_ROUND_H

#include "contact/curve.h"

/* Obstacles whose radius, with the wire's, is more edges than this are thick: a wire that begins to
 * go round them meets them by chords, which are as stiff as it is [-]. */
#define SW_THICK 4.0

/* The obstacles that a body goes round at the step's start. */
void sw_contact_find_wound(sw_contact *c, const sw_system *s, size_t body);
/* At the step's start: is the candidate's obstacle round and thin for the wire, and how firmly do
 * touches keep to the middles of edges? */
void sw_contact_find_round(const sw_contact *c, const sw_system *s, sw_candidate *k);

/* Places of a piece that are less than reach away from it [m]. */
void sw_contact_round_places(const sw_piece *piece, double reach, sw_places *list);

/* 1: at this place of its chord a-b, in the obstacle's coordinates, a wire lies across the round
 * side: its curve meets that. */
int sw_contact_is_rounds(const sw_contact *c, const sw_candidate *k, sw_vec a, sw_vec b, double at);
/* 1: a node's nearest place is on the round side and along it. */
int sw_contact_over_round(const sw_contact *c, const sw_candidate *k, const sw_closest *near,
                          sw_vec *along);

#endif
