/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Divides steps that would take a wire past a force of short reach (passing.h). */
#include "step/passing.h"

#include <math.h>

#include "scene/parts.h"
#include "system/system.h"

/* Parts are halves. A part in which a wire moves too far by less than this factor is accepted
 * [-]. */
static const double WELL_ENOUGH = 1.25;
/* Shortest part for moving past a force; even it limits only speeds of tens of m/s [s]. */
static const double SHORTEST = 1e-5;

int sw_passing_any(const sw_scene *s) {
  const sw_system *system = sw_scene_system(s);
  for (size_t w = 0; sw_scene_force_slots(s) && w < system->body_count; w++)
    for (size_t k = 0; k < system->bodies[w].term_count; k++) {
      const sw_term *term = &system->bodies[w].terms[k];
      if (!term->cls->oversteps || !term->history) continue;
      if (!term->cls->idle || !term->cls->idle(term->history)) return 1;
    }
  return 0;
}

double sw_passing_between(const sw_scene *s, const double *from, const double *to) {
  sw_system *system = sw_scene_system(s);
  double most = 0;
  for (size_t w = 0; sw_scene_force_slots(s) && w < system->body_count; w++) {
    const sw_body *b = &system->bodies[w];
    SW_ITEMS(const sw_term, term, b->terms, b->term_count) {
      if (!term->cls->oversteps) continue;
      sw_field now = b->field; /* the field's own places may be those of a discarded trial */
      now.x = from + 3 * b->first_node;
      now.statics = 0;
      most =
          fmax(most, term->cls->oversteps(term->args, &now, term->history, to + 3 * b->first_node));
    }
  }
  return most;
}

double sw_passing_of(const sw_scene *s, const double *x) {
  return sw_passing_between(s, sw_scene_system(s)->x, x);
}

int sw_passing_too_far(const sw_scene *s, const double *x) {
  return sw_passing_of(s, x) > WELL_ENOUGH;
}

double sw_passing_part(double h, double over) {
  if (!(over > WELL_ENOUGH)) return h;
  return fmin(h, fmax(SHORTEST, h * exp2(-ceil(log2(over / WELL_ENOUGH)))));
}
