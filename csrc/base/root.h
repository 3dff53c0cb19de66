/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Root finding for a quantity that is measured trial by trial: finds the place with the target
 * value. Method: false position between a place with too small a value and one with too large a
 * value. The Illinois rule (Dowell and Jarratt, BIT 11, 1971) halves the weight of a side that
 * stays. The caller chooses the places until both sides are known. */
#ifndef SW_BASE_ROOT_H
#define SW_BASE_ROOT_H

typedef struct sw_bracket {
  double tried[2]; /* places: [0] quantity too small, [1] too large [unit of the places] */
  double off[2];   /* quantity less target there; NAN = not known [unit of the quantity] */
  int last_side;   /* side of the last trial; -1: none [-] */
} sw_bracket;

/* Forgets all trials. */
void sw_bracket_clear(sw_bracket *b);
/* Records a trial at a place: off is the quantity less its target. Returns the trial's side: 1 =
 * too large. */
int sw_bracket_add(sw_bracket *b, double at, double off);
/* Forgets the other side if a trial (at, off) contradicts it. falls = 1: the quantity falls with
 * rising place. */
void sw_bracket_mend(sw_bracket *b, int falls, double at, double off);
/* 1 if both sides are known. */
int sw_bracket_closed(const sw_bracket *b);
/* Distance from the place on the too-small side to the other one, with its sign. */
double sw_bracket_width(const sw_bracket *b);
/* Slope of the chord between both sides. */
double sw_bracket_slope(const sw_bracket *b);
/* Applies the Illinois rule: side is that of the last trial. Call it before sw_bracket_root. */
void sw_bracket_weigh(sw_bracket *b, int side);
/* Returns the next place to try: the root of the chord. */
double sw_bracket_root(const sw_bracket *b);

#endif
