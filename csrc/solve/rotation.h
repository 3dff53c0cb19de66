/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rotation between two sets of directions. */
#ifndef SW_SOLVE_ROTATION_H
#define SW_SOLVE_ROTATION_H

#include "base/vec.h"

/* Returns the rotation R that maximises the sum of the products of B's and R's entries. For B = sum
 * k p d' it turns the directions d nearest to p. If R is not unique, it is one of the solutions. B
 * is row by row; if B is not finite, R is the identity. Davenport's q method: the quaternion is an
 * eigenvector (Wahba's problem, SIAM Review 7, 1965). */
sw_quat sw_rotation_fit(const double B[9]);

#endif
