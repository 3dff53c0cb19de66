/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the largest torsion of a line. */
#include <math.h>

#include "body/spin.h"
#include "system/system.h"

static void keep(sw_extreme *out, double value, double s) {
  if (value > out->value) out->value = value, out->s = s;
}

/* For a wire with material frames: of each hinge, beyond that at rest. */
static void of_hinges(const sw_body *b, sw_extreme *out) {
  const sw_plan *p = b->plan;
  for (size_t k = 0; k < p->nodes + p->clamp_count; k++) {
    const double length = k < p->nodes ? p->hinge[k] : p->clamps[k - p->nodes].length;
    const size_t node = k < p->nodes ? k : p->clamps[k - p->nodes].node;
    if (!(length > 0)) continue;
    keep(out, fabs(b->field.hinge_twist[k] - p->rest_twist[k]) / length, p->s[node]);
  }
}

void sw_scene_torsion(const sw_system *s, const sw_body *b, sw_extreme *out) {
  const sw_plan *p = b->plan;
  *out = (sw_extreme){.value = 0, .s = p->s[0]};
  if (b->spin_block) of_hinges(b, out);
  for (size_t k = 0; b->has_twist && !b->spin_block && k < p->span_count; k++) {
    const sw_span *span = &p->spans[k];
    const double torque = sw_span_torque(p, span, 1.0, s->twist[b->first_span + k]);
    keep(out, fabs(torque), 0.5 * (p->s[span->first] + p->s[span->last + 1]));
  }
}
