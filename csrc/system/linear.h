/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small motions about the state of a system. */
#ifndef SW_SYSTEM_LINEAR_H
#define SW_SYSTEM_LINEAR_H

#include "system/system.h"

/* Computes forces and stiffness at the state, with zero velocities and the stored axial forces. The
 * functions below are valid until the next evaluation of any kind. Motions have (unknowns) values;
 * those of held nodes must be zero on input. */
sw_status sw_system_linearise(sw_system *system, double time, sw_error *err);

/* Computes the forces between the particles of a mesh body at the state, summed for each (particles
 * x 3) [N]. */
sw_status sw_system_inner_forces(sw_system *system, size_t body, double *out, sw_error *err);

/* Factorises a mesh of a linearised system with these particles fixed (flag 1, particles). Call
 * once per linearisation; fails as sw_blocks_factor. */
sw_status sw_system_fix_particles(sw_system *system, size_t body, const unsigned char *fixed);
/* After that, any number of times. in: motion (particles x 3) of the fixed particles, 0 for the
 * others. out: motion of all, with the others free of load; push: the loads on the fixed ones [m],
 * [N]. */
void sw_system_carry(const sw_system *system, size_t body, const unsigned char *fixed,
                     double *motion, double *push);

size_t sw_system_unknowns(const sw_system *system, size_t body);
size_t sw_system_free_unknowns(const sw_system *system, size_t body);
size_t sw_system_factor_size(const sw_system *system, size_t body); /* in doubles */

/* Out-of-balance forces (unknowns), zero where held [N]. */
void sw_system_residual(const sw_system *system, size_t body, double *out);
/* Nodes' displacements in a motion: (nodes x 3) [m]. */
void sw_system_shifts(const sw_system *system, size_t body, const double *motion, double *out);
/* Returns the change of the stored axial forces by the motion, over the largest of: these forces,
 * the wire's weight, its buckling force [-]. */
double sw_system_axial_error(const sw_system *system, size_t body, const double *motion);
/* Sets a motion's held unknowns to zero. */
void sw_system_fix_held(const sw_system *system, size_t body, double *motion);

/* Factorises K - shift M. below: number of eigenvalues of K x = lambda M x below the shift. Fails
 * as sw_band3_factor. shift [rad2/s2] */
sw_status sw_system_factor(const sw_system *system, size_t body, double shift, double *factor,
                           size_t *below);
void sw_system_factor_solve(const sw_system *system, size_t body, const double *factor, double *x);
/* Returns the largest ratio of a diagonal term of K to that of M; work has a factor's size
 * [rad2/s2]. */
double sw_system_stiffest(const sw_system *system, size_t body, double *work);

/* out = K motion, out = M motion */
void sw_system_stiffness_times(const sw_system *system, size_t body, const double *motion,
                               double *out);
void sw_system_mass_times(const sw_system *system, size_t body, const double *motion, double *out);

#endif
