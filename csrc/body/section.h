/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads a wire that is a mesh of particles as a wire. */
#ifndef SW_BODY_SECTION_H
#define SW_BODY_SECTION_H

#include "scene/wire.h"

/* Forces and bend of slice number r, between rings r and r + 1. T: elastic axial forces of its
 * springs, from the state; pull: the same with the forces of their dashpots, or T [N]. After a step
 * of few iterations the springs' lengths at x would give rougher ones. */
typedef struct sw_slice {
  double tension, elastic;        /* axial force; the same without dashpots [N] */
  double twist_moment, curvature; /* [N m], [1/m] */
  sw_vec bend;                    /* the curvature, towards its centre [1/m] */
} sw_slice;
sw_slice sw_strand_slice(const sw_plan *plan, const double *x, const double *T, const double *pull,
                         size_t r);
/* Read-outs at arc length s. */
void sw_strand_at(const sw_scene *scene, const sw_scene_wire *wire, const sw_body *body, double s,
                  sw_point_state *out);
/* Returns the bending moment in the slice of a mesh at a place [m], [N m]. */
double sw_strand_moment(const sw_plan *plan, const double *x, const double *T, double place);
/* Finds the extremes. tension (rings - 1), or NULL: tension between two rings [N]. */
void sw_strand_extremes(const sw_scene *scene, size_t wire, double *tension, sw_wire_extremes *now);

#endif
