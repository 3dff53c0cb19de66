/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Quasi-static twist of a straight wire with equal bending stiffness in all directions. Torsional
 * waves are much faster than anything a wire does in handling, so the twist is uniform over the
 * span between two holds: E = 1/2 (GJ/L) tau^2 with the span's total twist tau [rad] (Kirchhoff;
 * Bergou et al. 2008, section 5). The system keeps tau, which changes with the holds' turning and
 * the wire's writhing. Its slope with respect to the two edges of a hinge is kb/(2 l), kb = 2 t1 x
 * t2/(1 + t1.t2). The second derivative has a block part, tau GJ/L times that of tau, and a
 * rank-one part that the system adds (twist_stiffness). Valid while a step turns no span by more
 * than pi. */
#include <math.h>

#include "base/simd.h"
#include "force/force.h"

typedef struct twist_args {
  double GJ; /* [N m2] */
} twist_args;

/* Contribution of a hinge between tangents t1, t2. */
typedef struct corner {
  double kb[3], mean[3]; /* mean = (t1 + t2)/(1 + t1.t2) */
} corner;

static const double SHARPEST = 1e-3; /* least 1 + t1.t2: about 177 degrees [-] */

static corner corner_of(const double t1[3], const double t2[3]) {
  corner c;
  const double dot = t1[0] * t2[0] + t1[1] * t2[1] + t1[2] * t2[2];
  const double over = 1.0 / fmax(SHARPEST, 1.0 + dot);
  for (int k = 0; k < 3; k++) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    c.kb[k] = 2.0 * over * (t1[i] * t2[j] - t1[j] * t2[i]);
    c.mean[k] = (t1[k] + t2[k]) * over;
  }
  return c;
}

static void tangent(const sw_field *f, size_t e, double t[3]) {
  for (int k = 0; k < 3; k++) t[k] = f->tangent[k][e];
}

static const double *director(const sw_field *f, const sw_clamp_hinge *h) {
  return f->hold_directors + 3 * sw_clamp_place(h);
}

/* Adds a clamp's part of the slope on its edge, and of the block second derivative. */
static void clamp_part(sw_field *f, const sw_clamp_hinge *h, double torque) {
  const size_t e = h->edge;
  double t[3];
  tangent(f, e, t);
  const corner c = h->side > 0 ? corner_of(director(f, h), t) : corner_of(t, director(f, h));
  for (int k = 0; k < 3; k++) f->twist_slope[k][e] += 0.5 * c.kb[k] * f->reciprocal[e];
  if (!(f->want & SW_WANT_STIFFNESS)) return;
  const double w = -0.25 * torque * f->reciprocal[e] * f->reciprocal[e];
  for (int i = 0, at = 0; i < 3; i++)
    for (int j = i; j < 3; j++, at++)
      f->own[at][e] += w * (c.kb[i] * (t[j] + c.mean[j]) + (t[i] + c.mean[i]) * c.kb[j]);
}

/* Fills scratch 0..3 with kb and 1/(1 + t1.t2) of hinges first + 1 .. last. */
SW_HOT
static void corners(size_t first, size_t last, const double *restrict tx, const double *restrict ty,
                    const double *restrict tz, double *restrict kx, double *restrict ky,
                    double *restrict kz, double *restrict over) {
  for (size_t i = first + 1; i <= last; i++) {
    const double ax = tx[i - 1], ay = ty[i - 1], az = tz[i - 1];
    const double bx = tx[i], by = ty[i], bz = tz[i];
    const double sum = 1.0 + (ax * bx + ay * by + az * bz);
    const double r = 1.0 / (sum > SHARPEST ? sum : SHARPEST);
    kx[i] = 2.0 * r * (ay * bz - az * by);
    ky[i] = 2.0 * r * (az * bx - ax * bz);
    kz[i] = 2.0 * r * (ax * by - ay * bx);
    over[i] = r;
  }
}

/* slope of edge e = (kb of the hinge before + kb of the hinge after)/(2 l) */
SW_HOT
static void slopes(size_t first, size_t last, const double *restrict k,
                   const double *restrict reciprocal, double *restrict slope) {
  for (size_t e = first; e <= last; e++) slope[e] = 0;
  for (size_t e = first + 1; e <= last; e++) slope[e] += 0.5 * k[e] * reciprocal[e];
  for (size_t e = first; e < last; e++) slope[e] += 0.5 * k[e + 1] * reciprocal[e];
}

/* own += -(f/4l^2) (kb (t + m)' + (t + m) kb'), m = (t1 + t2)/(1 + t1.t2), for the
 * edge at shift (0: second edge of the hinge, -1: first) */
SW_HOT
static void add_own(size_t first, size_t last, long shift, double factor, const double *restrict kx,
                    const double *restrict ky, const double *restrict kz,
                    const double *restrict over, const double *restrict rl,
                    const double *restrict tx, const double *restrict ty, const double *restrict tz,
                    double *restrict o0, double *restrict o1, double *restrict o2,
                    double *restrict o3, double *restrict o4, double *restrict o5) {
  for (long i = (long)first + 1; i <= (long)last; i++) {
    const long e = i + shift;
    const double w = -0.25 * factor * rl[e] * rl[e], r = over[i];
    const double sx = w * (tx[e] + r * (tx[i - 1] + tx[i]));
    const double sy = w * (ty[e] + r * (ty[i - 1] + ty[i]));
    const double sz = w * (tz[e] + r * (tz[i - 1] + tz[i]));
    o0[e] += 2.0 * kx[i] * sx;
    o1[e] += kx[i] * sy + ky[i] * sx;
    o2[e] += kx[i] * sz + kz[i] * sx;
    o3[e] += 2.0 * ky[i] * sy;
    o4[e] += ky[i] * sz + kz[i] * sy;
    o5[e] += 2.0 * kz[i] * sz;
  }
}

/* next += (f/2 l1 l2) (2/(1 + t1.t2) [t1]x - kb m') */
SW_HOT
static void add_next(size_t first, size_t last, double factor, const double *restrict kx,
                     const double *restrict ky, const double *restrict kz,
                     const double *restrict over, const double *restrict rl,
                     const double *restrict tx, const double *restrict ty,
                     const double *restrict tz, double *restrict n0, double *restrict n1,
                     double *restrict n2, double *restrict n3, double *restrict n4,
                     double *restrict n5, double *restrict n6, double *restrict n7,
                     double *restrict n8) {
  for (size_t i = first + 1; i <= last; i++) {
    const double w = 0.5 * factor * rl[i - 1] * rl[i], r = over[i], s = 2.0 * r * w;
    const double ax = tx[i - 1], ay = ty[i - 1], az = tz[i - 1];
    const double mx = w * r * (ax + tx[i]), my = w * r * (ay + ty[i]), mz = w * r * (az + tz[i]);
    n0[i] -= kx[i] * mx;
    n1[i] -= kx[i] * my + s * az;
    n2[i] -= kx[i] * mz - s * ay;
    n3[i] -= ky[i] * mx - s * az;
    n4[i] -= ky[i] * my;
    n5[i] -= ky[i] * mz + s * ax;
    n6[i] -= kz[i] * mx + s * ay;
    n7[i] -= kz[i] * my - s * ax;
    n8[i] -= kz[i] * mz;
  }
}

SW_HOT
static void add_gradient(size_t first, size_t last, double torque, const double *restrict slope,
                         double *restrict gradient) {
  for (size_t e = first; e <= last; e++) gradient[e] += torque * slope[e];
}

static void span_part(const sw_span *span, double torque, sw_field *f) {
  const size_t a = span->first, b = span->last;
  double *const *t = f->tangent, *const *k = f->scratch, *const *o = f->own, *const *n = f->next;
  corners(a, b, t[0], t[1], t[2], k[0], k[1], k[2], k[3]);
  for (int c = 0; c < 3; c++) slopes(a, b, k[c], f->reciprocal, f->twist_slope[c]);
  if ((f->want & SW_WANT_STIFFNESS) && torque != 0) {
    for (long shift = -1; shift <= 0; shift++)
      add_own(a, b, shift, torque, k[0], k[1], k[2], k[3], f->reciprocal, t[0], t[1], t[2], o[0],
              o[1], o[2], o[3], o[4], o[5]);
    add_next(a, b, torque, k[0], k[1], k[2], k[3], f->reciprocal, t[0], t[1], t[2], n[0], n[1],
             n[2], n[3], n[4], n[5], n[6], n[7], n[8]);
  }
  clamp_part(f, &f->plan->clamps[span->left], torque);
  clamp_part(f, &f->plan->clamps[span->right], torque);
}

static sw_status eval(const void *args, sw_field *f, sw_error *err SW_UNUSED) {
  const double GJ = ((const twist_args *)args)->GJ;
  if (!f->twist) return SW_OK;
  for (size_t k = 0; k < f->plan->span_count; k++) {
    const sw_span *span = &f->plan->spans[k];
    const double stiffness = GJ / span->length;
    const double torque = sw_span_torque(f->plan, span, GJ, f->twist[k]);
    if (f->want & SW_WANT_ENERGY) f->energy += 0.5 * torque * torque / stiffness;
    if (!(f->want & (SW_WANT_FORCE | SW_WANT_STIFFNESS))) continue;
    span_part(span, torque, f);
    for (int c = 0; c < 3; c++)
      add_gradient(span->first, span->last, torque, f->twist_slope[c], f->gradient[c]);
    f->twist_stiffness[k] += stiffness;
  }
  return SW_OK;
}

/* Returns the torque at the held end, about the mean of director and edge. A positive twist turns
 * the span's end relative to its start. */
static sw_vec clamp_moment(const void *args, const sw_field *f, const sw_clamp_hinge *h) {
  const double GJ = ((const twist_args *)args)->GJ;
  for (size_t k = 0; f->twist && k < f->plan->span_count; k++) {
    const sw_span *span = &f->plan->spans[k];
    const int starts = h == &f->plan->clamps[span->left];
    if (!starts && h != &f->plan->clamps[span->right]) continue;
    double t[3];
    tangent(f, h->edge, t);
    const corner c = corner_of(director(f, h), t);
    const double torque = sw_span_torque(f->plan, span, GJ, f->twist[k]) * (starts ? -1.0 : 1.0);
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
