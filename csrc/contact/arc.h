/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The arc of a wire that goes round an obstacle. The wire is as long as its edges. So on a circle
 * of radius R the nodes lie outside the wire's curve by h^2/(24 R), and the middles of the chords
 * inside by h^2/(12 R). Chords that lay on the circle would be too long by h^2/(12 R^2), and a
 * stiff cable led round a drum would be taut too early. Therefore chords and curves may come nearer
 * to a round side by h^2 K/12, with the wire's curvature K. */
#ifndef SW_CONTACT_ARC_H
#define SW_CONTACT_ARC_H

#include "contact/curve.h"

/* 1 if a candidate touches a round side with its arc. */
int sw_contact_arcs(const sw_contact *c, const sw_system *s, const sw_candidate *k);

/* Distance of a candidate's arc from its chord or smooth curve at a place, in the direction of this
 * world normal [m]. In time steps it is computed at the start of the step, so that the wire's
 * equations do not depend on it; in statics from the nodes at y. */
double sw_contact_arc_rise(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                           const sw_place *place, const double *y, sw_vec normal);
/* The same for the touch of a chord in a step, with the memory of the touch there, or NULL. */
double sw_contact_arc_mean(const sw_system *s, const sw_candidate *k, const sw_memory *m,
                           double rise);

/* A wire that rolls and goes round something: the surface of its chords would slide while they take
 * their places. A chord presses, with the whole shear force of the wire that arrives, before it has
 * all of its tilt; its tilt then drew the wire back by mu times that force, and a wire wound on a
 * drum kept up to 17 % too much tension, with edges of any length. The wire itself is bent when it
 * touches, and then a section has the tilt of the place where it lies: if its axis slides by u, its
 * surface slides by u (1 - r K), with the curvature K of the wire's way round. So friction along
 * such a wire acts at its axis, without a couple, and the coefficient includes the lever
 * (spec/contact/rolling_drum_spec). Returns the wire's direction, in the obstacle's coordinates,
 * times the part of its radius that is no lever of friction along it; nodes at y [m]. */
sw_vec sw_contact_arc_lies(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                           const double *y, const sw_touch *t);

/* Coefficient of friction on chords round an obstacle [-]. Chords touch in their middles and
 * friction turns with them, while on a wire it follows the arc. If a chord and its pressing
 * neighbours turn by phi from middle to middle, ln(T2/T1) = mu phi needs the coefficient sinh(mu
 * phi)/sin(phi) instead of mu (balance of a polygon's corners). */
double sw_contact_arc_friction(const sw_contact *c, const sw_system *s, const sw_memory *m,
                               const sw_touch *t, double mu);

#endif
