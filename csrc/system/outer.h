/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces that act from outside and have no energy: functions of scripts, wind. */
#ifndef SW_SYSTEM_OUTER_H
#define SW_SYSTEM_OUTER_H

#include "system/system.h"

/* 1 for forces without a potential that may do work of any sign. */
int sw_outer_is(const sw_force_class *cls);
/* Fills out (3 x nodes of the body) with a term's force on the system's state at this time [N].
 * statics: 1: in an equilibrium. */
sw_status sw_outer_force(sw_system *system, sw_body *body, const sw_term *term, double time,
                         int statics, double *out, sw_error *err);
/* Returns the shortest period with which a force changes by itself, and its term; HUGE_VAL, NULL:
 * none does [s]. */
double sw_outer_period(const sw_system *system, const sw_term **term);

#endif
