/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wires that are pushed along their length by more than their buckling load: how fast their bend
 * grows. */
#ifndef SW_SYSTEM_PUSHED_H
#define SW_SYSTEM_PUSHED_H

#include "system/system.h"

/* A piece of a wire that is pushed. */
typedef struct sw_pushed {
  double push, length; /* mean [N], [m] */
  size_t edge;         /* or slice, in its middle */
  size_t from, to;     /* its first edge or slice, and the one after its last */
} sw_pushed;

/* Returns the fastest rate at which a small bend of one of the wire's pieces grows under the
 * tensions evaluated last, for a mesh under the strains of its axis; 0: no push is large enough
 * [1/s]. x: places of all nodes of the system [m]. *most: that piece. gravity [m/s2]. */
double sw_pushed_rate(const sw_system *system, const sw_body *body, const double *x, double gravity,
                      sw_pushed *most);
/* The same of one piece. */
double sw_pushed_rate_of(const sw_beam *beam, double gravity, const sw_pushed *piece);

#endif
