/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Twist of a straight wire with equal bending stiffness in all directions,
 * quasi-static: torsional waves are much faster than anything a wire does in
 * handling, so the twist spreads evenly over the span between two holds,
 * E = 1/2 (GJ/L) tau^2 with the span's total twist tau [rad] (Kirchhoff; Bergou
 * et al. 2008, section 5). tau is kept by the system: it changes by the holds'
 * turning and by the wire's writhing. Its slope with respect to the two edges of
 * a hinge is kb/(2 l), kb = 2 t1 x t2/(1 + t1.t2). The second derivative is a
 * block part, tau GJ/L times that of tau, and a part of rank one that the system
 * adds (twist_stiffness). Valid while a step turns no span by more than pi. */
#include <math.h>
#include <string.h>

#include "force/force.h"

typedef struct twist_args {
  double GJ; /* [N m2] */
} twist_args;

/* What a hinge between tangents t1, t2 contributes. */
typedef struct corner {
  double t1[3], t2[3], kb[3], mean[3]; /* mean = (t1 + t2)/(1 + t1.t2) */
  double over; /* 1/(1 + t1.t2) */
} corner;

static const double SHARPEST = 1e-3; /* least 1 + t1.t2: about 177 degrees [-] */

static corner corner_of(const double t1[3], const double t2[3]) {
  corner c;
  const double dot = t1[0] * t2[0] + t1[1] * t2[1] + t1[2] * t2[2];
  c.over = 1.0 / fmax(SHARPEST, 1.0 + dot);
  for (int k = 0; k < 3; k++) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    c.t1[k] = t1[k];
    c.t2[k] = t2[k];
    c.kb[k] = 2.0 * c.over * (t1[i] * t2[j] - t1[j] * t2[i]);
    c.mean[k] = (t1[k] + t2[k]) * c.over;
  }
  return c;
}

/* own += f d2(twist)/de2 for the edge with tangent t and 1/l = r */
static void add_own(sw_field *f, size_t e, const corner *c, const double t[3], double factor) {
  const double w = -0.25 * factor * f->reciprocal[e] * f->reciprocal[e];
  for (int i = 0, at = 0; i < 3; i++)
    for (int j = i; j < 3; j++, at++)
      f->own[at][e] += w * (c->kb[i] * (t[j] + c->mean[j]) + (t[i] + c->mean[i]) * c->kb[j]);
}

/* next += f d2(twist)/de1 de2 at the hinge between edges i - 1 and i */
static void add_next(sw_field *f, size_t i, const corner *c, double factor) {
  const double w = 0.5 * factor * f->reciprocal[i - 1] * f->reciprocal[i];
  const double *t = c->t1, s = 2.0 * c->over;
  const double cross[9] = {0, -t[2], t[1], t[2], 0, -t[0], -t[1], t[0], 0};
  for (int a = 0; a < 3; a++)
    for (int b = 0; b < 3; b++)
      f->next[3 * a + b][i] += w * (s * cross[3 * a + b] - c->kb[a] * c->mean[b]);
}

static void tangent(const sw_field *f, size_t e, double t[3]) {
  for (int k = 0; k < 3; k++) t[k] = f->tangent[k][e];
}

static const double *director(const sw_field *f, const sw_clamp_hinge *h) {
  return f->hold_directors + 3 * (2 * (size_t)h->hold + (h->side > 0 ? 1 : 0));
}

/* A hinge's part of the slope on one edge, and of the block second derivative. */
static void edge_part(sw_field *f, size_t e, const corner *c, const double t[3], double torque) {
  for (int k = 0; k < 3; k++)
    f->twist_slope[3 * e + (size_t)k] += 0.5 * c->kb[k] * f->reciprocal[e];
  if (f->want & SW_WANT_STIFFNESS) add_own(f, e, c, t, torque);
}

static void span_part(const sw_span *span, double torque, sw_field *f) {
  const sw_clamp_hinge *left = &f->plan->clamps[span->left];
  const sw_clamp_hinge *right = &f->plan->clamps[span->right];
  double a[3], b[3];
  tangent(f, span->first, b);
  corner c = corner_of(director(f, left), b);
  edge_part(f, span->first, &c, b, torque);
  for (size_t i = span->first + 1; i <= span->last; i++) {
    memcpy(a, b, sizeof a);
    tangent(f, i, b);
    c = corner_of(a, b);
    edge_part(f, i - 1, &c, a, torque);
    edge_part(f, i, &c, b, torque);
    if (f->want & SW_WANT_STIFFNESS) add_next(f, i, &c, torque);
  }
  c = corner_of(b, director(f, right));
  edge_part(f, span->last, &c, b, torque);
}

static sw_status eval(const void *args, sw_field *f, sw_error *err) {
  const double GJ = ((const twist_args *)args)->GJ;
  (void)err;
  if (!f->twist) return SW_OK;
  for (size_t k = 0; k < f->plan->span_count; k++) {
    const sw_span *span = &f->plan->spans[k];
    const double stiffness = GJ / span->length, torque = stiffness * f->twist[k];
    if (f->want & SW_WANT_ENERGY) f->energy += 0.5 * torque * f->twist[k];
    if (!(f->want & (SW_WANT_FORCE | SW_WANT_STIFFNESS))) continue;
    memset(f->twist_slope + 3 * span->first, 0,
           3 * (span->last + 1 - span->first) * sizeof(double));
    span_part(span, torque, f);
    for (size_t e = span->first; e <= span->last; e++)
      for (size_t c = 0; c < 3; c++) f->gradient[c][e] += torque * f->twist_slope[3 * e + c];
    f->twist_stiffness[k] += stiffness;
  }
  return SW_OK;
}

/* The torque at the held end, about the mean of director and edge. A positive
 * twist turns the span's end against its start. */
static sw_vec clamp_moment(const void *args, const sw_field *f, const sw_clamp_hinge *h) {
  const double GJ = ((const twist_args *)args)->GJ;
  for (size_t k = 0; f->twist && k < f->plan->span_count; k++) {
    const sw_span *span = &f->plan->spans[k];
    const int starts = h == &f->plan->clamps[span->left];
    if (!starts && h != &f->plan->clamps[span->right]) continue;
    double t[3];
    tangent(f, h->edge, t);
    const corner c = corner_of(director(f, h), t);
    const double torque = GJ / span->length * f->twist[k] * (starts ? -1.0 : 1.0);
    return sw_scale(sw_load(c.mean), torque);
  }
  return sw_v(0, 0, 0);
}

const sw_force_class sw_force_twist = {
    .name = "twist",
    .summary = "torque of the twist between two holds, straight isotropic wire",
    .flags = SW_FORCE_INNER,
    .params = {"force twist", NULL, 0},
    .eval = eval,
    .clamp_moment = clamp_moment,
};
