/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Loads of holds and grippers between two times, from the forces and moments of single steps. */
#ifndef SW_RECORD_LOADS_H
#define SW_RECORD_LOADS_H

#include "base/vec.h"
#include "record/peak.h"

/* One recorded step. span: above 0 = force and moment are means over this time up to t; below 0 =
 * they are those at the end of a step of this length; 0 = an equilibrium. */
typedef struct sw_load_row {
  double t, span;       /* [s] */
  sw_vec force, moment; /* [N], [N m] */
  int idle;             /* 1: pads that bear nothing and hold nothing */
  double squeeze;       /* of pads; NAN: not pads [N] */
  double margin, slip;  /* of pads; margin NAN: they hold nothing, close or let go [-], [m] */
} sw_load_row;

/* What to measure. gaps: pairs of times between which something was held, or NULL: always. */
typedef struct sw_loads_args {
  double t1, t2; /* [s] */
  double width;  /* of the window [s] */
  const double *held;
  size_t spans; /* number of pairs */
} sw_loads_args;

typedef struct sw_loads {
  sw_peak force, moment, margin; /* [N], [N m], [-] */
  sw_vec impulse;                /* [N s] */
  double duration;               /* time in which it held something [s] */
  double mean_force, mean_moment;
  double squeeze, slip; /* largest, last; NAN: no pads [N], [m] */
  int holds;            /* 1: pads held something, so that there is a margin */
} sw_loads;

/* Measures n steps in the order of time. room: n spans, and as many sums. */
sw_loads sw_loads_over(const sw_load_row *rows, size_t n, const sw_loads_args *args, sw_lapse *room,
                       double (*sums)[3]);

#endif
