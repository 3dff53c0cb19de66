/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Holds: constraints that impose a motion on part of a wire. A member is one
 * file ending in one sw_hold_class and one X(name) line in list.def. */
#ifndef SW_CONSTRAINT_CONSTRAINT_H
#define SW_CONSTRAINT_CONSTRAINT_H

#include <stddef.h>

#include "base/param.h"
#include "base/status.h"
#include "base/vec.h"

/* A user's arguments for a hold. */
typedef struct sw_hold_args {
  double s;         /* arc length of the held point [m] */
  double width;     /* of the held interval around s; 0 = a point [m] */
  sw_vec direction; /* held tangent; NAN = as the wire is [-] */
  char name[SW_NAME_SIZE];

  /* of a hold that feeds */
  double speed;       /* wire paid out per time; NAN = not given [m/s] */
  double force;       /* pushing the wire out; NAN = not given [N] */
  double force_limit; /* beyond it the wire slips; NAN = none [N] */
} sw_hold_args;

typedef struct sw_hold_class {
  const char *name;
  const char *summary;
  int clamped; /* 1: direction held too */
  int feeds;   /* 1: the wire slides through */
  sw_params params;
} sw_hold_class;

const sw_hold_class *sw_hold_find(const char *name);
const sw_hold_class *const *sw_hold_all(void); /* NULL-terminated */

#endif
