/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions shared by the files of the calibration. */
#ifndef SW_CALIBRATE_CALIBRATE_INNER_H
#define SW_CALIBRATE_CALIBRATE_INNER_H

#include "calibrate/calibrate.h"

/* Makes the mesh for a beam. A spacing that args leave open is chosen for springs. */
sw_status sw_calibrate_lattice(const sw_calibrate_args *args, const sw_beam *beam,
                               sw_lattice_args *mesh, sw_lattice *out, sw_error *err);

/* Makes the mesh of a composite of elements. */
sw_status sw_calibrate_composite_lattice(const sw_composite *place, const sw_beam *beam,
                                         double spacing, sw_lattice *out, sw_error *err);

/* Computes the residuals from the reached values; returns the largest requested one. */
double sw_calibrate_residuals(sw_calibration *calibration);

/* Counts links and elements by group. */
void sw_calibrate_count(sw_calibration *calibration);

/* sw_calibrate for body = "solid": elements, and springs where needed. */
sw_status sw_calibrate_solid(const sw_calibrate_args *args, const sw_section *section,
                             const sw_beam *beam, sw_lattice_args *mesh, sw_calibration *out,
                             sw_error *err);

#endif
