/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The angle phi of a hinge, by functions of u = sin^2(phi/2): s = phi/sin(phi), w = -ds/dcos(phi)
 * and v = -dw/dcos(phi). */
#ifndef SW_STATE_ANGLE_H
#define SW_STATE_ANGLE_H

#include <math.h>

/* Chebyshev fits on u in [0, 1/4] (phi <= 60 degrees), error below 5e-16. */
static const double SW_ANGLE_FIT = 0.25; /* largest u of the fits [-] */
/* Horner's scheme for the coefficients c0 .. c13. */
#define SW_FIT_STEP(u, c, rest) ((c) + (u) * (rest))
#define SW_FIT(u, c)                                                \
  SW_FIT_STEP(                                                      \
      u, c##0,                                                      \
      SW_FIT_STEP(                                                  \
          u, c##1,                                                  \
          SW_FIT_STEP(                                              \
              u, c##2,                                              \
              SW_FIT_STEP(                                          \
                  u, c##3,                                          \
                  SW_FIT_STEP(                                      \
                      u, c##4,                                      \
                      SW_FIT_STEP(                                  \
                          u, c##5,                                  \
                          SW_FIT_STEP(                              \
                              u, c##6,                              \
                              SW_FIT_STEP(                          \
                                  u, c##7,                          \
                                  SW_FIT_STEP(                      \
                                      u, c##8,                      \
                                      SW_FIT_STEP(                  \
                                          u, c##9,                  \
                                          SW_FIT_STEP(              \
                                              u, c##10,             \
                                              SW_FIT_STEP(u, c##11, \
                                                          SW_FIT_STEP(u, c##12, c##13)))))))))))))
#define SW_FIT_S0 1.0
#define SW_FIT_S1 0.66666666666673224
#define SW_FIT_S2 0.53333333331635013
#define SW_FIT_S3 0.45714285887196332
#define SW_FIT_S4 0.40634911476368524
#define SW_FIT_S5 0.36941126493138032
#define SW_FIT_S6 0.3409332932493519
#define SW_FIT_S7 0.31907228762239243
#define SW_FIT_S8 0.29180058074110277
#define SW_FIT_S9 0.33511256175349097
#define SW_FIT_S10 0.035139155368524883
#define SW_FIT_S11 0.97765555800227311
#define SW_FIT_S12 (-1.1132861271784307)
#define SW_FIT_S13 1.5537792943093436
#define SW_FIT_W0 0.33333333333333298
#define SW_FIT_W1 0.53333333333387734
#define SW_FIT_W2 0.6857142855733187
#define SW_FIT_W3 0.81269842704561113
#define SW_FIT_W4 0.92352016399108761
#define SW_FIT_W5 1.0230010184700724
#define SW_FIT_W6 1.1134194540041413
#define SW_FIT_W7 1.204873841758062
#define SW_FIT_W8 1.2131077477347334
#define SW_FIT_W9 1.7741216298827196
#define SW_FIT_W10 (-0.50853150242764933)
#define SW_FIT_W11 7.3660905082461881
#define SW_FIT_W12 (-9.4903230920523001)
#define SW_FIT_W13 12.120085660545596

/* sin^2 of half the largest angle for which the formulas are used: 0.98 * pi. Beyond it s and w
 * grow without bound; so sharp a hinge is outside the model's range [-]. */
static const double SW_ANGLE_SHARPEST = 0.999;

/* Computes s = phi/sin(phi) and w for any u. */
static inline void sw_angle_factors(double u, double *s, double *w) {
  const double v = u < SW_ANGLE_SHARPEST ? u : SW_ANGLE_SHARPEST;
  if (v <= SW_ANGLE_FIT) {
    *s = SW_FIT(v, SW_FIT_S);
    *w = SW_FIT(v, SW_FIT_W);
    return;
  }
  const double c = 1.0 - 2.0 * v, sine2 = 4.0 * v * (1.0 - v);
  *s = acos(c) / sqrt(sine2);
  *w = (1.0 - *s * c) / sine2;
}

/* Returns v for given u, s and w: from the differential equation of s, near 0 by its series. */
static inline double sw_angle_third(double u, double s, double w) {
  if (u < 0.01)
    return 4.0 / 15.0 +
           u * (24.0 / 35.0 + u * (128.0 / 105.0 + u * (1280.0 / 693.0 + u * 2.557442557)));
  const double v = u < SW_ANGLE_SHARPEST ? u : SW_ANGLE_SHARPEST;
  return (s - 3.0 * (1.0 - 2.0 * v) * w) / (4.0 * v * (1.0 - v));
}

#endif
