/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wires whose edges turn about themselves with inertia, so that friction can roll them. Turns are
 * freedoms of the system like the nodes' places; the frames of spin.h go with them. No effect on
 * other bodies. Private to this room. */
#ifndef SW_SYSTEM_ROLL_H
#define SW_SYSTEM_ROLL_H

#include "system/system.h"

/* Make work space, if the beam rolls. SW_ENOMEM. */
sw_status sw_roll_new(sw_body *body);

/* The iterate starts from the state. */
void sw_roll_begin(const sw_system *system, sw_body *body);

/* A stage begins: turn the frames to where the system's yhat has them. */
void sw_roll_predict(const sw_system *system, sw_body *body, double rate2);

/* The frames were turned by share times angle[edge stride]. */
void sw_roll_add(sw_body *body, const double *angle, size_t stride, double share);

/* The frames are about to be carried on to these tangents from those in spin_tangent. */
void sw_roll_carry(sw_body *body, double *const tangent[3]);

/* Add inertia to the rows of spins and to the right-hand side (nodes x 4). */
void sw_roll_load(const sw_system *system, const sw_body *body, double *right);

/* Put the turns of the solved stage into y, after the nodes there; the frames have been
 * carried on to it. */
void sw_roll_store(const sw_system *system, const sw_body *body, double *y);

/* Turn of y's edges beyond the frames: the way left for them [rad]. */
void sw_roll_rest(const sw_system *system, const sw_body *body, const double *y, double *out);

/* Kinetic energy of the state's turning [J]. */
double sw_roll_kinetic(const sw_system *system, const sw_body *body);

#endif
