/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds directions across a wire that turn with it. */
#include <math.h>

#include "state/clamp.h"
#include "state/hinge.h"
#include "watch/wear.h"

/* Returns a direction that moves with the hold, carried to the edge beside it. */
static sw_vec from_hold(const sw_system *s, const sw_body *b, const sw_clamp_hinge *c) {
  const size_t at = sw_clamp_place(c);
  const sw_vec local = sw_perpendicular(sw_unit_or(sw_vec_at(s->directors, at), sw_v(1, 0, 0)));
  const sw_vec d = sw_vec_at(s->directors_now, at);
  const sw_vec u = sw_rotate(s->hold_states[c->hold].pose.q, local);
  return sw_carry_unit(u, d, sw_field_tangent(&b->field, c->edge));
}

/* Returns the plan's clamp that the edge leaves (1) or arrives at (-1), or NULL. */
static const sw_clamp_hinge *clamp_of(const sw_plan *p, size_t edge, int side) {
  for (size_t c = 0; c < p->clamp_count; c++)
    if (p->clamps[c].edge == edge && p->clamps[c].side == side) return &p->clamps[c];
  return NULL;
}

/* Returns the first edge that gets its direction from a hold. The wire before it takes its
 * directions from this edge. */
static size_t first_source(const sw_plan *p, const sw_clamp_hinge **clamp) {
  *clamp = NULL;
  for (size_t c = 0; c < p->clamp_count; c++)
    if (!*clamp || p->clamps[c].edge < (*clamp)->edge) *clamp = &p->clamps[c];
  return *clamp ? (*clamp)->edge : 0;
}

/* Adds the twist of spans to their edges: it grows evenly between the two holds. */
static void twist_spans(const sw_system *s, const sw_body *b, sw_vec *across) {
  const sw_plan *p = b->plan;
  for (size_t k = 0; b->has_twist && k < p->span_count; k++) {
    const sw_span *span = &p->spans[k];
    const double from = p->s[span->first], length = p->s[span->last + 1] - from;
    for (size_t e = span->first; e <= span->last && length > 0; e++) {
      const double share = (0.5 * (p->s[e] + p->s[e + 1]) - from) / length;
      across[e] =
          sw_turned(across[e], sw_field_tangent(&b->field, e), share * s->twist[b->first_span + k]);
    }
  }
}

void sw_wear_axes(const sw_system *s, const sw_body *b, sw_vec first, sw_vec *across) {
  const sw_plan *p = b->plan;
  const sw_clamp_hinge *clamp;
  if (b->spin_block) {
    for (size_t e = 0; e < p->edges; e++)
      across[e] = sw_v(b->field.normals[0][e], b->field.normals[1][e], b->field.normals[2][e]);
    return;
  }
  const size_t source = first_source(p, &clamp);
  across[source] = clamp ? from_hold(s, b, clamp) : first;
  for (size_t e = source; e > 0; e--)
    across[e - 1] = sw_carry_unit(across[e], sw_field_tangent(&b->field, e),
                                  sw_field_tangent(&b->field, e - 1));
  for (size_t e = source + 1; e < p->edges; e++) {
    clamp = clamp_of(p, e, 1);
    across[e] = clamp ? from_hold(s, b, clamp)
                      : sw_carry_unit(across[e - 1], sw_field_tangent(&b->field, e - 1),
                                      sw_field_tangent(&b->field, e));
  }
  twist_spans(s, b, across);
}
