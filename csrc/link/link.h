/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Links keep wires at a place or at each other. Holds keep part of one wire (hold.h); joints
 * connect two wires or more (joint.h). Each member is one file with its parameters, its held nodes
 * or springs, its reaction and its read-outs. The file ends in one sw_link_class; list.def has one
 * X(name) line for each. */
#ifndef SW_LINK_LINK_H
#define SW_LINK_LINK_H

#include <stddef.h>

#include "base/param.h"
#include "base/vec.h"

/* A user's arguments for a hold. */
typedef struct sw_hold_args {
  double s;         /* arc length of the held point [m] */
  double width;     /* length of the held interval around s; 0 = a point [m] */
  sw_vec direction; /* held tangent; NAN = the wire's present one [-] */
  char name[SW_NAME_SIZE];

  /* of a hold that feeds: */
  double speed;       /* wire paid out per time; NAN = not given [m/s] */
  double force;       /* pushes the wire out; NAN = not given [N] */
  double force_limit; /* the wire slips beyond it; NAN = none [N] */

  /* of a hold along which the wire slides; not kept after the hold has begun (sw_hold_forget): */
  sw_vec line;          /* direction of a straight rail; NAN = not given [-] */
  double from, to;      /* its ends, from the wire's place [m] */
  const double *points; /* (count x 3) of a curved rail, or NULL [m] */
  size_t count;
  int closed;      /* 1: the last point is followed by the first */
  int formed;      /* 1: of a frozen grip, whose places are given */
  double friction; /* [-] */
} sw_hold_args;

enum { SW_JOIN_ENDS = 8 };    /* largest number of wires in a join */
enum { SW_LINK_OUTPUTS = 8 }; /* largest number of values that a link lets one read */

/* A user's arguments for a joint. */
typedef struct sw_join_args {
  int rigid; /* 1: the angles between the wires are kept */
  char name[SW_NAME_SIZE];
  double slack;     /* of a tie: distance up to which it does not pull; NAN = no tie [m] */
  double stiffness; /* of a taut tie [N/m] */
  double strength;  /* pull at which a tie breaks; NAN = never [N] */
} sw_join_args;

typedef struct sw_link_class {
  const char *name;
  const char *summary;
  sw_params params;
  const struct sw_hold_acts *hold;   /* of links of one wire, or NULL */
  const struct sw_joint_acts *joint; /* of links of several wires, or NULL */
} sw_link_class;

const sw_link_class *sw_link_find(const char *name); /* NULL if there is none */
const sw_link_class *const *sw_link_all(void);       /* NULL-terminated */

#endif
