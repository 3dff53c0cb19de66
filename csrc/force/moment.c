/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A couple of fixed size M about an axis fixed in space, at one arc length. Its work is M times the
 * angle by which the wire's direction turns about the axis: E = -M theta, theta being the azimuth
 * of the edge vector e about the axis. Gradient and second derivative of the azimuth are exact and
 * symmetric. The couple bends but does not twist the wire (its component along the wire does no
 * work). Undefined where the wire lies along the axis; the energy is known up to whole turns. */
#include <math.h>
#include <stddef.h>

#include "force/force.h"

typedef struct moment_args {
  double s;      /* [m] */
  sw_vec moment; /* [N m] */
} moment_args;

static const sw_param rows[] = {
    {"s", SW_PARAM_NUMBER, "m", NAN, 0, HUGE_VAL, SW_PARAM_REQUIRED, NULL, offsetof(moment_args, s),
     "arc length where the couple acts"},
    {"moment", SW_PARAM_VECTOR, "N m", 0, -HUGE_VAL, HUGE_VAL, SW_PARAM_REQUIRED | SW_PARAM_CHANGES,
     NULL, offsetof(moment_args, moment),
     "the couple, fixed in world axes; it bends the wire and does not twist it"},
};

/* An edge whose part across the axis is below this share of its length has no azimuth [-]. */
static const double LEAST_ACROSS = 1e-6;

/* Adds the couple's share on one edge. */
static void on_edge(const sw_vec *axis, double M, size_t e, sw_field *f) {
  const sw_vec edge = sw_sub(sw_vec_at(f->x, e + 1), sw_vec_at(f->x, e));
  const sw_vec across = sw_madd(edge, *axis, -sw_dot(edge, *axis));
  const double r2 = sw_norm2(across), least = LEAST_ACROSS * f->plan->rest[e];
  if (!(r2 > least * least)) return;
  const sw_vec round = sw_cross(*axis, across); /* has the length of across */
  if (f->want & SW_WANT_ENERGY) {
    const sw_vec zero = sw_perpendicular(*axis), ninety = sw_cross(*axis, zero);
    f->energy -= M * atan2(sw_dot(across, ninety), sw_dot(across, zero));
  }
  const double p[3] = {across.x, across.y, across.z}, q[3] = {round.x, round.y, round.z};
  for (int k = 0; k < 3; k++)
    if (f->want & SW_WANT_FORCE) f->gradient[k][e] -= M * q[k] / r2;
  if (!(f->want & SW_WANT_STIFFNESS)) return;
  for (int i = 0, at = 0; i < 3; i++) /* d2 theta = -(p q' + q p')/r^4 */
    for (int j = i; j < 3; j++, at++) f->own[at][e] += M * (p[i] * q[j] + q[i] * p[j]) / (r2 * r2);
}

/* Shares the couple between the two edges whose middles enclose s, by distance. */
static sw_status eval(const void *args, sw_field *f, sw_error *err) {
  const moment_args *a = args;
  const sw_plan *plan = f->plan;
  const double M = sw_norm(a->moment);
  double fraction;
  (void)err;
  if (!(M > 0)) return SW_OK;
  const sw_vec axis = sw_scale(a->moment, 1.0 / M);
  size_t e = sw_plan_locate(plan, a->s, &fraction);
  if (fraction < 0.5 && e > 0) e--;
  const size_t next = e + 1 < plan->edges ? e + 1 : e;
  const double m0 = 0.5 * (plan->s[e] + plan->s[e + 1]);
  const double m1 = 0.5 * (plan->s[next] + plan->s[next + 1]);
  const double share = m1 > m0 ? fmin(1.0, fmax(0.0, (a->s - m0) / (m1 - m0))) : 0.0;
  if (share < 1) on_edge(&axis, M * (1.0 - share), e, f);
  if (share > 0) on_edge(&axis, M * share, next, f);
  return SW_OK;
}

const sw_force_class sw_force_moment = {
    .name = "moment",
    .summary = "a couple about a fixed axis at one place of the wire",
    .flags = SW_FORCE_AT_PLACE | SW_FORCE_LOAD,
    .params = SW_PARAMS("force moment", rows),
    .eval = eval,
};
