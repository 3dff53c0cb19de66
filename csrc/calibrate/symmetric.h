/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef SW_CALIBRATE_SYMMETRIC_H
#define SW_CALIBRATE_SYMMETRIC_H

#include <stddef.h>

#include "base/status.h"

/* Eigenvalues, ascending, and eigenvectors of length 1, one after the other, of a symmetric matrix
 * a (n x n, of which the lower half is read). SW_ENOMEM; SW_EDIVERGED where it is not finite. */
sw_status sw_symmetric_eigen(const double *a, size_t n, double *values, double *vectors);

#endif
