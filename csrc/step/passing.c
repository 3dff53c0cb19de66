/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "step/passing.h"

#include <math.h>

#include "scene/parts.h"
#include "system/system.h"

/* A part that goes too far by less than this is taken all the same: parts are halves [-]. */
static const double WELL_ENOUGH = 1.25;
/* No part is made shorter than this for what is passed: it is passed at tens of m/s [s]. */
static const double SHORTEST = 1e-5;

double sw_passing_of(const sw_scene *s, const double *x) {
  sw_system *system = sw_scene_system(s);
  double most = 0;
  for (size_t w = 0; sw_scene_force_slots(s) && w < system->body_count; w++) {
    const sw_body *b = &system->bodies[w];
    SW_ITEMS(const sw_term, term, b->terms, b->term_count) {
      if (!term->cls->oversteps) continue;
      sw_field now = b->field; /* its own places may be those of a trial that is gone */
      now.x = system->x + 3 * b->first_node;
      most =
          fmax(most, term->cls->oversteps(term->args, &now, term->history, x + 3 * b->first_node));
    }
  }
  return most;
}

double sw_passing_part(double h, double over) {
  if (!(over > WELL_ENOUGH)) return h;
  return fmin(h, fmax(SHORTEST, h * exp2(-ceil(log2(over / WELL_ENOUGH)))));
}
