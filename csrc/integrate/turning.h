/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors of a method's axial forces in wires that turn. */
#ifndef SW_INTEGRATE_TURNING_H
#define SW_INTEGRATE_TURNING_H

#include "integrate/integrate.h"

/* Follows the method through a step h after one of last_h [s]. kept: its memory from step to step
 * (SW_TURN_SIZE). Returns the mix of both stages whose axial force is right. */
sw_between sw_turning_step(const sw_integrator *method, double h, double last_h, double *kept);

#endif
