/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bend and twist of a hinge between two edges with material frames. An edge has the unit tangent t
 * and, across it, the material axes m1 (its normal) and m2 = t x m1. */
#ifndef SW_STATE_HINGE_H
#define SW_STATE_HINGE_H

#include "base/vec.h"
#include "state/angle.h"

typedef struct sw_edge_frame {
  sw_vec t, m1;
} sw_edge_frame;

/* Averaging the axes of two edges that are twisted by m shortens them by cos(m/2). g makes up for
 * this; with its first and second derivative. */
typedef struct sw_hinge_gain {
  double g, slope, curve;
} sw_hinge_gain;

static inline sw_hinge_gain sw_hinge_gain_of(double twist) {
  const double c = cos(0.5 * twist), least = 0.1; /* about 169 degrees */
  if (fabs(c) < least) return (sw_hinge_gain){c < 0 ? -1.0 / least : 1.0 / least, 0, 0};
  const double g = 1.0 / c, t2 = g * g - 1.0;
  return (sw_hinge_gain){g, 0.5 * g * g * sin(0.5 * twist), 0.25 * g * (1.0 + 2.0 * t2)};
}

/* Computes the bend about the edges' mean axes [rad]: the hinge's rotation vector phi/sin(phi) t1 x
 * t2, seen in both frames and averaged, as in Bergou et al. 2008, who take 2 tan(phi/2). The gain
 * makes its squares add up to phi^2. */
static inline void sw_hinge_bend(const sw_edge_frame *a, const sw_edge_frame *b, double twist,
                                 double out[2]) {
  double s, w;
  sw_angle_factors(0.25 * sw_norm2(sw_sub(a->t, b->t)), &s, &w);
  s *= sw_hinge_gain_of(twist).g;
  out[0] = 0.5 * s * (sw_dot(a->m1, b->t) - sw_dot(b->m1, a->t));
  out[1] = 0.5 * s * (sw_dot(sw_cross(a->t, a->m1), b->t) - sw_dot(sw_cross(b->t, b->m1), a->t));
}

/* Carries a vector that is across `from` along the great circle to `to`. */
static inline sw_vec sw_carry(sw_vec v, sw_vec from, sw_vec to) {
  const double share = sw_dot(v, to) / fmax(1e-9, 1.0 + sw_dot(from, to));
  return sw_madd(v, sw_add(from, to), -share);
}

/* The same; the result is exactly across `to` and of unit length. */
static inline sw_vec sw_carry_unit(sw_vec v, sw_vec from, sw_vec to) {
  const sw_vec u = sw_carry(v, from, to), w = sw_madd(u, to, -sw_dot(u, to));
  const double off = sw_norm2(w) - 1.0;
  if (fabs(off) < 1e-8) return sw_scale(w, 1.0 - 0.5 * off); /* the usual case, no root */
  return sw_unit_or(w, sw_perpendicular(to));
}

/* 2 atan(h) for y = h^2 below 0.01, to rounding. */
#define SW_TWICE_ATAN(h, y)        \
  (2.0 * (h) *                     \
   (1.0 -                          \
    (y) * (1.0 / 3 -               \
           (y) * (1.0 / 5 -        \
                  (y) * (1.0 / 7 - \
                         (y) * (1.0 / 9 - (y) * (1.0 / 11 - (y) * (1.0 / 13 - (y) / 15))))))))

/* Returns the turn of the second frame against the first one carried to it; of equal angles, the
 * one nearest to `before` [rad]. */
static inline double sw_hinge_twist(const sw_edge_frame *a, const sw_edge_frame *b, double before) {
  const sw_vec u = sw_carry(a->m1, a->t, b->t);
  const double sine = sw_dot(sw_cross(u, b->m1), b->t), cosine = sw_dot(u, b->m1);
  const double half = sine / (1.0 + cosine), y = half * half; /* tan of half the turn */
  if (y < 0.01 && fabs(before) < 1.0)                         /* the usual case, by series */
    return SW_TWICE_ATAN(half, y);
  const double turn = atan2(sine, cosine);
  return before + remainder(turn - before, 6.283185307179586477);
}

#endif
