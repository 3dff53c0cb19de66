/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions shared by the files of the solid elements. */
#ifndef SW_FORCE_SOLID_INNER_H
#define SW_FORCE_SOLID_INNER_H

/* The part of the energy that depends on J, per volume, and its derivatives with respect to J
 * [Pa]. */
typedef struct sw_solid_volumetric {
  double value, slope, curve;
} sw_solid_volumetric;
sw_solid_volumetric sw_solid_of_J(double mu, double lambda, double J);

enum { SW_SOLID_CONVEX = 9 }; /* most rank-one terms [-] */

/* Finds the negative part of the second derivative of mu/2 F.F + f(J): directions (3 columns of 3)
 * and the stiffness to add along each to reach zero [Pa]. Returns the number of directions. */
int sw_solid_convexify(const double F[3][3], double mu, double slope, double curve,
                       double direction[SW_SOLID_CONVEX][3][3], double amount[SW_SOLID_CONVEX]);

#endif
