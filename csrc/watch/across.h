/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How wires that are straight or plane leave their line or plane under a push. */
#ifndef SW_WATCH_ACROSS_H
#define SW_WATCH_ACROSS_H

#include "scene/parts.h"
#include "system/pushed.h"
#include "system/system.h"

/* 1 if the wire lies in a plane, bent by more than `bent` [-]; fills the plane's normal. */
int sw_scene_lies_in_plane(const sw_system *system, const sw_body *b, double bent, sw_vec *normal);
/* Counts the motions across this plane that grow faster than sqrt(slow); *rate: of the fastest
 * [1/s]. The system must be linearised. Status as of sw_modal_solve. */
sw_status sw_scene_unstable_across(const sw_system *system, size_t w, double slow, sw_vec normal,
                                   size_t *count, double *rate);
/* Returns the rate at which a real wire would bend to the side, if it were straight where it is
 * pushed; 0: it would not [1/s]. *most: what is pushed. */
double sw_scene_bend_rate(const sw_scene *s, const sw_body *b, sw_pushed *most);

#endif
