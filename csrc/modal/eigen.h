/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small dense symmetric eigenproblems. */
#ifndef SW_MODAL_EIGEN_H
#define SW_MODAL_EIGEN_H

#include <stddef.h>

#include "base/status.h"

/* Solves A z = value B z for symmetric A (n x n) and positive definite B; B = NULL is the identity.
 * values ascend; vectors holds one eigenvector per row, z' B z = 1. SW_ENOMEM; SW_EDIVERGED for
 * non-finite numbers or no convergence. */
sw_status sw_eigen_dense(const double *a, const double *b, size_t n, double *values,
                         double *vectors);

#endif
