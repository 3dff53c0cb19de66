/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frames are carried from iterate to iterate. Iterates that throw a wire far may lead its frames
 * through the wire itself, or turn a hinge by more than pi; then they have lost or won whole turns
 * when the iterates come back. The straight way from the state to the result has none of this, and
 * tells how much the twist between two clamps may have changed: see system/twist.h. */
#include <math.h>

#include "base/each.h"
#include "system/part.h"
#include "system/spin.h"
#include "system/twist.h"

/* Stages that converge in fewer iterations throw nothing far [-]. */
enum { FEW = 4 };

static const double HALF_TURN = 3.14159265358979323846; /* [rad] */

static sw_vec edge_of(const double *x, size_t e) {
  return sw_unit_or(sw_sub(sw_vec_at(x, e + 1), sw_vec_at(x, e)), sw_v(1, 0, 0));
}

/* Change of a span's twist on the straight way to positions y of the body [rad]. */
static double straight_change(const sw_system *s, const sw_body *b, const sw_span *span,
                              const double *y) {
  const double *x = s->x + 3 * b->first_node;
  const sw_clamp_change left = sw_clamp_change_of(s, &b->plan->clamps[span->left]);
  const sw_clamp_change right = sw_clamp_change_of(s, &b->plan->clamps[span->right]);
  sw_vec before = left.before, now = left.now;
  double sum = right.turn - left.turn;
  for (size_t e = span->first; e <= span->last; e++) {
    const sw_vec was = edge_of(x, e), is = edge_of(y, e);
    sum += sw_hinge_change(before, was, now, is);
    before = was, now = is;
  }
  return sum + sw_hinge_change(before, right.before, now, right.now);
}

/* Change of a span's twist that its hinges have followed [rad]. */
static double followed_change(const sw_system *s, const sw_body *b, const sw_span *span) {
  const sw_plan *p = b->plan;
  const double *before = s->frames + b->first_frame + 3 * p->edges, *now = b->spin_twist;
  const size_t left = p->nodes + span->left, right = p->nodes + span->right;
  double sum = now[left] - before[left] + now[right] - before[right];
  for (size_t i = span->first + 1; i <= span->last; i++) sum += now[i] - before[i];
  return sum;
}

int sw_spins_are_whole(const sw_system *s, const double *y, int iterations) {
  if (iterations < FEW) return 1;
  SW_ITEMS(const sw_body, b, s->bodies, s->body_count) {
    if (!b->spin_block || b->waits) continue;
    SW_ITEMS(const sw_span, span, b->plan->spans, b->plan->span_count) {
      if (span->left >= b->plan->clamp_count || span->right >= b->plan->clamp_count) continue;
      const double straight = straight_change(s, b, span, y + 3 * b->first_node);
      if (fabs(straight - followed_change(s, b, span)) > HALF_TURN) return 0;
    }
  }
  return 1;
}
