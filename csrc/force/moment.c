/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A couple of fixed size M about an axis fixed in space, at one arc length. Its work is M times the
 * angle by which the wire's direction turns about the axis: E = -M theta, theta being the azimuth
 * of the edge vector e about the axis. Gradient and second derivative of the azimuth are exact and
 * symmetric. The couple bends but does not twist the wire (its component along the wire does no
 * work). Its moment on a wire at an angle a to the axis is M / sin a, for its part along the axis
 * is M: it acts as a fork that carries the wire round the axis. Along the axis it is undefined, and
 * an event says so below 45 degrees. The history holds the azimuths of the last accepted state,
 * whole turns included: without them the energy would jump by 2 pi M once a turn. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

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

/* Below this sine of the angle between wire and axis the event "couple" is told: a couple whose
 * part along the wire merely had no effect would have half the moment there [-]. */
static const double TOO_FLAT = M_SQRT1_2;

/* History: azimuths of the two edges [rad]; smallest sine of their angles to the axis [-]. */
enum { AZIMUTH = 1, SINE = AZIMUTH + 2, HISTORY };

/* Returns the part of an edge across the axis; 0: it has no azimuth. */
static sw_vec across_of(const sw_field *f, sw_vec axis, size_t e) {
  const sw_vec edge = sw_sub(sw_vec_at(f->x, e + 1), sw_vec_at(f->x, e));
  const sw_vec across = sw_madd(edge, axis, -sw_dot(edge, axis));
  return sw_norm(across) > LEAST_ACROSS * f->plan->rest[e] ? across : sw_v(0, 0, 0);
}

/* Returns the azimuth that is nearest to an earlier one [rad]. */
static double azimuth(sw_vec axis, sw_vec across, double before) {
  const sw_vec zero = sw_perpendicular(axis), ninety = sw_cross(axis, zero);
  const double now = atan2(sw_dot(across, ninety), sw_dot(across, zero));
  return before + remainder(now - before, 2.0 * M_PI);
}

/* The two edges whose middles enclose s share the couple by distance. */
typedef struct couple {
  sw_vec axis;
  size_t edge[2];
  double moment[2]; /* [N m] */
} couple;

static couple couple_of(const moment_args *a, const sw_plan *plan) {
  const double M = sw_norm(a->moment);
  couple c = {sw_unit_or(a->moment, sw_v(1, 0, 0)), {0, 0}, {0, 0}};
  double fraction;
  size_t e = sw_plan_locate(plan, a->s, &fraction);
  if (fraction < 0.5 && e > 0) e--;
  const size_t next = e + 1 < plan->edges ? e + 1 : e;
  const double m0 = 0.5 * (plan->s[e] + plan->s[e + 1]);
  const double m1 = 0.5 * (plan->s[next] + plan->s[next + 1]);
  const double share = m1 > m0 ? fmin(1.0, fmax(0.0, (a->s - m0) / (m1 - m0))) : 0.0;
  c.edge[0] = e, c.edge[1] = next;
  c.moment[0] = M * (1.0 - share), c.moment[1] = M * share;
  return c;
}

/* Adds a couple's share on one of its edges. */
static void on_edge(const couple *c, int k, sw_field *f) {
  const double M = c->moment[k];
  const size_t e = c->edge[k];
  const sw_vec across = across_of(f, c->axis, e);
  const double r2 = sw_norm2(across);
  if (!(r2 > 0)) return;
  const sw_vec round = sw_cross(c->axis, across); /* has the length of across */
  if (f->want & SW_WANT_ENERGY)
    f->energy -= M * azimuth(c->axis, across, f->history ? f->history[AZIMUTH + k] : 0.0);
  const double p[3] = {across.x, across.y, across.z}, q[3] = {round.x, round.y, round.z};
  for (int i = 0; i < 3; i++)
    if (f->want & SW_WANT_FORCE) f->gradient[i][e] -= M * q[i] / r2;
  if (!(f->want & SW_WANT_STIFFNESS)) return;
  for (int i = 0, at = 0; i < 3; i++) /* d2 theta = -(p q' + q p')/r^4 */
    for (int j = i; j < 3; j++, at++) f->own[at][e] += M * (p[i] * q[j] + q[i] * p[j]) / (r2 * r2);
}

static sw_status eval(const void *args, sw_field *f, sw_error *err SW_UNUSED) {
  const couple c = couple_of(args, f->plan);
  for (int k = 0; k < 2; k++)
    if (c.moment[k] > 0) on_edge(&c, k, f);
  return SW_OK;
}

static size_t state_size(const sw_plan *plan SW_UNUSED) { return HISTORY; }

static void commit(const void *args, const sw_field *f, double *history) {
  const couple c = couple_of(args, f->plan);
  history[SINE] = 1;
  for (int k = 0; k < 2; k++) {
    const sw_vec across = across_of(f, c.axis, c.edge[k]);
    double *at = &history[AZIMUTH + k];
    if (sw_norm2(across) > 0) *at = azimuth(c.axis, across, *at);
    if (c.moment[k] > 0)
      history[SINE] = fmin(history[SINE], sw_norm(across) * f->reciprocal[c.edge[k]]);
  }
}

/* Edges of another plan point nearly as those before. */
static void inherit(const sw_plan *old SW_UNUSED, const double *from, const sw_field *f,
                    double *history) {
  memcpy(history, from, state_size(f->plan) * sizeof *history);
}

static int news(const void *args, const double *history, sw_force_news *out) {
  const moment_args *a = args;
  const double sine = history[SINE], degrees = asin(sine) * 180.0 / M_PI;
  if (!(sine < TOO_FLAT)) return 0;
  out->kind = "couple", out->s = a->s;
  out->value = 1.0 / fmax(sine, LEAST_ACROSS);
  if (sine > LEAST_ACROSS)
    snprintf(out->text, sizeof out->text,
             "it lies %.2g degrees off the couple's axis and is bent by %.3g times the couple's "
             "moment; along the axis a couple is undefined",
             degrees, out->value);
  else
    snprintf(out->text, sizeof out->text,
             "it lies along the couple's axis: the couple is undefined there and does nothing, but "
             "bends by M / sin a as soon as the wire turns off it by an angle a");
  return 1;
}

const sw_force_class sw_force_moment = {
    .name = "moment",
    .summary =
        "a couple about a fixed axis at one place of the wire, across which the wire must lie",
    .flags = SW_FORCE_AT_PLACE | SW_FORCE_LOAD | SW_FORCE_ANY_SHAPE,
    .params = SW_PARAMS("force moment", rows),
    .eval = eval,
    .state_size = state_size,
    .commit = commit,
    .inherit = inherit,
    .news = news,
};
