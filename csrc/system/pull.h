/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Axial forces as they are read out. Those of the state belong to its strains and to the method:
 * in wires that turn they may be several times what a wire bears (integrate/turning.h). */
#ifndef SW_SYSTEM_PULL_H
#define SW_SYSTEM_PULL_H

#include "system/system.h"

/* Room in the state. SW_ENOMEM. */
sw_status sw_system_add_even(sw_system *system);

#endif
