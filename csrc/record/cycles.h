/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cycles of a load that comes value by value, by the rainflow count of ASTM E1049-85, 5.4.4, in
 * bounded room. A cycle closes as soon as no later value can change it, so that the count is that
 * of the whole history. Where room is short, what is kept damages at least as much by any law of a
 * slope up to SW_CYCLES_SLOPE. */
#ifndef SW_RECORD_CYCLES_H
#define SW_RECORD_CYCLES_H

#include <stddef.h>

/* Reversals that wait for their cycle, kinds of cycles that are told apart, and the slope of an
 * S-N curve up to which those that are not count as at least what they were [-]. */
enum { SW_CYCLES_OPEN = 24, SW_CYCLES_KEPT = 56, SW_CYCLES_SLOPE = 8 };

typedef struct sw_cycle {
  double range; /* from valley to peak [the load's unit] */
  double mean;  /* largest of those that it stands for [the load's unit] */
  double count; /* how many [-] */
} sw_cycle;

typedef struct sw_cycles {
  double open[SW_CYCLES_OPEN];   /* the last is the present value [the load's unit] */
  sw_cycle kept[SW_CYCLES_KEPT]; /* ranges rising */
  int opened, count;             /* how many of each [-] */
} sw_cycles;

/* The next value; one that is not a number is left out. */
void sw_cycles_add(sw_cycles *c, double value);
/* All cycles so far, SW_CYCLES_KEPT + SW_CYCLES_OPEN at most; those that wait count one half. Gives
 * how many. */
size_t sw_cycles_read(const sw_cycles *c, sw_cycle *out);
/* The widest range so far [the load's unit]. */
double sw_cycles_widest(const sw_cycles *c);
/* 1: what may have come from anywhere is a count. */
int sw_cycles_fine(const sw_cycles *c);

#endif
