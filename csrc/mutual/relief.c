/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tension that the depth of touches takes from wires (mutual/relief.h). */
#include "mutual/relief.h"

#include <math.h>
#include <string.h>

#include "contact/contact.h"
#include "mutual/meet.h"

/* A stretch of a line between two fixed nodes, in the system's arrays. */
typedef struct span {
  const sw_body *body;
  size_t from, to;
  double length, tension; /* without load [m]; mean [N] */
} span;

/* Turn of a line round a place towards the normal [-]. A touch stands for one node or one edge of
 * it, as in touch/drawn.c. */
static double turn_at(const sw_system *s, const span *p, size_t node, size_t end, sw_vec normal) {
  const size_t first = node < end ? node : end, last = node < end ? end : node;
  if (first <= p->from || last >= p->to) return 0;
  const sw_vec before = sw_sub(sw_vec_at(s->x, first), sw_vec_at(s->x, first - 1));
  const sw_vec after = sw_sub(sw_vec_at(s->x, last + 1), sw_vec_at(s->x, last));
  const sw_vec zero = {0, 0, 0};
  return fabs(sw_dot(normal, sw_sub(sw_unit_or(after, zero), sw_unit_or(before, zero))));
}

/* Part of a touch's depth by which this line's way is shorter [-]: the tension presses with the
 * turn of the way there, and what presses more is the line's bending. */
static double shortens(const sw_system *s, const span *p, const sw_met *t, int k) {
  const double turn = turn_at(s, p, t->of.node[k], t->of.end[k], t->normal);
  const double pull = fmax(p->tension, 0.0);
  return pull * turn > t->kept.normal_force ? t->kept.normal_force / pull : turn;
}

/* Stretch of a line between the fixed nodes round a node; 0: nothing fixes it on one side. */
static int span_at(const sw_system *s, size_t body, size_t node, span *out) {
  const sw_body *b = &s->bodies[body];
  const int *held = b->plan->held;
  const sw_drawn between = sw_drawn_between(s, body), *drawn = &between;
  if (b->plan->web || node < drawn->first || node > drawn->last) return 0;
  size_t from = node - b->first_node, to = from + 1;
  const size_t first = drawn->first - b->first_node, last = drawn->last - b->first_node;
  if (to > last) return 0;
  while (from > first && held[from] == SW_FREE) from--;
  while (to < last && held[to] == SW_FREE) to++;
  *out = (span){b, b->first_node + from, b->first_node + to, 0, 0};
  for (size_t e = from; e < to; e++) {
    out->length += b->plan->rest[e];
    out->tension += s->tension[b->first_edge + e] * b->plan->rest[e];
  }
  out->tension /= out->length;
  return 1;
}

/* Force against a way at a touch, by stretching, by tension and by bending [N/m]. */
static double resists(const sw_system *s, const span *p, const sw_met *t, int k) {
  const double turn = shortens(s, p, t, k), L = p->length;
  const double across = 4.0 * fmax(p->tension, 0.0) + 192.0 * p->body->plan->beam.EI / (L * L);
  return (p->body->EA * turn * turn + across) / L;
}

/* Share of a touch's depth that a line takes if both give way as they resist; all of it if nothing
 * holds the other one, which may lie on something [-]. other: a stretch of the other line, or an
 * empty one; mostly the next touch is on the same. */
static double share_of(const sw_system *s, const sw_met *t, int k, const span *p, span *other) {
  const size_t body = t->of.body[!k], node = t->of.node[!k];
  const int same = other->body == &s->bodies[body] && node >= other->from && node < other->to;
  if (!same && !span_at(s, body, node, other)) {
    other->body = NULL;
    return 1;
  }
  const double own = resists(s, p, t, k), others = resists(s, other, t, !k);
  return own + others > 0 ? others / (own + others) : 0;
}

/* Tension of a stretch whose way becomes longer: it is stretched, and its sag becomes less. A
 * clamped line's stiffness against bending counts like 4 pi^2 EI / length^2 of tension. */
static double tension_after(const sw_system *s, const span *p, double longer) {
  const sw_beam *beam = &p->body->plan->beam;
  const double L = p->length, weight = beam->mass * L * sw_norm(sw_load(s->gravity));
  const double stiff = 4.0 * M_PI * M_PI * beam->EI / (L * L), T = fmax(p->tension, 0.0);
  const double sags = weight * weight * L / 24.0, now = T + stiff;
  double low = T, high = T + p->body->EA * longer / L;
  for (int k = 0; k < 50 && high - low > 1e-3 * high; k++) {
    const double mid = 0.5 * (low + high), then = mid + stiff;
    const double less = now > 0 ? sags * (1.0 / (now * now) - 1.0 / (then * then)) : 0;
    *((mid - T) * L / p->body->EA + less < longer ? &low : &high) = mid;
  }
  return 0.5 * (low + high);
}

static double depth_of(const sw_met *t) { return t->kept.depth + fmax(t->kept.left, 0.0); }

/* Way by which the touches shorten a stretch; *out: the touch that does so most [m]. */
static double shortened(const sw_mutual *m, const sw_system *s, const span *p, sw_relief *out) {
  double sum = 0, most = 0;
  span other = {0};
  for (size_t i = 0; i < m->memory_count; i++) {
    const sw_met *t = &m->memory[i];
    if (!(t->kept.normal_force > 0)) continue;
    for (int k = 0; k < 2; k++) {
      const size_t node = t->of.node[k];
      if (&s->bodies[t->of.body[k]] != p->body || node < p->from || node >= p->to) continue;
      const double less = depth_of(t) * shortens(s, p, t, k) * share_of(s, t, k, p, &other);
      sum += less;
      if (!(less > most)) continue;
      most = less, out->node = node, out->with = t->of.body[!k], out->depth = depth_of(t);
    }
  }
  return sum;
}

int sw_mutual_relief(const sw_mutual *m, const sw_system *s, size_t body, sw_relief *out) {
  const sw_body *b = &s->bodies[body];
  *out = (sw_relief){0};
  if (b->plan->web || !m->memory_count) return 0;
  const sw_drawn drawn = sw_drawn_between(s, body);
  for (size_t at = drawn.first; at < drawn.last;) {
    span p;
    if (!span_at(s, body, at, &p)) break;
    at = p.to;
    sw_relief one = {0};
    const double less = shortened(m, s, &p, &one);
    if (!(less > 0)) continue;
    one.from = p.from, one.to = p.to;
    one.tension = p.tension, one.taken = tension_after(s, &p, less) - fmax(p.tension, 0.0);
    if (one.taken > out->taken) *out = one;
  }
  return out->taken > 0;
}

void sw_mutual_part(const sw_mutual *m, const sw_system *s, size_t body, const sw_relief *relief,
                    double *out) {
  const sw_body *b = &s->bodies[body];
  span p, other = {0};
  memset(out, 0, 3 * b->plan->nodes * sizeof *out);
  if (!span_at(s, body, relief->from, &p)) return;
  for (size_t i = 0; i < m->memory_count; i++) {
    const sw_met *t = &m->memory[i];
    if (!(t->kept.normal_force > 0 && t->kept.depth > 0)) continue;
    for (int k = 0; k < 2; k++) {
      const size_t node = t->of.node[k], end = t->of.end[k];
      if (t->of.body[k] != body || node < p.from || node >= p.to) continue;
      const double force = t->kept.normal_force / t->kept.depth * depth_of(t);
      const double push = (k ? -force : force) * share_of(s, t, k, &p, &other);
      double *one = out + 3 * (node - b->first_node), *two = out + 3 * (end - b->first_node);
      sw_store(one, sw_madd(sw_load(one), t->normal, (1.0 - t->at[k]) * push));
      sw_store(two, sw_madd(sw_load(two), t->normal, t->at[k] * push));
    }
  }
}

void sw_mutual_find_taken(sw_mutual *m, const sw_system *s) {
  sw_relief relief;
  for (size_t b = 0; b < s->body_count; b++)
    if (!s->bodies[b].waits && sw_mutual_takes_part(m, b) && sw_mutual_relief(m, s, b, &relief))
      m->drawn[b].taken = relief.taken;
}

int sw_mutual_is_sunk(const sw_mutual *m, const sw_system *s, double share) {
  sw_relief relief;
  for (size_t b = 0; b < s->body_count; b++) {
    if (m->drawn[b].last < m->drawn[b].first || !sw_mutual_relief(m, s, b, &relief)) continue;
    if (relief.taken > share * (fmax(relief.tension, 0.0) + relief.taken) &&
        sw_drawn_is_taut(s, b, relief.node, relief.taken,
                         sw_contact_usual_force(s, s->bodies[b].plan)))
      return 1;
  }
  return 0;
}
