/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The hinge of frame.c, four hinges at a time: energy and first derivatives. Private to that file.
 *
 * The unknowns are the edge vectors, with frames carried along without turning about their own
 * tangents, and that turn (the spin). First derivatives are exact. Second derivatives are made
 * symmetric; they are symmetric by themselves where all spins are in equilibrium. Each component of
 * b is g phi/sin(phi) q with q = (m_a . t_b - m_b . t_a)/2 and g the gain. */
#ifndef SW_FORCE_FRAME_FIRST_H
#define SW_FORCE_FRAME_FIRST_H

#include <math.h>

#include "force/lane.h"
#include "state/hinge.h"

typedef long long wide __attribute__((vector_size(32)));

typedef struct frame {
  vec t, m1;
} frame;

/* Terms to compute; the others are left out. */
typedef enum kind {
  TWISTED, /* straight at rest, one stiffness: bend.c has all but the twist */
  CURVED,  /* one stiffness, bent at rest */
  TWO      /* two stiffnesses */
} kind;

typedef struct frame_args {
  double EI; /* stiffness in bend.c [N m2] */
  double EI_axis[2];
  double GJ; /* [N m2] */
} frame_args;

/* Derivative with respect to both edges and both spins. */
typedef struct slope {
  vec e1, e2;
  lane s1, s2;
} slope;

typedef struct hinge {
  frame a, b;
  lane ra, rb; /* 1/length of the edges [1/m] */
  lane over_length, twist;
  lane rest[2], rest_twist;
  lane excess[2], twist_stiffness; /* excess: above bend.c's; [N m] */
  lane push[2], torque;            /* d energy / d bend, d energy / d twist [N m] */
  lane cosine, s, w, third;
  lane gain, gain_slope, gain_curve;
  vec ma[2], mb[2];       /* material axes */
  vec across_a, across_b; /* part of the other tangent across this one */
  lane over;              /* 1/(1 + cosine) */
  lane q[2], energy, bending;
  slope gq[2], gc, gb[2], gm; /* of q, cosine, bend without gain, and twist */
} hinge;

typedef struct blocks {
  lane own1[6], own2[6], next[9];
  lane spin1, spin2, both;
  vec e1s1, e1s2, e2s1, e2s2;
} blocks;

FLAT slope add_slopes(const slope *g, lane f, const slope *h, lane k) {
  return (slope){madd(scale(g->e1, f), h->e1, k), madd(scale(g->e2, f), h->e2, k),
                 f * g->s1 + k * h->s1, f * g->s2 + k * h->s2};
}

FLAT slope scale_slope(const slope *g, lane f) {
  return (slope){scale(g->e1, f), scale(g->e2, f), f * g->s1, f * g->s2};
}

/* --- functions of the angle and of the twist ------------------------------------ */

#define SLOPE_OF_W(u)                                                                 \
  (SW_FIT_W1 +                                                                        \
   (u) *                                                                              \
       (2 * SW_FIT_W2 +                                                               \
        (u) *                                                                         \
            (3 * SW_FIT_W3 +                                                          \
             (u) *                                                                    \
                 (4 * SW_FIT_W4 +                                                     \
                  (u) *                                                               \
                      (5 * SW_FIT_W5 +                                                \
                       (u) *                                                          \
                           (6 * SW_FIT_W6 +                                           \
                            (u) *                                                     \
                                (7 * SW_FIT_W7 +                                      \
                                 (u) * (8 * SW_FIT_W8 +                               \
                                        (u) * (9 * SW_FIT_W9 +                        \
                                               (u) * (10 * SW_FIT_W10 +               \
                                                      (u) * (11 * SW_FIT_W11 +        \
                                                             (u) * (12 * SW_FIT_W12 + \
                                                                    (u) * (13 *       \
                                                                           SW_FIT_W13)))))))))))))

/* Returns the larger of a and b in each lane. */
FLAT lane larger(lane a, lane b) {
  const wide yes = a > b;
  return (lane)((yes & (wide)a) | (~yes & (wide)b));
}

/* Returns the largest item of x, in every lane. */
FLAT lane largest_lane(lane x) {
  const lane a = larger(__builtin_shufflevector(x, x, 2, 3, 0, 1), x);
  return larger(__builtin_shufflevector(a, a, 1, 0, 3, 2), a);
}

/* Returns 1/(1 + cosine), bounded where edges fold back (beyond about 177 degrees). */
FLAT lane over_sum(lane cosine) { return 1.0 / larger(1.0 + cosine, all(1e-3)); }

FLAT void set_angle(hinge *h) {
  const vec d = madd(h->a.t, h->b.t, all(-1.0));
  const lane u = 0.25 * dot(d, d);
  h->cosine = 1.0 - 2.0 * u;
  h->s = SW_FIT(u, SW_FIT_S);
  h->w = SW_FIT(u, SW_FIT_W);
  h->third = 0.5 * SLOPE_OF_W(u);
  h->over = over_sum(h->cosine);
  const lane sharp = largest_lane(u);
  for (int k = 0; k < LANES && sharp[0] > SW_ANGLE_FIT; k++) {
    if (u[k] <= SW_ANGLE_FIT) continue;
    double s, w;
    sw_angle_factors(u[k], &s, &w);
    h->s[k] = s;
    h->w[k] = w;
    h->third[k] = sw_angle_third(u[k], s, w);
  }
}

/* Below this twist the gain comes from a series [rad]. */
static const double SMALL_TWIST = 0.5;

FLAT void set_gain(hinge *h) {
  const lane x = 0.5 * h->twist, y = x * x;
  const lane c =
      1.0 +
      y * (-1.0 / 2 + y * (1.0 / 24 + y * (-1.0 / 720 + y * (1.0 / 40320 + y * (-1.0 / 3628800)))));
  const lane sine =
      x * (1.0 +
           y * (-1.0 / 6 +
                y * (1.0 / 120 + y * (-1.0 / 5040 + y * (1.0 / 362880 + y * (-1.0 / 39916800))))));
  h->gain = 1.0 / c;
  h->gain_slope = 0.5 * h->gain * h->gain * sine;
  h->gain_curve = 0.25 * h->gain * (2.0 * h->gain * h->gain - 1.0);
  const lane widest = largest_lane(x * x);
  for (int k = 0; k < LANES && widest[0] > 0.25 * SMALL_TWIST * SMALL_TWIST; k++) {
    if (fabs(h->twist[k]) <= SMALL_TWIST) continue;
    const sw_hinge_gain gain = sw_hinge_gain_of(h->twist[k]);
    h->gain[k] = gain.g;
    h->gain_slope[k] = gain.slope;
    h->gain_curve[k] = gain.curve;
  }
}

/* --- energy and first derivatives ----------------------------------------------- */

/* Computes energy and generalised forces from frames, lengths, twist and rest values. */
FLAT void set_hinge(hinge *h, const frame_args *args, kind what) {
  const lane off = h->twist - h->rest_twist;
  h->twist_stiffness = args->GJ * h->over_length;
  h->torque = h->twist_stiffness * off;
  if (what == TWISTED) {
    h->cosine = dot(h->a.t, h->b.t);
    h->over = over_sum(h->cosine);
    h->bending = all(0.0);
    h->energy = 0.5 * h->torque * off;
    return;
  }
  set_angle(h);
  set_gain(h);
  h->ma[0] = h->a.m1, h->ma[1] = cross(h->a.t, h->a.m1);
  h->mb[0] = h->b.m1, h->mb[1] = cross(h->b.t, h->b.m1);
  h->bending = all(0.0);
  for (int j = 0; j < 2; j++) {
    const lane k = args->EI_axis[j] * h->over_length, rest = h->rest[j];
    h->q[j] = 0.5 * (dot(h->ma[j], h->b.t) - dot(h->mb[j], h->a.t));
    const lane bend = h->gain * h->s * h->q[j];
    h->excess[j] = (args->EI_axis[j] - args->EI) * h->over_length;
    h->push[j] = h->excess[j] * bend - k * rest;
    h->bending += 0.5 * h->excess[j] * bend * bend + k * rest * (0.5 * rest - bend);
  }
  h->energy = h->bending + 0.5 * h->torque * off;
}

/* Computes the slopes of the cosine, of q and of the twist. */
FLAT void set_slopes(hinge *h, kind what) {
  const vec a = h->a.t, b = h->b.t;
  const lane c = h->cosine, zero = all(0.0);
  const vec kb = scale(cross(a, b), h->over);
  h->gm = (slope){scale(kb, h->ra), scale(kb, h->rb), all(-1.0), all(1.0)};
  if (what == TWISTED) return;
  h->across_a = madd(b, a, -c);
  h->across_b = madd(a, b, -c);
  h->gc = (slope){scale(h->across_a, h->ra), scale(h->across_b, h->rb), zero, zero};
  for (int j = 0; j < 2; j++) {
    const vec ma = h->ma[j], mb = h->mb[j];
    const vec pa = madd(mb, a, -dot(mb, a)), pb = madd(ma, b, -dot(ma, b));
    const double sign = j == 0 ? 0.5 : -0.5; /* a spin turns m1 to m2 and m2 to -m1 */
    h->gq[j] = (slope){scale(madd(pa, ma, c), -0.5 * h->ra), scale(madd(pb, mb, c), 0.5 * h->rb),
                       sign * dot(h->ma[1 - j], b), -sign * dot(h->mb[1 - j], a)};
    h->gb[j] = add_slopes(&h->gq[j], h->s, &h->gc, -h->w * h->q[j]);
  }
}

/* Returns the sum of push times bend without gain: the factor of the gain's derivatives. */
FLAT lane pushed(const hinge *h) { return h->s * (h->push[0] * h->q[0] + h->push[1] * h->q[1]); }

FLAT slope gradient(const hinge *h, kind what) {
  if (what == TWISTED) return scale_slope(&h->gm, h->torque);
  const slope bend = add_slopes(&h->gb[0], h->push[0], &h->gb[1], h->push[1]);
  return add_slopes(&bend, h->gain, &h->gm, h->torque + h->gain_slope * pushed(h));
}

#endif
