/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strains of edges, directions at clamps and places of held nodes, with rates by the method's
 * formula. */
#include "system/strain.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "base/simd.h"
#include "system/arrays.h"
#include "system/axial.h"
#include "system/part.h"

sw_status sw_system_add_strains(sw_system *s) {
  int any = 0;
  s->strains = s->edges;
  SW_ITEMS(sw_body, b, s->bodies, s->body_count) {
    b->first_clamp = s->strains;
    b->kept_clamps = b->viscosity > 0 ? b->plan->clamp_count : 0;
    s->strains += 3 * b->kept_clamps;
    any |= b->axial_time > 0 || b->viscosity > 0;
  }
  s->first_kept = s->strains;
  SW_ITEMS(const sw_body, b, s->bodies, s->body_count) {
    for (size_t i = 0; b->viscosity > 0 && i < b->plan->nodes; i++)
      s->strains += b->plan->held[i] != SW_FREE ? 3 : 0;
  }
  if (!any) return SW_OK;
  s->pull_block = sw_alloc(s->edges + s->first_kept, sizeof *s->pull);
  if (!s->pull_block) return SW_ENOMEM;
  s->pull = s->pull_block;
  s->strain_new = s->pull + s->edges;
  s->clamps_now = s->strain_new + s->edges;
  SW_TRY(sw_system_grow_state(s, 2 * s->strains, &s->strain));
  s->strain_rate = s->strain + s->strains;
  return SW_OK;
}

void sw_system_add_up_pull(sw_system *s) {
  if (s->pull) sw_system_sum_pull(s, s->tension, s->strain_rate, s->pull);
}

/* Returns the strain of an edge from its nodes' places [-]. */
static double strain_between(const sw_body *b, const double *x, size_t e) {
  const sw_web *w = b->plan->web;
  if (!w) return sw_dist(sw_vec_at(x, e), sw_vec_at(x, e + 1)) / b->plan->rest[e] - 1.0;
  const sw_web_link *link = &w->link[e];
  return sw_dist(sw_vec_at(x, link->a), sw_vec_at(x, link->b)) / link->rest - 1.0;
}

/* --- at clamps ------------------------------------------------------------------- */

/* Returns a vector of the world in the coordinates of a clamp's hold. */
static sw_vec seen(const sw_system *s, const sw_clamp_hinge *h, sw_vec u) {
  return sw_unrotate(s->hold_states[h->hold].pose.q, u);
}

static void direct_clamps(const sw_system *s, const sw_body *b, const double *x, double *strain) {
  for (size_t c = 0; c < b->kept_clamps; c++) {
    const sw_clamp_hinge *h = &b->plan->clamps[c];
    const double *from = x + 3 * (b->first_node + h->edge);
    const sw_vec t = sw_unit_or(sw_sub(sw_load(from + 3), sw_load(from)), sw_v(0, 0, 0));
    sw_store(strain + b->first_clamp + 3 * c, seen(s, h, t));
  }
}

/* --- held nodes ------------------------------------------------------------------ */

static void number_held(sw_system *s) {
  size_t at = s->first_kept;
  SW_ITEMS(sw_held_node, h, s->held, s->held_count) {
    if (!(s->bodies[h->body].viscosity > 0)) continue;
    h->kept = at;
    at += 3;
  }
}

/* Copies values of held nodes (3 each) from the array of all nodes to the strains. */
static void keep_held(const sw_system *s, const double *all, double *strain) {
  SW_ITEMS(const sw_held_node, h, s->held, s->held_count) {
    if (h->kept) sw_store(strain + h->kept, sw_load(all + 3 * h->node));
  }
}

void sw_strain_show_held(const sw_system *s, const double *y, double rate, double *v) {
  if (!s->strain_past) return;
  SW_PART_EACH(s, b)
  for (size_t k = s->bodies[b].held; k; k = s->held[k - 1].next) {
    const sw_held_node *h = &s->held[k - 1];
    if (!h->kept || h->slides || h->rail) continue;
    const sw_vec way = sw_sub(sw_load(y + 3 * h->node), sw_load(s->strain_past + h->kept));
    sw_store(v + 3 * h->node, sw_scale(way, rate));
  }
}

void sw_strain_show_held_rates(const sw_system *s, double *v) {
  if (!s->strain_rate) return;
  SW_ITEMS(const sw_held_node, h, s->held, s->held_count) {
    if (!h->kept || h->slides || h->rail) continue;
    sw_store(v + 3 * h->node, sw_load(s->strain_rate + h->kept));
  }
}

/* --- both ------------------------------------------------------------------------ */

static void keep_places(const sw_system *s, const double *x, double *strain) {
  SW_ITEMS(const sw_body, b, s->bodies, s->body_count) direct_clamps(s, b, x, strain);
  keep_held(s, x, strain);
}

static void turn_clamps(sw_system *s, const sw_body *b) {
  for (size_t c = 0; c < b->kept_clamps; c++) {
    const sw_clamp_hinge *h = &b->plan->clamps[c];
    const size_t at = 3 * (b->first_node + h->edge);
    const sw_vec edge = sw_sub(sw_load(s->x + at + 3), sw_load(s->x + at));
    const sw_vec v = sw_sub(sw_load(s->v + at + 3), sw_load(s->v + at));
    const double l = sw_norm(edge);
    const sw_vec t = sw_scale(edge, l > 0 ? 1.0 / l : 0.0);
    const sw_vec turns = sw_scale(sw_madd(v, t, -sw_dot(v, t)), l > 0 ? 1.0 / l : 0.0);
    const sw_vec away = sw_sub(turns, sw_cross(s->hold_states[h->hold].omega, t));
    sw_store(s->strain_rate + b->first_clamp + 3 * c, seen(s, h, away));
  }
}

void sw_system_held_from_velocity(sw_system *s) {
  if (!s->strain) return;
  number_held(s);
  keep_places(s, s->x, s->strain);
  SW_ITEMS(const sw_body, b, s->bodies, s->body_count) turn_clamps(s, b);
  keep_held(s, s->v, s->strain_rate);
}

sw_status sw_system_held_anew(sw_system *s, double t, sw_error *err) {
  if (!s->strain || s->strains == s->edges) return SW_OK;
  SW_TRY(sw_system_place_holds(s, t, NULL, NULL, NULL, err));
  keep_places(s, s->x, s->strain);
  return SW_OK;
}

/* Rotates vectors from the holds' coordinates to the world. Returns the body's part of
 * clamps_now. */
static double *show(const sw_system *s, const sw_body *b, const double *vectors) {
  double *now = s->clamps_now + (b->first_clamp - s->edges);
  for (size_t c = 0; c < b->kept_clamps; c++)
    sw_store(now + 3 * c, sw_rotate(s->hold_states[b->plan->clamps[c].hold].pose.q,
                                    sw_vec_at(vectors + b->first_clamp, c)));
  return now;
}

void sw_strain_place(sw_system *s) {
  for (size_t b = 0; s->strain_past && b < s->body_count; b++)
    show(s, &s->bodies[b], s->strain_past);
}

void sw_strain_show_past(const sw_system *s, sw_body *b) {
  const int known = s->strain_past && b->kept_clamps;
  b->field.clamp_past = known ? s->clamps_now + (b->first_clamp - s->edges) : NULL;
  b->field.clamp_rate = NULL;
}

void sw_strain_show_rates(sw_system *s, sw_body *b) {
  b->field.clamp_past = NULL;
  b->field.clamp_rate = s->strain_rate && b->kept_clamps ? show(s, b, s->strain_rate) : NULL;
}

/* Sets the edges at clamps to those after the last update: a clamp's moment is computed from them.
 * In a stiff hinge even the small last update changes this moment by more than its value. */
static void turn_clamped_edges(sw_system *s, const double *y) {
  SW_ITEMS(sw_body, b, s->bodies, s->body_count) {
    for (size_t c = 0; c < b->plan->clamp_count; c++) {
      const size_t e = b->plan->clamps[c].edge;
      const double *at = y + 3 * (b->first_node + e);
      const sw_vec edge = sw_sub(sw_load(at + 3), sw_load(at));
      const sw_vec t = sw_unit_or(edge, sw_field_tangent(&b->field, e));
      b->field.length[e] = sw_norm(edge);
      b->field.tangent[0][e] = t.x, b->field.tangent[1][e] = t.y, b->field.tangent[2][e] = t.z;
    }
  }
}

void sw_strain_finish(sw_system *s, const double *y) {
  turn_clamped_edges(s, y);
  if (s->strain_past) keep_places(s, y, s->strain_now);
}

/* --- at a state ------------------------------------------------------------------ */

void sw_system_strain_from_state(sw_system *s) {
  sw_system_forget_turning(s);
  if (!s->strain) return;
  keep_places(s, s->x, s->strain);
  memset(s->strain_rate + s->edges, 0, (s->strains - s->edges) * sizeof *s->strain_rate);
  SW_ITEMS(const sw_body, b, s->bodies, s->body_count) {
    if (!(b->axial_time > 0)) continue;
    for (size_t e = 0; e < sw_plan_axial(b->plan); e++) {
      const double T = s->tension[b->first_edge + e], k = sw_body_axial(b, e);
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
    const double k = sw_body_axial(b, e);
    strain[e] = k != 0 ? s->tension_new[b->first_edge + e] / k : 0.0;
  }
}

void sw_strain_take(sw_system *s, double share) {
  if (!s->strain_past) return;
  SW_PART_EACH(s, b) {
    const size_t first = s->bodies[b].first_edge;
    for (size_t e = first; e < first + sw_plan_axial(s->bodies[b].plan); e++)
      s->strain_now[e] += share * (s->strain_new[e] - s->strain_now[e]);
  }
}
