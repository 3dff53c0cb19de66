/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a wire remembers of zones (watch/zone.c notes it). */
#ifndef SW_RECORD_ZONE_H
#define SW_RECORD_ZONE_H

#include "base/tape.h"
#include "base/vec.h"

/* Of one wire and one zone, since the run began. */
typedef struct sw_zone_past {
  double gap;     /* least distance of the wire's surface at a step's end; below 0: inside [m] */
  double s, time; /* where and when [m], [s] */
  double between; /* least that it may have been, also within steps, nodes moving straight [m] */
  double inside;  /* time that something of the wire was inside [s] */
  double until;   /* end of the last step that is in it [s] */
  double last;    /* distance then [m] */
  sw_pose before; /* then, of the obstacle that the zone goes with */
} sw_zone_past;

typedef struct sw_zone_watch {
  size_t zones, edges;
  sw_zone_past *past; /* (zones) */
  double *gaps;       /* (zones x edges) at the last step's end [m] */
  double *x;          /* (edges x 6) their ends then [m] */
} sw_zone_watch;

void sw_zones_forget(sw_zone_watch *watch);
void sw_tape_zone_watch(sw_tape *tape, sw_zone_watch *watch);

#endif
