/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Recorded wear of a wire, place by place: cycles of tension and of bending, and work of friction;
 * for a mesh at its rings. Bending is counted as the fibres feel it, in SW_WORN_WAYS directions
 * that turn with the wire, so that bending to and fro is one cycle of the whole range. */
#ifndef SW_RECORD_WEAR_H
#define SW_RECORD_WEAR_H

#include "base/extreme.h"
#include "base/tape.h"
#include "base/vec.h"
#include "record/cycles.h"
#include "record/window.h"

/* Signals counted at each place: the tension, then the bend in SW_WORN_WAYS directions [-]. */
enum { SW_WORN_TENSION, SW_WORN_BEND, SW_WORN_WAYS = 12, SW_WORN_SIGNALS = 1 + SW_WORN_WAYS };

/* Number of directions over half a turn; number of signals at each place [-]. */
enum { SW_WEAR_WAYS = SW_WORN_WAYS, SW_WEAR_SIGNALS = SW_WORN_SIGNALS };

typedef struct sw_wear_place {
  double s;               /* arc length of the mesh [m] */
  double rubbed, slid;    /* work of friction, normal force times way, per length [J/m], [N] */
  double turn;            /* from the direction carried along the wire to the place's own [rad] */
  sw_vec tangent, across; /* wire tangent and the place's own direction at the last state [-] */
  double load;            /* tension times curvature at this state [N/m] */
  int touches;            /* 1: something presses on it at this state */
  int side;               /* -1, 1: where the wire arrives at or leaves a clamp; else 0 */
  int seen;               /* 1: tangent and across are known */
} sw_wear_place;

typedef struct sw_wear {
  size_t count, nodes;   /* places: nodes or rings, then clamps */
  sw_wear_place *places; /* (count) */
  sw_cycles *cycles;     /* (count x SW_WEAR_SIGNALS) */
  sw_vec *across;        /* (count) work space of a step; NULL until the first */
  uint64_t holds;        /* tells which holds or rings gave the directions; 0: unknown */
  sw_extreme sidewall;   /* largest pressure T/R at touches, averaged like other peaks [N/m] */
  sw_window pressed;     /* window of the pressure at its nodes [N/m] */
} sw_wear;

void sw_wear_free(sw_wear *wear);
void sw_tape_wear(sw_tape *tape, sw_wear *wear);

#endif
