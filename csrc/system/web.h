/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies that are webs of particles: the matrix, its solution, and the springs' axial forces, which
 * are unknowns of the mixed Newton method as in a rod. Of this room only. */
#ifndef SW_SYSTEM_WEB_H
#define SW_SYSTEM_WEB_H

#include "solve/sparse.h"
#include "system/system.h"

/* The matrix of a body whose plan has a web, and where its forces write. SW_ENOMEM. */
sw_status sw_web_prepare(sw_body *body);
void sw_web_discard(sw_body *body);

/* For a matrix in which webs are tied to other bodies: the pairs of particles that have a block,
 * each once, i < j, into out (room for sw_web_couples_room); their number. */
size_t sw_web_couples_room(const sw_body *body);
size_t sw_web_couples(const sw_body *body, sw_sparse_pair *out);
/* The 3 x 3 block of rows of i and columns of j, i <= j. */
void sw_web_block(const sw_body *body, size_t i, size_t j, double out[9]);

/* An evaluation with stiffness begins; it ends, and the nodes' part in the field's rows is added.
 */
void sw_web_begin(sw_body *body);
void sw_web_gather(sw_body *body);

/* Take a held node out of the equations; its reaction after the update delta (nodes x 3). */
void sw_web_hold(sw_held_node *held, const sw_body *body, double *right);
sw_vec sw_web_reaction(const sw_held_node *held, const sw_body *body, const double *delta);

/* The update of all free particles: right side in, delta out. Fails as sw_blocks_factor. */
sw_status sw_web_solve(sw_body *body, double *delta, size_t *negative);

/* Axial forces after delta by the linearised law, at positions x before it; returns the square
 * of the largest rotation of a spring or of a solid element's edge. */
double sw_web_advance(const sw_body *body, const double *x, const double *delta, double *axial);
/* Share of the move delta from x that turns no solid element inside out, in (0, 1] [-]. */
double sw_web_share(const sw_body *body, const double *x, const double *delta);

/* The largest change of an edge of a solid element by the move from - to (from may be NULL: to is
 * the move), of its length at x [-]. */
double sw_web_change(const sw_body *body, const double *x, const double *from, const double *to);

/* Axial forces as the springs' lengths give them. */
void sw_web_axial(const sw_body *body, const double *x, double *axial);

/* Springs that keep less than a share of their length along themselves from x to y. */
long sw_web_turned(const sw_body *body, const double *x, const double *y, double share);

#endif
