/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces and stiffness of bodies at given places, and accelerations for explicit methods. */
#include <math.h>

#include "base/each.h"
#include "base/interrupt.h"
#include "system/assemble.h"
#include "system/inner.h"
#include "system/join_twist.h"
#include "system/spin.h"
#include "system/strain.h"
#include "system/system.h"
#include "system/twist.h"
#include "system/web.h"

/* Where the stiffness jumps, Newton may alternate between both sides. After QUICK iterations every
 * other one is cautious. */
enum { QUICK = 4 };

int sw_evaluate_cautious(int iteration) { return iteration > QUICK && iteration % 2; }

void sw_body_aim(const sw_system *s, sw_body *b, const double *x, const double *v) {
  sw_field *f = &b->field;
  f->x = x;
  f->v = v;
  f->strain_past = f->strain = f->strain_rate = NULL;
  f->clamp_past = f->clamp_rate = NULL;
  f->gravity = s->gravity;
  f->hold_directors = s->directors_now;
  f->hold_normals = s->normals_now;
  f->hold_turns = s->turns;
  f->hold_flows = s->flows;
}

void sw_body_begin(sw_body *b) {
  sw_field_clear(&b->field);
  sw_field_geometry(&b->field);
  if (b->plan->web && b->field.want & SW_WANT_STIFFNESS) sw_web_begin(b);
}

/* With many nodes each term takes long, so the user's wish to stop is checked between terms. */
static sw_status eval_terms(sw_body *b, sw_error *err) {
  for (size_t k = 0; k < b->term_count; k++) {
    if (sw_interrupted()) return SW_EINTR;
    SW_TRY(sw_term_eval(&b->terms[k], &b->field, err));
  }
  return SW_OK;
}

sw_status sw_body_evaluate(sw_system *s, sw_body *b, double time, double hbar, const double *y,
                           const double *v, int statics, int iteration, sw_error *err) {
  sw_field *f = &b->field;
  f->want = SW_WANT_FORCE | (s->goes_on ? 0u : SW_WANT_STIFFNESS);
  f->time = time;
  f->velocity_rate = statics ? 0.0 : 1.0 / hbar;
  f->statics = statics;
  f->cautious = sw_evaluate_cautious(iteration);
  sw_body_aim(s, b, y + 3 * b->first_node, v + 3 * b->first_node);
  f->tension = s->tension + b->first_edge;
  if (s->strain_past && b->axial_time > 0) {
    f->strain_past = s->strain_past + b->first_edge;
    f->strain = s->strain_now + b->first_edge;
  }
  sw_strain_show_past(s, b);
  sw_body_begin(b);
  sw_inner_felt_lengths(s, b);
  if (b->has_twist || b->spin_block) sw_system_measure(s, b);
  SW_TRY(eval_terms(b, err));
  const double *dead = s->dead ? s->dead + 3 * b->first_node : NULL;
  for (size_t i = 0; dead && i < 3 * b->plan->nodes; i++) f->force[i] += dead[i];
  return SW_OK;
}

sw_status sw_system_acceleration(sw_system *s, double t, const double *x, const double *v,
                                 double *a, sw_error *err) {
  if (sw_interrupted()) return SW_EINTR;
  SW_TRY(sw_system_place_holds(s, t, NULL, NULL, a, err));
  sw_joins_twist(s, x);
  SW_ITEMS(sw_body, body, s->bodies, s->body_count) {
    sw_field *f = &body->field;
    f->want = SW_WANT_FORCE;
    f->time = t;
    f->velocity_rate = 0;
    f->tension = NULL;
    sw_body_aim(s, body, x + 3 * body->first_node, v + 3 * body->first_node);
    sw_body_begin(body);
    if (body->has_twist || body->spin_block) sw_system_measure(s, body);
    SW_TRY(eval_terms(body, err));
  }
  if (s->coupling.eval)
    SW_TRY(s->coupling.eval(s->coupling.user, s, t, HUGE_VAL, x, SW_WANT_FORCE, err));
  SW_ITEMS(const sw_body, body, s->bodies, s->body_count) {
    const sw_field *f = &body->field;
    for (size_t i = 0; i < body->plan->nodes; i++)
      for (size_t k = 0; k < 3; k++) {
        const double force = sw_field_force(f, i, k);
        s->delta[3 * (body->first_node + i) + k] = force;
        if (body->plan->held[i] == SW_FREE)
          a[3 * (body->first_node + i) + k] = force / body->plan->lumped[i];
      }
  }
  SW_ITEMS(sw_held_node, h, s->held, s->held_count) {
    const sw_body *body = &s->bodies[h->body];
    const double m = body->plan->lumped[h->node - body->first_node];
    h->reaction = sw_sub(sw_scale(sw_load(a + 3 * h->node), m), sw_load(s->delta + 3 * h->node));
  }
  s->counters.evaluations++;
  return SW_OK;
}
