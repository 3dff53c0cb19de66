/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes and frees a system, its histories, read-outs of the state, and the stable step of
 * leapfrog. */
#include "system/system.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "base/simd.h"
#include "base/spread.h"
#include "system/arrays.h"
#include "system/axial.h"
#include "system/borne.h"
#include "system/bridge.h"
#include "system/factors.h"
#include "system/join.h"
#include "system/roll.h"
#include "system/spin.h"
#include "system/strain.h"
#include "system/twist.h"
#include "system/web.h"

void sw_system_free(sw_system *system) {
  for (size_t b = 0; system->bodies && b < system->body_count; b++) {
    sw_plan_release(system->bodies[b].plan);
    SW_FREE_ALL(system->bodies[b].field_block, system->bodies[b].terms,
                system->bodies[b].twist_block, system->bodies[b].spin_block,
                system->bodies[b].roll_block);
    sw_web_discard(&system->bodies[b]);
  }
  sw_bridges_free(system);
  sw_joins_free(system);
  SW_FREE_ALL(system->bodies, system->held, system->rails, system->rail_room, system->directors,
              system->hold_states, system->loads, system->standing, system->state,
              system->pull_block, system->borne, system->work, system->trial_history,
              system->parted);
  memset(system, 0, sizeof *system);
}

static sw_status new_bodies(sw_system *s, sw_plan *const *plans, size_t count) {
  s->bodies = sw_alloc(count + 1, sizeof *s->bodies);
  if (!s->bodies) return SW_ENOMEM;
  for (size_t b = 0; b < count; b++) {
    sw_body *body = &s->bodies[b];
    SW_TRY(sw_field_new(&body->field, plans[b]->nodes, &body->field_block));
    body->plan = sw_plan_retain(plans[b]);
    s->body_count = b + 1;
    body->field.plan = plans[b];
    body->first_node = s->nodes;
    body->first_edge = s->edges;
    body->first_span = s->span_count;
    s->span_count += plans[b]->span_count;
    SW_TRY(sw_spin_new(body));
    if (plans[b]->web) SW_TRY(sw_web_prepare(body));
    body->first_roll = s->rolls;
    if (body->roll_block) s->rolls += plans[b]->edges;
    s->nodes += plans[b]->nodes;
    s->edges += sw_plan_axial(plans[b]);
    body->first_slice = s->slices;
    if (plans[b]->web && plans[b]->web->rings > 1) s->slices += plans[b]->web->rings - 1;
  }
  s->freedoms = 3 * s->nodes + s->rolls + s->rail_count;
  return SW_OK;
}

static sw_status new_arrays(sw_system *s, size_t hold_count) {
  size_t held = 0;
  for (size_t b = 0; b < s->body_count; b++)
    for (size_t i = 0; i < s->bodies[b].plan->nodes; i++)
      held += s->bodies[b].plan->held[i] != SW_FREE;
  /* directors of joins follow those of holds */
  size_t ends = hold_count;
  for (size_t b = 0; b < s->body_count; b++) {
    const sw_plan *p = s->bodies[b].plan;
    for (size_t k = p->clamp_count; k < p->clamp_count + p->stops; k++)
      if ((size_t)p->clamps[k].hold >= ends) ends = (size_t)p->clamps[k].hold + 1;
  }
  s->hold_count = hold_count;
  s->state_size = 3 * s->freedoms + s->edges + s->span_count + 4 * hold_count;
  const size_t frames = s->state_size;
  for (size_t b = 0; b < s->body_count; b++) {
    s->bodies[b].first_frame = s->state_size - frames;
    s->state_size += sw_spin_state_size(s->bodies[b].plan);
  }
  if (s->span_count || s->state_size > frames)
    s->follow_size = s->state_size - 3 * s->freedoms - s->edges;
  const size_t kept = sw_factors_room(s);
  SW_TRY(SW_ALLOC_ALL(
      SW_ROOM(s->held, held), SW_ROOM(s->directors, 28 * ends), SW_ROOM(s->hold_states, hold_count),
      SW_ROOM(s->loads, hold_count), SW_ROOM(s->standing, hold_count),
      SW_ROOM(s->state, s->state_size),
      {&s->work, 3 * s->freedoms + kept + 2 * s->edges + s->follow_size, sizeof *s->yhat}));
  s->directors_now = s->directors + 6 * ends;
  s->normals = s->directors + 12 * ends;
  s->normals_now = s->directors + 18 * ends;
  s->turns = s->directors + 24 * ends;
  s->flows = s->directors + 27 * ends;
  sw_system_lay_out(s);
  s->yhat = s->work;
  s->delta = s->yhat + s->freedoms;
  s->velocity = s->delta + s->freedoms;
  s->factor_at = s->velocity + s->freedoms;
  s->tension_new = s->factor_at + kept;
  s->excess = s->tension_new + s->edges;
  s->aside = s->excess + s->edges;
  return SW_OK;
}

sw_status sw_system_new(sw_system *system, sw_plan *const *plans, size_t body_count,
                        size_t hold_count, size_t rail_count) {
  memset(system, 0, sizeof *system);
  system->rail_count = rail_count;
  sw_status status = new_bodies(system, plans, body_count);
  if (status == SW_OK) status = new_arrays(system, hold_count);
  if (status != SW_OK) sw_system_free(system);
  return status;
}

sw_status sw_system_add_term(sw_system *system, size_t body, const sw_force_class *cls,
                             const void *args, size_t args_size, int id) {
  sw_body *b = &system->bodies[body];
  sw_term *more = sw_alloc(b->term_count + 1, sizeof *more);
  if (!more) return SW_ENOMEM;
  if (b->term_count) memcpy(more, b->terms, b->term_count * sizeof *more);
  sw_term *term = &more[b->term_count];
  term->cls = cls;
  term->id = id;
  if (args_size) memcpy(term->args, args, args_size);
  sw_free(b->terms);
  b->terms = more;
  b->term_count++;
  if (cls->flags & SW_FORCE_EXPLICIT) b->is_explicit = 1;
  if (cls->commit) b->is_kinked = 1;
  if (!(cls->flags & SW_FORCE_INNER) || (cls->flags & SW_FORCE_EXPLICIT)) b->needs_velocity = 1;
  if (cls->axial && !b->plan->web) b->bears = 1;
  if (cls->axial_time) b->axial_time += cls->axial_time(term->args);
  if (cls->viscosity && !b->plan->web) b->viscosity += cls->viscosity(term->args, b->plan);
  return SW_OK;
}

/* --- histories -------------------------------------------------------------- */

sw_status sw_system_add_histories(sw_system *s) {
  double *next;
  size_t size = 0, largest = 0;
  SW_TRY(sw_system_add_strains(s));
  SW_TRY(sw_system_add_even(s));
  SW_TRY(sw_system_add_borne(s));
  for (size_t b = 0; b < s->body_count; b++)
    SW_ITEMS(const sw_term, term, s->bodies[b].terms, s->bodies[b].term_count) {
      const size_t own = term->cls->state_size ? term->cls->state_size(s->bodies[b].plan) : 0;
      size += own;
      if (own > largest) largest = own;
    }
  if (!size) return SW_OK;
  s->trial_history = sw_alloc(largest, sizeof *s->trial_history);
  if (!s->trial_history) return SW_ENOMEM;
  SW_TRY(sw_system_grow_state(s, size, &next));
  for (size_t b = 0; b < s->body_count; b++)
    SW_ITEMS(sw_term, term, s->bodies[b].terms, s->bodies[b].term_count) {
      if (!term->cls->state_size) continue;
      term->history = next;
      next += term->cls->state_size(s->bodies[b].plan);
    }
  return SW_OK;
}

void sw_system_commit(sw_system *s, double time) {
  for (size_t b = 0; b < s->body_count; b++) {
    sw_field *f = &s->bodies[b].field;
    f->time = time;
    f->first = s->first;
    if (f->first.x) f->first.x += 3 * s->bodies[b].first_node;
    SW_ITEMS(const sw_term, term, s->bodies[b].terms, s->bodies[b].term_count) {
      if (term->cls->commit) term->cls->commit(term->args, f, term->history);
    }
    f->first.x = NULL;
  }
}

double sw_system_dissipated(const sw_system *s, int *any) {
  double sum = 0;
  *any = 0;
  for (size_t b = 0; b < s->body_count; b++)
    for (size_t k = 0; k < s->bodies[b].term_count; k++) {
      const double *history = s->bodies[b].terms[k].history;
      if (!history) continue;
      sum += history[0];
      *any = 1;
    }
  return sum;
}

/* --- read-outs of the state -------------------------------------------------- */

static void aim(sw_system *s, sw_body *b) {
  sw_field *f = &b->field;
  sw_body_aim(s, b, s->x + 3 * b->first_node, s->v + 3 * b->first_node);
  f->strain_rate = b->axial_time > 0 ? s->strain_rate + b->first_edge : NULL;
  sw_strain_show_rates(s, b);
}

/* 1 if its field still has the geometry of the trial that became the state. */
static int is_measured(const sw_system *s, const sw_body *b) {
  if (b->waits && b->field.is_judged) return 1;
  if (!b->field.is_judged || !s->judged) return 0;
  const double *x = s->judged + 3 * b->first_node;
  return memcmp(x, b->field.x, 3 * b->plan->nodes * sizeof *x) == 0;
}

/* A waiting body needs no new measurement until its next solve. */
static void measure(sw_body *b) {
  sw_field_geometry(&b->field);
  b->field.is_judged = b->waits;
}

void sw_system_refresh(sw_system *s) {
  sw_system_add_up_pull(s);
  SW_ITEMS(sw_body, body, s->bodies, s->body_count) {
    aim(s, body);
    if (!is_measured(s, body)) measure(body);
    body->field.twist = body->has_twist ? s->twist + body->first_span : NULL;
    if (body->spin_block) sw_spin_show(s, body);
    sw_system_find_borne(s, body);
  }
  s->judged = NULL;
}

static int is_kinked(const sw_body *b) {
  SW_ITEMS(const sw_term, t, b->terms, b->term_count) {
    if (t->cls->commit && !(t->cls->idle && t->history && t->cls->idle(t->history))) return 1;
  }
  return 0;
}

void sw_system_begin_step(sw_system *s) {
  s->fastest_turn = 0;
  s->loads_kept = 0, s->first.x = NULL;
  s->factor_hbar = 0;
  sw_system_keep_borne(s);
  for (size_t b = 0; b < s->body_count; b++) s->bodies[b].is_kinked = is_kinked(&s->bodies[b]);
  for (size_t b = 0; b < s->body_count; b++) s->bodies[b].web_factored = s->bodies[b].web_slow = 0;
  for (size_t b = 0; b < s->body_count; b++)
    if (s->bodies[b].spin_block) sw_spin_begin(s, &s->bodies[b]);
}

void sw_system_measure_frames(sw_system *s, size_t body) {
  sw_body *b = &s->bodies[body];
  sw_spin_begin(s, b);
  sw_spin_take(s, b, s->x + 3 * b->first_node);
}

void sw_system_measure(sw_system *s, sw_body *b) {
  if (b->has_twist) sw_twist_measure(s, b);
  if (b->spin_block) sw_spin_carry(s, b);
}

void sw_system_axial_from_state(sw_system *s) {
  SW_ITEMS(const sw_body, body, s->bodies, s->body_count) {
    const double *x = s->x + 3 * body->first_node;
    double *T = s->tension + body->first_edge;
    if (body->plan->web) sw_web_axial(body, x, T);
    for (size_t e = 0; e < body->plan->edges; e++) {
      const double l = sw_dist(sw_vec_at(x, e), sw_vec_at(x, e + 1));
      const double strain = l / body->plan->rest[e] - 1.0;
      T[e] = (strain >= 0 ? body->EA : body->EA_push) * strain;
    }
  }
  sw_system_strain_from_state(s);
  for (size_t b = 0; b < s->body_count; b++) sw_system_rate_from_velocity(s, b);
  sw_system_held_from_velocity(s);
}

/* Returns the sum of m v.v / 2 and of the coupling terms between neighbours. */
SW_HOT
static double kinetic_of_nodes(size_t n, const double *own, const double *next, const double *v) {
  sw_spread sums = {{{0}}};
  double sum = 0;
  size_t i = 0;
  for (; i + 4 < n; i += 4) {
    const sw_spread o = sw_spread_of(own + i), m = sw_spread_of(next + i);
    const sw_spread a = sw_spread_load(v + 3 * i), b = sw_spread_load(v + 3 * i + 3);
    for (int k = 0; k < 3; k++)
      sums.part[k] += a.part[k] * (0.5 * o.part[k] * a.part[k] + m.part[k] * b.part[k]);
  }
  for (; i < n; i++) {
    const sw_vec vi = sw_load(v + 3 * i);
    sum += 0.5 * own[i] * sw_norm2(vi);
    if (i + 1 < n) sum += next[i] * sw_dot(vi, sw_load(v + 3 * i + 3));
  }
  const sw_quad all = sums.part[0] + sums.part[1] + sums.part[2];
  return sum + ((all[0] + all[1]) + (all[2] + all[3]));
}

double sw_body_kinetic(const sw_system *s, size_t body, int lumped) {
  const sw_plan *p = s->bodies[body].plan;
  const double *v = s->v + 3 * s->bodies[body].first_node;
  double sum = sw_roll_kinetic(s, &s->bodies[body]);
  if (!lumped) return sum + kinetic_of_nodes(p->nodes, p->mass_own, p->mass_next, v);
  for (size_t i = 0; i < p->nodes; i++) sum += 0.5 * p->lumped[i] * sw_norm2(sw_load(v + 3 * i));
  return sum;
}

double sw_system_kinetic(const sw_system *s, int lumped) {
  double sum = 0;
  for (size_t b = 0; b < s->body_count; b++) sum += sw_body_kinetic(s, b, lumped);
  return sum;
}

void sw_system_show(sw_system *s, size_t body) {
  sw_body *b = &s->bodies[body];
  aim(s, b);
  if (!(b->waits && b->field.is_judged)) measure(b);
  b->field.tension = s->tension + b->first_edge;
  b->field.twist = b->has_twist ? s->twist + b->first_span : NULL;
  if (b->spin_block) sw_spin_show(s, b);
}

void sw_system_begin_borne(sw_system *s) {
  for (size_t b = 0; s->borne && b < s->body_count; b++) {
    if (!s->bodies[b].bears) continue;
    sw_system_show(s, b);
    sw_system_find_borne(s, &s->bodies[b]);
  }
}

double sw_system_term_energy(sw_system *s, size_t body, size_t term, double *bending) {
  sw_field *f = &s->bodies[body].field;
  sw_error err;
  f->want = SW_WANT_ENERGY;
  f->energy = f->bending = 0;
  sw_term_eval(&s->bodies[body].terms[term], f, &err);
  *bending = f->bending;
  return f->energy;
}

/* Retardation times of a body's dashpots: their force per rate over the stiffness beside them
 * [s]. */
typedef struct lags {
  double axial, bending;
} lags;

static lags lags_of(const sw_body *b) {
  lags lag = {0, 0};
  const double EI = b->plan->beam.EI;
  SW_ITEMS(const sw_term, t, b->terms, b->term_count) {
    if (t->cls->axial_time) lag.axial += t->cls->axial_time(t->args);
    if (t->cls->viscosity && EI > 0) lag.bending += t->cls->viscosity(t->args, b->plan) / EI;
  }
  return lag;
}

/* Returns the largest stable step of leapfrog with dashpots, whose force has the velocity of the
 * step before: 2/omega (sqrt(1 + zeta^2) - zeta) with zeta = lag omega/2. undamped: 2/omega [s]. */
static double damped(double undamped, double lag) {
  const double zeta = lag / undamped;
  return undamped / (hypot(1.0, zeta) + zeta);
}

double sw_system_stable_dt(const sw_system *s) {
  double smallest = HUGE_VAL;
  SW_ITEMS(const sw_body, b, s->bodies, s->body_count) {
    const lags lag = lags_of(b);
    SW_ITEMS(const sw_term, t, b->terms, b->term_count) {
      if (!t->cls->stable_dt) continue;
      const double dt = t->cls->stable_dt(t->args, b->plan);
      const int bends = (t->cls->flags & SW_FORCE_BENDING) != 0;
      if (dt < HUGE_VAL) smallest = fmin(smallest, damped(dt, bends ? lag.bending : lag.axial));
    }
  }
  return smallest;
}
