/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory of touches of wires that have got other edges. */
#ifndef SW_MUTUAL_RESAMPLE_H
#define SW_MUTUAL_RESAMPLE_H

#include "mutual/mutual.h"

/* The wires of a memory of touches as they were. */
typedef struct sw_pairs_former {
  const double *s;     /* (nodes) arc lengths [m] */
  const size_t *first; /* (wires + 1) first node of each wire */
  const size_t *now;   /* (wires) present bodies; SIZE_MAX: gone */
  const char *changed; /* (wires) 1: a line that has got other edges */
  size_t wires;
} sw_pairs_former;

/* Gives lines that have got other edges the memory of their touches with each other and with
 * themselves, with the same sum of forces, as if they were still on them. The present memory is
 * that of the nodes that stayed; memory and bytes are the former one. SW_ENOMEM. */
sw_status sw_pairs_resample(sw_mutual *pairs, const sw_system *system, const void *memory,
                            size_t bytes, const sw_pairs_former *former);

#endif
