/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a wire bends between two nodes under a push is not in its smooth curve: it bends deeper in
 * the middle between them, and would be held there if a touch did not lean a little along it. */
#ifndef SW_CONTACT_LEAN_H
#define SW_CONTACT_LEAN_H

#include "system/system.h"

/* How much a push on a body leans along it, so many edges from its first node, where the force has
 * been this for a while [-], [N]. */
double sw_lean_of(const sw_system *s, const sw_body *b, double place, double force);

/* The force that it has been for a while, after a step of h [s]: steady before, now force [N]. */
double sw_lean_steady(const sw_body *b, size_t edge, double steady, double force, double h);

#endif
