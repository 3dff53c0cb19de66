/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Axial spring T = EA (l/l0 - 1), with energy T^2 l0/(2 EA), for tension, compression or both. */
#include "force/axial.h"

#include <math.h>

#include "base/simd.h"

/* Returns the axial force of an edge from its length, for the strains in signs. */
static inline double axial_force(double EA, int signs, double l, double rest) {
  const double force = EA * (l / rest - 1.0);
  const int allowed = force >= 0 ? (signs & SW_AXIAL_TENSION) : (signs & SW_AXIAL_COMPRESSION);
  return allowed ? force : 0.0;
}

SW_HOT
static void add_gradient(double EA, int signs, size_t m, const double *restrict rest,
                         const double *restrict l, const double *restrict tx,
                         const double *restrict ty, const double *restrict tz, double *restrict gx,
                         double *restrict gy, double *restrict gz) {
  const double tension = (signs & SW_AXIAL_TENSION) ? 1.0 : 0.0;
  const double compression = (signs & SW_AXIAL_COMPRESSION) ? 1.0 : 0.0;
  for (size_t e = 0; e < m; e++) {
    const double raw = EA * (l[e] / rest[e] - 1.0);
    const double force = raw * (raw >= 0 ? tension : compression);
    gx[e] += force * tx[e];
    gy[e] += force * ty[e];
    gz[e] += force * tz[e];
  }
}

/* own += (EA/l0) t t' + (T/l)(I - t t') */
SW_HOT
static void add_stiffness(double EA, int signs, int statics, size_t m, const double *restrict rest,
                          const double *restrict l, const double *restrict rl,
                          const double *restrict stored, const double *restrict tx,
                          const double *restrict ty, const double *restrict tz, double *restrict o0,
                          double *restrict o1, double *restrict o2, double *restrict o3,
                          double *restrict o4, double *restrict o5) {
  const double tension = (signs & SW_AXIAL_TENSION) ? 1.0 : 0.0;
  const double compression = (signs & SW_AXIAL_COMPRESSION) ? 1.0 : 0.0;
  const double pushing = statics ? compression : 0.0; /* of the geometric part; statics only */
  for (size_t e = 0; e < m; e++) {
    const double strain = l[e] / rest[e] - 1.0;
    const double T = stored ? stored[e] : EA * strain;
    const double geometric = T * (T >= 0 ? tension : pushing) * rl[e];
    const double axial = EA / rest[e] * (strain >= 0 ? tension : compression) - geometric;
    o0[e] += axial * tx[e] * tx[e] + geometric;
    o1[e] += axial * tx[e] * ty[e];
    o2[e] += axial * tx[e] * tz[e];
    o3[e] += axial * ty[e] * ty[e] + geometric;
    o4[e] += axial * ty[e] * tz[e];
    o5[e] += axial * tz[e] * tz[e] + geometric;
  }
}

enum { LANES = 8 }; /* parallel sums, for vector instructions [-] */

/* Returns the sum of T^2 l0 over the edges whose strain is in signs: 2 EA times their energy. */
SW_HOT
static double squares_of_forces(int signs, size_t m, const double *restrict rest,
                                const double *restrict T) {
  const double tension = (signs & SW_AXIAL_TENSION) ? 1.0 : 0.0;
  const double compression = (signs & SW_AXIAL_COMPRESSION) ? 1.0 : 0.0;
  double lane[LANES] = {0}, sum = 0;
  size_t e = 0;
  for (; e + LANES <= m; e += LANES)
    for (size_t k = 0; k < LANES; k++)
      lane[k] += (T[e + k] >= 0 ? tension : compression) * (T[e + k] * T[e + k] * rest[e + k]);
  for (; e < m; e++) sum += (T[e] >= 0 ? tension : compression) * (T[e] * T[e] * rest[e]);
  for (size_t k = 0; k < LANES; k++) sum += lane[k];
  return sum;
}

static double energy_of(double EA, int signs, const sw_field *f) {
  const sw_plan *p = f->plan;
  double *now = f->scratch[3];
  if (!(EA > 0)) return 0.0;
  for (size_t e = 0; !f->tension && e < p->edges; e++)
    now[e] = axial_force(EA, signs, f->length[e], p->rest[e]);
  const double *T = f->tension ? f->tension : now;
  return 0.5 * squares_of_forces(signs, p->edges, p->rest, T) / EA;
}

sw_status sw_axial_eval(double EA, int signs, sw_field *field) {
  const sw_plan *p = field->plan;
  if (field->want & SW_WANT_FORCE)
    add_gradient(EA, signs, p->edges, p->rest, field->length, field->tangent[0], field->tangent[1],
                 field->tangent[2], field->gradient[0], field->gradient[1], field->gradient[2]);
  if (field->want & SW_WANT_STIFFNESS)
    add_stiffness(EA, signs, field->statics, p->edges, p->rest, field->length, field->reciprocal,
                  field->tension, field->tangent[0], field->tangent[1], field->tangent[2],
                  field->own[0], field->own[1], field->own[2], field->own[3], field->own[4],
                  field->own[5]);
  if (field->want & SW_WANT_ENERGY) field->energy += energy_of(EA, signs, field);
  return SW_OK;
}

double sw_axial_stable_dt(double EA, const sw_plan *plan) {
  double smallest = HUGE_VAL;
  for (size_t e = 0; e < plan->edges; e++) {
    const double dt = plan->rest[e] * sqrt(plan->beam.mass / EA);
    if (dt < smallest) smallest = dt;
  }
  return smallest;
}
