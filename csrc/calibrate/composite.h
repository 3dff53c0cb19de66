/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A tube of rings as shell around one or several equal cores, each a line of particles, layers
 * or voxels: one slice that repeats. Bonded, springs hold core and shell together; sliding,
 * nothing does, and the pairs that face each other are listed for a law of contact. Of solid
 * elements it is one mesh of layers, one of which is the face between core and shell. */
#ifndef SW_CALIBRATE_COMPOSITE_H
#define SW_CALIBRATE_COMPOSITE_H

#include "base/param.h"
#include "base/vec.h"
#include "calibrate/cell.h"
#include "calibrate/lattice.h"

enum { SW_CORE_LINE, SW_CORE_RADIAL, SW_CORE_CUBIC };
enum { SW_COMPOSITE_CORES = 7 }; /* most of one shell [-] */

typedef struct sw_composite_args {
  int core, bonded;                              /* [-] */
  long cores, particles, reach;                  /* [-] */
  long core_particles, core_layers, core_across; /* of one core; 0: chosen [-] */
  long layers;                                   /* of a shell of elements; 0: chosen [-] */
  double core_radius, wall;                      /* NAN: chosen [m] */
  double core_EA, core_EI, core_GJ;              /* of each core; NAN: chosen [N, N m2, N m2] */
  double core_mass;                              /* of each core; NAN: by areas [kg/m] */
  double friction;                               /* of parts that slide [-] */
  double grip;                                   /* presses each core, when they slide [N/m] */
  double bond;                                   /* bonds' stiffness over the usual one [-] */
  double core_E, core_nu, core_density;          /* of elements; NAN: chosen [Pa, -, kg/m3] */
} sw_composite_args;
extern const sw_params sw_composite_params;

/* Two particles that face each other across the clearance of their bodies. */
typedef struct sw_slide {
  uint32_t from, to; /* from: of the shell, or of the core with the smaller number */
  double gap;        /* of the surfaces, which particles stand for, at rest [m] */
} sw_slide;

/* Where shell and cores are. Particles of a slice: the shell's ring, then core after core; of
 * elements the core, with those of the face between both, then the shell's. */
typedef struct sw_composite {
  size_t cores, ring, each;          /* particles of a ring, of each core [-] */
  size_t layers, core_layers;        /* of elements: of the shell and the core; else 0 [-] */
  size_t shell_links;                /* the first ones of the slice [-] */
  double radius, bore, core_radius;  /* of the shell outside and inside, of each core [m] */
  double ring_radius;                /* of the shell's particles [m] */
  sw_vec centre[SW_COMPOSITE_CORES]; /* of the cores [m] */
  sw_cell_result shell, core;        /* what the shell alone is, and each core by itself */
  sw_slide *slide;                   /* none when bonded */
  size_t slides, capacity;           /* [-] */
} sw_composite;

/* Radii and centres, from what was given and defaults. SW_EINVAL where cores have no room. */
sw_status sw_composite_place(const sw_composite_args *args, double radius, sw_composite *out,
                             sw_error *err);

/* SW_EINVAL for what does not go together, or not with springs or elements. */
sw_status sw_composite_check(const sw_composite_args *args, sw_error *err);
sw_status sw_composite_check_springs(const sw_composite_args *args, sw_error *err);
sw_status sw_composite_check_solid(const sw_composite_args *args, sw_error *err);

/* Share of the mass in each core. mass: NAN when not known [kg/m]. */
sw_status sw_composite_core_share(const sw_composite_args *args, const sw_composite *place,
                                  double mass, double *share, sw_error *err);

/* The part that a particle of the slice is of: 0 the shell, 1 the first core [-]. */
size_t sw_composite_part(const sw_composite *place, size_t particle);

/* Numbers of a core's mesh, given or chosen [-]. */
long sw_core_particles(const sw_composite_args *args, const sw_composite *place);
long sw_core_layers(const sw_composite_args *args, const sw_composite *place);
long sw_core_across(const sw_composite_args *args, const sw_composite *place);

/* One core about its own axis, with shares of its own mass. line: without links. */
sw_status sw_lattice_core(const sw_composite_args *args, const sw_composite *place, double spacing,
                          sw_lattice *out, sw_error *err);

/* The whole slice, its ring at place->ring_radius. core_share: of mass in each core [-].
 * Bonds within the slice and to the next one have weight 1. */
sw_status sw_lattice_composite(const sw_composite_args *args, const sw_lattice *core,
                               double core_share, sw_composite *place, sw_lattice *out,
                               sw_error *err);

/* Moves the ring to another radius [m]. */
void sw_composite_resize(sw_composite *place, sw_lattice *lattice, double ring_radius);

#endif
