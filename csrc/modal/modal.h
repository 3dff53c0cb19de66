/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Natural frequencies and modes of one wire about the present state:
 * K x = omega^2 M x with the lowest omega^2, those below zero included. */
#ifndef SW_MODAL_MODAL_H
#define SW_MODAL_MODAL_H

#include <stddef.h>

#include "base/status.h"
#include "system/system.h"

typedef struct sw_modes {
  size_t count;      /* of all below [-] */
  size_t unstable;   /* of them with omega2 < 0: these come first [-] */
  size_t unknowns;   /* per shape [-] */
  double *omega2;    /* (count), ascending; neutral motions have 0 [rad2/s2] */
  double *shapes;    /* (count x unknowns), x' M x = 1 [1/sqrt(kg)] */
  size_t iterations; /* solves with a factorised matrix [-] */
} sw_modes;

/* The system must be linearised. Finds the `modes` lowest that are not unstable,
 * after every unstable one; what would grow slower than sqrt(slow) is neutral. Statuses: SW_EINVAL
 * (more than there are), SW_EDIVERGED (unstable in very many ways, or rounding leaves no digit),
 * SW_ENOCONV, SW_EINTR, SW_ENOMEM; then out is empty. */
sw_status sw_modal_solve(const sw_system *system, size_t body, size_t modes, double slow,
                         int (*interrupted)(void), sw_modes *out, sw_error *err);
/* How many motions of the body would grow, faster than sqrt(slow). SW_ENOMEM, SW_EDIVERGED. */
sw_status sw_modal_unstable(const sw_system *system, size_t body, double slow, size_t *count);
void sw_modes_free(sw_modes *modes);

/* Motion of the body by forces out of balance within about the time tau [s]: drift, the largest
 * shift of a node, NAN when that cannot be said [m]; axial, the largest change of an axial
 * force as sw_system_axial_error [-]. */
sw_status sw_modal_unrest(const sw_system *system, size_t body, double tau, double *drift,
                          double *axial, sw_error *err);

#endif
