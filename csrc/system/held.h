/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Held nodes in a body's equations. Of this room only. */
#ifndef SW_SYSTEM_HELD_H
#define SW_SYSTEM_HELD_H

#include "system/system.h"

/* Take the body's held nodes out of its gathered equations; what couples them is kept. */
void sw_held_take_out(sw_system *system, const sw_body *body);
/* The reaction after the last update, linearised as the solve was. */
void sw_held_react(sw_system *system, sw_held_node *held);

#endif
