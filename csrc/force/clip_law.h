/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The potential of a snap-in clip across a wire. For one section of the wire, u is the distance of
 * its centre line from the seat towards the mouth, and v the distance to the side.
 *
 * Lips: a hump that begins at the seat, is `out` + `in` long and has its top at u = out. Both
 * flanks are sin^2, so the force grows smoothly from 0 to its peak and falls back: the peak is
 * `insertion` on the way in and `retention` on the way out. Pushing a lip aside from either side
 * stores the same energy H = (2/pi) insertion in = (2/pi) retention out. The steeper flank is
 * therefore the shorter one, like the ramps of real snap fits (two angles, one lip: Bayer, Snap-Fit
 * Joints for Plastics, 1998). The lips are relaxed when the wire is in its seat and when it is out:
 * a closed cycle loses no energy.
 *
 * Floor (u < -clearance) and walls (|v| > clearance): springs of stiffness k. Above the lips' top
 * the walls open into a funnel, which widens to either side by half the length of the lips' outer
 * flank, and fade out over the mouth. Floor and walls are 2 reach thick and hold up to strength = k
 * reach / pi from either side. For a wire that came over the mouth, lips and floor extend to the
 * sides without end, and the walls extend below the floor without end. For any other wire they end,
 * so that the wire may lie beside or under the clip. A wire pressed harder than strength breaks
 * through; the law is not valid beyond that. */
#ifndef SW_FORCE_CLIP_LAW_H
#define SW_FORCE_CLIP_LAW_H

/* Constants of a curve height sin^2(rate x): derivatives are slope sin cos, curve (cos^2 - sin^2).
 */
typedef struct sw_clip_hump {
  double length, rate;         /* x of its top [m], [rad/m] */
  double height, slope, curve; /* the curve's unit, over [m], over [m2] */
} sw_clip_hump;

typedef struct sw_clip_law {
  double in, out;            /* lengths of the lips' outer (in) and inner (out) flank [m] */
  double top;                /* H [J] */
  double clearance;          /* between wire and seat [m] */
  double k;                  /* of floor and walls [N/m] */
  double reach;              /* depth from which floor and walls no longer push back [m] */
  double strength;           /* largest force of floor and walls, at half that depth [N] */
  int caught;                /* 1: the wire came over the mouth */
  sw_clip_hump outer, inner; /* flanks of the lips [J] */
  sw_clip_hump side;         /* floor or wall, up to the depth `reach` [J] */
  sw_clip_hump ends, mouth;  /* weights that fade beyond walls and floor, and over the mouth [-] */
} sw_clip_law;

/* Returns the law for a wire of this radius [m]. NAN chooses a default. seat: radius of the seat
 * (default: the wire's) [m]; insertion, retention [N]; way: way of the wire over the lips [m];
 * stiffness [N/m] and strength [N] of floor and walls. */
sw_clip_law sw_clip_law_of(double wire, double seat, double insertion, double retention, double way,
                           double stiffness, double strength);

/* Value and derivatives at u, v. */
typedef struct sw_clip_point {
  double energy;     /* [J] */
  double u, v;       /* first derivatives [N] */
  double uu, uv, vv; /* second ones [N/m] */
} sw_clip_point;

sw_clip_point sw_clip_at(const sw_clip_law *law, double u, double v);

/* Returns the weight of a section at v in the clip: 1 between the walls, fading to 0 beyond them
 * [-]. */
double sw_clip_between(const sw_clip_law *law, double v);

/* Returns the largest second derivative [N/m]. */
double sw_clip_stiffest(const sw_clip_law *law);

#endif
