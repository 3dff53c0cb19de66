/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The path from an iterate to its solution: a line search that keeps touches from cycling. A solve
 * assumes states of touches (pressing, sticking). If the new states are taken fully each time, the
 * iteration may cycle without end. With given normal forces for friction the energy is convex along
 * the path and has a minimum there. A sequence of steps to such minima always ends. The minimum
 * needs only the touches' own forces; the rest is linear. */
#ifndef SW_TOUCH_WAY_H
#define SW_TOUCH_WAY_H

#include <stddef.h>

#include "touch/law.h"

/* Force of a touch by the contact law at a shift s, with the given normal force for friction
 * [N]. */
sw_vec sw_press_at(const sw_press *press, double friction, sw_vec s);
/* Sets the states for the next solve to those that the touch has when shifted by s. may: 1 if it
 * may press. */
void sw_press_go_on(sw_press *press, double friction, sw_vec s, int may);

/* Returns where a slope that rises along the path becomes positive [-]; 1 if it does not. */
double sw_way_least(double (*slope)(const void *user, double share), const void *user);

/* A touch on the way. */
typedef struct sw_way {
  sw_press *press;
  double friction;     /* [-] */
  sw_vec shift;        /* shift over the whole way [m] */
  double begins, ends; /* work of the assumed force over the shift, for the forces at both ends of
                          the path [J] */
} sw_way;

typedef struct sw_ways {
  sw_way *list; /* touches that press, or would after the whole way */
  size_t count, capacity;
  double work; /* right-hand sides times the solution [J] */
} sw_ways;

/* Adds a touch. If memory runs out, the touch is left out. */
void sw_ways_add(sw_ways *ways, sw_press *press, double friction, sw_vec shift);
/* Returns the share of the path up to the least energy. Returns 1 if the slope at the end is at
 * most `accepted` times that at the beginning, in size. If the share is below 1, touches continue
 * with their states there. */
double sw_ways_share(sw_ways *ways, double accepted);

#endif
