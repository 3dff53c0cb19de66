/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sections of wires that are meshes of particles: shape, strain, what presses on them, stress. */
#ifndef SW_READ_SECTION_H
#define SW_READ_SECTION_H

#include "scene/scene.h"

/* Other wires have no such sections: SW_EINVAL. A section's outline are its particles at the
 * surface, in their order round it; the surface is skin further out. */
sw_status sw_scene_wire_outline(sw_scene *scene, sw_handle wire, size_t *count, sw_error *err);

typedef struct sw_section_shape {
  sw_vec middle, tangent, axis;  /* [m], [-]; where its own x has turned to [-] */
  double least, largest;         /* widths between parallel planes along the wire [m] */
  sw_vec least_way, largest_way; /* from one of these planes to the other [-] */
  double ovalisation; /* (largest - least) / (largest + least), as in API RP 1111, of the widths
                         of the smooth closed curve through the outline, so that a round section
                         has none however few its particles; of one that is not round those of the
                         outline itself [-] */
  double area, skin;  /* within the surface [m2], [m] */
  double turn, twist_rate;     /* about the tangent, from the start on, beyond what the middle line
                                  alone turns it [rad], [rad/m] */
  size_t count;                /* of the outline [-] */
  double *particles, *surface; /* (count x 3) the caller's [m] */
  double *axial, *hoop;        /* (count) strains of the lines of particles along and round the
                                  wire, at those of the outline; the caller's [-] */
} sw_section_shape;
sw_status sw_scene_wire_section(sw_scene *scene, sw_handle wire, double s, sw_section_shape *out,
                                sw_error *err);
/* Between planes across direction, of which the part across the wire counts. SW_EINVAL for one
 * that has none. */
sw_status sw_scene_wire_width(sw_scene *scene, sw_handle wire, double s, sw_vec direction,
                              double *width, sw_error *err);

/* What obstacles do to each particle of a mesh, in the order of sw_scene_wire_particle_copy:
 * force, its part across the surface, and the surface that is the particle's own (0 inside),
 * all the caller's (particles x 3) [N], (particles) [N], (particles) [m2]; s of each [m]. */
sw_status sw_scene_wire_pressed(sw_scene *scene, sw_handle wire, double *force,
                                double *normal_force, double *area, double *s, sw_error *err);

/* Solid elements of a mesh; the von Mises stress of each [Pa], its middle (count x 3) [m], and the
 * arc lengths where it begins and ends (count x 2) [m]. */
sw_status sw_scene_wire_elements(sw_scene *scene, sw_handle wire, size_t *count, sw_error *err);
sw_status sw_scene_wire_mises(sw_scene *scene, sw_handle wire, double *mises, double *middle,
                              double *s, sw_error *err);

#endif
