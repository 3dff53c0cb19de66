/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rotation between two sets of directions. */
#ifndef SW_SOLVE_ROTATION_H
#define SW_SOLVE_ROTATION_H

#include "base/vec.h"

/* The rotation R that makes the sum of B's entries times R's, over all nine, largest: for
 * B = sum k p d' the one that turns directions d nearest to p. Where it is not unique, one of
 * them. B is row by row; the identity where it is not finite. Davenport's q method: the
 * quaternion is an eigenvector (Wahba's problem, SIAM Review 7, 1965). */
sw_quat sw_rotation_fit(const double B[9]);

#endif
