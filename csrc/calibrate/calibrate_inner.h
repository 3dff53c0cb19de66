/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of the calibration. */
#ifndef SW_CALIBRATE_CALIBRATE_INNER_H
#define SW_CALIBRATE_CALIBRATE_INNER_H

#include "calibrate/calibrate.h"

/* The mesh for a beam; spacing chosen for springs when the arguments have none. */
sw_status sw_calibrate_lattice(const sw_calibrate_args *args, const sw_beam *beam,
                               sw_lattice_args *mesh, sw_lattice *out, sw_error *err);

/* The same for a composite of elements. */
sw_status sw_calibrate_composite_lattice(const sw_composite *place, const sw_beam *beam,
                                         double spacing, sw_lattice *out, sw_error *err);

/* Residuals from what was reached; returns the largest that counts. */
double sw_calibrate_residuals(sw_calibration *calibration);

/* Number of links and elements by group. */
void sw_calibrate_count(sw_calibration *calibration);

/* Elements, and springs where they are needed: sw_calibrate for body = "solid". */
sw_status sw_calibrate_solid(const sw_calibrate_args *args, const sw_section *section,
                             const sw_beam *beam, sw_lattice_args *mesh, sw_calibration *out,
                             sw_error *err);

#endif
