/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces that follow the solution of an iterate's equations within it. */
#ifndef SW_SYSTEM_AGAIN_H
#define SW_SYSTEM_AGAIN_H

#include "system/system.h"

/* After the solve: friction follows the normal forces, and the equations are solved again with the
 * same factors. delta and the held nodes' forces are brought up to it. */
void sw_system_solve_again(sw_system *system);

#endif
