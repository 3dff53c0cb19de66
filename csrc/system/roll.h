/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wires whose edges turn about themselves with inertia, so that friction can roll them. The turns
 * are freedoms of the system like the nodes' places; the frames of spin.h follow them. These
 * functions do nothing for other bodies. Private to this room. */
#ifndef SW_SYSTEM_ROLL_H
#define SW_SYSTEM_ROLL_H

#include "system/system.h"

/* Makes work space if the wire rolls. SW_ENOMEM. */
sw_status sw_roll_new(sw_body *body);

/* Starts the iterate from the state. */
void sw_roll_begin(const sw_system *system, sw_body *body);

/* A stage begins: turns the frames by the turns in the system's yhat. rate2: factor of the inertia
 * [1/s2]. */
void sw_roll_predict(const sw_system *system, sw_body *body, double rate2);

/* The frames were turned by share times angle[edge stride]: adds this to the turns. */
void sw_roll_add(sw_body *body, const double *angle, size_t stride, double share);

/* Before the frames are carried from the tangents in spin_tangent to these: adds the turn by
 * this. */
void sw_roll_carry(sw_body *body, double *const tangent[3]);

/* Adds the turns' inertia to the rows of spins and to the right-hand side (nodes x 4). */
void sw_roll_load(const sw_system *system, const sw_body *body, double *right);

/* Writes the turns of the solved stage into y, after the nodes. Call after the frames were carried
 * to y. */
void sw_roll_store(const sw_system *system, const sw_body *body, double *y);

/* out = turns in y minus the frames' turns: the remaining angle [rad]. */
void sw_roll_rest(const sw_system *system, const sw_body *body, const double *y, double *out);

/* Returns the state's kinetic energy of turning [J]. */
double sw_roll_kinetic(const sw_system *system, const sw_body *body);

#endif
