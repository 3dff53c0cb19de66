/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is kept of the wear of a wire, place by place: cycles of tension and of bending, work of
 * friction; of a mesh at its rings. Bending is counted as the fibres feel it, in SW_WORN_WAYS
 * directions that turn with the wire, so that to and fro is one cycle of the whole range. */
#ifndef SW_RECORD_WEAR_H
#define SW_RECORD_WEAR_H

#include "base/extreme.h"
#include "base/tape.h"
#include "base/vec.h"
#include "record/cycles.h"
#include "record/window.h"

/* What is counted at each place: the tension, then the bend in so many directions [-]. */
enum { SW_WORN_TENSION, SW_WORN_BEND, SW_WORN_WAYS = 12, SW_WORN_SIGNALS = 1 + SW_WORN_WAYS };

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
  size_t count, nodes;   /* places: nodes or rings, then clamps */
  sw_wear_place *places; /* (count) */
  sw_cycles *cycles;     /* (count x SW_WEAR_SIGNALS) */
  sw_vec *across;        /* (count) room for a step's work; NULL until the first */
  uint64_t holds;        /* a number for what gives its directions where; 0: not known */
  sw_extreme sidewall;   /* largest pressure T/R where it touches, a mean as peaks are [N/m] */
  sw_window pressed;     /* of the pressure at its nodes [N/m] */
} sw_wear;

void sw_wear_free(sw_wear *wear);
void sw_tape_wear(sw_tape *tape, sw_wear *wear);

#endif
