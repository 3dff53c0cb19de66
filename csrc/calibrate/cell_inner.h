/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions shared by the files of the cell. */
#ifndef SW_CALIBRATE_CELL_INNER_H
#define SW_CALIBRATE_CELL_INNER_H

#include "base/vec.h"
#include "calibrate/cell.h"

enum { SW_CELL_SIDES = SW_CELL_STRAINS + 1 }; /* right-hand sides: strains, and plates [-] */

/* Fills the displacements at p under unit strains: sections turn by z times curvatures and
 * twist. */
void sw_cell_macro(sw_vec p, sw_vec u[SW_CELL_STRAINS]);

/* The solid elements' contributions. assemble adds to K (n x n) and to the right-hand sides (sides
 * x n). collect adds the energy stored in the relaxed state v (sides x n; NULL: none) to the parts
 * of the groups and returns the compliance under the plates [m/N]. k: stiffness of each group. */
sw_status sw_cell_check_solids(const sw_cell *cell, sw_error *err);
void sw_cell_assemble_solids(const sw_cell *cell, const double *k, double *K, double *right);
double sw_cell_collect_solids(const sw_cell *cell, const double *k, const double *v, double *parts);

#endif
