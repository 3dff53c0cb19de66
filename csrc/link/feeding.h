/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a hold that feeds remembers. */
#ifndef SW_LINK_FEEDING_H
#define SW_LINK_FEEDING_H

#include "base/root.h"
#include "base/tape.h"
#include "motion/motion.h"
#include "state/mesh.h"

/* A way that gives way to a force: wire slips through, in a step with an acceleration that is
 * looked for. */
typedef struct sw_slip {
  double push, limit;   /* force on the wire, the largest one; NAN = none [N] */
  double length;        /* slipped, beyond what was asked for [m] */
  double since;         /* [s] */
  double speed;         /* [m/s] */
  double growth;        /* of the speed in this step; between steps that of the last one [m/s2] */
  double growth_before; /* that of the last step that was taken [m/s2] */
  double way;           /* sign of the force against which it slips; 0 = it does not [-] */
  double way_before;    /* that at its end [-] */
  sw_bracket found;     /* growths with too little force and with too much [m/s2], [N] */
  double slope;         /* of the force over growth, last found; 0 = not known [kg] */
} sw_slip;

/* A place through which wire goes, so that nodes beside it come and go. */
typedef struct sw_guide {
  int outward;         /* where paid-out wire goes: +1 along the arc length, -1 against it [-] */
  double label;        /* the mesh's arc length at the guide when nothing was fed [m] */
  double spare[2];     /* length given to the edge before and after the guide when nodes came
                          and went, so that no axial force jumps [m] */
  double spare_fed[2]; /* fed at that time; the spare goes back to 0 over one edge's length [m] */
  double size;         /* edges beside the guide are made this long [m] */
  double drive;        /* force that moves the wire, outwards, last [N] */
  double stage;        /* the same of the last stage, which the next step goes on from [N] */
  sw_mesh shape;       /* the wire with its unloaded shape, if it has frames */
} sw_guide;

/* What is left of the spare lengths when so much is fed [m]. */
void sw_guide_spare(const sw_guide *guide, double fed, double spare[2]);

/* A hold through which the wire slides. The length paid out at time t is fed + speed
 * (t - since) + motion's x at t - start + slip.length + slip.speed u + slip.growth u^2 / 2, with
 * u = t - slip.since. */
typedef struct sw_feed {
  sw_guide guide;
  sw_slip slip;
  double fed, since; /* [m], [s] */
  double speed;      /* [m/s] */
  sw_motion *motion; /* a given length to be fed, or NULL */
  double start;      /* [s] */
} sw_feed;

void sw_tape_feed(sw_tape *tape, sw_feed *feed);

#endif
