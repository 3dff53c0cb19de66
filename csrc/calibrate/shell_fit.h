/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fits a composite's shell so that a mesh has given EA, EI and GJ, by its springs along the wire,
 * its diagonals and its ring's radius. The springs that keep the ring round change with those along
 * the wire. */
#ifndef SW_CALIBRATE_SHELL_FIT_H
#define SW_CALIBRATE_SHELL_FIT_H

#include "calibrate/calibrate.h"

enum { SW_SHELL_EA, SW_SHELL_EI, SW_SHELL_GJ, SW_SHELL_TARGETS };

/* Sets the stiffness of the shell's groups by closed forms. shell: a view of out's lattice with the
 * shell alone. target: EA, EI, GJ [N, N m2, N m2]. */
void sw_shell_guess(sw_calibration *out, sw_cell shell, const double *target);

/* Changes the shell's groups of out->k and its ring until cell, a view of out's lattice, meets the
 * targets or comes as near as possible; both give SW_OK. */
sw_status sw_shell_fit(sw_calibration *out, sw_cell cell, const double *target, sw_error *err);

#endif
