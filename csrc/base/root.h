/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where a quantity that is measured trial by trial is as wanted: false position between a place
 * where it is too small and one where it is too large, by the Illinois rule (Dowell and Jarratt,
 * BIT 11, 1971), which halves the weight of a side that stays. Until both sides are known who asks
 * finds the next place. */
#ifndef SW_BASE_ROOT_H
#define SW_BASE_ROOT_H

typedef struct sw_bracket {
  double tried[2]; /* places where it was too small and too large [unit of the places] */
  double off[2];   /* how far it was off there; NAN = not known [unit of the quantity] */
  int last_side;   /* which of both was tried last; -1: none [-] */
} sw_bracket;

/* Nothing is known. */
void sw_bracket_clear(sw_bracket *b);
/* It was off by so much at a place. Returns the side that this is: 1 = too large. */
int sw_bracket_add(sw_bracket *b, double at, double off);
/* Forget the other side if a trial contradicts it: falls = 1, the quantity falls from a lower place
 * to a higher one; off: of the trial at that place. */
void sw_bracket_mend(sw_bracket *b, int falls, double at, double off);
/* 1: both sides are known. */
int sw_bracket_closed(const sw_bracket *b);
/* From the place where it is too small to the other one. */
double sw_bracket_width(const sw_bracket *b);
/* Of the chord between both, over the places. */
double sw_bracket_slope(const sw_bracket *b);
/* Before the next place between both is chosen: this side was tried last. */
void sw_bracket_weigh(sw_bracket *b, int side);
/* That place: where the chord is as wanted. */
double sw_bracket_root(const sw_bracket *b);

#endif
