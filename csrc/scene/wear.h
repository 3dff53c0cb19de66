/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run does to each place of its wires that only adds up over all steps: cycles of tension
 * and of bending, work of friction. Kept where a run asks for it, of wires that are lines.
 *
 * Bending is counted as the fibres feel it, in SW_WEAR_WAYS directions that turn with the wire, so
 * that to and fro is one cycle of the whole range. They are those of its material frames where it
 * has them; else they are carried along it from the holds, twisted as it is twisted evenly between
 * two of them, and where nothing holds it from its first edge, which does not roll. */
#ifndef SW_SCENE_WEAR_H
#define SW_SCENE_WEAR_H

#include "base/tape.h"
#include "base/vec.h"
#include "scene/cycles.h"
#include "scene/scene.h"
#include "scene/worn.h"
#include "system/system.h"

/* Directions over half a turn, and what is counted at each place: the tension, then these [-]. */
enum { SW_WEAR_WAYS = SW_WORN_WAYS, SW_WEAR_SIGNALS = SW_WORN_SIGNALS };

typedef struct sw_wear_place {
  double s;               /* arc length of the mesh [m] */
  double rubbed, slid;    /* work of friction, normal force times way, per length [J/m], [N] */
  double turn;            /* from what is carried along the wire to its own direction [rad] */
  sw_vec tangent, across; /* the wire and its own direction at the last state [-] */
  double load;            /* at this state: tension times curvature [N/m] */
  int touches;            /* at this state: 1, something presses on it */
  int side;               /* -1, 1: where it enters or leaves what holds its direction; else 0 */
  int seen;               /* 1: tangent and across are known */
} sw_wear_place;

typedef struct sw_wear {
  size_t count, nodes;   /* places: nodes, then clamps */
  sw_wear_place *places; /* (count) */
  sw_cycles *cycles;     /* (count x SW_WEAR_SIGNALS) */
  sw_vec *across;        /* (count) room for a step's work; NULL until the first */
  uint64_t holds;        /* a number for what holds its direction where */
  sw_extreme sidewall;   /* largest pressure T/R where it touches [N/m] */
  int partial;           /* 1: it was a mesh of particles for a while, of which nothing is kept */
} sw_wear;

void sw_wear_free(sw_wear *wear);
/* The state of wire w is one of the run; rubs: reached by a step, in which touches slid. SW_ENOMEM.
 */
sw_status sw_wear_note(sw_scene *scene, size_t w, int rubs, sw_error *err);
void sw_tape_wear(sw_tape *tape, sw_wear *wear);

/* The wire's directions across its edges (edges), carried from what holds it; first: that of its
 * first edge where nothing does [-]. */
void sw_wear_axes(const sw_system *system, const sw_body *body, sw_vec first, sw_vec *across);

#endif
