/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Updates twist and frames of the state before its places. */
#include "base/each.h"
#include "system/join_twist.h"
#include "system/spin.h"
#include "system/twist.h"

/* Stores the holds' orientations, as last placed, for the state's twist. */
static void take_turns(sw_system *s) {
  for (size_t k = 0; k < s->hold_count; k++) {
    const sw_quat q = s->hold_states[k].pose.q;
    double *out = s->turn + 4 * k;
    out[0] = q.w, out[1] = q.x, out[2] = q.y, out[3] = q.z;
  }
}

void sw_system_follow(sw_system *s, const double *x) {
  sw_joins_twist(s, x);
  SW_ITEMS(sw_body, body, s->bodies, s->body_count) {
    if (body->waits) continue;
    if (body->spin_block) sw_spin_follow(s, body, x);
    for (size_t k = 0; body->has_twist && k < body->plan->span_count; k++) {
      double *twist = &s->twist[body->first_span + k];
      *twist = body->plan->stops ? body->twist_now[k] : *twist + sw_twist_change(s, body, k, x);
    }
  }
  take_turns(s);
}
