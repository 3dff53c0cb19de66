/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rings of a mesh of particles along a wire, and the outlines of its sections. */
#ifndef SW_STRAND_RING_H
#define SW_STRAND_RING_H

#include "base/extreme.h"
#include "calibrate/calibrate.h"
#include "state/mesh.h"
#include "state/web.h"

/* Sets s1 and s2 to the first and last ring between them, or to the ring nearest their middle if
 * there is none between [m]. */
void sw_strand_rings(const sw_mesh *mesh, double *s1, double *s2);
/* Returns the angle by which a ring's outline is rotated about its tangent relative to u, the x
 * axis of the undeformed section: the angle of the best-fitting rotation [rad]. */
double sw_strand_turned(const sw_web *web, const double *x, size_t ring, sw_vec tangent, sw_vec u);
/* Widths of an outline (count x 3) across the tangent. */
typedef struct sw_widths {
  double least, largest;         /* [m] */
  sw_vec least_way, largest_way; /* [-] */
} sw_widths;
enum { SW_OUTLINE = SW_CELL_PARTICLES }; /* most points of an outline [-] */
sw_widths sw_outline_widths(const double *outline, size_t count, sw_vec tangent);
/* Ovalisation, see sw_section_shape: of one outline, and of a wire's most oval ring [-]. */
double sw_outline_ovalisation(const sw_web *web, const double *outline, sw_vec tangent);
sw_extreme sw_strand_ovalisation(const sw_web *web, const double *x);
/* For a hollow section of one layer at s: returns the least distance of facing walls, 0 if they
 * cross; for other sections infinity [m]. */
double sw_strand_walls_apart(const sw_web *web, const double *x, double s);
/* Returns, over all faces of the sections, the largest value of minus the area over the area at
 * rest: above 0 if a face is turned over [-]. */
sw_extreme sw_strand_folding(const sw_web *web, const double *x);
/* 1 if the undeformed outline is a regular polygon. */
int sw_outline_is_round(const sw_web *web);
/* Moves the points of the outline (count x 3) outwards by skin. */
void sw_outline_widen(const double *outline, size_t count, sw_vec tangent, double skin,
                      double *out);
/* Fills the outline of ring number r [m]. */
void sw_strand_outline(const sw_web *web, const double *x, size_t ring, double *out);

#endif
