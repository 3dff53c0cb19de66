/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The way from an iterate to its solution. A solve holds for assumed states of touches (pressing,
 * sticking), and taking its new states may go round in circles for ever. But with given normal
 * forces for friction the energy is convex along the way: it has a minimum there, and steps to such
 * minima always end. Only the touches' own forces are needed for it; the rest is linear. */
#ifndef SW_CONTACT_WAY_H
#define SW_CONTACT_WAY_H

#include <stddef.h>

#include "contact/law.h"

/* The force of a touch by its law, shifted by s, with friction's normal force as given [N]. */
sw_vec sw_press_at(const sw_press *press, double friction, sw_vec s);
/* The next solve is for the states that the touch has there; may: it may press. */
void sw_press_go_on(sw_press *press, double friction, sw_vec s, int may);

/* Where a slope that rises along the way becomes positive [-]: 1 if not before its end. */
double sw_way_least(double (*slope)(const void *user, double share), const void *user);

/* A touch on the way. */
typedef struct sw_way {
  sw_press *press;
  double friction;     /* [-] */
  sw_vec shift;        /* over the whole way [m] */
  double begins, ends; /* assumed force along the shift, at both ends of the way [J] */
} sw_way;

typedef struct sw_ways {
  sw_way *list; /* touches that press, or would after the whole way */
  size_t count, capacity;
  double work; /* right-hand sides times the solution [J] */
} sw_ways;

/* Out of memory it is left out. */
void sw_ways_add(sw_ways *ways, sw_press *press, double friction, sw_vec shift);
/* The share of the way up to the least energy; 1: at the end its slope is not above this share of
 * that at the beginning. If below 1, touches go on with their states there. */
double sw_ways_share(sw_ways *ways, double accepted);

#endif
