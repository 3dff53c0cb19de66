/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a hold that feeds remembers. */
#ifndef SW_LINK_FEEDING_H
#define SW_LINK_FEEDING_H

#include "base/root.h"
#include "base/tape.h"
#include "motion/motion.h"
#include "state/mesh.h"

struct sw_hold;

/* A hold through which the wire slides. The length paid out at time t is fed + speed
 * (t - since) + motion's x at t - start + slip + slip_speed u + slip_growth u^2 / 2, with
 * u = t - slip_since. */
typedef struct sw_feed {
  int outward;         /* where paid-out wire goes: +1 along the arc length, -1 against it [-] */
  double label;        /* the mesh's arc length at the guide when nothing was fed [m] */
  double fed, since;   /* [m], [s] */
  double speed;        /* [m/s] */
  sw_motion *motion;   /* a given length to be fed, or NULL */
  double start;        /* [s] */
  double slip;         /* beyond what was asked for [m] */
  double slip_since;   /* [s] */
  double slip_speed;   /* [m/s] */
  double slip_growth;  /* of this step; between steps that of the last one [m/s2] */
  double slip_before;  /* slip_growth of the step before [m/s2] */
  double push, limit;  /* force on the wire, the largest one; NAN = none [N] */
  double slip_way;     /* sign of the force against which it slips; 0 = it does not [-] */
  double way_before;   /* that of the step before [-] */
  sw_bracket found;    /* slip_growths with too little force and with too much [m/s2], [N] */
  double slope;        /* of the force over slip_growth, last found; 0 = not known [kg] */
  double spare[2];     /* length given to the edge before and after the guide when nodes came
                          and went, so that no axial force jumps [m] */
  double spare_fed[2]; /* fed at that time; the spare goes back to 0 over one edge's length [m] */
  double size;         /* edges beside the guide are made this long [m] */
  double drive;        /* force that moves the wire, outwards, last [N] */
  sw_mesh shape;       /* the wire with its unloaded shape, if it has frames */
} sw_feed;

/* Length paid out at a time, its speed and acceleration. */
typedef struct sw_feed_now {
  double fed, speed, acceleration; /* [m], [m/s], [m/s2] */
} sw_feed_now;
sw_feed_now sw_feed_at(const struct sw_hold *hold, double t);
/* What is left of the spare lengths when so much is fed [m]. */
void sw_feed_spare(const sw_feed *feed, double fed, double spare[2]);

void sw_tape_feed(sw_tape *tape, sw_feed *feed);

#endif
