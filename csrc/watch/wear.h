/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wear of each place of a wire, added up over all steps of a run: cycles of tension and of bending,
 * work of friction. Recorded if the run asks for it.
 *
 * Bending is counted as the fibres feel it, in SW_WEAR_WAYS directions that turn with the wire, so
 * that to and fro is one cycle of the whole range. They are those of its material frames or of the
 * sections of its mesh where it has them; else they are carried along it from the holds, twisted as
 * it is twisted evenly between two of them, and where nothing holds it from its first edge, which
 * does not roll. */
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

/* What one place bears at a state. */
typedef struct sw_wear_load {
  sw_vec tangent, across; /* of the wire; the direction that turns with it [-] */
  sw_vec bend;            /* the curvature, across the wire towards where it bends [1/m] */
  double tension;         /* [N] */
} sw_wear_load;

/* It joins the cycles of place k. anew: across is not what it was before the step; the place goes
 * on with its own direction as if it had not rolled in it. */
void sw_wear_count(sw_wear *wear, size_t k, const sw_wear_load *load, int anew);
/* The same of all places of a line, with axial forces T of its edges [N], and of a mesh. */
void sw_wear_count_line(const sw_system *system, const sw_body *body, const double *T,
                        sw_wear *wear);
void sw_wear_count_mesh(const sw_system *system, const sw_body *body, sw_wear *wear);
/* A bend of this size towards the change of tangent, seen across the tangent t [1/m]. */
sw_vec sw_wear_towards(sw_vec change, sw_vec t, double size);

/* Friction of the step that ends now, at the wire's places. */
void sw_wear_rub(const sw_scene *scene, const sw_body *body, sw_wear *wear);

/* The largest pressure T/R up to now, with what the last step is part of [N/m]. */
sw_extreme sw_wear_sidewall(const sw_scene *scene, const sw_wear *wear);

/* The wire's directions across its edges (edges), carried from what holds it; first: that of its
 * first edge where nothing does [-]. */
void sw_wear_axes(const sw_system *system, const sw_body *body, sw_vec first, sw_vec *across);

#endif
