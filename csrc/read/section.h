/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sections of wires that are meshes of particles: shape, strain, pressure, stress. */
#ifndef SW_READ_SECTION_H
#define SW_READ_SECTION_H

#include "scene/scene.h"

/* Other wires have no such sections: SW_EINVAL. A section's outline is its particles at the
 * surface, in order round it. The surface is `skin` further out. */
sw_status sw_scene_wire_outline(sw_scene *scene, sw_handle wire, size_t *count, sw_error *err);

typedef struct sw_section_shape {
  sw_vec middle, tangent, axis;  /* axis: where the section's own x has turned to [m], [-], [-] */
  double least, largest;         /* widths between parallel planes along the wire [m] */
  sw_vec least_way, largest_way; /* normals of these planes [-] */
  double ovalisation; /* (largest - least) / (largest + least), as in API RP 1111. The widths are
                       * those of the smooth closed curve through the outline, so a round section
                       * has none, however few its particles; if the outline at rest is no regular
                       * polygon, widths of the outline over those at rest [-] */
  double area, skin;  /* area within the surface [m2], [m] */
  double turn, twist_rate;     /* about the tangent, from the start on, in addition to the turn of
                                * the middle line [rad], [rad/m] */
  size_t count;                /* points of the outline [-] */
  double *particles, *surface; /* (count x 3) the caller's arrays [m] */
  double *axial, *hoop;        /* (count) strains of the lines of particles along and round the
                                * wire, at the outline's particles; the caller's arrays [-] */
} sw_section_shape;
sw_status sw_scene_wire_section(sw_scene *scene, sw_handle wire, double s, sw_section_shape *out,
                                sw_error *err);
/* Returns the width between two planes across a direction, of which the part across the wire
 * counts. SW_EINVAL if there is no such part. */
sw_status sw_scene_wire_width(sw_scene *scene, sw_handle wire, double s, sw_vec direction,
                              double *width, sw_error *err);

/* Load of obstacles on each particle of a mesh, in the order of sw_scene_wire_particle_copy: force
 * (particles x 3) [N], its part across the surface (particles) [N], the surface area of the
 * particle (particles; 0 inside) [m2], arc length (particles) [m]. The arrays are the caller's. */
sw_status sw_scene_wire_pressed(sw_scene *scene, sw_handle wire, double *force,
                                double *normal_force, double *area, double *s, sw_error *err);

/* Solid elements of a mesh: the von Mises stress of each [Pa], its middle (count x 3) [m], and the
 * arc lengths of its two ends (count x 2) [m]. */
sw_status sw_scene_wire_elements(sw_scene *scene, sw_handle wire, size_t *count, sw_error *err);
sw_status sw_scene_wire_mises(sw_scene *scene, sw_handle wire, double *mises, double *middle,
                              double *s, sw_error *err);

#endif
