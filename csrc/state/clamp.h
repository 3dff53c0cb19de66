/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A clamp's hinge that is softer about one axis than about others. The rotation vector from the
 * held director d to the edge's tangent t is s d x t, with s = phi/sin(phi). Its part about the
 * axis a is f = s t.n with n = a x d. */
#ifndef SW_STATE_CLAMP_H
#define SW_STATE_CLAMP_H

#include <math.h>

#include "base/vec.h"
#include "state/angle.h"
#include "state/plan.h"

typedef struct sw_clamp_bend {
  double angle; /* f [rad] */
  sw_vec slope; /* d f / d t [rad] */
  sw_vec d, n;  /* [-] */
  double w, v;  /* see angle.h */
} sw_clamp_bend;

/* directors, normals: present ones of all holds. */
static inline sw_clamp_bend sw_clamp_bend_of(const sw_clamp_hinge *h, const double *directors,
                                             const double *normals, sw_vec t) {
  const sw_vec d = sw_vec_at(directors, sw_clamp_place(h));
  const sw_vec n = sw_cross(sw_vec_at(normals, sw_clamp_place(h)), d);
  const double u = 0.25 * sw_norm2(sw_sub(t, d)), q = sw_dot(t, n);
  sw_clamp_bend b = {.d = d, .n = n};
  double s;
  sw_angle_factors(u, &s, &b.w);
  b.v = sw_angle_third(u, s, b.w);
  b.angle = s * q;
  b.slope = sw_madd(sw_scale(n, s), d, -b.w * q);
  return b;
}

/* Returns the wire's curvature at the clamp [1/m]. */
static inline double sw_clamp_curvature(const sw_clamp_hinge *h, const double *directors,
                                        const double *normals, sw_vec t) {
  const sw_vec d = sw_vec_at(directors, sw_clamp_place(h));
  const double angle = 2.0 * asin(fmin(1.0, 0.5 * sw_dist(t, d)));
  if (!(h->softer > 0)) return angle / h->length;
  const double about = sw_clamp_bend_of(h, directors, normals, t).angle;
  return hypot(sqrt(fmax(0.0, angle * angle - about * about)) / h->length,
               about / (h->length + h->softer));
}

#endif
