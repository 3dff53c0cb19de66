/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Touches of an iterate: where they are, and what they remember. */
#include <math.h>

#include "base/halving.h"
#include "base/interrupt.h"
#include "contact/grain.h"

/* --- memory ------------------------------------------------------------------------ */

static size_t first_memory(const sw_grains *g, const sw_grain_pair *k) {
  size_t i;
  SW_FIRST_NOT(sw_grain_order(&g->memory[i].pair, k) < 0, i, 0, g->memory_count);
  return i;
}

/* Of the same two; of a place on a wire the nearest one, up to a segment away. */
static const sw_grain_touch *recall(const sw_grains *g, const sw_system *s, const sw_grain_pair *k,
                                    const double at[2]) {
  const int wire = k->node[1] != k->end[1] && !s->bodies[k->body[1]].plan->web;
  const sw_grain_touch *best = NULL;
  sw_grain_pair from = *k;
  double nearest = 1.0;
  if (wire && from.node[1]) from.node[1]--, from.end[1]--;
  for (size_t i = first_memory(g, &from); i < g->memory_count; i++) {
    const sw_grain_touch *m = &g->memory[i];
    if (m->pair.node[0] != k->node[0] || m->pair.end[0] != k->end[0]) break;
    if (m->pair.node[1] > k->node[1] + (wire ? 1u : 0u)) break;
    if (m->pair.body[1] != k->body[1] || (!wire && m->pair.end[1] != k->end[1])) continue;
    const double d =
        wire ? fabs((double)m->pair.node[1] + m->at[1] - (double)k->node[1] - at[1]) : 0.0;
    if (d < nearest) best = m, nearest = d;
  }
  return best;
}

/* A tangential vector that went with normal from, taken along to normal to. */
static sw_vec carry(sw_vec v, sw_vec from, sw_vec to) {
  const double share = sw_dot(to, v) / fmax(1.0 + sw_dot(from, to), 1e-12);
  return sw_madd(v, sw_add(from, to), -share);
}

/* --- one touch ---------------------------------------------------------------------- */

/* Friction's springs in an object of many particles are softer than its touches, by their number
 * and up to this, as where it touches obstacles [-]. */
static const double SOFTEST = 1000.0;

static double softness(const sw_system *s, const sw_grain_pair *k) {
  double most = 0;
  for (int i = 0; i < 2; i++) {
    const sw_web *w = s->bodies[k->body[i]].plan->web;
    if (w) most = fmax(most, (double)w->particles);
  }
  return fmin(SOFTEST, most);
}

static void begin_friction(const sw_grains *g, const sw_system *s, const double *y,
                           const sw_grain_touch *m, const sw_grain_touch *last, sw_grain_touch *t) {
  sw_press *press = &t->press;
  const sw_grain_pair *k = &t->pair;
  const int pressed = m && m->press.normal_force > 0, went_on = last && last->press.active;
  sw_vec u = sw_sub(sw_grain_apart(y, k, t->at), sw_grain_apart(s->x, k, t->at));
  if (pressed) {
    const sw_vec spring = sw_scale(m->press.tangential, -1.0 / sw_press_grip(&m->press));
    u = sw_add(u, carry(spring, m->press.normal, press->normal));
  } else if (press->gap >= 0) {
    u = sw_v(0, 0, 0);
  }
  sw_press_aim(press, u, last ? &last->press : NULL, last && last->stage == g->stage, g->first);
  press->lag = pressed ? m->press.normal_force : press->k * fmax(0.0, -press->gap);
  if (last) sw_press_take_lag(press, &last->press);
  if (went_on || pressed)
    press->sliding = went_on ? last->press.next_sliding : m->press.next_sliding;
  sw_press_begin(press, sw_grain_rule(g, k->body)->friction, went_on || pressed, HUGE_VAL);
}

/* What is in each other at the start is let out as slowly as meshes are. */
static void forgive(const sw_grains *g, const sw_system *s, const sw_grain_touch *m,
                    sw_grain_touch *t) {
  if (g->regime != SW_CONTACT_IMPLICIT || t->press.gap >= 0) return;
  const double depth =
      t->pair.reach - sw_dot(t->press.normal, sw_grain_apart(s->x, &t->pair, t->at));
  const double explained = m && m->press.normal_force > 0 ? fmax(0.0, -m->press.gap_after) : 0.0;
  t->forgiven = sw_press_forgiven(depth, explained, g->h, 1);
  t->let_out = sw_press_let_out(depth, explained, t->forgiven);
}

static void set_touch(sw_grains *g, const sw_system *s, const double *y, size_t i,
                      const double at[2], double gap, sw_vec normal, int slides, int barred) {
  sw_grain_touch *t = &g->now[i];
  const sw_grain_pair *k = &g->pairs[i];
  const sw_grain_touch *m = recall(g, s, k, at), *last = g->last[i].stage ? &g->last[i] : NULL;
  const int pressed = m && m->press.normal_force > 0;
  const int is_explicit = g->regime == SW_CONTACT_EXPLICIT;
  *t = (sw_grain_touch){.pair = *k, .at = {at[0], at[1]}, .stage = g->stage, .barred = barred};
  for (int n = 0; n < 2; n++) t->slides[n] = slides && at[n] > 0 && at[n] < 1;
  sw_press *press = &t->press;
  press->gap = gap, press->normal = normal;
  press->soft = softness(s, k), press->by_place = 1;
  press->k = is_explicit ? k->usual : last ? last->stiffer : pressed ? m->press.k : k->usual;
  t->stiffer = press->k;
  forgive(g, s, m, t);
  press->gap += t->forgiven;
  press->gap_after = press->gap;
  sw_press_activate(press, last && !is_explicit ? &last->press : NULL);
  begin_friction(g, s, y, m, last, t);
}

/* --- where -------------------------------------------------------------------------- */

/* Both nearer than this share of the radii's sum are about to get through each other [-]. */
static const double TOO_NEAR = 0.25;
enum { MOST_ADVANCES = 100 };

static sw_vec part_way(const double *x0, const double *x1, uint32_t node, double t) {
  return sw_lerp(sw_vec_at(x0, node), sw_vec_at(x1, node), t);
}

/* How far the two may have come nearer from x0 to x1 [m]. */
static double approach_bound(const double *x0, const double *x1, const sw_grain_pair *k) {
  const uint32_t one[2] = {k->node[0], k->end[0]}, two[2] = {k->node[1], k->end[1]};
  double most = 0;
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 2; j++) {
      const sw_vec a = sw_sub(sw_vec_at(x1, one[i]), sw_vec_at(x0, one[i]));
      const sw_vec b = sw_sub(sw_vec_at(x1, two[j]), sw_vec_at(x0, two[j]));
      most = fmax(most, sw_norm2(sw_sub(a, b)));
    }
  return sqrt(most);
}

/* Do they get through each other on the straight way from x0 to y? Goes on by what they cannot have
 * come nearer in the meantime. 1 with the place and the direction just before. */
static int passes(const double *x0, const double *y, const sw_grain_pair *k, double at[2],
                  sw_vec *normal) {
  const double speed = approach_bound(x0, y, k), near = TOO_NEAR * k->reach;
  double t = 0;
  if (speed < near) return 0;
  for (int i = 0; i < MOST_ADVANCES && t < 1; i++) {
    const sw_vec x[4] = {part_way(x0, y, k->node[0], t), part_way(x0, y, k->end[0], t),
                         part_way(x0, y, k->node[1], t), part_way(x0, y, k->end[1], t)};
    const double distance = sw_segments_nearest(x[0], x[1], x[2], x[3], at);
    if (i == 0 && distance <= near) return 0; /* they start like that */
    const sw_vec d = sw_sub(sw_lerp(x[0], x[1], at[0]), sw_lerp(x[2], x[3], at[1]));
    *normal = sw_unit_or(d, sw_v(0, 0, 1));
    if (distance <= 1.01 * near) return 1;
    t += (distance - near) / speed;
  }
  return 0;
}

/* Edges that part by less than this touch along their length: points do that [-]. */
static const double PARALLEL = 1e-3;

static int crosses(const double *y, const sw_grain_pair *k, double at[2]) {
  const sw_vec u = sw_sub(sw_vec_at(y, k->end[0]), sw_vec_at(y, k->node[0]));
  const sw_vec v = sw_sub(sw_vec_at(y, k->end[1]), sw_vec_at(y, k->node[1]));
  if (!(sw_norm2(sw_cross(u, v)) > PARALLEL * sw_norm2(u) * sw_norm2(v))) return 0;
  sw_grain_nearest(y, k, at);
  return at[0] > 0 && at[0] < 1 && at[1] > 0 && at[1] < 1;
}

/* Where the two touch; 0: that is for others to say. Edges cross within both. A point has its place
 * within an edge; a particle on a wire's segment at its first node too where the one before does
 * not reach, and beyond the wire's end. */
static int owns(const sw_system *s, const double *y, const sw_grain_pair *k, double at[2]) {
  const sw_body *b = &s->bodies[k->body[1]];
  const uint32_t point = k->node[0], from = k->node[1], to = k->end[1];
  at[0] = at[1] = 0;
  if (point != k->end[0]) return crosses(y, k, at);
  if (from == to) return 1;
  at[1] = sw_grain_along(y, point, from, to);
  if (at[1] > 0 && at[1] < 1) return 1;
  const int beyond = at[1] >= 1;
  at[1] = beyond ? 1 : 0;
  if (b->plan->web) return 0;
  if (beyond) return to + 1 == b->first_node + b->plan->nodes;
  return from == b->first_node || sw_grain_along(y, point, from - 1, from) >= 1;
}

/* Places nearer than this share of the radii's sum are listed, so that what begins to touch finds
 * its state of the iterate before; nearer than that they may have passed each other [-]. */
static const double LISTED_GAP = 0.25, PASSED = 0.5;

static void find(sw_grains *g, const sw_system *s, const double *y, size_t i) {
  const sw_grain_pair *k = &g->pairs[i];
  const sw_grain_touch *last = g->last[i].stage ? &g->last[i] : NULL;
  double at[2];
  sw_vec normal;
  if (passes(s->x, y, k, at, &normal)) {
    const double gap = sw_dot(normal, sw_grain_apart(y, k, at)) - k->reach;
    set_touch(g, s, y, i, at, gap, normal, 0, 1);
    return;
  }
  const int own = owns(s, y, k, at);
  if (!own) {
    if (!last || !(last->press.normal_force > 0)) return;
    at[0] = last->at[0], at[1] = last->at[1]; /* one that pushed stays where it was */
  }
  const sw_vec d = sw_grain_apart(y, k, at);
  double distance = sw_norm(d);
  if (!(distance < (1.0 + LISTED_GAP) * k->reach)) return;
  const sw_grain_touch *m = recall(g, s, k, at);
  normal = sw_unit_or(d, m ? m->press.normal : sw_v(0, 0, 1));
  if (m && distance < PASSED * k->reach && sw_dot(normal, m->press.normal) < 0)
    normal = sw_neg(normal), distance = -distance;
  set_touch(g, s, y, i, at, distance - k->reach, normal, own, 0);
}

sw_status sw_grains_look(sw_grains *g, const sw_system *s, const double *y) {
  sw_grain_touch *swap = g->last;
  const size_t capacity = g->last_capacity;
  g->last = g->now, g->last_capacity = g->now_capacity;
  g->now = swap, g->now_capacity = capacity;
  g->looked = 1;
  for (size_t i = 0; i < g->pair_count; i++) {
    g->now[i].pair = g->pairs[i];
    g->now[i].stage = 0;
    if (sw_interrupted()) return SW_EINTR;
    if (!g->pairs[i].held) find(g, s, y, i);
  }
  return SW_OK;
}
