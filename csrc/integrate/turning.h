/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far off a method's axial forces are in wires that turn. */
#ifndef SW_INTEGRATE_TURNING_H
#define SW_INTEGRATE_TURNING_H

#include "integrate/integrate.h"

/* Take a step h of a method, after one of last_h [s]. kept: memory from step to step
 * (SW_TURN_SIZE). Returns where between both stages its axial force is right. */
sw_between sw_turning_step(const sw_integrator *method, double h, double last_h, double *kept);

#endif
