/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small dense symmetric eigenproblems; of this room only. */
#ifndef SW_MODAL_EIGEN_H
#define SW_MODAL_EIGEN_H

#include <stddef.h>

#include "base/status.h"

/* A z = value B z for symmetric A (n x n) and positive definite B, or the identity
 * for NULL. values ascend; vectors holds one eigenvector per row, z' B z = 1.
 * SW_ENOMEM; SW_EDIVERGED when there are non-finite numbers or no convergence. */
sw_status sw_eigen_dense(const double *a, const double *b, size_t n, double *values,
                         double *vectors);

#endif
