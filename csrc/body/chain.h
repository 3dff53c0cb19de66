/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A chain of straight links. Its turns from link to link come as near as possible to given turns.
 */
#ifndef SW_BODY_CHAIN_H
#define SW_BODY_CHAIN_H

#include <stddef.h>

#include "base/status.h"
#include "base/vec.h"

typedef struct sw_chain_link {
  sw_vec u;      /* direction [-] */
  double length; /* 0: a held direction [m] */
  int stays;     /* 1: it keeps its direction */
  double joint;  /* length of wire that bends between it and the next link; 0: none [m] */
  sw_vec turn;   /* wanted rotation there, a vector [rad] */
  int ends;      /* 1: it ends at a fixed place, by */
  sw_vec span;   /* from the fixed place before, or from the chain's start [m] */
} sw_chain_link;

/* Turns the links until the sum of (turn - wanted turn)^2 / joint is least, while they reach from
 * each fixed place to the next one. give: length that a stretch between fixed places gives per
 * force, over its length and over EI [1/m2]; it keeps stretches that are straight solvable.
 * start_free: 1 if the chain's start is no fixed place. *done: 0 if it was not found. SW_ENOMEM. */
sw_status sw_chain_ease(sw_chain_link *links, size_t count, double give, int start_free, int *done);

/* Returns the rotation vector of the shortest turn from one direction to another [rad]. */
sw_vec sw_chain_turn(sw_vec from, sw_vec to);

#endif
