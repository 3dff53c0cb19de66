/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A composite's shell that gives a mesh EA, EI and GJ: by its springs along the wire, its
 * diagonals and the radius of its ring. The springs that hold the ring round follow those along
 * the wire. */
#ifndef SW_CALIBRATE_SHELL_FIT_H
#define SW_CALIBRATE_SHELL_FIT_H

#include "calibrate/calibrate.h"

enum { SW_SHELL_EA, SW_SHELL_EI, SW_SHELL_GJ, SW_SHELL_TARGETS };

/* Stiffness of the shell's groups by closed forms. shell: a view of out's lattice with the
 * shell alone. target: EA, EI, GJ [N, N m2, N m2]. */
void sw_shell_guess(sw_calibration *out, sw_cell shell, const double *target);

/* Changes the shell's groups of out->k and its ring until cell, a view of out's lattice, meets
 * the targets or comes nearest to them; either is SW_OK. */
sw_status sw_shell_fit(sw_calibration *out, sw_cell cell, const double *target, sw_error *err);

#endif
