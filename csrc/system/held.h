/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Held nodes in a body's equations. Private to this room. */
#ifndef SW_SYSTEM_HELD_H
#define SW_SYSTEM_HELD_H

#include "system/system.h"

/* Takes the body's held nodes out of its gathered equations and keeps their couplings. */
void sw_held_take_out(sw_system *system, const sw_body *body);
/* Computes the reaction after the last update, with the solve's linearisation. */
void sw_held_react(sw_system *system, sw_held_node *held);

#endif
