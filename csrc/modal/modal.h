/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Natural frequencies and modes of one wire about the present state: K x = omega^2 M x for the
 * lowest omega^2, including negative ones. */
#ifndef SW_MODAL_MODAL_H
#define SW_MODAL_MODAL_H

#include <stddef.h>

#include "base/status.h"
#include "system/system.h"

typedef struct sw_modes {
  size_t count;    /* number of modes found [-] */
  size_t unstable; /* number of modes with omega2 < 0, which come first [-] */
  size_t unknowns; /* per shape [-] */
  double *omega2;  /* (count), ascending; neutral motions have 0 [rad2/s2] */
  double *shapes;  /* (count x unknowns), x' M x = 1 [1/sqrt(kg)] */
} sw_modes;

/* Finds all unstable modes and then the `modes` lowest other ones. The system must be linearised.
 * Motions that would grow slower than sqrt(slow) are neutral. SW_EINVAL (more modes than there
 * are), SW_EDIVERGED (too many unstable modes, or rounding leaves no digit), SW_ENOCONV, SW_EINTR,
 * SW_ENOMEM; out is then empty. */
sw_status sw_modal_solve(const sw_system *system, size_t body, size_t modes, double slow,
                         int (*interrupted)(void), sw_modes *out, sw_error *err);
/* Counts the motions of the body that would grow faster than sqrt(slow). SW_ENOMEM,
 * SW_EDIVERGED. */
sw_status sw_modal_unstable(const sw_system *system, size_t body, double slow, size_t *count);
void sw_modes_free(sw_modes *modes);

/* Estimates the body's motion by unbalanced forces within about the time tau [s]. drift: the
 * largest shift of a node, NAN when it cannot be found [m]; axial: the largest change of an axial
 * force, as in sw_system_axial_error [-]. */
sw_status sw_modal_unrest(const sw_system *system, size_t body, double tau, double *drift,
                          double *axial, sw_error *err);

#endif
