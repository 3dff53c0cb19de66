/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Depth of touches with obstacles: its limit, its value at the step's start, and the part that a
 * step does not correct. */
#ifndef SW_CONTACT_DEPTH_H
#define SW_CONTACT_DEPTH_H

#include "contact/touch.h"

/* Marks those of the body's candidates, from number first on, with a hold, a join or
 * pads on both sides. */
void sw_contact_find_drawn(sw_contact *c, const sw_system *s, size_t body, size_t first);
/* Largest allowed depth of the touch [m]. */
double sw_contact_deepest(const sw_contact *c, const sw_system *s, const sw_touch *t);
/* Depth of the touch's place at the step's start, negative outside [m]. It is measured along the
 * wire's path from there, so that a wire that has not moved has the depth of its gap. */
double sw_contact_depth_before(const sw_contact *c, const sw_system *s, const sw_touch *t);
/* Sets the part of its depth that the step does not correct. last: the touch's memory, or NULL. */
void sw_contact_forgive(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                        const sw_kept *last, const double *y, sw_touch *t);
/* 1 if the touch of a line must not be stiffened within the step: it carries far more than the
 * line's weight, or is deeper than allowed, as statics may leave it, and its wire would be thrown.
 * Such touches are stiffened from step to step. */
int sw_contact_is_squeezed(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                           const sw_kept *last, const sw_touch *t);

#endif
