/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The block of memory that holds a system's state. Private to this room. */
#ifndef SW_SYSTEM_ARRAYS_H
#define SW_SYSTEM_ARRAYS_H

#include "system/system.h"

/* Sets the pointers into s->state. Call after s->state has moved. */
void sw_system_lay_out(sw_system *system);

/* Appends zeros to the state; *added points to them. SW_ENOMEM. */
sw_status sw_system_grow_state(sw_system *system, size_t more, double **added);

#endif
