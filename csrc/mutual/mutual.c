/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Making and freeing contact between bodies; its steps, memory and read-outs. */
#include "mutual/mutual.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "mutual/meet.h"
#include "mutual/resample.h"
#include "touch/same.h"
#include "touch/tally.h"

sw_status sw_mutual_start(sw_mutual *m, const sw_finder *finder, const sw_pair_rule *rules,
                          size_t bodies) {
  m->finder = finder;
  m->bodies = bodies;
  SW_TRY(SW_ALLOC_ALL(SW_ROOM(m->rules, bodies * bodies), SW_ROOM(m->base, 2 * bodies),
                      SW_ROOM(m->drawn, bodies), SW_ROOM(m->rubbing, bodies),
                      SW_ROOM(m->turned, bodies), SW_ROOM(m->still.kept, bodies)));
  m->largest = m->base + bodies;
  memcpy(m->rules, rules, bodies * bodies * sizeof *rules);
  return SW_OK;
}

sw_status sw_mutual_copy(const sw_mutual *m, const sw_system *s, sw_mutual **out) {
  SW_TRY(m->finder->make(s, m->rules, out));
  return *out ? sw_mutual_set_memory(*out, m->memory, m->memory_count * sizeof *m->memory) : SW_OK;
}

void sw_mutual_free(sw_mutual *m) {
  if (!m) return;
  m->finder->free(m);
  sw_spots_free(&m->spots);
  SW_FREE_ALL(m->turns, m->turned, m->grid, m->rules, m->base, m->drawn, m->rubbing, m->touches,
              m->last, m->hits, m->memory, m->next_memory, m->ways.list);
  sw_meets_free(&m->still);
  sw_free(m);
}

int sw_mutual_idle(const sw_mutual *m) { return m->pair_count == 0; }

int sw_mutual_takes_part(const sw_mutual *m, size_t body) {
  for (size_t k = 0; k < m->bodies; k++)
    if (m->rules[m->bodies * body + k].on) return 1;
  return 0;
}

int sw_mutual_keeps_apart(const sw_mutual *m, size_t one, size_t two) {
  return m->rules[m->bodies * one + two].on;
}

/* --- two things ------------------------------------------------------------------ */

static int by_number(uint32_t p, uint32_t q) { return p < q ? -1 : p > q; }

int sw_ends_order(const sw_ends *p, const sw_ends *q) {
  if (p->node[0] != q->node[0]) return by_number(p->node[0], q->node[0]);
  if (p->end[0] != q->end[0]) return by_number(p->end[0], q->end[0]);
  if (p->node[1] != q->node[1]) return by_number(p->node[1], q->node[1]);
  return by_number(p->end[1], q->end[1]);
}

int sw_ends_held(const sw_system *s, const sw_ends *e) {
  for (int k = 0; k < 2; k++) {
    const sw_body *b = &s->bodies[e->body[k]];
    const int *held = b->plan->held;
    if (held[e->node[k] - b->first_node] == SW_FREE || held[e->end[k] - b->first_node] == SW_FREE)
      return 0;
  }
  return 1;
}

double sw_ends_speed(const sw_system *s, const sw_ends *e) {
  const uint32_t one[2] = {e->node[0], e->end[0]}, two[2] = {e->node[1], e->end[1]};
  double most = 0;
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 2; j++)
      most = fmax(most, sw_norm2(sw_sub(sw_vec_at(s->v, one[i]), sw_vec_at(s->v, two[j]))));
  return sqrt(most);
}

/* --- steps ----------------------------------------------------------------------- */

/* Scale of a body's pressing forces: its weight; for a wire also its bending force and its
 * tension. */
static double force_of(const sw_system *s, const sw_body *b) {
  const sw_plan *p = b->plan;
  double force = p->beam.mass * p->length * sw_norm(sw_load(s->gravity));
  if (p->web) return force;
  force = fmax(force, p->beam.EI / (p->length * p->length));
  for (size_t e = 0; e < p->edges; e++) force = fmax(force, fabs(s->tension[b->first_edge + e]));
  return force;
}

static sw_status fail(const sw_mutual *m, sw_status status, sw_error *err) {
  return sw_fail(err, status, "%s: %s", m->finder->name,
                 status == SW_ELIMIT ? m->finder->too_many : sw_status_text(status));
}

sw_status sw_mutual_choose(sw_mutual *m, sw_system *s) {
  m->pair_count = m->touch_count = m->last_count = 0;
  return m->finder->choose(m, s);
}

void sw_mutual_regard(sw_mutual *m, const sw_system *s, sw_contact_regime regime, double h,
                      double nominal) {
  m->regime = regime, m->looks = 0;
  m->h = h, m->nominal = nominal;
  m->least_reserve = 0;
  m->fall = regime == SW_CONTACT_STATIC ? 0.0 : SW_RESERVE * sw_norm(sw_load(s->gravity)) * h * h;
}

sw_status sw_mutual_begin_step(sw_mutual *m, sw_system *s, sw_contact_regime regime, double h,
                               double nominal, sw_error *err) {
  sw_mutual_regard(m, s, regime, h, nominal);
  m->hit_count = m->struck = m->barrier_count = 0;
  if (sw_mutual_set_aside(m, s) != SW_OK) return fail(m, SW_ENOMEM, err);
  for (size_t b = 0; b < s->body_count; b++) {
    if (s->bodies[b].waits || !sw_mutual_takes_part(m, b)) continue;
    sw_contact_stiffness(regime, s->bodies[b].plan, force_of(s, &s->bodies[b]), nominal,
                         &m->base[b], &m->rate2);
    m->drawn[b] = sw_drawn_of(s, b);
  }
  if (regime == SW_CONTACT_STATIC && s->tight) sw_mutual_find_taken(m, s);
  const sw_status status = sw_mutual_choose(m, s);
  return status == SW_OK ? SW_OK : fail(m, status, err);
}

void sw_mutual_begin_stage(sw_mutual *m, double first) {
  m->stage++;
  m->updates = m->solves = m->calm = m->soft = m->more_soft = 0;
  m->first = first;
}

sw_status sw_mutual_begin_look(sw_mutual *m, sw_system *s, sw_error *err) {
  for (size_t i = 0; i < m->memory_count; i++) sw_kept_as_felt(&m->memory[i].kept);
  const sw_status status = sw_mutual_begin_step(m, s, SW_CONTACT_STATIC, 0, 0, err);
  m->looks = 1;
  return status;
}

static void turn_over(sw_mutual *m) {
  SW_SWAP(m->touches, m->last);
  SW_SWAP(m->touch_capacity, m->last_capacity);
  m->last_count = m->touch_count, m->touch_count = 0;
}

static sw_status push(const sw_mutual *m, sw_system *s, sw_meet *t, const double *y,
                      unsigned want) {
  double K[6];
  t->press.normal_force = 0;
  t->press.tangential = sw_v(0, 0, 0);
  if (!t->press.active) return SW_OK;
  const double friction = sw_mutual_rule(m, t->of.body)->friction;
  const sw_vec f = sw_press_eval(&t->press, friction, m->regime != SW_CONTACT_EXPLICIT, K);
  return sw_meet_push(s, t, y, f, want & SW_WANT_STIFFNESS ? K : NULL);
}

sw_status sw_mutual_eval(sw_mutual *m, sw_system *s, const double *y, unsigned want,
                         sw_error *err) {
  turn_over(m);
  memset(m->turned, 0, m->bodies);
  sw_status status = m->finder->find(m, s, y);
  sw_mutual_soften(m);
  for (size_t i = 0; i < m->touch_count && status == SW_OK; i++)
    status = push(m, s, &m->touches[i], y, want);
  return status == SW_OK ? SW_OK : fail(m, status, err);
}

/* --- review ------------------------------------------------------------------------- */

/* Counts the striking places of a step. A step that strikes is repeated once by implicit Euler,
 * which treats all places: the bodies reach each other within it and go on together at any
 * stiffness; the integrator sees no shock, and nothing rebounds. */
static size_t strikes(const sw_mutual *m, const sw_system *s, double h) {
  size_t count = 0;
  for (size_t i = 0; i < m->hit_count && !m->struck; i++) {
    const sw_hit *t = &m->hits[i];
    count += sw_meet_excess(s, t->bow, t->reach, t->normal, h) > SW_SLOWEST_IMPACT;
  }
  return count;
}

static sw_contact_verdict review(sw_mutual *m, sw_system *s, const double *x1, double h, int dull) {
  const int wider = m->finder->widen(m, s, x1, h);
  if (wider) return wider > 0 ? SW_CONTACT_REDO : SW_CONTACT_SMALLER;
  const int crossed = m->finder->cross ? m->finder->cross(m, s, x1) : 0;
  if (crossed < 0) return SW_CONTACT_SMALLER;
  const size_t struck = strikes(m, s, h);
  m->struck += struck;
  if (crossed || (struck && !dull)) return SW_CONTACT_STRIKE;
  if (h < SW_SMALLEST_CARE * m->nominal || m->regime == SW_CONTACT_EXPLICIT)
    return SW_CONTACT_ACCEPT;
  return m->finder->cuts(m, s, x1) ? SW_CONTACT_SMALLER : SW_CONTACT_ACCEPT;
}

sw_contact_verdict sw_mutual_review(sw_mutual *m, sw_system *s, const double *x1, double h,
                                    int dull) {
  const sw_contact_verdict verdict = review(m, s, x1, h, dull);
  m->hit_count = 0;
  return verdict;
}

int sw_mutual_review_static(sw_mutual *m, sw_system *s, const double *x1) {
  if (m->finder->widen(m, s, x1, 0.0)) return 1;
  return m->finder->cross && m->finder->cross(m, s, x1) != 0;
}

/* --- memory ---------------------------------------------------------------------- */

void sw_mutual_commit(sw_mutual *m, sw_system *s, int holds) {
  m->next_count = 0;
  for (size_t i = 0; i < m->touch_count; i++) {
    const sw_meet *t = &m->touches[i];
    if (SW_GROW(m->next_memory, m->next_capacity, m->next_count + 1) != SW_OK)
      break; /* a lost anchor starts anew */
    sw_met *out = &m->next_memory[m->next_count++];
    *out = sw_meet_remember(s, t);
    if (holds) sw_kept_hold_slide(&out->kept, &t->press, t->known);
    if (m->finder->note) m->finder->note(m, s, t, out);
  }
  (void)sw_mutual_carry_over(m);
  m->still.accepted = 1;
  SW_SWAP(m->memory, m->next_memory);
  SW_SWAP(m->memory_capacity, m->next_capacity);
  m->memory_count = m->next_count;
}

const void *sw_mutual_memory(const sw_mutual *m, size_t *bytes) {
  *bytes = m->memory_count * sizeof *m->memory;
  return m->memory;
}

sw_status sw_mutual_set_memory(sw_mutual *m, const void *memory, size_t bytes) {
  const size_t n = bytes / sizeof *m->memory;
  SW_TRY(SW_FILL(m->memory, m->memory_capacity, memory, n));
  m->memory_count = n;
  m->touch_count = 0, m->still.accepted = 0;
  sw_mutual_forget_still(m);
  if (m->finder->forget) m->finder->forget(m);
  return SW_OK;
}

size_t sw_mutual_layout(void) { return 4096 * sizeof(sw_met) + sizeof(sw_meet); }

static int is_of(const size_t *first, size_t bodies, uint32_t body, uint32_t node) {
  return body < bodies && node >= first[body] && node < first[body + 1];
}

static int are_of(const size_t *first, size_t bodies, const sw_ends *e) {
  for (int k = 0; k < 2; k++)
    if (!is_of(first, bodies, e->body[k], e->node[k]) ||
        !is_of(first, bodies, e->body[k], e->end[k]))
      return 0;
  return 1;
}

sw_status sw_mutual_set_seen(sw_mutual *m, const void *seen, size_t bytes, const sw_system *s) {
  const size_t n = bytes / sizeof *m->touches;
  m->touch_count = 0;
  if (bytes % sizeof *m->touches != 0) return SW_EINVAL;
  SW_TRY(SW_FILL(m->touches, m->touch_capacity, seen, n));
  for (size_t i = 0; i < n; i++)
    for (int k = 0; k < 2; k++) {
      const sw_ends *e = &m->touches[i].of;
      if (e->body[k] >= s->body_count) return SW_EINVAL;
      const sw_body *b = &s->bodies[e->body[k]];
      const size_t range[2] = {b->first_node, b->first_node + b->plan->nodes};
      if (!is_of(range, 1, 0, e->node[k]) || !is_of(range, 1, 0, e->end[k])) return SW_EINVAL;
    }
  m->touch_count = n, m->still.accepted = 1;
  return SW_OK;
}

int sw_mutual_memory_fits(const void *memory, size_t bytes, const size_t *first, size_t bodies) {
  const size_t count = bytes / sizeof(sw_met);
  for (size_t i = 0; i < count; i++) {
    sw_met t;
    memcpy(&t, (const char *)memory + i * sizeof t, sizeof t);
    if (!are_of(first, bodies, &t.of) || !isfinite(t.at[0] + t.at[1] + t.kept.normal_force))
      return 0;
  }
  return bytes % sizeof(sw_met) == 0;
}

int sw_mutual_memory_names(const void *memory, size_t bytes, size_t node) {
  const sw_met *t = memory;
  for (size_t i = 0; i < bytes / sizeof *t; i++)
    for (int k = 0; k < 2; k++)
      if (t[i].of.node[k] == node || t[i].of.end[k] == node) return 1;
  return 0;
}

static int in_order(const void *p, const void *q) {
  const sw_met *one = p, *two = q;
  const int order = sw_ends_order(&one->of, &two->of);
  if (order || one->at[0] == two->at[0]) return order;
  return one->at[0] < two->at[0] ? -1 : 1;
}

/* Replaces the old numbers of two things by new ones; 0: one of them is gone. */
static int renumber(sw_ends *e, const size_t *new_node, const size_t *new_body) {
  for (int k = 0; k < 2; k++) {
    const size_t node = new_node[e->node[k]], end = new_node[e->end[k]];
    if (node == SIZE_MAX || end == SIZE_MAX) return 0;
    e->node[k] = (uint32_t)node, e->end[k] = (uint32_t)end;
    e->body[k] = (uint32_t)new_body[e->body[k]];
  }
  return 1;
}

/* Adds a touch made from memory, for read-outs until a step finds touches. */
static sw_status show(sw_mutual *m, const sw_met *met) {
  sw_meet *t = sw_meet_new(m);
  if (!t) return SW_ENOMEM;
  t->of = met->of, t->kind = met->kind;
  t->at[0] = met->at[0], t->at[1] = met->at[1];
  t->press = sw_press_felt(&met->kept);
  t->press.normal = met->normal;
  m->touch_count++;
  return SW_OK;
}

sw_status sw_mutual_inherit(sw_mutual *m, const sw_system *s, const void *memory, size_t bytes,
                            const size_t *new_node, const size_t *new_body,
                            const sw_pairs_former *former) {
  size_t kept = 0;
  SW_TRY(sw_mutual_set_memory(m, memory, bytes));
  for (size_t i = 0; i < m->memory_count; i++) {
    sw_met t = m->memory[i];
    if (renumber(&t.of, new_node, new_body)) m->memory[kept++] = t;
  }
  m->memory_count = kept;
  if (former) SW_TRY(sw_pairs_resample(m, s, memory, bytes, former));
  if (m->memory_count) qsort(m->memory, m->memory_count, sizeof *m->memory, in_order);
  for (size_t i = 0; i < m->memory_count; i++) SW_TRY(show(m, &m->memory[i]));
  return SW_OK;
}

/* --- read-outs ------------------------------------------------------------------- */

sw_presses sw_mutual_presses(const sw_mutual *m) {
  return SW_PRESSES(sw_meet, m->touches, m->touch_count);
}

sw_presses sw_mutual_still_presses(const sw_mutual *m) {
  sw_presses list = SW_PRESSES(sw_meet, m->still.list, m->still.count);
  list.known = &m->still.sums;
  return list;
}

/* Touch number k: those of bodies that are solved, then those of bodies that wait. */
static const sw_meet *meet_at(const sw_mutual *m, size_t k) {
  return k < m->touch_count ? &m->touches[k] : &m->still.list[k - m->touch_count];
}

static size_t all_of(const sw_mutual *m) { return m->touch_count + m->still.count; }

static sw_pair_place place_of(const sw_meet *t) {
  return (sw_pair_place){.body = {t->of.body[0], t->of.body[1]},
                         .node = {t->of.node[0], t->of.node[1]},
                         .end = {t->of.end[0], t->of.end[1]},
                         .at = {t->at[0], t->at[1]},
                         .normal = t->press.normal,
                         .normal_force = t->press.normal_force,
                         .friction = t->press.tangential,
                         .slip = t->press.slip,
                         .gap = t->press.gap_after - t->forgiven};
}

int sw_mutual_next_place(const sw_mutual *m, size_t body, size_t *next, sw_pair_place *out) {
  while (*next < all_of(m)) {
    const sw_meet *t = meet_at(m, (*next)++);
    const int is_of = body == SIZE_MAX || t->of.body[0] == body || t->of.body[1] == body;
    if (!is_of || !(t->press.normal_force > 0)) continue;
    *out = place_of(t);
    return 1;
  }
  return 0;
}

int sw_mutual_steady(const sw_mutual *m) {
  size_t before = 0;
  for (size_t i = 0; i < m->memory_count; i++) before += m->memory[i].kept.normal_force > 0;
  const size_t still = sw_presses_count(sw_mutual_still_presses(m));
  return before == sw_presses_count(sw_mutual_presses(m)) + still && !m->struck;
}

size_t sw_mutual_impacts(const sw_mutual *m) { return m->struck; }
