/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Blows of wires on each other. */
#ifndef SW_MUTUAL_JOLT_H
#define SW_MUTUAL_JOLT_H

#include "contact/jolt.h"
#include "mutual/mutual.h"

/* Like sw_contact_jolt, for few wires that strike each other. dull: 1 if the trial used implicit
 * Euler. */
double sw_mutual_jolt(const sw_mutual *pairs, const sw_system *system, int dull, int followed,
                      sw_blow_of of, void *user);

#endif
