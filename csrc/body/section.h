/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A wire that is a mesh of particles read as a wire. */
#ifndef SW_BODY_SECTION_H
#define SW_BODY_SECTION_H

#include "scene/wire.h"

/* What is carried by slice number r, between rings r and r + 1, and how it is bent. T: axial forces
 * of its springs, those of the state: in a step by few iterations their lengths at x are rougher
 * than they are [N]. */
typedef struct sw_slice {
  double tension, twist_moment, curvature; /* [N], [N m], [1/m] */
  sw_vec bend;                             /* the curvature, towards its middle [1/m] */
} sw_slice;
sw_slice sw_strand_slice(const sw_plan *plan, const double *x, const double *T, size_t r);
/* Read-outs at arc length s; extremes. */
void sw_strand_at(const sw_scene *scene, const sw_scene_wire *wire, const sw_body *body, double s,
                  sw_point_state *out);
/* Bending moment in the slice of a mesh that has a place [m], [N m]. */
double sw_strand_moment(const sw_plan *plan, const double *x, const double *T, double place);
/* tension (rings - 1), or NULL: what is carried between two rings [N]. */
void sw_strand_extremes(const sw_scene *scene, size_t wire, double *tension, sw_wire_extremes *now);

#endif
