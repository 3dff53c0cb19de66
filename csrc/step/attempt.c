/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One attempt of the search for an equilibrium: a solve from the present state, and its result made
 * the state. */
#include <math.h>
#include <string.h>

#include "body/touching.h"
#include "grip/held.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "state/mesh.h"
#include "step/let_go.h"
#include "step/passing.h"
#include "step/statics.h"
#include "system/axial.h"

enum { MOST_REDOS = 20 };
static const double FIRST_PSEUDO_STEP = 0.02; /* of sqrt(length/g) [-] */

/* Longest step of continuation in which a wire may leave the pads that hold it, over the first one.
 * In longer steps and in statics it may jump to a place beside them [-]. */
static const double HASTY = 0.1;

enum { NUMBERS = 6 }; /* of a tool's slip and turn [-] */

size_t sw_rest_room(const sw_scene *s) {
  return sw_scene_system(s)->state_size + NUMBERS * sw_scene_tool_slots(s);
}

void sw_rest_put_aside(const sw_scene *s, double *kept) {
  const sw_system *system = sw_scene_system(s);
  memcpy(kept, system->state, system->state_size * sizeof(double));
  double *at = kept + system->state_size;
  SW_EACH(tool, t, s) sw_store(at, t->way), sw_store(at + 3, t->swing), at += NUMBERS;
}

void sw_rest_take_back(sw_scene *s, const double *kept) {
  const sw_system *system = sw_scene_system(s);
  memcpy(system->state, kept, system->state_size * sizeof(double));
  const double *at = kept + system->state_size;
  SW_EACH(tool, t, s) t->way = sw_load(at), t->swing = sw_load(at + 3), at += NUMBERS;
}

double sw_rest_longest(const sw_scene *s) {
  double length = 0;
  SW_EACH(wire, wire, s) {
    const sw_mesh *m = &wire->mesh;
    length = fmax(length, m->s[m->n - 1] - m->s[0]);
  }
  return length;
}

double sw_rest_time_scale(const sw_scene *s) {
  return sqrt(sw_rest_longest(s) / fmax(sw_norm(sw_scene_gravity(s)), 1.0));
}

double sw_rest_first_step(const sw_scene *s) { return FIRST_PSEUDO_STEP * sw_rest_time_scale(s); }

/* 1 if a loose mesh moved further than its own size: an obstacle that touches it on one side pushes
 * it for the whole pseudo step. */
static int thrown(const sw_statics *p) {
  const sw_system *s = sw_scene_system(p->s);
  SW_ITEMS(const sw_body, body, s->bodies, s->body_count) {
    const double size = body->plan->length + 2.0 * body->plan->beam.radius;
    double least = HUGE_VAL;
    for (size_t i = 0; body->plan->web && i < body->plan->nodes; i++) {
      const size_t n = body->first_node + i;
      const int is_free = body->plan->held[i] == SW_FREE;
      least = fmin(least, is_free ? sw_dist(sw_vec_at(p->y, n), sw_vec_at(s->x, n)) : 0.0);
    }
    if (isfinite(least) && least > size) return 1;
  }
  return 0;
}

/* 1 if a wire may not leave the pads in this attempt. held: they held all wires before it. */
static int refuses(const sw_statics *p, double hbar, const sw_newton *newton, int held) {
  if (p->too_far) return 1;
  return p->args->holds && held && (newton->statics || hbar > HASTY * sw_rest_first_step(p->s));
}

sw_status sw_rest_solve(sw_statics *p, double hbar, const sw_newton *newton, sw_error *err) {
  sw_scene *s = p->s;
  sw_system *system = sw_scene_system(s);
  sw_stage_report r = {0};
  const int held = !sw_jaws_let_go(s);
  const sw_stage stage = {.time = sw_scene_time(s),
                          .hbar = hbar,
                          .xhat = p->from,
                          .vhat = p->zero,
                          .y = p->y,
                          .v = p->v};
  memcpy(p->from, system->x, system->freedoms * sizeof(double));
  memcpy(p->tension, system->tension, system->edges * sizeof(double));
  sw_system_begin_step(system);
  system->poses = p->args->poses, system->tight = p->args->tight;
  sw_status status = SW_OK;
  const double h = isfinite(hbar) ? hbar : 0.0;
  status = sw_scene_begin_contact(s, SW_CONTACT_STATIC, p->touched, h, sw_rest_first_step(s), err);
  sw_contact *contact = sw_scene_contact(s);
  if (status == SW_OK && contact)
    status = sw_contact_carry(contact, system, stage.time, p->from, err);
  for (int redo = 0; status == SW_OK; redo++) {
    status = sw_system_stage(system, &stage, newton, &r, err);
    p->report->iterations += (size_t)r.iterations;
    if (status != SW_OK || !sw_scene_review_static(s, p->y)) break;
    if (newton->statics || redo == MOST_REDOS)
      status = sw_fail(err, SW_ENOCONV, "the wire would pass through an obstacle");
  }
  if (status == SW_OK && !newton->statics && hbar > sw_rest_first_step(s) &&
      sw_scene_has_contact(s) && thrown(p))
    status = sw_fail(err, SW_ENOCONV, "a loose mesh would be thrown far");
  if (status == SW_OK && !p->args->stays && sw_passing_too_far(s, p->y))
    status = sw_fail(err, SW_ENOCONV, "a wire would spring past a clip");
  if (status == SW_OK && p->args->poses && refuses(p, hbar, newton, held) && sw_jaws_let_go(s))
    status = sw_fail(err, SW_ENOCONV, "a wire would leave the pads that hold it");
  p->report->negative = r.negative;
  if (status != SW_OK) memcpy(system->tension, p->tension, system->edges * sizeof(double));
  return status;
}

double sw_rest_shift(const sw_statics *p) {
  const sw_system *s = sw_scene_system(p->s);
  double shift = 0;
  for (size_t i = 0; i < 3 * s->nodes; i++) shift = fmax(shift, fabs(p->y[i] - s->x[i]));
  return shift;
}

double sw_rest_shift_from(const sw_statics *p, const double *before) {
  const sw_system *s = sw_scene_system(p->s);
  double largest = 0;
  for (size_t i = 0; i < s->nodes; i++)
    largest = fmax(largest, sw_dist(sw_vec_at(s->x, i), sw_vec_at(before, i)));
  return largest;
}

int sw_rest_falls(const sw_statics *p) {
  return p->fall > 0 && sw_rest_shift_from(p, p->begun) > p->fall;
}

sw_status sw_rest_fail_fall(const sw_statics *p, sw_error *err) {
  const sw_system *s = sw_scene_system(p->s);
  double largest = -1;
  size_t furthest = 0;
  for (size_t i = 0; i < s->nodes; i++) {
    const double shift = sw_dist(sw_vec_at(s->x, i), sw_vec_at(p->begun, i));
    if (shift > largest) largest = shift, furthest = i;
  }
  const sw_scene_wire *wire = sw_scene_wire_in(p->s, sw_system_body_of(s, furthest));
  p->report->falls = 1;
  return sw_fail(err, SW_ENOCONV, "%s'%s', which nothing holds, is carried away",
                 sw_scene_is_loose(wire) ? "" : "wire ", wire->name);
}

double sw_rest_take(sw_statics *p, int trial) {
  sw_scene *s = p->s;
  sw_system *system = sw_scene_system(s);
  const double shift = sw_rest_shift(p);
  sw_system_follow(system, p->y);
  memcpy(system->x, p->y, system->freedoms * sizeof(double));
  memset(system->v, 0, system->freedoms * sizeof(double));
  memset(system->a, 0, system->freedoms * sizeof(double));
  sw_system_strain_from_state(system);
  if (trial) return shift;
  p->leads = 0;
  sw_scene_commit_contact(s, p->holds);
  sw_error why; /* the sum of slips is then too small, as where memory is lost */
  SW_EACH(tool, t, s)
    if (p->args->poses && t->alive && t->pads && !p->holds) (void)sw_held_search(s, t, &why);
  p->touched = sw_scene_time(s);
  return shift;
}

int sw_rest_is_late(const sw_statics *p, double share) {
  return (double)(p->report->iterations - p->before) >= share * (double)p->args->max_iterations;
}

double sw_rest_dragged(const sw_statics *p) {
  const sw_contact *contact = sw_scene_contact(p->s);
  if (!contact || p->touched == sw_scene_time(p->s)) return 0;
  return sw_contact_shift(contact, sw_rest_longest(p->s));
}

int sw_rest_stops(sw_status status) {
  return status == SW_ECALLBACK || status == SW_ENOMEM || status == SW_EINTR || status == SW_ELIMIT;
}
