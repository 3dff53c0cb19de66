/* SPDX-License-Identifier: GPL-3.0-or-later */
/* History of a wire and the zones (written by watch/zone.c). */
#ifndef SW_RECORD_ZONE_H
#define SW_RECORD_ZONE_H

#include "base/tape.h"
#include "base/vec.h"

/* History of one wire and one zone since the run began. */
typedef struct sw_zone_past {
  double gap;     /* smallest distance of the wire's surface at a step's end; below 0: inside [m] */
  double s, time; /* where and when [m], [s] */
  double between; /* lower bound, also within steps; nodes move straight [m] */
  double inside;  /* time with any part of the wire inside [s] */
  double until;   /* end of the last noted step [s] */
  double last;    /* smallest distance at that time [m] */
  sw_pose before; /* pose of the zone's obstacle at that time */
} sw_zone_past;

typedef struct sw_zone_watch {
  size_t zones, edges;
  sw_zone_past *past; /* (zones) */
  double *gaps;       /* (zones x edges) at the last step's end [m] */
  double *x;          /* (edges x 6) the edges' ends at that time [m] */
} sw_zone_watch;

void sw_zones_forget(sw_zone_watch *watch);
void sw_tape_zone_watch(sw_tape *tape, sw_zone_watch *watch);

#endif
