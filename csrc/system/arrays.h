/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The block that a system's state is in. Of this room only. */
#ifndef SW_SYSTEM_ARRAYS_H
#define SW_SYSTEM_ARRAYS_H

#include "system/system.h"

/* The state's block is a new one: where its arrays are in it. */
void sw_system_lay_out(sw_system *system);

/* Make the state longer by zeros. SW_ENOMEM. */
sw_status sw_system_grow_state(sw_system *system, size_t more, double **added);

#endif
