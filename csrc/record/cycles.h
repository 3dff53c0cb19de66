/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rainflow count of the cycles of a load that comes value by value (ASTM E1049-85, 5.4.4), in
 * bounded room. A cycle closes as soon as no later value can change it, so the count is that of the
 * whole history. When room is short, cycles are merged. The merged ones damage at least as much
 * under any S-N curve with a slope up to SW_CYCLES_SLOPE. Of too many waiting reversals two are
 * closed; they damage as much with a slope of 3. Reversals at the start count as half cycles. They
 * are kept too: if the load is repeated, they close whole cycles with those that wait. */
#ifndef SW_RECORD_CYCLES_H
#define SW_RECORD_CYCLES_H

#include <stddef.h>

/* Most reversals that wait for their cycle; most kinds of cycles kept apart; the slope of an S-N
 * curve up to which merged cycles damage at least as much as the original ones [-]. */
enum { SW_CYCLES_OPEN = 32, SW_CYCLES_KEPT = 56, SW_CYCLES_SLOPE = 8 };

typedef struct sw_cycle {
  double range; /* from valley to peak [the load's unit] */
  double mean;  /* largest of the merged cycles [the load's unit] */
  double count; /* number of cycles [-] */
} sw_cycle;

typedef struct sw_cycles {
  double begun[SW_CYCLES_OPEN];  /* reversals before those, whose ranges only grow */
  double open[SW_CYCLES_OPEN];   /* the last is the present value [the load's unit] */
  sw_cycle kept[SW_CYCLES_KEPT]; /* sorted, smallest range first */
  int opened, count, begins;     /* number of entries of open, kept and begun [-] */
} sw_cycles;

/* Adds the next value; a NAN or infinite one is left out. */
void sw_cycles_add(sw_cycles *c, double value);
/* Copies all cycles so far, SW_CYCLES_KEPT + SW_CYCLES_OPEN at most; waiting ones count one half.
 * Returns their number. */
size_t sw_cycles_read(const sw_cycles *c, sw_cycle *out);
/* Copies the reversals whose ranges count as half cycles: those at the start, then those that wait,
 * 2 SW_CYCLES_OPEN at most. A load that is repeated closes cycles between them. Returns their
 * number. */
size_t sw_cycles_residue(const sw_cycles *c, double *out);
/* Returns the widest range so far [the load's unit]. */
double sw_cycles_widest(const sw_cycles *c);
/* 1 if the numbers of entries fit. */
int sw_cycles_sized(const sw_cycles *c);
/* 1 if a count of unknown origin is valid. */
int sw_cycles_fine(const sw_cycles *c);

#endif
