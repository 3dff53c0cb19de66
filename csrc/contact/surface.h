/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Surface of a wire that rolls: its motion where the wire touches an obstacle. */
#ifndef SW_CONTACT_SURFACE_H
#define SW_CONTACT_SURFACE_H

#include "contact/touch.h"

/* How the surface point of a touch moves against the axis, if edges turn about themselves (levers)
 * and if the wire tilts. */
typedef struct sw_levers {
  size_t count, edge; /* 0 (no rolling) to 2 edges; the first of them, in its body */
  sw_vec arm[2];      /* shift per turn [m] */
  size_t node[2];     /* the wire's chord here, as nodes of the system */
  sw_vec along;       /* the wire's direction on the obstacle's surface, unit vector */
  sw_vec pry;         /* shift in this direction per motion of node[1] against node[0] [-] */
  double lies; /* share with which it lies on a round side: its tilt has no effect there [-] */
} sw_levers;

/* Levers of a touch at a node or on a segment from it, with the last evaluation's tangents. */
sw_levers sw_levers_at(const sw_system *s, size_t body, size_t node, int segment, sw_vec normal);
static inline sw_levers sw_touch_levers(const sw_system *s, const sw_touch *t) {
  if (!s->bodies[t->body].roll_block) return (sw_levers){0};
  sw_levers l = sw_levers_at(s, t->body, t->node, t->segment, t->press.normal);
  l.lies = sw_norm(t->edge) / s->bodies[t->body].plan->beam.radius;
  l.pry = sw_scale(l.pry, 1.0 - l.lies);
  return l;
}

/* Shift of the surface against the axis by turns of edges, turn[edge stride] [m], or its speed if
 * these are rates [m/s]. */
sw_vec sw_levers_shift(const sw_levers *l, const double *turn, size_t stride);
/* The same by motions of the system's nodes (nodes x 3) [m], or their velocities [m/s]. */
sw_vec sw_levers_tilt(const sw_levers *l, const double *motion);

/* Adds the touch's friction and stiffness (upper half of K) to the turns and the chord. */
void sw_levers_push(sw_system *s, const sw_touch *t, const double K[6], unsigned want);
/* Change of the axis' velocity that stops the surface's sliding, of at most this size [m/s]. */
sw_vec sw_levers_brake(const sw_beam *beam, const sw_levers *l, sw_vec slide, double most);
/* Adds the change of the edges' rates (edges) by an impulse at the touch [N s]. */
void sw_levers_kick(const sw_plan *p, const sw_levers *l, sw_vec impulse, double *rates);
/* Slide at an impact, with the part along the wire by which both axis and surface slide. The couple
 * of an impulse would throw the neighbours at the obstacle, and impacts would not come to an end.
 * So the impulse acts at the axis, and must not drive it where only the surface slides [m/s]. */
sw_vec sw_levers_struck(const sw_levers *l, sw_vec slide, const double *velocities);

/* Makes the friction of one wire that rolls follow its normal forces, by further solves with the
 * same factor. force_scale: much smaller forces do not matter [N]. */
void sw_contact_refine_rolling(sw_contact *c, sw_system *s, size_t first, size_t end,
                               double force_scale);

#endif
