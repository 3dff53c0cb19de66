/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of the cell. */
#ifndef SW_CALIBRATE_CELL_INNER_H
#define SW_CALIBRATE_CELL_INNER_H

#include "base/vec.h"
#include "calibrate/cell.h"

enum { SW_CELL_SIDES = SW_CELL_STRAINS + 1 }; /* right sides: the strains, and the plates [-] */

/* Displacement at p by unit strains: sections turn by z times the curvatures and the twist. */
void sw_cell_macro(sw_vec p, sw_vec u[SW_CELL_STRAINS]);

/* The solid elements' part of K (n x n), of the right sides (sides x n), and of what is stored
 * in the relaxed state v (sides x n; NULL: none): adds to the parts of their groups and returns
 * the compliance under the plates [m/N]. k: of each group. */
sw_status sw_cell_check_solids(const sw_cell *cell, sw_error *err);
void sw_cell_assemble_solids(const sw_cell *cell, const double *k, double *K, double *right);
double sw_cell_collect_solids(const sw_cell *cell, const double *k, const double *v, double *parts);

#endif
