/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rings of a mesh of particles along a wire, and the outlines of its sections. */
#ifndef SW_STRAND_RING_H
#define SW_STRAND_RING_H

#include "base/extreme.h"
#include "calibrate/calibrate.h"
#include "state/mesh.h"
#include "state/web.h"

/* Rings between the arc lengths s1 and s2, at least the one nearest to their middle; sets s1 and s2
 * to the first and the last of them [m]. */
void sw_strand_rings(const sw_mesh *mesh, double *s1, double *s2);
/* Middle of ring number r of particles at x, and the direction across the area that its surface
 * encloses [m], [-]. */
sw_vec sw_strand_middle(const sw_web *web, const double *x, size_t ring);
sw_vec sw_strand_facing(const sw_web *web, const double *x, size_t ring);
/* The angle by which the outline of a ring is turned about its tangent against u, in which the
 * undeformed section has its x: of the rotation that brings it nearest [rad]. */
double sw_strand_turned(const sw_web *web, const double *x, size_t ring, sw_vec tangent, sw_vec u);
/* How wide an outline (count x 3) is across the tangent. */
typedef struct sw_widths {
  double least, largest;         /* [m] */
  sw_vec least_way, largest_way; /* [-] */
} sw_widths;
enum { SW_OUTLINE = SW_CELL_PARTICLES }; /* most points of an outline [-] */
sw_widths sw_outline_widths(const double *outline, size_t count, sw_vec tangent);
/* See sw_section_shape; and for all rings at once, of the one that is out of round most [-]. */
double sw_outline_ovalisation(const sw_web *web, const double *outline, sw_vec tangent);
sw_extreme sw_strand_ovalisation(const sw_web *web, const double *x);
/* Of a hollow section of one layer at s: how far walls that face each other are apart, 0 when they
 * cross; others: infinite [m]. */
double sw_strand_walls_apart(const sw_web *web, const double *x, double s);
/* How far the worst face of a section of springs is turned over: minus its area over that at rest,
 * above 0 when it is [-]. */
sw_extreme sw_strand_folding(const sw_web *web, const double *x);
/* Points of the outline (count x 3) moved outwards by skin. */
void sw_outline_widen(const double *outline, size_t count, sw_vec tangent, double skin,
                      double *out);
/* The outline of ring number r [m]. */
void sw_strand_outline(const sw_web *web, const double *x, size_t ring, double *out);

#endif
