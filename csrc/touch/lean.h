/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lean of a touch along the wire. Under a push a wire bends deeper in the middle between two nodes;
 * its smooth curve does not show this bend. The missing bend would hold the wire there, so the
 * touch leans a little along the wire. */
#ifndef SW_TOUCH_LEAN_H
#define SW_TOUCH_LEAN_H

#include "system/system.h"

/* Lean of a push along a body [-], this many edges from its first node, under this steady force
 * [N]. */
double sw_lean_of(const sw_system *s, const sw_body *b, double place, double force);

/* The steady force after a step of h [s], from the steady force before and the force now [N]. */
double sw_lean_steady(const sw_body *b, size_t edge, double steady, double force, double h);

#endif
