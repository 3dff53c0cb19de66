/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finite-strain solid elements between two neighbouring rings of a particle mesh: prisms of 6
 * particles and hexahedra of 8. Compressible neo-Hookean,
 * W = mu/2 (tr C - 3) - mu ln J + lambda/2 (ln J)^2.
 *
 * Energy = V W(mean deformation gradient F) + 1/2 e'K e. The mean over the element's volume at
 * rest sees all homogeneous strains and nothing else: neither shear nor volume lock. Bending,
 * twist and warping, which it does not see (nodes - 4 patterns of three components, amplitudes
 * q = the patterns' sums over the particles), have the energy of the second part. e = adj(F) q
 * is invariant to turning and behaves like a stretched neo-Hookean body: a bar drawn to 1.3 of
 * its length or pressed to 0.7 bends within 7 and 11 % of the exact stiffness (F'q would be 2.7
 * times too much, or 4.6 times too little). K is condensed once, at rest, from the linear
 * element with enhanced strains: Wilson's nine incompatible modes with constant Jacobian and
 * the three bilinear dilatations for hexahedra; for prisms all section strains that are linear
 * across the triangle and the axial strains that are linear along it. At rest the whole is
 * exactly that linear element (passes the patch test in any shape; bends with EI = E I of its
 * own section at any length and any nu), and K is positive: no zero-energy modes beyond the six
 * rigid ones, at any F with J above 0.
 *
 * Where it stops being valid: bending and twist within one element are linear in their own
 * strain, so that elements must be small against strain gradients; and the mean of a section
 * that turns by theta from ring to ring looks smaller by theta^2/8, which the section answers
 * by growing as much: keep theta below 0.3 rad (1 %). A corner may turn inside out while the
 * mean does not; only K resists that. Below J = 0.1 the energy goes on as its Taylor polynomial
 * of second order in J: finite for all places below about 1e40 times the element's size, and an
 * inverted element is pushed back. */
#ifndef SW_FORCE_SOLID_H
#define SW_FORCE_SOLID_H

#include "base/status.h"
#include "state/field.h"

enum { SW_SOLID_PRISM = 6, SW_SOLID_HEX = 8, SW_SOLID_NODES = 8 };
enum { SW_SOLID_MODES = 4, SW_SOLID_ROWS = 3 + SW_SOLID_MODES, SW_SOLID_STIFF = 12 };

/* Besides the SW_WANT_ of a field: a second derivative without negative eigenvalues, for far
 * from equilibrium. Too stiff where geometry softens, the same at rest. */
enum { SW_SOLID_SEMIDEFINITE = 256 };

/* One prepared element: plain data. Elements that are moved or turned copies of each other at
 * rest may share one. */
typedef struct sw_solid {
  int nodes;         /* [-] */
  double volume;     /* at rest [m3] */
  double mu, lambda; /* [Pa] */
  /* Weights of sums over the particles' places: three rows for the columns of F [1/m], one for
   * each pattern [-]. */
  double rows[SW_SOLID_ROWS][SW_SOLID_NODES];
  double K[SW_SOLID_STIFF][SW_SOLID_STIFF]; /* pattern by pattern, x y z each [N/m] */
} sw_solid;

/* rest: nodes x 3 [m]. The first half of the nodes is a face in one ring, anticlockwise seen
 * from the next ring; the second half the same face there. SW_EINVAL for an element without
 * volume, inverted or too much distorted, and for mu or lambda [Pa] that are no material
 * (mu > 0, lambda + 2/3 mu > 0). */
sw_status sw_solid_prepare(int nodes, const double *rest, double mu, double lambda, sw_solid *out);

/* Energy [J], 0 at rest. x: nodes x 3 [m]; want: SW_WANT_FORCE fills the energy's gradient g
 * (nodes x 3) [N], SW_WANT_STIFFNESS its second derivative H (3 nodes x 3 nodes, symmetric)
 * [N/m]; what is not wanted may be NULL. */
double sw_solid_eval(const sw_solid *e, const double *x, unsigned want, double *g, double *H);

/* Largest share in (0, 1] of the move dx [m] on which J stays above a fifth of its present
 * value, or of 1 when that is less; 1 for an element that is inverted already. */
double sw_solid_step(const sw_solid *e, const double *x, const double *dx);

/* Mean Cauchy stress xx xy xz yy yz zz [Pa], its von Mises value [Pa], J [-]. Any may be NULL. */
void sw_solid_stress(const sw_solid *e, const double *x, double stress[6], double *mises,
                     double *J);

#endif
