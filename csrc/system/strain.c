/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "system/strain.h"

#include <math.h>

#include "base/alloc.h"
#include "base/simd.h"
#include "system/arrays.h"
#include "system/axial.h"
#include "system/part.h"

sw_status sw_system_add_strains(sw_system *s) {
  int any = 0;
  for (size_t b = 0; b < s->body_count; b++) any |= s->bodies[b].axial_time > 0;
  if (!any) return SW_OK;
  s->pull_block = sw_alloc(2 * s->edges, sizeof *s->pull);
  if (!s->pull_block) return SW_ENOMEM;
  s->pull = s->pull_block;
  s->strain_new = s->pull + s->edges;
  SW_TRY(sw_system_grow_state(s, 2 * s->edges, &s->strain));
  s->strain_rate = s->strain + s->edges;
  return SW_OK;
}

/* Axial force of an edge or spring over its strain [N]. */
static double stiffness_of(const sw_body *b, size_t e) {
  if (!b->plan->web) return b->EA;
  return b->plan->web->link[e].k * b->plan->web->link[e].rest;
}

void sw_system_add_up_pull(sw_system *s) {
  if (s->pull) sw_system_sum_pull(s, s->tension, s->strain_rate, s->pull);
}

/* Strain of an edge by its nodes' places [-]. */
static double strain_between(const sw_body *b, const double *x, size_t e) {
  const sw_web *w = b->plan->web;
  if (!w) return sw_dist(sw_vec_at(x, e), sw_vec_at(x, e + 1)) / b->plan->rest[e] - 1.0;
  const sw_web_link *link = &w->link[e];
  return sw_dist(sw_vec_at(x, link->a), sw_vec_at(x, link->b)) / link->rest - 1.0;
}

void sw_system_strain_from_state(sw_system *s) {
  sw_system_forget_turning(s);
  for (size_t i = 0; s->strain && i < s->body_count; i++) {
    const sw_body *b = &s->bodies[i];
    if (!(b->axial_time > 0)) continue;
    for (size_t e = 0; e < sw_plan_axial(b->plan); e++) {
      const double T = s->tension[b->first_edge + e], k = stiffness_of(b, e);
      const int slack = !b->plan->web && !(T > 0) && !(b->EA_push > 0);
      const double between = slack || k == 0 ? strain_between(b, s->x + 3 * b->first_node, e) : 0;
      s->strain[b->first_edge + e] = slack ? fmin(between, 0.0) : k != 0 ? T / k : between;
      s->strain_rate[b->first_edge + e] = 0;
    }
  }
}

void sw_system_rate_from_velocity(sw_system *s, size_t body) {
  const sw_body *b = &s->bodies[body];
  if (!(b->axial_time > 0)) return;
  const double *x = s->x + 3 * b->first_node, *v = s->v + 3 * b->first_node;
  for (size_t e = 0; e < sw_plan_axial(b->plan); e++) {
    const sw_web *w = b->plan->web;
    const size_t p = w ? w->link[e].a : e, q = w ? w->link[e].b : e + 1;
    const sw_vec t = sw_unit_or(sw_sub(sw_vec_at(x, q), sw_vec_at(x, p)), sw_v(0, 0, 0));
    const double rest = w ? w->link[e].rest : b->plan->rest[e];
    s->strain_rate[b->first_edge + e] = sw_dot(t, sw_sub(sw_vec_at(v, q), sw_vec_at(v, p))) / rest;
  }
}

/* --- in a stage ---------------------------------------------------------------- */

void sw_strain_begin_stage(sw_system *s, const sw_stage *stage) {
  s->strain_past = stage->strain_past;
  s->strain_now = stage->strain;
}

void sw_strain_end_stage(sw_system *s) { s->strain_past = s->strain_now = NULL; }

SW_HOT
static void advance_edges(size_t m, const double *restrict delta, const double *restrict rest,
                          const double *restrict l, const double *restrict tx,
                          const double *restrict ty, const double *restrict tz,
                          double *restrict strain) {
  for (size_t e = 0; e < m; e++) {
    const double dx = delta[3 * e + 3] - delta[3 * e];
    const double dy = delta[3 * e + 4] - delta[3 * e + 1];
    const double dz = delta[3 * e + 5] - delta[3 * e + 2];
    const double along = dx * tx[e] + dy * ty[e] + dz * tz[e];
    strain[e] = (l[e] + along) / rest[e] - 1.0;
  }
}

void sw_strain_advance(sw_system *s, const sw_body *b) {
  if (!s->strain_past || !(b->axial_time > 0)) return;
  const sw_field *f = &b->field;
  double *strain = s->strain_new + b->first_edge;
  if (!b->plan->web) {
    advance_edges(b->plan->edges, s->delta + 3 * b->first_node, b->plan->rest, f->length,
                  f->tangent[0], f->tangent[1], f->tangent[2], strain);
    return;
  }
  for (size_t e = 0; e < b->plan->web->links; e++) {
    const double k = stiffness_of(b, e);
    strain[e] = k != 0 ? s->tension_new[b->first_edge + e] / k : 0.0;
  }
}

void sw_strain_take(sw_system *s, double share) {
  if (!s->strain_past) return;
  for (size_t e = sw_part_edge(s, s->part); e < sw_part_edge(s, s->part_end); e++)
    s->strain_now[e] += share * (s->strain_new[e] - s->strain_now[e]);
}
