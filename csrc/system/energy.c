/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Energies of the state or of a trial, and powers of forces without a potential. */
#include "system/energy.h"

#include <string.h>

#include "base/each.h"
#include "base/interrupt.h"
#include "system/spin.h"
#include "system/strain.h"

/* Start of the part of the state that sw_system_follow updates: twist, turn and frames. */
static double *followed(const sw_system *s) { return s->tension + s->edges; }

void sw_system_look_at(sw_system *s, sw_glance *g, const double *x, const double *v,
                       const double *rates) {
  *g = (sw_glance){s->x, s->v, s->strain_rate};
  memcpy(s->aside, followed(s), s->follow_size * sizeof *s->aside);
  if (s->follow_size) sw_system_follow(s, x);
  /* only read from here on */
  s->x = (double *)(uintptr_t)x;
  s->v = (double *)(uintptr_t)v;
  s->strain_rate = (double *)(uintptr_t)rates;
}

void sw_system_look_back(sw_system *s, const sw_glance *g) {
  s->x = g->x;
  s->v = g->v;
  s->strain_rate = g->rates;
  memcpy(followed(s), s->aside, s->follow_size * sizeof *s->aside);
}

/* 1 for forces without an energy; their power is computed instead. */
static int has_power(const sw_force_class *cls) {
  return (cls->flags & (SW_FORCE_DISSIPATIVE | SW_FORCE_EXPLICIT | SW_FORCE_DRIVEN)) != 0;
}

/* --- energies ---------------------------------------------------------------- */

static void aim(sw_system *s, sw_body *b, int lumped) {
  sw_field *f = &b->field;
  sw_body_aim(s, b, s->x + 3 * b->first_node, s->v + 3 * b->first_node);
  f->strain_rate = b->axial_time > 0 && s->strain_rate ? s->strain_rate + b->first_edge : NULL;
  sw_strain_show_rates(s, b);
  f->tension = lumped ? NULL : s->tension + b->first_edge;
  f->twist = b->has_twist ? s->twist + b->first_span : NULL;
  sw_field_geometry(f);
  f->is_judged = 1;
  if (b->spin_block) sw_spin_show(s, b);
}

static double *place_of(const sw_force_class *cls, sw_energies *out) {
  if (cls->flags & SW_FORCE_LOAD) return &out->loads;
  return strcmp(cls->name, "gravity") == 0 ? &out->gravity : &out->stored;
}

/* Replaces the term's history by the history after the commit. */
static void commit_aside(const sw_system *s, sw_body *b, sw_term *term, sw_committed *end) {
  sw_field *f = &b->field;
  double *room = s->trial_history;
  memcpy(room, term->history, term->cls->state_size(b->plan) * sizeof *room);
  f->time = end->time;
  f->first = s->first;
  if (f->first.x) f->first.x += 3 * b->first_node;
  term->cls->commit(term->args, f, room);
  f->first.x = NULL;
  end->lost += room[0] - term->history[0];
  term->history = room;
}

static void weigh(sw_system *s, sw_body *b, int lumped, sw_committed *end, sw_energies *out) {
  sw_error ignored;
  aim(s, b, lumped);
  b->field.want = SW_WANT_ENERGY;
  for (size_t i = 0; i < b->term_count; i++) {
    const sw_force_class *cls = b->terms[i].cls;
    if (has_power(cls)) continue;
    sw_term term = b->terms[i];
    if (end && cls->commit) commit_aside(s, b, &term, end);
    b->field.energy = b->field.bending = 0;
    if (sw_term_eval(&term, &b->field, &ignored) == SW_OK) *place_of(cls, out) += b->field.energy;
  }
}

/* A waiting body is weighed in the first trial only. */
void sw_system_energies(sw_system *s, int lumped, sw_committed *end, sw_energies *out) {
  *out = (sw_energies){.kinetic = sw_system_kinetic(s, lumped)};
  if (end) end->lost = 0;
  SW_ITEMS(sw_body, b, s->bodies, s->body_count) {
    sw_energies own = {.gravity = b->gravity, .stored = b->stored, .loads = b->loads};
    if (!end || !b->weighed) {
      own = (sw_energies){0};
      weigh(s, b, lumped, end, &own);
      b->gravity = own.gravity, b->stored = own.stored, b->loads = own.loads;
      b->weighed = end && b->waits;
    }
    out->gravity += own.gravity, out->stored += own.stored, out->loads += own.loads;
  }
}

double sw_system_rubbed(const sw_system *s) {
  double sum = 0;
  for (size_t b = 0; b < s->body_count; b++)
    SW_ITEMS(const sw_term, term, s->bodies[b].terms, s->bodies[b].term_count) {
      if (term->history && term->cls->loses && strcmp(term->cls->loses, "friction") == 0)
        sum += term->history[0];
    }
  return sum;
}

/* --- powers ------------------------------------------------------------------ */

int sw_system_has_powers(const sw_system *s) {
  for (size_t b = 0; b < s->body_count; b++)
    for (size_t k = 0; k < s->bodies[b].term_count; k++)
      if (has_power(s->bodies[b].terms[k].cls)) return 1;
  return 0;
}

/* Force times velocity over all nodes. */
static double power_of(const sw_field *f) {
  const size_t n = f->plan->nodes;
  double sum = 0;
  for (size_t i = 0; i < n; i++)
    for (size_t k = 0; k < 3; k++) sum += f->v[3 * i + k] * sw_field_force(f, i, k);
  return sum;
}

/* Forces with SW_FORCE_POWER compute their power more exactly than force times velocity
 * (field.h). */
static sw_status power_of_term(const sw_term *term, sw_field *f, double *power, sw_error *err) {
  const int knows = (term->cls->flags & SW_FORCE_POWER) != 0;
  f->want = knows ? SW_WANT_POWER : SW_WANT_FORCE;
  f->power = 0;
  sw_field_clear(f);
  if (sw_interrupted()) return SW_EINTR;
  SW_TRY(sw_term_eval(term, f, err));
  *power = knows ? -f->power : power_of(f);
  return SW_OK;
}

sw_status sw_system_powers(sw_system *s, double time, sw_powers *out, sw_error *err) {
  *out = (sw_powers){0};
  memcpy(s->velocity, s->v, 3 * s->nodes * sizeof *s->velocity);
  sw_strain_show_held_rates(s, s->velocity);
  SW_ITEMS(sw_body, b, s->bodies, s->body_count) {
    if (b->waits) continue; /* forces without potential do no work on it */
    b->field.v = s->velocity + 3 * b->first_node;
    SW_ITEMS(const sw_term, term, b->terms, b->term_count) {
      double power;
      if (!has_power(term->cls)) continue;
      b->field.time = time;
      b->field.velocity_rate = 0;
      b->field.statics = 0;
      SW_TRY(power_of_term(term, &b->field, &power, err));
      if (term->cls->flags & SW_FORCE_DISSIPATIVE)
        out->damping -= power;
      else
        out->given += power;
    }
    b->field.v = s->v + 3 * b->first_node;
  }
  return SW_OK;
}
