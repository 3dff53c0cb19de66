/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Life of the contact between wires, memory between steps, read-outs. */
#include "contact/pairs.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "contact/lean.h"
#include "contact/pair.h"

sw_status sw_pairs_new(const sw_pair_rule *rules, size_t count, sw_pairs **out) {
  sw_pairs *p = sw_alloc(1, sizeof *p);
  if (!p) return SW_ENOMEM;
  p->rules = sw_alloc(count * count, sizeof *p->rules);
  p->base_stiffness = sw_alloc(count, sizeof *p->base_stiffness);
  p->edge = sw_alloc(count, sizeof *p->edge);
  p->largest = sw_alloc(count, sizeof *p->largest);
  p->rubbing = sw_alloc(count, sizeof *p->rubbing);
  if (!p->rules || !p->base_stiffness || !p->edge || !p->largest || !p->rubbing) {
    sw_pairs_free(p);
    return SW_ENOMEM;
  }
  memcpy(p->rules, rules, count * count * sizeof *rules);
  p->bodies = count;
  *out = p;
  return SW_OK;
}

sw_status sw_pairs_copy(const sw_pairs *p, sw_pairs **out) {
  SW_TRY(sw_pairs_new(p->rules, p->bodies, out));
  return sw_pairs_set_memory(*out, p->memory, p->memory_count * sizeof *p->memory);
}

void sw_pairs_free(sw_pairs *p) {
  if (!p) return;
  sw_free(p->rules);
  sw_free(p->base_stiffness);
  sw_free(p->edge);
  sw_free(p->largest);
  sw_free(p->rubbing);
  sw_free(p->near);
  sw_free(p->listed_at);
  sw_free(p->grid);
  sw_free(p->pairs);
  sw_free(p->touches);
  sw_free(p->last);
  sw_free(p->pressed);
  sw_free(p->memory);
  sw_free(p->next_memory);
  sw_free(p->barriers);
  sw_spots_free(&p->spots);
  sw_free(p);
}

int sw_pairs_idle(const sw_pairs *p) { return p->pair_count == 0; }

/* --- steps ----------------------------------------------------------------------- */

static int takes_part(const sw_pairs *p, size_t body) {
  for (size_t k = 0; k < p->bodies; k++)
    if (p->rules[p->bodies * body + k].on) return 1;
  return 0;
}

/* What forces the wire may press with: its weight, that of bending it, its tension. */
static double force_of(const sw_system *s, const sw_body *b) {
  const sw_plan *p = b->plan;
  const double weight = p->beam.mass * p->length * sw_norm(sw_load(s->gravity));
  double force = fmax(weight, p->beam.EI / (p->length * p->length));
  for (size_t e = 0; e < p->edges; e++) force = fmax(force, fabs(s->tension[b->first_edge + e]));
  return force;
}

static double longest_edge(const sw_plan *p) {
  double longest = 0;
  for (size_t e = 0; e < p->edges; e++) longest = fmax(longest, p->rest[e]);
  return longest;
}

sw_status sw_pairs_fail(sw_status status, sw_error *err) {
  if (status != SW_ELIMIT)
    return sw_fail(err, status, "contact of wires: %s", sw_status_text(status));
  return sw_fail(err, status,
                 "contact of wires: too many pairs of segments are near each other; segments much "
                 "shorter than the wire is thick are too many, take fewer");
}

sw_status sw_pairs_begin_step(sw_pairs *p, sw_system *s, sw_contact_regime regime, double h,
                              double nominal, sw_error *err) {
  p->regime = regime;
  p->h = h, p->nominal = nominal;
  p->barrier_count = p->impact_count = p->pressed_count = 0;
  p->least_reserve = 0;
  for (size_t b = 0; b < s->body_count; b++) {
    if (!takes_part(p, b)) continue;
    sw_contact_stiffness(regime, force_of(s, &s->bodies[b]), nominal, &p->base_stiffness[b],
                         &p->rate2);
    p->edge[b] = longest_edge(s->bodies[b].plan);
  }
  const sw_status status = sw_pairs_choose(p, s);
  return status == SW_OK ? SW_OK : sw_pairs_fail(status, err);
}

void sw_pairs_begin_stage(sw_pairs *p, double first) {
  p->stage++;
  p->updates = 0;
  p->first = first;
}

sw_status sw_pairs_begin_look(sw_pairs *p, sw_system *s, sw_error *err) {
  SW_TRY(sw_pairs_begin_step(p, s, SW_CONTACT_STATIC, 0, 0, err));
  for (size_t i = 0; i < p->memory_count; i++) {
    sw_pair_memory *m = &p->memory[i];
    if (m->normal_force > 0 && m->depth > 0) m->k = m->normal_force / m->depth;
  }
  const sw_status status = sw_pairs_choose(p, s);
  return status == SW_OK ? SW_OK : sw_pairs_fail(status, err);
}

/* --- memory ---------------------------------------------------------------------- */

/* By the slower of both wires. */
static double steady_force(const sw_system *s, const sw_pair *k, const sw_pair_touch *t, double h) {
  const sw_body *one = &s->bodies[k->body[0]], *two = &s->bodies[k->body[1]];
  const double N = t->press.normal_force;
  if (!k->smooth) return N;
  return fmin(sw_lean_steady(one, k->one - one->first_node, t->steady, N, h),
              sw_lean_steady(two, k->two - two->first_node, t->steady, N, h));
}

void sw_pairs_commit(sw_pairs *p, sw_system *s) {
  p->next_count = 0;
  for (size_t i = 0; i < p->touch_count; i++) {
    const sw_pair_touch *t = &p->touches[i];
    const sw_pair *k = &p->pairs[t->pair];
    if (sw_grow((void **)&p->next_memory, &p->next_capacity, p->next_count + 1,
                sizeof *p->next_memory) != SW_OK)
      break; /* a lost anchor only starts anew */
    sw_pair_memory *m = &p->next_memory[p->next_count++];
    *m = (sw_pair_memory){.one = k->one,
                          .two = k->two,
                          .kind = t->kind,
                          .at = {t->at[0], t->at[1]},
                          .normal_force = t->press.normal_force,
                          .depth = t->press.normal_force / t->press.k,
                          .steady = steady_force(s, k, t, p->h),
                          .k = sw_press_eased(&t->press, k->usual, t->stiffer),
                          .normal = t->press.normal,
                          .sliding = t->press.next_sliding,
                          .smooth = k->smooth,
                          .emerges = t->let_out > 0 || (t->emerges && t->forgiven > 0)};
    if (m->normal_force > 0) m->elastic = sw_scale(t->press.tangential, -1.0 / t->press.k);
  }
  sw_pair_memory *swap = p->memory;
  const size_t capacity = p->memory_capacity;
  p->memory = p->next_memory, p->memory_capacity = p->next_capacity;
  p->next_memory = swap, p->next_capacity = capacity;
  p->memory_count = p->next_count;
}

const void *sw_pairs_memory(const sw_pairs *p, size_t *bytes) {
  *bytes = p->memory_count * sizeof *p->memory;
  return p->memory;
}

sw_status sw_pairs_set_memory(sw_pairs *p, const void *memory, size_t bytes) {
  const size_t n = bytes / sizeof *p->memory;
  SW_TRY(sw_grow((void **)&p->memory, &p->memory_capacity, n, sizeof *p->memory));
  if (n) memcpy(p->memory, memory, bytes);
  p->memory_count = n;
  p->touch_count = p->listed_nodes = 0; /* the list depends on what came before */
  return SW_OK;
}

size_t sw_pairs_layout(void) {
  return 4096 * sizeof(sw_pair_memory) + 64 * sizeof(sw_pair_touch) + sizeof(sw_pair);
}

void sw_pairs_seen(const sw_pairs *p, const void *blocks[2], size_t bytes[2]) {
  blocks[0] = p->pairs, bytes[0] = p->pair_count * sizeof *p->pairs;
  blocks[1] = p->touches, bytes[1] = p->touch_count * sizeof *p->touches;
}

/* The segment that begins at the node is one of the body's. */
static int is_segment(const sw_system *s, uint32_t body, uint32_t node) {
  if (body >= s->body_count) return 0;
  const sw_body *b = &s->bodies[body];
  return node >= b->first_node && node + 1 < b->first_node + b->plan->nodes;
}

sw_status sw_pairs_set_seen(sw_pairs *p, const void *const blocks[2], const size_t bytes[2],
                            const sw_system *s) {
  const size_t n = bytes[0] / sizeof *p->pairs, m = bytes[1] / sizeof *p->touches;
  p->pair_count = p->touch_count = 0;
  if (bytes[0] % sizeof *p->pairs != 0 || bytes[1] % sizeof *p->touches != 0) return SW_EINVAL;
  SW_TRY(sw_grow((void **)&p->pairs, &p->pair_capacity, n, sizeof *p->pairs));
  SW_TRY(sw_grow((void **)&p->touches, &p->touch_capacity, m, sizeof *p->touches));
  if (n) memcpy(p->pairs, blocks[0], bytes[0]);
  if (m) memcpy(p->touches, blocks[1], bytes[1]);
  for (size_t i = 0; i < n; i++) {
    const sw_pair *k = &p->pairs[i];
    if (!is_segment(s, k->body[0], k->one) || !is_segment(s, k->body[1], k->two)) return SW_EINVAL;
  }
  for (size_t i = 0; i < m; i++)
    if (p->touches[i].pair >= n) return SW_EINVAL;
  p->pair_count = n, p->touch_count = m;
  return SW_OK;
}

int sw_pairs_memory_fits(const void *memory, size_t bytes, size_t nodes) {
  const size_t count = bytes / sizeof(sw_pair_memory);
  for (size_t i = 0; i < count; i++) {
    sw_pair_memory m;
    memcpy(&m, (const char *)memory + i * sizeof m, sizeof m);
    if (m.one >= nodes || m.two >= nodes || !isfinite(m.at[0] + m.at[1])) return 0;
  }
  return bytes % sizeof(sw_pair_memory) == 0;
}

int sw_pairs_memory_names(const void *memory, size_t bytes, size_t node) {
  const sw_pair_memory *m = memory;
  for (size_t i = 0; i < bytes / sizeof *m; i++)
    if (m[i].one == node || m[i].two == node) return 1;
  return 0;
}

sw_status sw_pairs_inherit(sw_pairs *p, const void *memory, size_t bytes, const size_t *new_node) {
  size_t kept = 0;
  SW_TRY(sw_pairs_set_memory(p, memory, bytes));
  for (size_t i = 0; i < p->memory_count; i++) {
    sw_pair_memory m = p->memory[i];
    const size_t one = new_node[m.one], two = new_node[m.two];
    if (one == SIZE_MAX || two == SIZE_MAX) continue;
    m.one = (uint32_t)one, m.two = (uint32_t)two;
    p->memory[kept++] = m;
  }
  p->memory_count = kept;
  return SW_OK;
}

/* --- read-outs ------------------------------------------------------------------- */

size_t sw_pairs_count(const sw_pairs *p) {
  size_t n = 0;
  for (size_t i = 0; i < p->touch_count; i++) n += p->touches[i].press.normal_force > 0;
  return n;
}

sw_pair_place sw_pairs_place(const sw_pairs *p, size_t number) {
  size_t i = 0;
  for (size_t left = number + 1; i < p->touch_count; i++)
    if (p->touches[i].press.normal_force > 0 && --left == 0) break;
  const sw_pair_touch *t = &p->touches[i];
  const sw_pair *k = &p->pairs[t->pair];
  return (sw_pair_place){.body = {k->body[0], k->body[1]},
                         .node = {k->one, k->two},
                         .at = {t->at[0], t->at[1]},
                         .normal = t->press.normal,
                         .normal_force = t->press.normal_force,
                         .friction = t->press.tangential,
                         .slip = t->press.slip,
                         .gap = t->press.gap_after - t->forgiven};
}

double sw_pairs_penetration(const sw_pairs *p, size_t *node) {
  double deepest = 0;
  for (size_t i = 0; i < p->touch_count; i++) {
    const sw_pair_touch *t = &p->touches[i];
    const double depth = t->forgiven - t->press.gap_after - t->aslant;
    if (depth <= deepest) continue;
    deepest = depth;
    if (node) *node = p->pairs[p->touches[i].pair].one;
  }
  return deepest;
}

double sw_pairs_energy(const sw_pairs *p) {
  double sum = 0;
  for (size_t i = 0; i < p->touch_count; i++) {
    const sw_press *t = &p->touches[i].press;
    if (!(t->normal_force > 0)) continue;
    sum += 0.5 * (t->normal_force * t->normal_force + sw_norm2(t->tangential)) / t->k;
  }
  return sum;
}

double sw_pairs_emerged(const sw_pairs *p) {
  double sum = 0;
  for (size_t i = 0; i < p->touch_count; i++)
    sum += p->touches[i].let_out * p->touches[i].press.normal_force;
  return sum;
}

double sw_pairs_rubbed(const sw_pairs *p) {
  double sum = 0;
  for (size_t i = 0; i < p->touch_count; i++) {
    const sw_press *t = &p->touches[i].press;
    if (t->normal_force > 0) sum -= sw_dot(t->tangential, t->slip);
  }
  return sum;
}

int sw_pairs_steady(const sw_pairs *p) {
  size_t before = 0, now = 0;
  for (size_t i = 0; i < p->memory_count; i++) before += p->memory[i].normal_force > 0;
  for (size_t i = 0; i < p->touch_count; i++) now += p->touches[i].press.normal_force > 0;
  return before == now && !p->impact_count;
}

size_t sw_pairs_impacts(const sw_pairs *p) { return p->impact_count; }
