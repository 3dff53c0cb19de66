/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The potential of a snap-in clip across a wire. u is how far the wire's centre line is from the
 * seat towards the mouth, v how far to the side, both of one section of the wire.
 *
 * Lips: a hump that begins at the seat, is `out` + `in` long and has its top at u = out. Both of
 * its flanks are sin^2, so that the force grows smoothly from 0 to its peak and back: on the way
 * in up to `insertion`, on the way out up to `retention`. A lip that has to be pushed aside by the
 * same amount from either side stores the same energy H = (2/pi) insertion in = (2/pi) retention
 * out, so the steeper flank is the shorter one, as with the ramps of real snap fits (two angles,
 * one lip: Bayer, Snap-Fit Joints for Plastics, 1998). The lips rest when the wire is in its
 * seat and when it is out: nothing is lost, a closed cycle costs what it gives back.
 *
 * Floor (u < -clearance) and walls (|v| > clearance): springs of stiffness k. Above the lips' top
 * the walls open and fade out over the mouth, a funnel half as wide to either side as the lips'
 * outer flank is long. They are as thick as a wall: twice reach deep, they hold up to
 * strength = k reach / pi from either side. For a wire that came over the mouth they go on to
 * either side without end, for one that is elsewhere they do not, so that it may lie beside or
 * under the clip. Pressed harder it breaks through, where this is valid no more. */
#ifndef SW_FORCE_CLIP_LAW_H
#define SW_FORCE_CLIP_LAW_H

typedef struct sw_clip_law {
  double in, out;   /* lengths of the lips' outer and inner flank [m] */
  double top;       /* H [J] */
  double clearance; /* of the wire in its seat [m] */
  double k;         /* of floor and walls [N/m] */
  double reach;     /* depth at which these hold no more [m] */
  double strength;  /* of floor and walls there [N] */
  int caught;       /* 1: the wire came over the mouth */
} sw_clip_law;

/* For a wire of this radius. seat: radius of the seat, NAN = that of the wire; way: of the wire
 * over the lips, NAN = chosen; stiffness of floor and walls, and their strength, NAN = chosen
 * [m], [m], [N], [N], [m], [N/m], [N]. */
sw_clip_law sw_clip_law_of(double wire, double seat, double insertion, double retention, double way,
                           double stiffness, double strength);

/* Value and derivatives at u, v. */
typedef struct sw_clip_point {
  double energy;     /* [J] */
  double u, v;       /* first derivatives [N] */
  double uu, uv, vv; /* second ones [N/m] */
} sw_clip_point;

sw_clip_point sw_clip_at(const sw_clip_law *law, double u, double v);

/* Share of a wire to the side by v that is the clip's: 1 between the walls, 0 beyond them [-]. */
double sw_clip_between(const sw_clip_law *law, double v);

/* Largest second derivative [N/m]. */
double sw_clip_stiffest(const sw_clip_law *law);

#endif
