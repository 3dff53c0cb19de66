/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Axial forces that wires bear beside those of their edges' springs: some bending forces pull along
 * the wire too (sw_force_class.axial). Read-outs show the sum of both. */
#ifndef SW_SYSTEM_BORNE_H
#define SW_SYSTEM_BORNE_H

#include "system/system.h"

/* Room of a sum that is read out: of the springs alone, with dashpots, the mean over a step. */
enum { SW_BORNE_ELASTIC, SW_BORNE_PULL, SW_BORNE_MEAN, SW_BORNE_SUMS };

/* Makes room if a force of any body needs it. SW_ENOMEM. */
sw_status sw_system_add_borne(sw_system *system);
/* The body's field has just been measured at the state: computes these forces there. */
void sw_system_find_borne(sw_system *system, const sw_body *body);
/* A step begins at the state: keeps the forces there, for the mean over the step. */
void sw_system_keep_borne(sw_system *system);
/* Returns T of the body's edges plus these forces at the state, or for SW_BORNE_MEAN the mean of
 * them at both ends of the step; T itself if the body bears none. Valid until the next call with
 * this room [N]. */
const double *sw_system_with_borne(const sw_system *system, const sw_body *body, const double *T,
                                   int room);

#endif
