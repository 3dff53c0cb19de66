/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A composite of solid elements: its mesh, and the materials and stiffness of its parts. */
#ifndef SW_CALIBRATE_COMPOSITE_SOLID_H
#define SW_CALIBRATE_COMPOSITE_SOLID_H

#include "calibrate/composite.h"
#include "wire/wire.h"

/* Like sw_composite_place, for elements. */
sw_status sw_composite_place_solid(const sw_composite_args *args, double radius, sw_composite *out,
                                   sw_error *err);

/* Areas and second moments of area about the axis [m2, m4]. */
typedef struct sw_composite_areas {
  double shell, core, shell_I, core_I;
} sw_composite_areas;
sw_composite_areas sw_composite_measure(const sw_composite *place);

/* For given materials of both parts: sets those of EA, EI, GJ and mass per length that *section
 * leaves open, as for a circle in a ring. object names the wire in messages. */
sw_status sw_composite_section(const char *object, const sw_composite_args *args,
                               sw_section *section, sw_error *err);

/* Finds the modulus of the core over that of the shell: from the materials, or such that EA and EI
 * are both met; 1 if no two materials meet them. */
sw_status sw_composite_ratio(const sw_composite_args *args, const sw_section *section,
                             const sw_beam *beam, const sw_composite *place, double *ratio,
                             sw_error *err);

/* Finds the Poisson's ratios: the given ones, else one that gives GJ along with EI; NAN if none
 * does [-]. */
void sw_composite_poisson(const sw_composite_args *args, const sw_section *section,
                          const sw_beam *beam, const sw_composite *place, double ratio, double *nu,
                          double *core_nu);

/* Makes the slice of elements. The core's elements are in group SW_GROUP_OF_CORE + SW_GROUP_SOLID.
 * Masses as for one material. */
sw_status sw_lattice_composite_solid(const sw_composite *place, double spacing, sw_lattice *out,
                                     sw_error *err);

/* Sets the masses of such a slice with this share in the core. */
void sw_composite_weigh(const sw_composite *place, double core_share, sw_lattice *lattice);

/* Computes the stiffness of shell and core alone, with these moduli [Pa]. */
sw_status sw_composite_parts(sw_composite *place, const sw_lattice *lattice, const double *k,
                             sw_error *err);

#endif
