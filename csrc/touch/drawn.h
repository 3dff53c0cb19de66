/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wires that are drawn taut round something. A touch that is sunk in shortens their way, which
 * lowers their tension: by EA depth turn / length. The usual depth may then be far too much. */
#ifndef SW_TOUCH_DRAWN_H
#define SW_TOUCH_DRAWN_H

#include "system/system.h"

/* First and last of a body's nodes that are fixed; last < first: no such stretch. Numbers are those
 * of the system's arrays. */
typedef struct sw_drawn {
  size_t first, last;
  double taken; /* tension that the depth of its touches takes; 0: not known [N] */
} sw_drawn;

/* The stretch of a line between its holds and joins; none for a web. */
sw_drawn sw_drawn_between(const sw_system *system, size_t body);
/* The same; none for a wire that slides through a hold. */
sw_drawn sw_drawn_of(const sw_system *system, size_t body);
/* Something else fixes the node. */
void sw_drawn_take(sw_drawn *drawn, size_t node);
static inline int sw_drawn_has(const sw_drawn *drawn, size_t node, size_t end) {
  return node >= drawn->first && end <= drawn->last;
}
/* 1 if the line does not just hang. taken: tension to be added, see sw_drawn; usual: force of the
 * line by its weight or bending, sw_contact_usual_force [N]. */
int sw_drawn_is_taut(const sw_system *system, size_t body, size_t node, double taken, double usual);
/* Largest depth of a touch on the segment from node to end, or on a node with end = node, at which
 * the way of a drawn wire is short by less than 1 % of its stretch; HUGE_VAL: any [m]. normal: of
 * the touch [-]; least: no smaller depth is returned [m]. */
double sw_drawn_depth(const sw_system *system, size_t body, size_t node, size_t end, sw_vec normal,
                      double least);

#endif
