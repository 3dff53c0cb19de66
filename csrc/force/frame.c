/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What material frames add to a rod: two bending stiffnesses, natural curvature, and a twist at
 * every hinge (discrete elastic rods, Bergou et al. 2008 and 2010). The whole bending energy is 1/2
 * k1 (b1 - b1')^2 + 1/2 k2 (b2 - b2')^2, with b as in state/hinge.h and b' its unloaded value.
 * bend.c contributes 1/2 k (b1^2 + b2^2), k the smaller stiffness; this force adds the rest. */

#include "force/frame.h"

#include "base/simd.h"
#include "force/force.h"

/* --- into the field ------------------------------------------------------------- */

FLAT void put(double *const *arrays, size_t at, vec v) {
  accumulate(arrays[0] + at, v.x);
  accumulate(arrays[1] + at, v.y);
  accumulate(arrays[2] + at, v.z);
}

/* Loads hinges i .. i + 3. Lanes beyond the last hinge get no stiffness. */
FLAT void gather(const sw_field *f, size_t i, hinge *h, kind what) {
  const sw_plan *p = f->plan;
  double *const *t = f->tangent;
  h->a.t = (vec){load(t[0] + i - 1), load(t[1] + i - 1), load(t[2] + i - 1)};
  h->b.t = (vec){load(t[0] + i), load(t[1] + i), load(t[2] + i)};
  h->ra = load(f->reciprocal + i - 1), h->rb = load(f->reciprocal + i);
  const double *const *m = f->normals;
  if (what != TWISTED) {
    h->a.m1 = (vec){load(m[0] + i - 1), load(m[1] + i - 1), load(m[2] + i - 1)};
    h->b.m1 = (vec){load(m[0] + i), load(m[1] + i), load(m[2] + i)};
  }
  double end[4][2 * LANES]; /* copies of the last hinges, filled up for the lanes beyond */
  const double *length = p->hinge + i, *twist = f->hinge_twist + i, *rest_twist = p->rest_twist + i;
  const double *bend = p->rest_bend + 2 * i;
  if (i + LANES > p->edges) {
    for (size_t k = 0; k < LANES; k++) {
      const size_t at = i + k < p->edges ? i + k : i;
      end[0][k] = i + k < p->edges ? p->hinge[at] : 0.0;
      end[1][k] = f->hinge_twist[at], end[2][k] = p->rest_twist[at];
      end[3][2 * k] = p->rest_bend[2 * at], end[3][2 * k + 1] = p->rest_bend[2 * at + 1];
    }
    length = end[0], twist = end[1], rest_twist = end[2], bend = end[3];
  }
  h->over_length = (lane)((wide)(1.0 / load(length)) & (load(length) > 0.0));
  h->twist = load(twist), h->rest_twist = load(rest_twist);
  if (what == TWISTED) return;
  h->rest[0] = __builtin_shufflevector(load(bend), load(bend + LANES), 0, 2, 4, 6);
  h->rest[1] = __builtin_shufflevector(load(bend), load(bend + LANES), 1, 3, 5, 7);
}

FLAT void scatter(sw_field *f, size_t i, const blocks *o) {
  for (int k = 0; k < 6; k++) {
    accumulate(f->own[k] + i - 1, o->own1[k]);
    accumulate(f->own[k] + i, o->own2[k]);
  }
  for (int k = 0; k < 9; k++) accumulate(f->next[k] + i, o->next[k]);
  accumulate(f->spin_own + i - 1, o->spin1);
  accumulate(f->spin_own + i, o->spin2);
  accumulate(f->spin_next + i, o->both);
  put(f->spin_edge, i - 1, o->e1s1);
  put(f->spin_edge, i, o->e2s2);
  put(f->spin_edge + 3, i, o->e2s1);
  put(f->spin_edge + 6, i, o->e1s2);
}

FLAT void between_edges(const frame_args *args, sw_field *f, kind what) {
  for (size_t i = 1; i + 1 < f->plan->nodes; i += LANES) {
    hinge h;
    gather(f, i, &h, what);
    set_hinge(&h, args, what);
    if (f->want & SW_WANT_ENERGY)
      for (int k = 0; k < LANES; k++) f->energy += h.energy[k], f->bending += h.bending[k];
    if (!(f->want & (SW_WANT_FORCE | SW_WANT_STIFFNESS))) continue;
    set_slopes(&h, what);
    if (f->want & SW_WANT_FORCE) {
      const slope g = gradient(&h, what);
      put(f->gradient, i - 1, g.e1);
      put(f->gradient, i, g.e2);
      accumulate(f->spin + i - 1, g.s1);
      accumulate(f->spin + i, g.s2);
    }
    if (!(f->want & SW_WANT_STIFFNESS)) continue;
    blocks o;
    second(&h, &o, args, what);
    scatter(f, i, &o);
  }
}

SW_HOT
static void twisted(const frame_args *args, sw_field *f) { between_edges(args, f, TWISTED); }

SW_HOT
static void curved(const frame_args *args, sw_field *f) { between_edges(args, f, CURVED); }

SW_HOT
static void two(const frame_args *args, sw_field *f) { between_edges(args, f, TWO); }

/* --- clamps, the same hinge in all lanes --------------------------------------------- */

FLAT void spread(vec *out, sw_vec v) { *out = (vec){all(v.x), all(v.y), all(v.z)}; }

/* Sets the hinge between a held frame, treated as an edge of length 1, and an edge. */
FLAT void clamp_hinge(const frame_args *args, const sw_field *f, size_t c, hinge *h) {
  const sw_plan *p = f->plan;
  const sw_clamp_hinge *at = &p->clamps[c];
  const size_t number = p->nodes + c, place = 2 * (size_t)at->hold + (at->side > 0 ? 1 : 0);
  const size_t e = at->edge;
  const int leaves = at->side > 0;
  frame *held = leaves ? &h->a : &h->b, *edge = leaves ? &h->b : &h->a;
  spread(&held->t, sw_vec_at(f->hold_directors, place));
  spread(&held->m1, sw_vec_at(f->hold_normals, place));
  spread(&edge->t, sw_field_tangent(f, e));
  spread(&edge->m1, sw_v(f->normals[0][e], f->normals[1][e], f->normals[2][e]));
  h->ra = all(leaves ? 1.0 : f->reciprocal[e]);
  h->rb = all(leaves ? f->reciprocal[e] : 1.0);
  h->over_length = all(1.0 / at->length);
  h->twist = all(f->hinge_twist[number]);
  h->rest[0] = all(p->rest_bend[2 * number]), h->rest[1] = all(p->rest_bend[2 * number + 1]);
  h->rest_twist = all(p->rest_twist[number]);
  set_hinge(h, args, TWO);
  set_slopes(h, TWO);
}

FLAT sw_vec first_lane(vec v) { return sw_v(v.x[0], v.y[0], v.z[0]); }

FLAT void put_clamp(const frame_args *args, sw_field *f, size_t e, int leaves, const hinge *h) {
  if (f->want & SW_WANT_ENERGY) f->energy += h->energy[0], f->bending += h->bending[0];
  if (f->want & SW_WANT_FORCE) {
    const slope g = gradient(h, TWO);
    double force[3];
    sw_store(force, first_lane(leaves ? g.e2 : g.e1));
    for (int k = 0; k < 3; k++) f->gradient[k][e] += force[k];
    f->spin[e] += leaves ? g.s2[0] : g.s1[0];
  }
  if (!(f->want & SW_WANT_STIFFNESS)) return;
  blocks o;
  double edge[3];
  second(h, &o, args, TWO);
  for (int k = 0; k < 6; k++) f->own[k][e] += leaves ? o.own2[k][0] : o.own1[k][0];
  f->spin_own[e] += leaves ? o.spin2[0] : o.spin1[0];
  sw_store(edge, first_lane(leaves ? o.e2s2 : o.e1s1));
  for (int k = 0; k < 3; k++) f->spin_edge[k][e] += edge[k];
}

SW_HOT
static void at_clamps(const frame_args *args, sw_field *f) {
  for (size_t c = 0; c < f->plan->clamp_count; c++) {
    hinge h;
    clamp_hinge(args, f, c, &h);
    put_clamp(args, f, f->plan->clamps[c].edge, f->plan->clamps[c].side > 0, &h);
  }
}

static sw_status eval(const void *args, sw_field *f, sw_error *err SW_UNUSED) {
  const frame_args *a = args;
  if (a->EI_axis[0] != a->EI_axis[1])
    two(a, f);
  else if (f->plan->beam.curved)
    curved(a, f);
  else
    twisted(a, f);
  at_clamps(args, f);
  return SW_OK;
}

/* Returns the moment on the wire: the energy's derivative by a rotation of the held frame. */
SW_HOT
static sw_vec clamp_moment(const void *args, const sw_field *f, const sw_clamp_hinge *at) {
  hinge h;
  clamp_hinge(args, f, (size_t)(at - f->plan->clamps), &h);
  const slope g = gradient(&h, TWO);
  const sw_vec t = first_lane(at->side > 0 ? h.a.t : h.b.t);
  const sw_vec push = first_lane(at->side > 0 ? g.e1 : g.e2);
  return sw_madd(sw_cross(t, push), t, at->side > 0 ? g.s1[0] : g.s2[0]);
}

const sw_force_class sw_force_frame = {
    .name = "frame",
    .summary = "two bending stiffnesses, natural curvature and local twist",
    .stores = "twist", /* the rest of its energy counts as bend */
    .flags = SW_FORCE_INNER,
    .params = {"force frame", NULL, 0},
    .eval = eval,
    .clamp_moment = clamp_moment,
};
