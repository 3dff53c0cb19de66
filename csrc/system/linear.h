/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small motions about the state of a system. */
#ifndef SW_SYSTEM_LINEAR_H
#define SW_SYSTEM_LINEAR_H

#include "system/system.h"

/* Forces and stiffness at the state, with zero velocities and the stored axial forces. The
 * functions below are valid until the next evaluation of any kind. Motions are (unknowns) values;
 * given ones are zero at held nodes. */
sw_status sw_system_linearise(sw_system *system, double time, sw_error *err);

/* Forces that the particles of a body that is a mesh exert on each other at the state, on each
 * (particles x 3) [N]. */
sw_status sw_system_inner_forces(sw_system *system, size_t body, double *out, sw_error *err);

/* Small motions of a mesh, in a linearised system, from those of some particles with flag 1
 * (particles). Once only; fails as sw_blocks_factor. */
sw_status sw_system_fix_particles(sw_system *system, size_t body, const unsigned char *fixed);
/* Then, any number of times: motion (particles x 3) is given for these particles and 0 for the
 * others, which follow without load; push receives the loads on the given ones [m], [N]. */
void sw_system_carry(const sw_system *system, size_t body, const unsigned char *fixed,
                     double *motion, double *push);

size_t sw_system_unknowns(const sw_system *system, size_t body);
size_t sw_system_free_unknowns(const sw_system *system, size_t body);
size_t sw_system_factor_size(const sw_system *system, size_t body); /* in doubles */

/* Forces that are out of balance, zero where held; (unknowns) [N]. */
void sw_system_residual(const sw_system *system, size_t body, double *out);
/* How far the nodes go in a motion: (nodes x 3) [m]. */
void sw_system_shifts(const sw_system *system, size_t body, const double *motion, double *out);
/* Change of the stored axial forces by the motion, relative to the largest of them, the wire's
 * weight and its buckling force [-]. */
double sw_system_axial_error(const sw_system *system, size_t body, const double *motion);
/* Zero a motion's held unknowns. */
void sw_system_fix_held(const sw_system *system, size_t body, double *motion);

/* Factorise K - shift M; below receives how many eigenvalues of K x = lambda M x
 * are below the shift. Fails as sw_band3_factor. shift [rad2/s2] */
sw_status sw_system_factor(const sw_system *system, size_t body, double shift, double *factor,
                           size_t *below);
void sw_system_factor_solve(const sw_system *system, size_t body, const double *factor, double *x);
/* The largest diagonal term of K over that of M; work has a factor's size [rad2/s2]. */
double sw_system_stiffest(const sw_system *system, size_t body, double *work);

/* out = K motion, out = M motion */
void sw_system_stiffness_times(const sw_system *system, size_t body, const double *motion,
                               double *out);
void sw_system_mass_times(const sw_system *system, size_t body, const double *motion, double *out);

#endif
