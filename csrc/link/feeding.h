/* SPDX-License-Identifier: GPL-3.0-or-later */
/* State of a hold that feeds. */
#ifndef SW_LINK_FEEDING_H
#define SW_LINK_FEEDING_H

#include "base/root.h"
#include "base/tape.h"
#include "motion/motion.h"
#include "state/mesh.h"

/* A drive that yields to a force: the wire slips through it. The acceleration in a step is searched
 * for (step/slip.c). */
typedef struct sw_slip {
  double push, limit;   /* force on the wire, largest force; NAN = none [N] */
  double length;        /* slipped, beyond the fed length [m] */
  double since;         /* time at which length and speed hold [s] */
  double speed;         /* [m/s] */
  double growth;        /* rate of the speed in this step; between steps: in the last one [m/s2] */
  double growth_before; /* the same in the last accepted step [m/s2] */
  double way;           /* sign of the force against which it slips; 0 = no slip [-] */
  double way_before;    /* the same at the end of the last accepted step [-] */
  sw_bracket found;     /* growths with too small and too large a force [m/s2], [N] */
  int evened;           /* 1: this step's force is the mix of the method's stages, without a blow */
  int anew;             /* 1: this step begins anew, see sw_course */
  double off;   /* force less the asked one at this step's end, where it jumps; else 0 [N] */
  double slope; /* last slope of the force over the growth; 0 = unknown [kg] */
} sw_slip;

/* The present values become those from which the next step starts. */
static inline void sw_slip_taken(sw_slip *slip) {
  slip->growth_before = slip->growth;
  slip->way_before = slip->way;
}

/* A place through which wire passes. Nodes beside it come and go. */
typedef struct sw_guide {
  int outward;         /* direction of paid-out wire: +1 along the arc length, -1 against it [-] */
  double label;        /* the mesh's arc length at the guide when nothing was fed [m] */
  double spare[2];     /* length added to the edge before and after the guide when nodes came and
                        * went, so that no axial force jumps [m] */
  double spare_fed[2]; /* length fed at that time; spare returns to 0 over one edge length [m] */
  double size;         /* length of edges made beside the guide [m] */
  double drive;        /* last force that moves the wire outwards, as read out [N] */
  double stage;        /* the same of the last stage, from which the next step starts [N] */
  sw_mesh shape;       /* the wire with its unloaded shape, if the wire has frames */
} sw_guide;

/* Returns the rest of the spare lengths at a fed length [m]. */
void sw_guide_spare(const sw_guide *guide, double fed, double spare[2]);

/* A hold through which the wire slides. The length paid out at time t is fed + speed (t - since) +
 * the motion's x at t - start + slip.length + slip.speed u + slip.growth u^2 / 2, with u = t -
 * slip.since. */
typedef struct sw_feed {
  sw_guide guide;
  sw_slip slip;
  double fed, since; /* [m], [s] */
  double speed;      /* [m/s] */
  sw_motion *motion; /* prescribed feeding of a given length, or NULL */
  double start;      /* [s] */
} sw_feed;

void sw_tape_feed(sw_tape *tape, sw_feed *feed);

#endif
