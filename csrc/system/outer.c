/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces from outside, evaluated by themselves. */
#include "system/outer.h"

#include <math.h>

#include "base/each.h"
#include "base/interrupt.h"

int sw_outer_is(const sw_force_class *cls) {
  return (cls->flags & (SW_FORCE_EXPLICIT | SW_FORCE_DRIVEN)) &&
         !(cls->flags & SW_FORCE_DISSIPATIVE);
}

sw_status sw_outer_force(sw_system *s, sw_body *b, const sw_term *term, double time, int statics,
                         double *out, sw_error *err) {
  sw_field *f = &b->field;
  sw_body_aim(s, b, s->x + 3 * b->first_node, s->v + 3 * b->first_node);
  f->want = SW_WANT_FORCE;
  f->time = time;
  f->velocity_rate = 0;
  f->statics = statics;
  sw_body_begin(b);
  if (sw_interrupted()) return SW_EINTR;
  SW_TRY(sw_term_eval(term, f, err));
  for (size_t i = 0; i < b->plan->nodes; i++)
    for (size_t k = 0; k < 3; k++) out[3 * i + k] = sw_field_force(f, i, k);
  return SW_OK;
}

double sw_outer_period(const sw_system *s, const sw_term **term) {
  double least = HUGE_VAL;
  *term = NULL;
  SW_ITEMS(const sw_body, b, s->bodies, s->body_count)
    SW_ITEMS(const sw_term, t, b->terms, b->term_count) {
      const double period = t->cls->period ? t->cls->period(t->args) : HUGE_VAL;
      if (period < least) least = period, *term = t;
    }
  return least;
}
