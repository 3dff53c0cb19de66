/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrates axial forces over time: of the edges of lines, and of the slices of meshes. */
#include "base/each.h"
#include "base/vec.h"
#include "force/solid.h"
#include "system/axial.h"

/* Axial forces of a body's springs. */
typedef struct pulls {
  const double *tension, *rate; /* of the body's springs; rate: or NULL [N], [1/s] */
  double time;                  /* of its dashpots [s] */
} pulls;

static double spring_pull(const sw_body *b, const pulls *p, size_t e) {
  return p->tension[e] +
         (p->rate && p->time > 0 ? p->time * sw_body_axial(b, e) * p->rate[e] : 0.0);
}

/* Returns the force along the axis of an element on the corners of its first ring [N]. */
static double solid_pull(const sw_plan *p, const sw_web_solid *s, const double *x, sw_vec axis) {
  double at[3 * SW_SOLID_NODES], g[3 * SW_SOLID_NODES], sum = 0;
  for (uint32_t i = 0; i < s->count; i++) sw_store(at + 3 * i, sw_vec_at(x, s->node[i]));
  sw_solid_eval((const sw_solid *)p->web->shapes + sw_plan_shape(p, s), at, SW_WANT_FORCE, g, NULL);
  for (uint32_t i = 0; i < s->count / 2; i++) sum -= sw_dot(sw_load(g + 3 * i), axis);
  return sum;
}

/* Returns the axial force in slice r, as read-outs have it (body/section.c) [N]. */
static double slice_pull(const sw_body *b, const pulls *p, const double *x, size_t r, sw_vec axis) {
  const sw_web *w = b->plan->web;
  double sum = 0;
  for (size_t e = w->ring_links[r]; e < w->ring_links[r + 1]; e++) {
    const sw_web_link *link = &w->link[e];
    if (link->b < w->first[r + 1]) continue; /* within ring r */
    const sw_vec d = sw_sub(sw_vec_at(x, link->b), sw_vec_at(x, link->a));
    sum += spring_pull(b, p, e) * sw_dot(d, axis) / sw_norm(d);
  }
  for (size_t k = w->ring_solids[r]; k < w->ring_solids[r + 1]; k++)
    sum += solid_pull(b->plan, &w->solid[k], x, axis);
  return sum;
}

static void add_slices(const sw_body *b, const pulls *p, const double *x, double share,
                       double *sum) {
  const sw_web *w = b->plan->web;
  sw_vec before = sw_web_facing(w, x, 0);
  for (size_t r = 0; r + 1 < w->rings; r++) {
    const sw_vec after = sw_web_facing(w, x, r + 1);
    sum[r] += share * slice_pull(b, p, x, r, sw_unit_or(sw_add(before, after), before));
    before = after;
  }
}

size_t sw_system_pulls(const sw_system *s) { return s->edges + s->slices; }

size_t sw_system_first_pull(const sw_system *s, const sw_body *b) {
  return b->plan->web ? s->edges + b->first_slice : b->first_edge;
}

void sw_system_add_pull(const sw_system *s, const double *x, const double *tension,
                        const double *rate, double share, double *sum) {
  SW_ITEMS(const sw_body, b, s->bodies, s->body_count) {
    const size_t first = b->first_edge;
    const pulls p = {tension + first, rate ? rate + first : NULL, b->axial_time};
    if (b->plan->web && b->plan->web->rings > 1)
      add_slices(b, &p, x + 3 * b->first_node, share, sum + sw_system_first_pull(s, b));
    if (b->plan->web) continue;
    const double c = rate && b->axial_time > 0 ? share * b->axial_time * b->EA : 0.0;
    const size_t end = first + sw_plan_axial(b->plan);
    for (size_t e = first; e < end; e++) sum[e] += share * tension[e];
    for (size_t e = first; rate && c > 0 && e < end; e++) sum[e] += c * rate[e];
  }
}
