/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Second derivatives of the hinge of frame.c, four hinges at a time. Private to that file. */
#ifndef SW_FORCE_FRAME_H
#define SW_FORCE_FRAME_H

#include "force/frame_first.h"

/* out += x y' + y x' */
FLAT void add_pair(lane out[6], vec x, vec y) {
  out[0] += 2.0 * x.x * y.x;
  out[1] += x.x * y.y + y.x * x.y;
  out[2] += x.x * y.z + y.x * x.z;
  out[3] += 2.0 * x.y * y.y;
  out[4] += x.y * y.z + y.y * x.z;
  out[5] += 2.0 * x.z * y.z;
}

/* out += x y', for x and y whose product is symmetric */
FLAT void add_symmetric(lane out[6], vec x, vec y) {
  out[0] += x.x * y.x;
  out[1] += x.x * y.y;
  out[2] += x.x * y.z;
  out[3] += x.y * y.y;
  out[4] += x.y * y.z;
  out[5] += x.z * y.z;
}

/* out += x y' */
FLAT void add_product(lane out[9], vec x, vec y) {
  out[0] += x.x * y.x, out[1] += x.x * y.y, out[2] += x.x * y.z;
  out[3] += x.y * y.x, out[4] += x.y * y.y, out[5] += x.y * y.z;
  out[6] += x.z * y.x, out[7] += x.z * y.y, out[8] += x.z * y.z;
}

/* Adds g k' + k g' over the edges, and the products of k's edges with g's spins. */
FLAT void add_edge_pair(blocks *o, const slope *g, const slope *k) {
  add_pair(o->own1, g->e1, k->e1);
  add_pair(o->own2, g->e2, k->e2);
  add_product(o->next, g->e1, k->e2);
  add_product(o->next, k->e1, g->e2);
  o->e1s1 = madd(o->e1s1, k->e1, g->s1);
  o->e1s2 = madd(o->e1s2, k->e1, g->s2);
  o->e2s1 = madd(o->e2s1, k->e2, g->s1);
  o->e2s2 = madd(o->e2s2, k->e2, g->s2);
}

/* Adds g k' + k g' over all unknowns. */
FLAT void add_slope_pair(blocks *o, const slope *g, const slope *k) {
  add_edge_pair(o, g, k);
  o->e1s1 = madd(o->e1s1, g->e1, k->s1);
  o->e1s2 = madd(o->e1s2, g->e1, k->s2);
  o->e2s1 = madd(o->e2s1, g->e2, k->s1);
  o->e2s2 = madd(o->e2s2, g->e2, k->s2);
  o->spin1 += 2.0 * g->s1 * k->s1;
  o->spin2 += 2.0 * g->s2 * k->s2;
  o->both += g->s1 * k->s2 + k->s1 * g->s2;
}

FLAT void add_square(blocks *o, const slope *g, lane factor) {
  const vec e1 = scale(g->e1, factor), e2 = scale(g->e2, factor);
  const lane s1 = factor * g->s1, s2 = factor * g->s2;
  add_symmetric(o->own1, e1, g->e1);
  add_symmetric(o->own2, e2, g->e2);
  add_product(o->next, e1, g->e2);
  o->e1s1 = madd(o->e1s1, g->e1, s1);
  o->e1s2 = madd(o->e1s2, g->e1, s2);
  o->e2s1 = madd(o->e2s1, g->e2, s1);
  o->e2s2 = madd(o->e2s2, g->e2, s2);
  o->spin1 += s1 * g->s1;
  o->spin2 += s2 * g->s2;
  o->both += s1 * g->s2;
}

/* out += f (I - t t') */
FLAT void add_across(lane out[6], vec t, lane f) {
  out[0] += f, out[3] += f, out[5] += f;
  add_pair(out, t, scale(t, -0.5 * f));
}

/* Adds f times the second derivative of the cosine. */
FLAT void add_cosine(blocks *o, const hinge *h, lane f) {
  const vec a = h->a.t, b = h->b.t;
  const lane f1 = -f * h->ra * h->ra, f2 = -f * h->rb * h->rb, f3 = f * h->ra * h->rb;
  add_across(o->own1, a, f1 * h->cosine);
  add_pair(o->own1, a, scale(h->across_a, f1));
  add_across(o->own2, b, f2 * h->cosine);
  add_pair(o->own2, b, scale(h->across_b, f2));
  o->next[0] += f3, o->next[4] += f3, o->next[8] += f3;
  add_product(o->next, a, scale(h->across_b, -f3));
  add_product(o->next, b, scale(b, -f3));
}

/* Adds s times the second derivative of f1 q1 + f2 q2; ma, mb: the axes summed with these
 * factors. */
FLAT void add_q(blocks *o, const hinge *h, vec ma, vec mb) {
  const vec a = h->a.t, b = h->b.t;
  const lane c = h->cosine, f = 0.5 * h->s, ab = dot(a, mb), ba = dot(b, ma);
  const lane f1 = f * h->ra * h->ra, f2 = -f * h->rb * h->rb, f3 = -f * h->ra * h->rb;
  const vec va = madd(madd(mb, a, -ab), ma, c), vb = madd(madd(ma, b, -ba), mb, c);
  add_pair(o->own1, va, scale(a, f1));
  add_across(o->own1, a, f1 * ab);
  add_pair(o->own1, ma, scale(h->across_a, -0.5 * f1));
  add_pair(o->own2, vb, scale(b, f2));
  add_across(o->own2, b, f2 * ba);
  add_pair(o->own2, mb, scale(h->across_b, -0.5 * f2));
  add_product(o->next, ma, scale(h->across_b, f3));
  add_product(o->next, h->across_a, scale(mb, -f3));
  const vec ta = cross(a, ma), tb = cross(b, mb); /* turned by 90 degrees */
  o->e1s1 = madd(o->e1s1, ta, -f * h->ra * c);
  o->e1s2 = madd(o->e1s2, madd(tb, a, -dot(tb, a)), -f * h->ra);
  o->e2s1 = madd(o->e2s1, madd(ta, b, -dot(ta, b)), f * h->rb);
  o->e2s2 = madd(o->e2s2, tb, f * h->rb * c);
  o->spin1 -= f * ba;
  o->spin2 += f * ab;
}

/* Adds f times the second derivative of the twist. */
FLAT void add_twist(blocks *o, const hinge *h, lane f) {
  const vec a = h->a.t, b = h->b.t;
  const lane over = h->over, f3 = 0.5 * f * h->ra * h->rb;
  const vec kb = scale(cross(a, b), 2.0 * over), mean = scale(add(a, b), over);
  add_pair(o->own1, kb, scale(add(a, mean), -0.25 * f * h->ra * h->ra));
  add_pair(o->own2, kb, scale(add(b, mean), -0.25 * f * h->rb * h->rb));
  add_product(o->next, kb, scale(mean, -f3));
  const lane x = 2.0 * over * f3;
  o->next[1] -= x * a.z, o->next[2] += x * a.y, o->next[3] += x * a.z;
  o->next[5] -= x * a.x, o->next[6] -= x * a.y, o->next[7] += x * a.x;
}

FLAT void second(const hinge *h, blocks *o, const frame_args *args, kind what) {
  *o = (blocks){0};
  if (what == TWISTED) {
    add_square(o, &h->gm, h->twist_stiffness);
    add_twist(o, h, h->torque);
    return;
  }
  const lane whole = pushed(h), f0 = h->push[0] * h->gain, f1 = h->push[1] * h->gain;
  add_square(o, &h->gm, h->twist_stiffness + whole * h->gain_curve);
  add_twist(o, h, h->torque + whole * h->gain_slope);
  for (int j = 0; j < 2 && what == TWO; j++) {
    if (args->EI_axis[j] == args->EI) continue; /* true for at least one j */
    const slope g = add_slopes(&h->gb[j], h->gain, &h->gm, h->gain_slope * h->s * h->q[j]);
    add_square(o, &g, h->excess[j]);
  }
  const slope bend = add_slopes(&h->gb[0], h->push[0], &h->gb[1], h->push[1]);
  const slope part = scale_slope(&bend, h->gain_slope);
  add_slope_pair(o, &part, &h->gm);
  const lane sum = f0 * h->q[0] + f1 * h->q[1];
  const slope g = add_slopes(&h->gq[0], f0, &h->gq[1], f1);
  const slope mix = add_slopes(&g, -h->w, &h->gc, 0.5 * sum * h->third);
  add_edge_pair(o, &mix, &h->gc); /* the cosine does not depend on spins */
  add_cosine(o, h, -h->w * sum);
  add_q(o, h, madd(scale(h->ma[0], f0), h->ma[1], f1), madd(scale(h->mb[0], f0), h->mb[1], f1));
}

#endif
