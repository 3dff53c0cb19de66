/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Holds: places their nodes and computes their loads. */
#include <math.h>

#include "base/each.h"
#include "system/inner.h"
#include "system/rail.h"
#include "system/system.h"

static void place_node(const sw_hold_state *h, sw_vec local, double *x, double *v, double *a) {
  const sw_vec arm = sw_rotate(h->pose.q, local);
  if (x) sw_store(x, sw_add(h->pose.p, arm));
  const sw_vec spin = sw_cross(h->omega, arm);
  if (v) sw_store(v, sw_add(h->v, spin));
  if (a) sw_store(a, sw_add(h->a, sw_add(sw_cross(h->alpha, arm), sw_cross(h->omega, spin))));
}

static sw_status place_hold(sw_system *s, size_t k, double t, sw_error *err) {
  sw_hold_state *at = &s->hold_states[k], from, to;
  SW_TRY(s->coupling.place(s->coupling.user, (int)k, t, at, err));
  if (!(s->to > s->from)) return SW_OK;
  SW_TRY(s->coupling.place(s->coupling.user, (int)k, s->from, &from, err));
  SW_TRY(s->coupling.place(s->coupling.user, (int)k, s->to, &to, err));
  const double share = (t - s->from) / (s->to - s->from);
  const sw_vec turn = sw_quat_log(sw_quat_mul(to.pose.q, sw_quat_conj(from.pose.q)));
  at->pose.p = sw_madd(from.pose.p, sw_sub(to.pose.p, from.pose.p), share);
  at->pose.q = sw_quat_mul(sw_quat_exp(sw_scale(turn, share)), from.pose.q);
  return SW_OK;
}

sw_status sw_system_place_holds(sw_system *s, double t, double *x, double *v, double *a,
                                sw_error *err) {
  for (size_t k = 0; k < s->hold_count; k++) SW_TRY(place_hold(s, k, t, err));
  if (s->inner > 0) SW_TRY(sw_inner_check(s, t, err));
  for (size_t k = 0; k < s->hold_count; k++) {
    s->fastest_turn = fmax(s->fastest_turn, sw_norm(s->hold_states[k].omega));
    sw_store(s->turns + 3 * k, s->still ? sw_v(0, 0, 0) : s->hold_states[k].omega);
    s->flows[k] = s->still ? 0 : s->hold_states[k].flow;
    for (size_t side = 0; side < 2; side++) {
      const size_t at = 3 * (2 * k + side);
      const sw_vec d = sw_rotate(s->hold_states[k].pose.q, sw_load(s->directors + at));
      sw_store(s->directors_now + at, d);
      sw_store(s->normals_now + at, sw_rotate(s->hold_states[k].pose.q, sw_load(s->normals + at)));
    }
  }
  SW_ITEMS(const sw_held_node, h, s->held, s->held_count) {
    place_node(&s->hold_states[h->hold], h->local, x ? x + 3 * h->node : NULL,
               v ? v + 3 * h->node : NULL, a ? a + 3 * h->node : NULL);
  }
  if (x) sw_rails_place(s, x, v, a, x);
  return SW_OK;
}

void sw_system_held_velocity(const sw_system *s, const sw_held_node *held, double *v) {
  place_node(&s->hold_states[held->hold], held->local, NULL, v, NULL);
}

/* 1 if the hold's wire waits: its load is that of an earlier step. */
static int bears_still(const sw_system *s, int hold) {
  return s->waiting && s->standing[hold].stands && s->bodies[s->standing[hold].body].waits;
}

static void move_moment(sw_hold_load *load, sw_vec from, sw_vec to) {
  load->moment = sw_add(load->moment, sw_cross(sw_sub(from, to), load->force));
}

/* Adds the moments of clamps on directions: of hold `hold` to *out; for -1 of every hold to
 * out[hold]. */
static void add_clamp_moments(const sw_system *s, int hold, sw_hold_load *out) {
  for (size_t b = 0; b < s->body_count; b++) {
    const sw_body *body = &s->bodies[b];
    for (size_t c = 0; c < body->plan->clamp_count; c++) {
      const int own = body->plan->clamps[c].hold;
      sw_hold_load *to = hold < 0 ? &out[own] : out;
      if (hold >= 0 && own != hold) continue;
      SW_ITEMS(const sw_term, term, body->terms, body->term_count) {
        if (!term->cls->clamp_moment) continue;
        s->bodies[b].field.history = term->history;
        to->moment = sw_add(
            to->moment, term->cls->clamp_moment(term->args, &body->field, &body->plan->clamps[c]));
      }
    }
  }
}

void sw_system_reaction(const sw_system *s, int hold, sw_vec point, sw_vec *force, sw_vec *moment) {
  sw_hold_load sum = {.force = {0, 0, 0}};
  int rail = 0;
  if (bears_still(s, hold)) {
    sum = s->standing[hold].load;
    move_moment(&sum, s->hold_states[hold].pose.p, point);
    *force = sum.force, *moment = sum.moment;
    return;
  }
  SW_ITEMS(const sw_held_node, h, s->held, s->held_count) {
    if (h->hold != hold) continue;
    rail |= h->rail != 0;
    const sw_vec arm = sw_sub(sw_load(s->x + 3 * h->node), point);
    sum.force = sw_add(sum.force, h->reaction);
    sum.moment = sw_add(sum.moment, sw_cross(arm, h->reaction));
  }
  if (s->loads_kept && !rail) {
    sum = s->loads[hold];
    move_moment(&sum, s->hold_states[hold].pose.p, point);
    *force = sum.force, *moment = sum.moment;
    return;
  }
  add_clamp_moments(s, hold, &sum);
  *force = sum.force;
  *moment = sum.moment;
}

void sw_system_hold_loads(const sw_system *s, sw_hold_load *out) {
  for (size_t k = 0; k < s->hold_count; k++) out[k] = (sw_hold_load){.force = {0, 0, 0}};
  SW_ITEMS(const sw_held_node, h, s->held, s->held_count) {
    sw_hold_load *to = &out[h->hold];
    const sw_vec arm = sw_rotate(s->hold_states[h->hold].pose.q, h->local);
    to->force = sw_add(to->force, h->reaction);
    to->moment = sw_add(to->moment, sw_cross(arm, h->reaction));
  }
  add_clamp_moments(s, -1, out);
  for (size_t k = 0; k < s->hold_count; k++)
    if (bears_still(s, (int)k)) out[k] = s->standing[k].load;
}

void sw_system_keep_loads(sw_system *s) {
  sw_system_hold_loads(s, s->loads);
  s->loads_kept = 1;
}
