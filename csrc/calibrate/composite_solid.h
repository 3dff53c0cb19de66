/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A composite of solid elements: its mesh, the materials of its parts, what they are. */
#ifndef SW_CALIBRATE_COMPOSITE_SOLID_H
#define SW_CALIBRATE_COMPOSITE_SOLID_H

#include "calibrate/composite.h"
#include "wire/wire.h"

/* As sw_composite_place, for elements. */
sw_status sw_composite_place_solid(const sw_composite_args *args, double radius, sw_composite *out,
                                   sw_error *err);

/* Areas and their second moments about the axis [m2, m4]. */
typedef struct sw_composite_areas {
  double shell, core, shell_I, core_I;
} sw_composite_areas;
sw_composite_areas sw_composite_measure(const sw_composite *place);

/* A composite of elements whose parts' materials are given: EA, EI, GJ and mass per length of a
 * circle in a ring, into what *section does not give. object names the wire in messages. */
sw_status sw_composite_section(const char *object, const sw_composite_args *args,
                               sw_section *section, sw_error *err);

/* Modulus of the core over that of the shell: of their materials, or so that EA and EI come
 * together; 1 where no two materials would. */
sw_status sw_composite_ratio(const sw_composite_args *args, const sw_section *section,
                             const sw_beam *beam, const sw_composite *place, double *ratio,
                             sw_error *err);

/* The Poisson's ratios that were given; else one that makes GJ of EI, NAN when none does [-]. */
void sw_composite_poisson(const sw_composite_args *args, const sw_section *section,
                          const sw_beam *beam, const sw_composite *place, double ratio, double *nu,
                          double *core_nu);

/* The slice of elements: the core's are of group SW_GROUP_OF_CORE + SW_GROUP_SOLID. Masses as of
 * one material. */
sw_status sw_lattice_composite_solid(const sw_composite *place, double spacing, sw_lattice *out,
                                     sw_error *err);

/* Masses of such a slice with this share of them in the core. */
void sw_composite_weigh(const sw_composite *place, double core_share, sw_lattice *lattice);

/* Stiffness of the elements of shell and core by themselves, with these moduli [Pa]. */
sw_status sw_composite_parts(sw_composite *place, const sw_lattice *lattice, const double *k,
                             sw_error *err);

#endif
