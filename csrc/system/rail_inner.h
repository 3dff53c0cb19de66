/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Helpers of rail.c and rail_solve.c. Private to them. */
#ifndef SW_SYSTEM_RAIL_INNER_H
#define SW_SYSTEM_RAIL_INNER_H

#include "system/part.h"
#include "system/rail.h"

static inline const sw_held_node *sw_rail_node(const sw_system *s, const sw_rail *r) {
  return &s->held[r->held];
}

/* 1 if it belongs to the bodies of the present part. */
static inline int sw_rail_is_part(const sw_system *s, const sw_rail *r) {
  const size_t body = sw_rail_node(s, r)->body;
  return body < s->part_end && body >= s->part && sw_part_next(s, body) == body;
}

static inline sw_vec sw_rail_times(const double K[9], sw_vec d) {
  return sw_v(K[0] * d.x + K[1] * d.y + K[2] * d.z, K[3] * d.x + K[4] * d.y + K[5] * d.z,
              K[6] * d.x + K[7] * d.y + K[8] * d.z);
}

static inline sw_vec sw_rail_across(const sw_rail *r, sw_vec f) {
  return sw_madd(f, r->along, -sw_dot(f, r->along));
}

#endif
