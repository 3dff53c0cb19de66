/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How much a touch leans along the wire (see lean.h). */
#include "touch/lean.h"

#include <math.h>

/* TAUT: effect of tension relative to an edge's bending. MOST_LEAN: largest lean of a touch [-]. */
static const double TAUT = 0.27, MOST_LEAN = 0.1;
/* Bending between nodes follows the force with a time constant of this many of its periods [-]. */
static const double SLOWLY = 4.0;

double sw_lean_of(const sw_system *s, const sw_body *b, double place, double force) {
  const sw_plan *p = b->plan;
  if (!(place > 0.5) || !(place < (double)p->edges - 0.5) || !(p->beam.EI > 0)) return 0;
  const size_t i = (size_t)(place + 0.5), e = b->first_edge + i;
  const double v = place + 0.5 - (double)i, h = 0.5 * (p->rest[i - 1] + p->rest[i]);
  const double T = fmax(0.0, 0.5 * (s->tension[e - 1] + s->tension[e])), h2 = h * h / p->beam.EI;
  const double lean = 0.25 * force * h2 * v * (1.0 - v) * (1.0 - 2.0 * v) / (1.0 + TAUT * T * h2);
  return fmin(fmax(lean, -MOST_LEAN), MOST_LEAN);
}

double sw_lean_steady(const sw_body *b, size_t edge, double steady, double force, double h) {
  const sw_plan *p = b->plan;
  const double length = p->rest[edge < p->edges ? edge : p->edges - 1];
  const double slow = SLOWLY * length * length * sqrt(p->beam.mass / p->beam.EI);
  if (force <= steady || !(h > 0)) return force;
  return steady + (force - steady) * h / (h + slow);
}
