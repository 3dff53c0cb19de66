/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Geometry of two lines of particles that face each other, in a ring and the next one: the offset r
 * between the middles of both edges. It is split into u along t, the unit vector of the edges' sum
 * e, and d across it. Middles look the same from either ring, and an even bend, in which sections
 * stay plane, has u = 0. */
#ifndef SW_STATE_SLIDE_H
#define SW_STATE_SLIDE_H

#include <math.h>

#include "base/vec.h"
#include "state/web.h"

/* Weights of the four particles in r and e [-]. */
static const double sw_slide_offset[SW_SLIDE_NODES] = {0.5, 0.5, -0.5, -0.5};
static const double sw_slide_edge[SW_SLIDE_NODES] = {-1, 1, -1, 1};

typedef struct sw_slide_place {
  double l;          /* length of e [m] */
  double u, apart;   /* part of r along t; |d| [m] */
  double t[3], n[3]; /* n: direction of d [-] */
} sw_slide_place;

/* at: places of the four particles. */
static inline sw_slide_place sw_slide_measure(const double *const at[SW_SLIDE_NODES]) {
  sw_slide_place p;
  double r[3], l2 = 0, apart2 = 0;
  for (int k = 0; k < 3; k++) {
    r[k] = p.t[k] = 0;
    for (int i = 0; i < SW_SLIDE_NODES; i++) {
      r[k] += sw_slide_offset[i] * at[i][k];
      p.t[k] += sw_slide_edge[i] * at[i][k];
    }
    l2 += p.t[k] * p.t[k];
  }
  p.l = fmax(sqrt(l2), 1e-30);
  p.u = 0;
  for (int k = 0; k < 3; k++) p.t[k] /= p.l, p.u += r[k] * p.t[k];
  for (int k = 0; k < 3; k++) p.n[k] = r[k] - p.u * p.t[k], apart2 += p.n[k] * p.n[k];
  p.apart = fmax(sqrt(apart2), 1e-30);
  for (int k = 0; k < 3; k++) p.n[k] /= p.apart;
  return p;
}

#endif
