/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies that are webs of particles: their matrix, its solution, and the springs' axial forces,
 * which are unknowns of the mixed Newton method as in a rod. Private to this room. */
#ifndef SW_SYSTEM_WEB_H
#define SW_SYSTEM_WEB_H

#include "solve/sparse.h"
#include "system/system.h"

/* Makes the matrix of a body whose plan has a web, and lists where forces write into it. SW_ENOMEM.
 */
sw_status sw_web_prepare(sw_body *body);
void sw_web_discard(sw_body *body);

/* For a matrix with webs and other bodies: writes the pairs of particles with a block, each once, i
 * < j, into out (room for sw_web_couples_room). Returns their number. */
size_t sw_web_couples_room(const sw_body *body);
size_t sw_web_couples(const sw_body *body, sw_couple *out);
/* Copies the 3 x 3 block with rows of i and columns of j, i <= j. */
void sw_web_block(const sw_body *body, size_t i, size_t j, double out[9]);

/* begin: an evaluation with stiffness begins. gather: it ends; adds the nodes' part in the field's
 * rows to the matrix. */
void sw_web_begin(sw_body *body);
void sw_web_gather(sw_body *body);

/* hold: takes a held node out of the equations. reaction: its reaction after the update delta
 * (nodes x 3). */
void sw_web_hold(sw_held_node *held, const sw_body *body, double *right);
sw_vec sw_web_reaction(const sw_held_node *held, const sw_body *body, const double *delta);

/* Solves for the update of all free particles. in: right-hand side, out: delta. Fails as
 * sw_blocks_factor. */
sw_status sw_web_solve(sw_body *body, double *delta, size_t *negative);

/* Computes the axial forces after delta by the linearised law, from positions x before it. Returns
 * the square of the largest rotation of a spring or of a solid element's edge. */
double sw_web_advance(const sw_body *body, const double *x, const double *delta, double *axial);
/* Returns the largest change of an edge of a solid element by the move to - from (from NULL: to is
 * the move), relative to its length at x [-]. */
double sw_web_change(const sw_body *body, const double *x, const double *from, const double *to);

/* Computes axial forces from the springs' lengths. */
void sw_web_axial(const sw_body *body, const double *x, double *axial);

/* Returns the number of springs whose projection on their old direction is below a share of their
 * length, from x to y. */
long sw_web_turned(const sw_body *body, const double *x, const double *y, double share);

#endif
