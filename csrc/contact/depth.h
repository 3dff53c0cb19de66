/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Depth of touches with obstacles: how deep a touch may be, how deep it was, and which depth a step
 * leaves alone. */
#ifndef SW_CONTACT_DEPTH_H
#define SW_CONTACT_DEPTH_H

#include "contact/touch.h"

/* Depth that the touch may have [m]. */
double sw_contact_deepest(const sw_contact *c, const sw_system *s, const sw_touch *t);
/* Depth of the touch's place at the step's start, negative outside [m]. It is measured along the
 * wire's way from there, so that a wire that has not moved is as deep as its gap says. */
double sw_contact_depth_before(const sw_contact *c, const sw_system *s, const sw_touch *t);
/* Sets how much of its depth a touch leaves alone in this step. last: its memory, or NULL. */
void sw_contact_forgive(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                        const sw_kept *last, const double *y, sw_touch *t);
/* 1 if the touch of a line must not be made stiffer within the step, because what it bears would be
 * thrown: it bears far more than the line's weight, or is deeper than it may be, as statics leave
 * it. Such touches become stiffer from step to step. */
int sw_contact_is_squeezed(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                           const sw_kept *last, const sw_touch *t);

#endif
