/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far a rod has turned about its axis where it touches obstacles (watch/spun.c). */
#ifndef SW_RECORD_SPUN_H
#define SW_RECORD_SPUN_H

#include <stddef.h>
#include <stdint.h>

#include "base/tape.h"
#include "base/vec.h"

/* One edge of the wire. */
typedef struct sw_spun_place {
  double turn;            /* against the obstacle, since the touch began [rad] */
  double share;           /* part of friction that such a turn takes from the slide along it [-] */
  sw_vec tangent, across; /* at the last state; across turns with the wire [-] */
  double seen;            /* 1: it touched at the last state [-] */
} sw_spun_place;

typedef struct sw_spun {
  size_t count;
  sw_spun_place *places; /* (count) NULL: the wire has not been twisted on an obstacle */
  sw_vec *across;        /* (count) work space of a step; NULL until the first */
  uint64_t holds;        /* tells which holds gave the directions */
} sw_spun;

void sw_spun_free(sw_spun *spun);
void sw_tape_spun(sw_tape *tape, sw_spun *spun);

#endif
