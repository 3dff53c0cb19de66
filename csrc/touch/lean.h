/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lean of a touch along the wire. Under a push a wire bends more in the middle between two nodes;
 * its smooth curve does not contain this bend. Without it the wire would be held there, so the
 * touch leans a little along the wire. */
#ifndef SW_TOUCH_LEAN_H
#define SW_TOUCH_LEAN_H

#include "system/system.h"

/* Lean of a push along a body [-]. place: number of edges from its first node; force: steady force
 * [N]. */
double sw_lean_of(const sw_system *s, const sw_body *b, double place, double force);

/* The steady force after a step of h [s], from the steady force before and the force now [N]. */
double sw_lean_steady(const sw_body *b, size_t edge, double steady, double force, double h);

#endif
