/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A tube of rings as shell around one or several equal cores, each core a line of particles, layers
 * or voxels: one slice, repeated. If bonded, springs hold core and shell together. If sliding,
 * nothing does, and facing pairs are listed for a contact law. With solid elements it is one mesh
 * of layers; one layer is the face between core and shell. */
#ifndef SW_CALIBRATE_COMPOSITE_H
#define SW_CALIBRATE_COMPOSITE_H

#include "base/param.h"
#include "base/vec.h"
#include "calibrate/cell.h"
#include "calibrate/lattice.h"

enum { SW_CORE_LINE, SW_CORE_RADIAL, SW_CORE_CUBIC };
enum { SW_COMPOSITE_CORES = 7 }; /* most cores in one shell [-] */

typedef struct sw_composite_args {
  int core, bonded;                              /* [-] */
  long cores, particles, reach;                  /* [-] */
  long core_particles, core_layers, core_across; /* of one core; 0: chosen [-] */
  long layers;                                   /* of a shell of elements; 0: chosen [-] */
  double core_radius, wall;                      /* NAN: chosen [m] */
  double core_EA, core_EI, core_GJ;              /* of each core; NAN: chosen [N, N m2, N m2] */
  double core_mass;                              /* of each core; NAN: by areas [kg/m] */
  double friction;                               /* of sliding parts [-] */
  double grip;                                   /* radial line force on each sliding core [N/m] */
  double bond;                                   /* stiffness of the bonds over the usual one [-] */
  double core_E, core_nu, core_density;          /* of elements; NAN: chosen [Pa, -, kg/m3] */
} sw_composite_args;
extern const sw_params sw_composite_params;

/* Two particles that face each other across the gap between their bodies. */
typedef struct sw_slide {
  uint32_t from, to; /* from: in the shell, or in the core with the smaller number */
  double gap;        /* gap between the surfaces they represent, at rest [m] */
} sw_slide;

/* Positions of shell and cores. Particles of a slice: the shell's ring, then core after core. With
 * elements: the core with the particles of the common face, then the shell's. */
typedef struct sw_composite {
  size_t cores, ring, each;          /* cores; particles of the ring and of each core [-] */
  size_t layers, core_layers;        /* with elements: layers of shell and core; else 0 [-] */
  size_t shell_links;                /* the slice's first links are the shell's: their number [-] */
  double radius, bore, core_radius;  /* of the shell outside and inside; of each core [m] */
  double ring_radius;                /* of the shell's particles [m] */
  sw_vec centre[SW_COMPOSITE_CORES]; /* of the cores [m] */
  sw_cell_result shell, core;        /* stiffness of the shell alone, and of each core alone */
  sw_slide *slide;                   /* none if bonded */
  size_t slides, capacity;           /* [-] */
} sw_composite;

/* Sets radii and centres from given values and defaults. SW_EINVAL if the cores do not fit. */
sw_status sw_composite_place(const sw_composite_args *args, double radius, sw_composite *out,
                             sw_error *err);

/* SW_EINVAL for arguments that do not go together, or not with springs, or not with elements. */
sw_status sw_composite_check(const sw_composite_args *args, sw_error *err);
sw_status sw_composite_check_springs(const sw_composite_args *args, sw_error *err);
sw_status sw_composite_check_solid(const sw_composite_args *args, sw_error *err);

/* Finds the share of the mass in each core. mass: NAN if unknown [kg/m]. */
sw_status sw_composite_core_share(const sw_composite_args *args, const sw_composite *place,
                                  double mass, double *share, sw_error *err);

/* Returns the part that a particle of the slice belongs to: 0 = shell, 1 = first core [-]. */
size_t sw_composite_part(const sw_composite *place, size_t particle);

/* Return the numbers of a core's mesh, given or chosen [-]. */
long sw_core_particles(const sw_composite_args *args, const sw_composite *place);
long sw_core_layers(const sw_composite_args *args, const sw_composite *place);
long sw_core_across(const sw_composite_args *args, const sw_composite *place);

/* Makes one core about its own axis, with shares of its own mass. A line has no links. */
sw_status sw_lattice_core(const sw_composite_args *args, const sw_composite *place, double spacing,
                          sw_lattice *out, sw_error *err);

/* Makes the whole slice, its ring at place->ring_radius. core_share: share of the mass in each core
 * [-]. Bonds within the slice and to the next slice have weight 1. */
sw_status sw_lattice_composite(const sw_composite_args *args, const sw_lattice *core,
                               double core_share, sw_composite *place, sw_lattice *out,
                               sw_error *err);

/* Moves the ring to another radius [m]. */
void sw_composite_resize(sw_composite *place, sw_lattice *lattice, double ring_radius);

#endif
