/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A touch in the equations: its law, and the few nodes that share its force. The same for all kinds
 * of touch. */
#ifndef SW_TOUCH_SPOT_H
#define SW_TOUCH_SPOT_H

#include <stddef.h>

#include "system/system.h"
#include "touch/law.h"
#include "touch/mean.h"

enum { SW_SPOT_NODES = 6 };

typedef struct sw_spot {
  sw_press *press;
  double friction;              /* [-] */
  double scale;                 /* force scale: forces far below this do not matter [N] */
  uint32_t node[SW_SPOT_NODES]; /* count nodes of the system */
  double weight[SW_SPOT_NODES]; /* share of the force; negative on the other wire [-] */
  int count;
  int held[SW_SPOT_NODES];     /* 1: a hold carries the node's share */
  int turns;                   /* 1: the turn of the wires moves their surfaces along them: */
  sw_vec eases;                /* as in sw_meet [-] */
  sw_vec lever[SW_SPOT_NODES]; /* by this times the node's shift along the normal [-] */
} sw_spot;

typedef struct sw_spots {
  sw_spot *list;
  size_t count, capacity;
  double *more; /* (nodes x 3) memory for a solution [m] */
  size_t room;
  double *mixed; /* memory for forces [N] */
  size_t mixed_room;
} sw_spots;

void sw_spots_free(sw_spots *spots);

/* Appends a sliding touch, with press, friction and scale set in spot, at a place of one body and a
 * place of another one, or NULL. Returns it to set its levers; NULL: it does not slide, or memory
 * ran out and the touch is left out. */
sw_spot *sw_spots_add(sw_spots *spots, const sw_system *system, sw_spot spot, const sw_mean *one,
                      size_t body_one, const sw_mean *two, size_t body_two);

/* Updates friction of sliding touches to the normal forces, within the linearisation of bodies that
 * are solved together, by further solves with the same factor. */
void sw_spots_follow(sw_spots *spots, sw_system *system);

#endif
