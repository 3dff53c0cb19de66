/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What material frames add to a rod: two bending stiffnesses, natural curvature,
 * twist with a value at every hinge (discrete elastic rods, Bergou et al. 2008 and
 * 2010). Of the bending energy 1/2 k1 (b1 - b1')^2 + 1/2 k2 (b2 - b2')^2, b as in
 * state/hinge.h and b' its unloaded value, bend.c has 1/2 k (b1^2 + b2^2), k the
 * smaller stiffness; here is the rest.
 *
 * Derivatives are with respect to the edge vectors, frames being carried along
 * without turning about themselves, and to that turn. They are exact; the second
 * ones are made symmetric, which they are where no spin is out of balance. Each
 * part of b is g phi/sin(phi) q with q = (m_a . t_b - m_b . t_a)/2, g the gain. */
#include <math.h>

#include "force/force.h"
#include "state/hinge.h"

typedef struct frame_args {
  double EI; /* what bend has [N m2] */
  double EI_axis[2];
  double GJ; /* [N m2] */
} frame_args;

/* A derivative with respect to both edges and both spins. */
typedef struct slope {
  sw_vec e1, e2;
  double s1, s2;
} slope;

typedef struct hinge {
  sw_edge_frame a, b;
  double ra, rb; /* 1/length of the edges [1/m] */
  double excess[2], twist_stiffness; /* over bend's; [N m] */
  double push[2], torque; /* d energy / d bend, d energy / d twist [N m] */
  double cosine, s, w, u;
  sw_hinge_gain gain;
  sw_vec ma[2], mb[2]; /* material axes */
  sw_vec across_a, across_b; /* the other tangent's part across this one */
  double q[2];
  slope gq[2], gc, gb[2], gm; /* of q, cosine, bend without gain, twist */
} hinge;

typedef struct blocks {
  double own1[6], own2[6], next[9];
  double spin1, spin2, both;
  sw_vec e1s1, e1s2, e2s1, e2s2;
} blocks;

static double value(const slope *g, int row, int second) {
  const sw_vec v = second ? g->e2 : g->e1;
  return row == 0 ? v.x : row == 1 ? v.y : v.z;
}

static slope add_slopes(const slope *g, double f, const slope *h, double k) {
  return (slope){sw_madd(sw_scale(g->e1, f), h->e1, k), sw_madd(sw_scale(g->e2, f), h->e2, k),
                 f * g->s1 + k * h->s1, f * g->s2 + k * h->s2};
}

/* Slopes of the cosine, of q and of the twist. */
static void set_slopes(hinge *h) {
  const sw_vec a = h->a.t, b = h->b.t;
  const double c = h->cosine, over = 1.0 / fmax(1e-3, 1.0 + c);
  h->across_a = sw_madd(b, a, -c);
  h->across_b = sw_madd(a, b, -c);
  h->gc = (slope){sw_scale(h->across_a, h->ra), sw_scale(h->across_b, h->rb), 0, 0};
  for (int j = 0; j < 2; j++) {
    const sw_vec ma = h->ma[j], mb = h->mb[j];
    const sw_vec pa = sw_madd(mb, a, -sw_dot(mb, a)), pb = sw_madd(ma, b, -sw_dot(ma, b));
    const double sign = j == 0 ? 0.5 : -0.5; /* turning takes m1 to m2, m2 to -m1 */
    h->gq[j] = (slope){sw_scale(sw_madd(pa, ma, c), -0.5 * h->ra),
                       sw_scale(sw_madd(pb, mb, c), 0.5 * h->rb),
                       sign * sw_dot(h->ma[1 - j], b), -sign * sw_dot(h->mb[1 - j], a)};
    h->gb[j] = add_slopes(&h->gq[j], h->s, &h->gc, -h->w * h->q[j]);
  }
  const sw_vec kb = sw_scale(sw_cross(a, b), over);
  h->gm = (slope){sw_scale(kb, h->ra), sw_scale(kb, h->rb), -1.0, 1.0};
}

/* Sum of push times bend without gain: what the gain's derivatives come with. */
static double pushed(const hinge *h) {
  return h->s * (h->push[0] * h->q[0] + h->push[1] * h->q[1]);
}

/* number: of the hinge in the plan's lists */
static double set_hinge(hinge *h, const frame_args *args, const sw_plan *p, size_t number,
                        double length, double twist, double *bending) {
  const double *rest = p->rest_bend + 2 * number;
  double energy = 0;
  h->cosine = 1.0 - 0.5 * sw_norm2(sw_sub(h->a.t, h->b.t));
  h->u = 0.5 * (1.0 - h->cosine);
  sw_angle_factors(h->u, &h->s, &h->w);
  h->gain = sw_hinge_gain_of(twist);
  h->ma[0] = h->a.m1, h->ma[1] = sw_cross(h->a.t, h->a.m1);
  h->mb[0] = h->b.m1, h->mb[1] = sw_cross(h->b.t, h->b.m1);
  for (int j = 0; j < 2; j++) {
    const double k = args->EI_axis[j] / length;
    h->q[j] = 0.5 * (sw_dot(h->ma[j], h->b.t) - sw_dot(h->mb[j], h->a.t));
    const double bend = h->gain.g * h->s * h->q[j];
    h->excess[j] = (args->EI_axis[j] - args->EI) / length;
    h->push[j] = h->excess[j] * bend - k * rest[j];
    energy += 0.5 * h->excess[j] * bend * bend + k * rest[j] * (0.5 * rest[j] - bend);
  }
  *bending = energy;
  const double off = twist - p->rest_twist[number];
  h->twist_stiffness = args->GJ / length;
  h->torque = h->twist_stiffness * off;
  return energy + 0.5 * h->torque * off;
}

static slope gradient(const hinge *h) {
  const slope bend = add_slopes(&h->gb[0], h->push[0], &h->gb[1], h->push[1]);
  return add_slopes(&bend, h->gain.g, &h->gm, h->torque + h->gain.slope * pushed(h));
}

/* --- second derivatives -------------------------------------------------------- */

/* out += x y' + y x' */
static inline void add_pair(double out[6], sw_vec x, sw_vec y) {
  out[0] += 2.0 * x.x * y.x;
  out[1] += x.x * y.y + y.x * x.y;
  out[2] += x.x * y.z + y.x * x.z;
  out[3] += 2.0 * x.y * y.y;
  out[4] += x.y * y.z + y.y * x.z;
  out[5] += 2.0 * x.z * y.z;
}

/* out += x y' */
static inline void add_product(double out[9], sw_vec x, sw_vec y) {
  out[0] += x.x * y.x, out[1] += x.x * y.y, out[2] += x.x * y.z;
  out[3] += x.y * y.x, out[4] += x.y * y.y, out[5] += x.y * y.z;
  out[6] += x.z * y.x, out[7] += x.z * y.y, out[8] += x.z * y.z;
}

/* g k' + k g' over all unknowns */
static void add_slope_pair(blocks *o, const slope *g, const slope *k) {
  add_pair(o->own1, g->e1, k->e1);
  add_pair(o->own2, g->e2, k->e2);
  add_product(o->next, g->e1, k->e2);
  add_product(o->next, k->e1, g->e2);
  o->e1s1 = sw_madd(sw_madd(o->e1s1, g->e1, k->s1), k->e1, g->s1);
  o->e1s2 = sw_madd(sw_madd(o->e1s2, g->e1, k->s2), k->e1, g->s2);
  o->e2s1 = sw_madd(sw_madd(o->e2s1, g->e2, k->s1), k->e2, g->s1);
  o->e2s2 = sw_madd(sw_madd(o->e2s2, g->e2, k->s2), k->e2, g->s2);
  o->spin1 += 2.0 * g->s1 * k->s1;
  o->spin2 += 2.0 * g->s2 * k->s2;
  o->both += g->s1 * k->s2 + k->s1 * g->s2;
}

static void add_square(blocks *o, const slope *g, double factor) {
  const slope half = add_slopes(g, 0.5 * factor, g, 0.0);
  add_slope_pair(o, &half, g);
}

/* out += f (I - t t') */
static inline void add_across(double out[6], sw_vec t, double f) {
  out[0] += f, out[3] += f, out[5] += f;
  add_pair(out, t, sw_scale(t, -0.5 * f));
}

/* f times the second derivative of the cosine */
static void add_cosine(blocks *o, const hinge *h, double f) {
  const sw_vec a = h->a.t, b = h->b.t;
  const double f1 = -f * h->ra * h->ra, f2 = -f * h->rb * h->rb, f3 = f * h->ra * h->rb;
  add_across(o->own1, a, f1 * h->cosine);
  add_pair(o->own1, a, sw_scale(h->across_a, f1));
  add_across(o->own2, b, f2 * h->cosine);
  add_pair(o->own2, b, sw_scale(h->across_b, f2));
  o->next[0] += f3, o->next[4] += f3, o->next[8] += f3;
  add_product(o->next, a, sw_scale(h->across_b, -f3));
  add_product(o->next, b, sw_scale(b, -f3));
}

/* s times the second derivative of f1 q1 + f2 q2; ma, mb: the axes summed with those
 * factors */
static void add_q(blocks *o, const hinge *h, sw_vec ma, sw_vec mb) {
  const sw_vec a = h->a.t, b = h->b.t;
  const double c = h->cosine, f = 0.5 * h->s, ab = sw_dot(a, mb), ba = sw_dot(b, ma);
  const double f1 = f * h->ra * h->ra, f2 = -f * h->rb * h->rb, f3 = -f * h->ra * h->rb;
  const sw_vec va = sw_madd(sw_madd(mb, a, -ab), ma, c), vb = sw_madd(sw_madd(ma, b, -ba), mb, c);
  add_pair(o->own1, va, sw_scale(a, f1));
  add_across(o->own1, a, f1 * ab);
  add_pair(o->own1, ma, sw_scale(h->across_a, -0.5 * f1));
  add_pair(o->own2, vb, sw_scale(b, f2));
  add_across(o->own2, b, f2 * ba);
  add_pair(o->own2, mb, sw_scale(h->across_b, -0.5 * f2));
  add_product(o->next, ma, sw_scale(h->across_b, f3));
  add_product(o->next, h->across_a, sw_scale(mb, -f3));
  const sw_vec ta = sw_cross(a, ma), tb = sw_cross(b, mb); /* turned by a right angle */
  o->e1s1 = sw_madd(o->e1s1, ta, -f * h->ra * c);
  o->e1s2 = sw_madd(o->e1s2, sw_madd(tb, a, -sw_dot(tb, a)), -f * h->ra);
  o->e2s1 = sw_madd(o->e2s1, sw_madd(ta, b, -sw_dot(ta, b)), f * h->rb);
  o->e2s2 = sw_madd(o->e2s2, tb, f * h->rb * c);
  o->spin1 -= f * ba;
  o->spin2 += f * ab;
}

/* f times the second derivative of the twist */
static void add_twist(blocks *o, const hinge *h, double f) {
  const sw_vec a = h->a.t, b = h->b.t;
  const double over = 1.0 / fmax(1e-3, 1.0 + h->cosine), f3 = 0.5 * f * h->ra * h->rb;
  const sw_vec kb = sw_scale(sw_cross(a, b), 2.0 * over), mean = sw_scale(sw_add(a, b), over);
  add_pair(o->own1, kb, sw_scale(sw_add(a, mean), -0.25 * f * h->ra * h->ra));
  add_pair(o->own2, kb, sw_scale(sw_add(b, mean), -0.25 * f * h->rb * h->rb));
  add_product(o->next, kb, sw_scale(mean, -f3));
  const double x = 2.0 * over * f3;
  o->next[1] -= x * a.z, o->next[2] += x * a.y, o->next[3] += x * a.z;
  o->next[5] -= x * a.x, o->next[6] -= x * a.y, o->next[7] += x * a.x;
}

static void second(const hinge *h, blocks *o) {
  const double all = pushed(h), f0 = h->push[0] * h->gain.g, f1 = h->push[1] * h->gain.g;
  *o = (blocks){0};
  add_square(o, &h->gm, h->twist_stiffness + all * h->gain.curve);
  const double torque = h->torque + all * h->gain.slope;
  if (torque != 0) add_twist(o, h, torque);
  for (int j = 0; j < 2; j++) {
    if (h->excess[j] == 0) continue;
    const slope whole =
        add_slopes(&h->gb[j], h->gain.g, &h->gm, h->gain.slope * h->s * h->q[j]);
    add_square(o, &whole, h->excess[j]);
  }
  if (f0 == 0 && f1 == 0) return;
  if (h->gain.slope != 0) {
    const slope bend = add_slopes(&h->gb[0], h->push[0], &h->gb[1], h->push[1]);
    const slope part = add_slopes(&bend, h->gain.slope, &bend, 0.0);
    add_slope_pair(o, &part, &h->gm);
  }
  const double sum = f0 * h->q[0] + f1 * h->q[1];
  const slope g = add_slopes(&h->gq[0], f0, &h->gq[1], f1);
  const double third = sw_angle_third(h->u, h->s, h->w);
  const slope mix = add_slopes(&g, -h->w, &h->gc, 0.5 * sum * third);
  add_slope_pair(o, &mix, &h->gc);
  add_cosine(o, h, -h->w * sum);
  add_q(o, h, sw_madd(sw_scale(h->ma[0], f0), h->ma[1], f1),
        sw_madd(sw_scale(h->mb[0], f0), h->mb[1], f1));
}

/* --- into the field ------------------------------------------------------------ */

static sw_edge_frame edge_frame(const sw_field *f, size_t e) {
  return (sw_edge_frame){sw_v(f->tangent[0][e], f->tangent[1][e], f->tangent[2][e]),
                         sw_vec_at(f->normals, e)};
}

static sw_edge_frame hold_frame(const sw_field *f, const sw_clamp_hinge *c) {
  const size_t at = 2 * (size_t)c->hold + (c->side > 0 ? 1 : 0);
  return (sw_edge_frame){sw_vec_at(f->hold_directors, at), sw_vec_at(f->hold_normals, at)};
}

static void put_edge(sw_field *f, size_t e, const slope *g, int is_second) {
  for (int k = 0; k < 3; k++) f->gradient[k][e] += value(g, k, is_second);
  f->spin[e] += is_second ? g->s2 : g->s1;
}

static void put_own(sw_field *f, size_t e, const blocks *o, int is_second) {
  for (int k = 0; k < 6; k++) f->own[k][e] += is_second ? o->own2[k] : o->own1[k];
  f->spin_own[e] += is_second ? o->spin2 : o->spin1;
  sw_accumulate(f->spin_edge[0] + 3 * e, is_second ? o->e2s2 : o->e1s1);
}

static void between_edges(const frame_args *args, sw_field *f, size_t i) {
  const sw_plan *p = f->plan;
  hinge h;
  double bending;
  h.a = edge_frame(f, i - 1), h.b = edge_frame(f, i);
  h.ra = f->reciprocal[i - 1], h.rb = f->reciprocal[i];
  const double energy = set_hinge(&h, args, p, i, p->hinge[i], f->hinge_twist[i], &bending);
  if (f->want & SW_WANT_ENERGY) f->energy += energy, f->bending += bending;
  if (!(f->want & (SW_WANT_FORCE | SW_WANT_STIFFNESS))) return;
  set_slopes(&h);
  if (f->want & SW_WANT_FORCE) {
    const slope g = gradient(&h);
    put_edge(f, i - 1, &g, 0);
    put_edge(f, i, &g, 1);
  }
  if (!(f->want & SW_WANT_STIFFNESS)) return;
  blocks o;
  second(&h, &o);
  put_own(f, i - 1, &o, 0);
  put_own(f, i, &o, 1);
  for (int k = 0; k < 9; k++) f->next[k][i] += o.next[k];
  f->spin_next[i] += o.both;
  sw_accumulate(f->spin_edge[1] + 3 * i, o.e2s1);
  sw_accumulate(f->spin_edge[2] + 3 * i, o.e1s2);
}

/* The hinge between a held frame, as an edge of length 1, and an edge. */
static double clamp_hinge(const frame_args *args, const sw_field *f, size_t c, hinge *h,
                          double *bending) {
  const sw_clamp_hinge *at = &f->plan->clamps[c];
  const sw_edge_frame held = hold_frame(f, at), edge = edge_frame(f, at->edge);
  const int leaves = at->side > 0;
  h->a = leaves ? held : edge;
  h->b = leaves ? edge : held;
  h->ra = leaves ? 1.0 : f->reciprocal[at->edge];
  h->rb = leaves ? f->reciprocal[at->edge] : 1.0;
  const size_t number = f->plan->nodes + c;
  const double energy =
      set_hinge(h, args, f->plan, number, at->length, f->hinge_twist[number], bending);
  set_slopes(h);
  return energy;
}

static sw_status eval(const void *args, sw_field *f, sw_error *err) {
  const sw_plan *p = f->plan;
  (void)err;
  for (size_t i = 1; i + 1 < p->nodes; i++)
    if (p->hinge[i] > 0) between_edges(args, f, i);
  for (size_t c = 0; c < p->clamp_count; c++) {
    const int leaves = p->clamps[c].side > 0;
    hinge h;
    double bending;
    const double energy = clamp_hinge(args, f, c, &h, &bending);
    if (f->want & SW_WANT_ENERGY) f->energy += energy, f->bending += bending;
    const slope g = gradient(&h);
    if (f->want & SW_WANT_FORCE) put_edge(f, p->clamps[c].edge, &g, leaves);
    if (!(f->want & SW_WANT_STIFFNESS)) continue;
    blocks o;
    second(&h, &o);
    put_own(f, p->clamps[c].edge, &o, leaves);
  }
  return SW_OK;
}

/* What turning the held frame would cost: the moment on the wire. */
static sw_vec clamp_moment(const void *args, const sw_field *f, const sw_clamp_hinge *at) {
  hinge h;
  double bending;
  clamp_hinge(args, f, (size_t)(at - f->plan->clamps), &h, &bending);
  const slope g = gradient(&h);
  return at->side > 0 ? sw_madd(sw_cross(h.a.t, g.e1), h.a.t, g.s1)
                      : sw_madd(sw_cross(h.b.t, g.e2), h.b.t, g.s2);
}

const sw_force_class sw_force_frame = {
    .name = "frame",
    .summary = "two bending stiffnesses, natural curvature and local twist",
    .stores = "twist", /* beside what counts as bend */
    .flags = SW_FORCE_INNER,
    .params = {"force frame", NULL, 0},
    .eval = eval,
    .clamp_moment = clamp_moment,
};
