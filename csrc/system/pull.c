/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>

#include "base/each.h"
#include "system/arrays.h"
#include "system/axial.h"

/* Relative changes in a step above this are blows, which do not last [-]. */
static const double SMOOTH = 0.1;

sw_status sw_system_add_even(sw_system *s) {
  double *room;
  SW_TRY(sw_system_grow_state(s, 2 * s->edges + SW_TURN_SIZE, &room));
  s->even = room;
  s->between = room + s->edges;
  s->turning = s->between + s->edges;
  return SW_OK;
}

void sw_system_sum_pull(const sw_system *s, const double *tension, const double *rate,
                        double *out) {
  if (s->edges) memcpy(out, tension, s->edges * sizeof *out);
  for (size_t i = 0; rate && i < s->body_count; i++) {
    const sw_body *b = &s->bodies[i];
    if (!(b->axial_time > 0)) continue;
    for (size_t e = 0; e < sw_plan_axial(b->plan); e++)
      out[b->first_edge + e] += b->axial_time * sw_body_axial(b, e) * rate[b->first_edge + e];
  }
}

void sw_system_add_pull(const sw_system *s, const double *tension, const double *rate, double share,
                        double *sum) {
  SW_ITEMS(const sw_body, b, s->bodies, s->body_count) {
    if (b->plan->web) continue;
    const double c = b->axial_time > 0 ? share * b->axial_time * b->EA : 0.0;
    const size_t end = b->first_edge + sw_plan_axial(b->plan);
    for (size_t e = b->first_edge; e < end; e++) sum[e] += share * tension[e];
    for (size_t e = b->first_edge; c > 0 && e < end; e++) sum[e] += c * rate[e];
  }
}

void sw_system_even_out(sw_system *s, double h, const double *first, double share, double behind) {
  const double apart = h - behind + s->turning[SW_TURN_BEHIND];
  const double on = s->turning[SW_TURN_EVEN] > 0 && apart > 0 ? behind / apart : 0.0;
  sw_system_sum_pull(s, s->tension, s->strain_rate, s->even);
  for (size_t e = 0; e < s->edges; e++) {
    const double now = first[e] + share * (s->even[e] - first[e]), most = SMOOTH * fabs(now);
    s->even[e] = now + fmin(fmax(on * (now - s->between[e]), -most), most);
    s->between[e] = now;
  }
  s->turning[SW_TURN_EVEN] = 1, s->turning[SW_TURN_BEHIND] = behind;
}

void sw_system_uneven(sw_system *s) { s->turning[SW_TURN_EVEN] = 0; }

void sw_system_forget_turning(sw_system *s) {
  memset(s->turning, 0, SW_TURN_SIZE * sizeof *s->turning);
}

const double *sw_system_pull(const sw_system *s, const sw_body *body) {
  if (s->turning[SW_TURN_EVEN] > 0) return s->even + body->first_edge;
  return (body->axial_time > 0 ? s->pull : s->tension) + body->first_edge;
}

const double *sw_system_elastic(const sw_system *s, const sw_body *body) {
  if (s->turning[SW_TURN_EVEN] > 0 && !(body->axial_time > 0)) return s->even + body->first_edge;
  return s->tension + body->first_edge;
}
