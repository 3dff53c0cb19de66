/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A wire that is a mesh of particles read as a wire. */
#ifndef SW_BODY_SECTION_H
#define SW_BODY_SECTION_H

#include "scene/wire.h"

/* Read-outs at arc length s; extremes. */
void sw_strand_at(const sw_scene *scene, const sw_scene_wire *wire, const sw_body *body, double s,
                  sw_point_state *out);
/* Bending moment in the slice of a mesh that has a place [m], [N m]. */
double sw_strand_moment(const sw_plan *plan, const double *x, double place);
/* tension (rings - 1), or NULL: what is carried between two rings [N]. */
void sw_strand_extremes(const sw_scene *scene, size_t wire, double *tension, sw_wire_extremes *now);

#endif
