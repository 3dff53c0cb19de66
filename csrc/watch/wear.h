/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wear of each place of a wire, summed over all steps of a run: cycles of tension and of bending,
 * and work of friction. Recorded only if the run asks for it.
 *
 * Bending is counted as the wire's fibres feel it, in SW_WEAR_WAYS directions that turn with the
 * wire: bending to and fro is one cycle of the whole range. The directions are those of the wire's
 * material frames or mesh sections, if it has them. Otherwise they are carried along the wire from
 * its holds, with the twist spread evenly between two holds. Without a hold they are carried from
 * the first edge, which does not roll. */
#ifndef SW_WATCH_WEAR_H
#define SW_WATCH_WEAR_H

#include "base/tape.h"
#include "base/vec.h"
#include "body/side.h"
#include "record/wear.h"
#include "scene/scene.h"
#include "system/system.h"

/* Makes the recorded places those of the present state. SW_ENOMEM. */
sw_status sw_wear_fit(sw_scene *scene, size_t w, sw_error *err);
/* Does so, and notes the present state of wire w. rubs = 1: a step led to it, in which touches
 * slid. SW_ENOMEM. */
sw_status sw_wear_note(sw_scene *scene, size_t w, int rubs, sw_error *err);

/* Load of one place at a state. */
typedef struct sw_wear_load {
  sw_vec tangent, across; /* wire tangent; direction that turns with the wire [-] */
  sw_vec bend;            /* curvature, across the wire towards where it bends [1/m] */
  double tension;         /* [N] */
  int averaged;           /* 1: its tension is counted by means over the window, see
                             sw_scene_wear_means */
} sw_wear_load;

/* Adds a load to the cycles of place k. anew = 1: across has changed its meaning since the last
 * step; the place keeps its own direction, as if it had not rolled in this step. */
void sw_wear_count(sw_wear *wear, size_t k, const sw_wear_load *load, int anew);
/* The same for all places of a line, with the sides that are its last places and the axial forces T
 * of its edges [N]; and of a mesh. averaged: see sw_wear_load. */
void sw_wear_count_line(const sw_system *system, const sw_body *body, const sw_bent_side *sides,
                        const double *T, int averaged, sw_wear *wear);
void sw_wear_count_mesh(const sw_system *system, const sw_body *body, int averaged, sw_wear *wear);
/* Returns a vector of this size in the direction of the tangent's change, across the tangent t
 * [1/m]. */
sw_vec sw_wear_towards(sw_vec change, sw_vec t, double size);

/* Adds the friction of the step that just ended, at the wire's places. */
void sw_wear_rub(const sw_scene *scene, const sw_body *body, sw_wear *wear);

/* Returns the largest pressure T/R so far, including the window of the last steps [N/m]. */
sw_extreme sw_wear_sidewall(const sw_scene *scene, const sw_wear *wear);

/* Finds the wire's directions across its edges (edges), carried from its holds [-]. first: the
 * first edge's direction if no hold gives one. */
void sw_wear_axes(const sw_system *system, const sw_body *body, sw_vec first, sw_vec *across);
/* Returns a number that tells which holds fix a line's direction, and where. */
uint64_t sw_wear_holds(const sw_body *body);

#endif
