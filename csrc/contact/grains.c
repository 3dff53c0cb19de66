/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Life of the contact of objects of particles, memory between steps, read-outs. */
#include "contact/grains.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "contact/grain.h"

static int is_loose(const sw_body *b) { return b->plan->web && !b->plan->web->per_ring; }

/* Rules of two objects of particles, or of one and a wire that is a line. */
static int take_rules(sw_grains *g, const sw_system *s, const sw_pair_rule *rules) {
  int any = 0;
  for (size_t i = 0; i < g->bodies; i++)
    for (size_t j = 0; j < g->bodies; j++) {
      const sw_body *a = &s->bodies[i], *b = &s->bodies[j];
      const int rings = (a->plan->web && !is_loose(a)) || (b->plan->web && !is_loose(b));
      sw_pair_rule *own = &g->rules[g->bodies * i + j];
      *own = rules[g->bodies * i + j];
      own->on &= !rings && (is_loose(a) || is_loose(b));
      any |= own->on;
    }
  return any;
}

sw_status sw_grains_new(const sw_system *s, const sw_pair_rule *rules, sw_grains **out) {
  const size_t n = s->body_count;
  sw_status status = SW_OK;
  *out = NULL;
  sw_grains *g = sw_alloc(1, sizeof *g);
  if (!g) return SW_ENOMEM;
  g->bodies = n;
  g->rules = sw_alloc(n * n, sizeof *g->rules);
  g->joined = sw_alloc(n, sizeof *g->joined);
  g->base = sw_alloc(n, sizeof *g->base);
  g->largest = sw_alloc(n, sizeof *g->largest);
  if (!g->rules || !g->joined || !g->base || !g->largest) status = SW_ENOMEM;
  const int any = status == SW_OK && take_rules(g, s, rules);
  for (size_t b = 0; any && b < n && status == SW_OK; b++)
    if (g->rules[n * b + b].on) status = sw_joined_new(s->bodies[b].plan->web, &g->joined[b]);
  if (any && status == SW_OK)
    *out = g;
  else
    sw_grains_free(g);
  return status;
}

sw_status sw_grains_copy(const sw_grains *g, const sw_system *s, sw_grains **out) {
  SW_TRY(sw_grains_new(s, g->rules, out));
  if (!*out) return SW_OK; /* no rule is on */
  return sw_grains_set_memory(*out, g->memory, g->memory_count * sizeof *g->memory);
}

void sw_grains_free(sw_grains *g) {
  if (!g) return;
  for (size_t b = 0; g->joined && b < g->bodies; b++) sw_joined_free(&g->joined[b]);
  void *const blocks[] = {g->rules, g->joined, g->base,   g->largest, g->pairs,
                          g->now,   g->last,   g->memory, g->grid};
  for (size_t k = 0; k < sizeof blocks / sizeof blocks[0]; k++) sw_free(blocks[k]);
  sw_free(g);
}

/* --- steps ----------------------------------------------------------------------- */

/* What forces an object may press with: its weight; of a wire, that of bending it, its tension. */
static double force_of(const sw_system *s, const sw_body *b) {
  const sw_plan *p = b->plan;
  double force = p->beam.mass * p->length * sw_norm(sw_load(s->gravity));
  if (p->web) return force;
  force = fmax(force, p->beam.EI / (p->length * p->length));
  for (size_t e = 0; e < p->edges; e++) force = fmax(force, fabs(s->tension[b->first_edge + e]));
  return force;
}

static sw_status fail(sw_status status, sw_error *err) {
  return sw_fail(err, status, "contact of particles: %s",
                 status == SW_ELIMIT ? "too many are near each other" : sw_status_text(status));
}

sw_status sw_grains_begin_step(sw_grains *g, sw_system *s, sw_contact_regime regime, double h,
                               double nominal, sw_error *err) {
  g->regime = regime;
  g->h = h, g->nominal = nominal;
  g->least_reserve = 0;
  g->struck = 0, g->hits = 0;
  for (size_t b = 0; b < s->body_count; b++)
    sw_contact_stiffness(regime, force_of(s, &s->bodies[b]), nominal, &g->base[b], &g->rate2);
  const sw_status status = sw_grains_choose(g, s);
  return status == SW_OK ? SW_OK : fail(status, err);
}

void sw_grains_begin_stage(sw_grains *g, double first) {
  g->stage++;
  g->first = first;
  g->updates = 0;
}

sw_status sw_grains_begin_look(sw_grains *g, sw_system *s, sw_error *err) {
  for (size_t i = 0; i < g->memory_count; i++) {
    sw_press *p = &g->memory[i].press;
    if (p->normal_force > 0 && p->gap_after < 0) p->k = p->normal_force / -p->gap_after;
  }
  return sw_grains_begin_step(g, s, SW_CONTACT_STATIC, 0, 0, err);
}

sw_status sw_grains_eval(sw_grains *g, sw_system *s, const double *y, unsigned want,
                         sw_error *err) {
  if (g->regime == SW_CONTACT_EXPLICIT) sw_grains_begin_stage(g, 0); /* nobody else does */
  sw_status status = sw_grains_look(g, s, y);
  for (size_t i = 0; i < g->pair_count && status == SW_OK; i++) {
    sw_grain_touch *t = &g->now[i];
    double K[6];
    t->press.normal_force = 0;
    t->press.tangential = sw_v(0, 0, 0);
    if (!t->stage || !t->press.active) continue;
    const double friction = sw_grain_rule(g, t->pair.body)->friction;
    const sw_vec f = sw_press_eval(&t->press, friction, g->regime != SW_CONTACT_EXPLICIT, K);
    status = sw_grain_add(s, t, y, f, want & SW_WANT_STIFFNESS ? K : NULL);
  }
  return status == SW_OK ? SW_OK : fail(status, err);
}

/* --- memory ---------------------------------------------------------------------- */

void sw_grains_commit(sw_grains *g) {
  size_t n = 0;
  if (sw_grow((void **)&g->memory, &g->memory_capacity, g->pair_count, sizeof *g->memory) != SW_OK)
    g->looked = 0; /* lost anchors only start anew */
  for (size_t i = 0; g->looked && i < g->pair_count; i++) {
    if (!g->now[i].stage) continue;
    g->memory[n] = g->now[i];
    g->memory[n].press.k =
        sw_press_eased(&g->now[i].press, g->now[i].pair.usual, g->now[i].stiffer);
    n++;
  }
  g->memory_count = n;
}

const void *sw_grains_memory(const sw_grains *g, size_t *bytes) {
  *bytes = g->memory_count * sizeof *g->memory;
  return g->memory;
}

sw_status sw_grains_set_memory(sw_grains *g, const void *memory, size_t bytes) {
  const size_t n = bytes / sizeof *g->memory;
  SW_TRY(sw_grow((void **)&g->memory, &g->memory_capacity, n, sizeof *g->memory));
  if (n) memcpy(g->memory, memory, bytes);
  g->memory_count = n;
  g->pair_count = 0, g->looked = 0;
  return SW_OK;
}

static int is_of(const size_t *first, size_t bodies, uint32_t body, uint32_t node) {
  return body < bodies && node >= first[body] && node < first[body + 1];
}

int sw_grains_memory_fits(const void *memory, size_t bytes, const size_t *first, size_t bodies) {
  const size_t count = bytes / sizeof(sw_grain_touch);
  for (size_t i = 0; i < count; i++) {
    sw_grain_touch m;
    memcpy(&m, (const char *)memory + i * sizeof m, sizeof m);
    const sw_grain_pair *k = &m.pair;
    for (int n = 0; n < 2; n++)
      if (!is_of(first, bodies, k->body[n], k->node[n]) ||
          !is_of(first, bodies, k->body[n], k->end[n]) || !(m.at[n] >= 0 && m.at[n] <= 1))
        return 0;
    if (!(m.press.k > 0) || !isfinite(m.press.normal_force)) return 0;
  }
  return bytes % sizeof(sw_grain_touch) == 0;
}

int sw_grains_memory_names(const void *memory, size_t bytes, size_t node) {
  const sw_grain_touch *m = memory;
  for (size_t i = 0; i < bytes / sizeof *m; i++)
    for (int n = 0; n < 2; n++)
      if (m[i].pair.node[n] == node || m[i].pair.end[n] == node) return 1;
  return 0;
}

size_t sw_grains_layout(void) { return sizeof(sw_grain_touch); }

static int by_order(const void *p, const void *q) {
  return sw_grain_order(&((const sw_grain_touch *)p)->pair, &((const sw_grain_touch *)q)->pair);
}

sw_status sw_grains_inherit(sw_grains *g, const void *memory, size_t bytes, const size_t *new_node,
                            const size_t *new_body) {
  size_t kept = 0;
  SW_TRY(sw_grains_set_memory(g, memory, bytes));
  for (size_t i = 0; i < g->memory_count; i++) {
    sw_grain_touch m = g->memory[i];
    size_t node[2], end[2];
    int stays = 1;
    for (int n = 0; n < 2; n++) {
      node[n] = new_node[m.pair.node[n]], end[n] = new_node[m.pair.end[n]];
      stays &= node[n] != SIZE_MAX && end[n] != SIZE_MAX;
      m.pair.node[n] = (uint32_t)node[n], m.pair.end[n] = (uint32_t)end[n];
    }
    if (!stays) continue;
    for (int n = 0; n < 2; n++) m.pair.body[n] = (uint32_t)new_body[m.pair.body[n]];
    g->memory[kept++] = m;
  }
  g->memory_count = kept;
  if (kept) qsort(g->memory, kept, sizeof *g->memory, by_order);
  return SW_OK;
}

/* --- read-outs: of what is remembered -------------------------------------------------- */

/* Of the trial that is judged, or of the accepted state. */
static const sw_grain_touch *list_of(const sw_grains *g, size_t *count) {
  *count = g->looked ? g->pair_count : g->memory_count;
  return g->looked ? g->now : g->memory;
}

static int presses(const sw_grain_touch *t) { return t->stage && t->press.normal_force > 0; }

size_t sw_grains_count(const sw_grains *g) {
  size_t n = 0, count;
  const sw_grain_touch *t = list_of(g, &count);
  for (size_t i = 0; i < count; i++) n += (size_t)presses(&t[i]);
  return n;
}

sw_pair_place sw_grains_place(const sw_grains *g, size_t number) {
  size_t i = 0, count;
  const sw_grain_touch *t = list_of(g, &count);
  for (size_t left = number + 1; i < count; i++)
    if (presses(&t[i]) && --left == 0) break;
  t += i;
  return (sw_pair_place){.body = {t->pair.body[0], t->pair.body[1]},
                         .node = {t->pair.node[0], t->pair.node[1]},
                         .at = {t->at[0], t->at[1]},
                         .normal = t->press.normal,
                         .normal_force = t->press.normal_force,
                         .friction = t->press.tangential,
                         .slip = t->press.slip,
                         .gap = t->press.gap_after - t->forgiven};
}

double sw_grains_penetration(const sw_grains *g, size_t *node) {
  double deepest = 0;
  size_t count;
  const sw_grain_touch *t = list_of(g, &count);
  for (size_t i = 0; i < count; i++) {
    const double depth = t[i].forgiven - t[i].press.gap_after;
    if (!t[i].stage || t[i].barred || depth <= deepest) continue;
    deepest = depth;
    if (node) *node = t[i].pair.node[0];
  }
  return deepest;
}

double sw_grains_energy(const sw_grains *g) {
  double sum = 0;
  size_t count;
  const sw_grain_touch *t = list_of(g, &count);
  for (size_t i = 0; i < count; i++) {
    const sw_press *p = &t[i].press;
    if (!presses(&t[i])) continue;
    /* the force was that of its stiffness then, which may have been eased since */
    sum += 0.5 * p->normal_force * fmax(0.0, -p->gap_after);
    sum += 0.5 * sw_norm2(p->tangential) / sw_press_grip(p);
  }
  return sum;
}

double sw_grains_rubbed(const sw_grains *g) {
  double sum = 0;
  size_t count;
  const sw_grain_touch *t = list_of(g, &count);
  for (size_t i = 0; i < count; i++)
    if (presses(&t[i])) sum -= sw_dot(t[i].press.tangential, t[i].press.slip);
  return sum;
}

double sw_grains_emerged(const sw_grains *g) {
  double sum = 0;
  size_t count;
  const sw_grain_touch *t = list_of(g, &count);
  for (size_t i = 0; i < count; i++)
    if (presses(&t[i])) sum += t[i].let_out * t[i].press.normal_force;
  return sum;
}

int sw_grains_steady(const sw_grains *g) {
  size_t before = 0;
  for (size_t i = 0; i < g->memory_count; i++) before += (size_t)presses(&g->memory[i]);
  return before == sw_grains_count(g) && !g->hits;
}

size_t sw_grains_impacts(const sw_grains *g) { return g->hits; }
