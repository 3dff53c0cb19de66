/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wear of each place of a wire, added up over all steps of a run: cycles of tension and of bending,
 * work of friction. Recorded if the run asks for it; of a mesh the friction alone, at its rings.
 *
 * Bending is counted as the fibres feel it, in SW_WEAR_WAYS directions that turn with the wire, so
 * that to and fro is one cycle of the whole range. They are those of its material frames where it
 * has them; else they are carried along it from the holds, twisted as it is twisted evenly between
 * two of them, and where nothing holds it from its first edge, which does not roll. */
#ifndef SW_WATCH_WEAR_H
#define SW_WATCH_WEAR_H

#include "base/tape.h"
#include "base/vec.h"
#include "record/wear.h"
#include "scene/scene.h"
#include "system/system.h"

/* The state of wire w is one of the run; rubs: reached by a step, in which touches slid. SW_ENOMEM.
 */
sw_status sw_wear_note(sw_scene *scene, size_t w, int rubs, sw_error *err);

/* Friction of the step that ends now, at the wire's places. */
void sw_wear_rub(const sw_scene *scene, const sw_body *body, sw_wear *wear);

/* The largest pressure T/R up to now, with what the last step is part of [N/m]. */
sw_extreme sw_wear_sidewall(const sw_scene *scene, const sw_wear *wear);

/* The wire's directions across its edges (edges), carried from what holds it; first: that of its
 * first edge where nothing does [-]. */
void sw_wear_axes(const sw_system *system, const sw_body *body, sw_vec first, sw_vec *across);

#endif
