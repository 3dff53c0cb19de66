/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Axial forces of wires besides those of their edges' springs: some bending forces pull along the
 * wire too (sw_force_class.axial). Read-outs show the sum of both. */
#ifndef SW_SYSTEM_BORNE_H
#define SW_SYSTEM_BORNE_H

#include "system/system.h"

/* Arrays for sums: springs alone, springs with dashpots, mean over a step. */
enum { SW_BORNE_ELASTIC, SW_BORNE_PULL, SW_BORNE_MEAN, SW_BORNE_SUMS };

/* Makes room if any body has such a force. SW_ENOMEM. */
sw_status sw_system_add_borne(sw_system *system);
/* Computes these forces at the state. The body's field must have just been measured there. */
void sw_system_find_borne(sw_system *system, const sw_body *body);
/* A step begins: keeps the state's forces for the mean over the step. */
void sw_system_keep_borne(sw_system *system);
/* Returns T of the body's edges plus these forces at the state; for SW_BORNE_MEAN plus their mean
 * over both ends of the step; T itself if the body has none. Valid until the next call with this
 * room [N]. */
const double *sw_system_with_borne(const sw_system *system, const sw_body *body, const double *T,
                                   int room);

#endif
