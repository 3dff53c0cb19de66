/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finite-strain solid elements between two neighbouring rings of a particle mesh: prisms of 6
 * particles and hexahedra of 8. Compressible neo-Hookean,
 *   W = mu/2 (tr C - 3) - mu ln J + lambda/2 (ln J)^2.
 *
 * Energy = V W(F) + 1/2 e'K e, with F the mean deformation gradient over the element's rest volume.
 * F captures all homogeneous strains and only those, so neither shear nor volume locks. The second
 * part is the energy of bending, twist and warping: nodes - 4 patterns of three components, with
 * amplitudes q = sums over the particles weighted by the patterns. e = adj(F) q is invariant under
 * rotation and behaves like a stretched neo-Hookean body: a bar stretched to 1.3 of its length or
 * compressed to 0.7 bends within 7 and 11 % of the exact stiffness (F'q would be 2.7 times too
 * stiff, or 4.6 times too soft). K is condensed once, at rest, from the linear element with
 * enhanced strains. Hexahedra: Wilson's nine incompatible modes with constant Jacobian and the
 * three bilinear dilatations. Prisms: all section strains linear across the triangle, and the axial
 * strains linear along it. At rest the element is exactly that linear element (passes the patch
 * test in any shape; bends with EI = E I of its own section at any length and any nu). K is
 * positive definite: no zero-energy modes beyond the six rigid ones, at any F with J above 0.
 *
 * Limits: bending and twist within one element are linear in their own strain, so elements must be
 * small against strain gradients. When a section turns by theta from ring to ring, the mean sees it
 * smaller by theta^2/8, and the section grows by as much: keep theta below 0.3 rad (1 %). A corner
 * may turn inside out while the mean does not; only K resists that. Below J = 0.1 the energy
 * continues as its Taylor polynomial of second order in J: it is finite at distances below about
 * 1e40 element sizes, and it pushes an inverted element back. */
#ifndef SW_FORCE_SOLID_H
#define SW_FORCE_SOLID_H

#include "base/status.h"
#include "state/field.h"

enum { SW_SOLID_PRISM = 6, SW_SOLID_HEX = 8, SW_SOLID_NODES = 8 };
enum { SW_SOLID_MODES = 4, SW_SOLID_ROWS = 3 + SW_SOLID_MODES, SW_SOLID_STIFF = 12 };

/* An extra flag besides the field's SW_WANT_...: a second derivative without negative eigenvalues,
 * for states far from equilibrium. It is too stiff where geometry softens; at rest it is exact. */
enum { SW_SOLID_SEMIDEFINITE = 256 };

/* One prepared element: plain data. Elements whose rest shapes are shifted or rotated copies of
 * each other may share one. */
typedef struct sw_solid {
  int nodes;         /* [-] */
  double volume;     /* at rest [m3] */
  double mu, lambda; /* [Pa] */
  /* Weights of sums over the particles' positions: three rows for the columns of F [1/m], one row
   * for each pattern [-]. */
  double rows[SW_SOLID_ROWS][SW_SOLID_NODES];
  double K[SW_SOLID_STIFF][SW_SOLID_STIFF]; /* pattern by pattern, each with x y z [N/m] */
} sw_solid;

/* Prepares an element. rest: nodes x 3 [m]; the first half of the nodes is a face in one ring,
 * anticlockwise seen from the next ring; the second half is the same face in that ring. SW_EINVAL
 * for an element that has no volume, is inverted or too distorted, and for mu or lambda [Pa] of no
 * real material (needs mu > 0, lambda + 2/3 mu > 0). */
sw_status sw_solid_prepare(int nodes, const double *rest, double mu, double lambda, sw_solid *out);

/* Returns the energy [J], 0 at rest. x: nodes x 3 [m]. want: SW_WANT_FORCE fills the energy's
 * gradient g (nodes x 3) [N], SW_WANT_STIFFNESS its second derivative H (3 nodes x 3 nodes,
 * symmetric) [N/m]. g or H may be NULL if not wanted. */
double sw_solid_eval(const sw_solid *e, const double *x, unsigned want, double *g, double *H);

/* Returns the largest share in (0, 1] of the move dx [m] that keeps J above a fifth of min(J now,
 * 1); 1 for an element that is inverted already. */
double sw_solid_step(const sw_solid *e, const double *x, const double *dx);

/* Mean Cauchy stress xx xy xz yy yz zz [Pa], its von Mises value [Pa], and J [-]. Any may be
 * NULL. */
void sw_solid_stress(const sw_solid *e, const double *x, double stress[6], double *mises,
                     double *J);

#endif
