/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The C2 cubic spline through all way-points, at rest at both ends. Position and orientation (a
 * quaternion, scaled to unit length afterwards) are one curve with seven components. Its slopes at
 * the way-points follow from a symmetric tridiagonal system, which GSL solves. The acceleration
 * jumps at both ends, from and to rest. If a speed is given, the way-points get times by the legs'
 * lengths, and the whole motion is slowed down until no limit is exceeded anywhere. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <string.h>

#include "base/alloc.h"
#include "base/halving.h"
#include "motion/law.h"

enum { PARTS = 7 }; /* x y z of position, w x y z of the quaternion [-] */

typedef struct knot {
  double t;            /* from the start [s] */
  double y[PARTS];     /* values */
  double slope[PARTS]; /* [1/s] */
} knot;

typedef struct spline {
  size_t count; /* knots [-] */
  int turns;    /* the orientation changes [-] */
  knot *knots;
} spline;

/* Evaluates `count` components from `first` on: values and first two derivatives. */
static void cubic(const knot *a, double t, int first, int count, double *y, double *d, double *dd) {
  const knot *b = a + 1;
  const double h = b->t - a->t, r = 1 / h, u = (t - a->t) * r;
  for (int i = first; i < first + count; i++) {
    const double rise = b->y[i] - a->y[i], m0 = h * a->slope[i], m1 = h * b->slope[i];
    const double c2 = 3 * rise - 2 * m0 - m1, c3 = m0 + m1 - 2 * rise;
    *y++ = a->y[i] + u * (m0 + u * (c2 + u * c3));
    *d++ = r * (m0 + u * (2 * c2 + 3 * u * c3));
    *dd++ = r * r * (2 * c2 + 6 * u * c3);
  }
}

static const knot *find(const spline *s, double t) {
  size_t after;
  SW_FIRST_NOT(s->knots[after].t <= t, after, 1, s->count - 1);
  return &s->knots[after - 1];
}

static sw_quat quat_at(const double *p) { return (sw_quat){p[0], p[1], p[2], p[3]}; }
static sw_vec imaginary(sw_quat q) { return sw_v(q.x, q.y, q.z); }

/* With N = |Q|^2: omega = 2 Im(Q' Q*) / N, alpha = 2 Im(Q'' Q*) / N - omega N' / N. */
static void turn_at(const knot *k, double t, sw_motion_state *out) {
  double y[4], d[4], dd[4], norm = 0, rate = 0;
  cubic(k, t, 3, 4, y, d, dd);
  for (int i = 0; i < 4; i++) norm += y[i] * y[i], rate += 2 * y[i] * d[i];
  const sw_quat back = sw_quat_conj(quat_at(y));
  out->pose.q = sw_quat_unit(quat_at(y));
  out->omega = sw_scale(imaginary(sw_quat_mul(quat_at(d), back)), 2 / norm);
  out->alpha = sw_madd(sw_scale(imaginary(sw_quat_mul(quat_at(dd), back)), 2 / norm), out->omega,
                       -rate / norm);
}

static void state_at(const spline *s, const knot *k, double t, sw_motion_state *out) {
  double y[3], d[3], dd[3];
  cubic(k, t, 0, 3, y, d, dd);
  out->pose.p = sw_load(y);
  out->v = sw_load(d);
  out->a = sw_load(dd);
  out->pose.q = quat_at(k->y + 3);
  out->omega = out->alpha = sw_v(0, 0, 0);
  if (s->turns) turn_at(k, t, out);
}

static sw_status eval(const sw_motion *motion, double t, sw_motion_state *out,
                      sw_error *err SW_UNUSED) {
  const spline *s = motion->body;
  state_at(s, find(s, t), t, out);
  return SW_OK;
}

static void destroy(void *body) {
  spline *s = body;
  if (!s) return;
  sw_free(s->knots);
  sw_free(s);
}

/* --- planning ----------------------------------------------------------------- */

/* Fills in the matrix: its diagonal and the elements beside it (n each). The slopes at the ends are
 * 0. */
static void matrix(const spline *s, double *diagonal, double *beside) {
  const size_t last = s->count - 1;
  diagonal[0] = diagonal[last] = 1;
  for (size_t i = 1; i < last; i++) {
    const double before = 1 / (s->knots[i].t - s->knots[i - 1].t);
    const double after = 1 / (s->knots[i + 1].t - s->knots[i].t);
    diagonal[i] = 2 * (before + after);
    beside[i] = i + 1 < last ? after : 0;
  }
  beside[0] = 0;
}

static sw_status solve_part(spline *s, int part, double *diagonal, double *beside, double *right,
                            double *slopes) {
  const size_t n = s->count;
  memset(right, 0, n * sizeof *right);
  for (size_t i = 1; i + 1 < n; i++) {
    const knot *k = &s->knots[i];
    const double before = 1 / (k->t - k[-1].t), after = 1 / (k[1].t - k->t);
    right[i] = 3 * ((k->y[part] - k[-1].y[part]) * before * before +
                    (k[1].y[part] - k->y[part]) * after * after);
  }
  const gsl_vector_view d = gsl_vector_view_array(diagonal, n);
  const gsl_vector_view e = gsl_vector_view_array(beside, n - 1);
  const gsl_vector_view b = gsl_vector_view_array(right, n);
  gsl_vector_view x = gsl_vector_view_array(slopes, n);
  const int code = gsl_linalg_solve_symm_tridiag(&d.vector, &e.vector, &b.vector, &x.vector);
  if (code == GSL_ENOMEM) return SW_ENOMEM;
  if (code != GSL_SUCCESS) return SW_ESINGULAR;
  for (size_t i = 0; i < n; i++) s->knots[i].slope[part] = slopes[i];
  return SW_OK;
}

static sw_status solve_slopes(spline *s) {
  const size_t n = s->count;
  double *work SW_LOCAL = sw_alloc(4 * n, sizeof *work);
  if (!work) return SW_ENOMEM;
  gsl_set_error_handler_off(); /* a status is enough */
  matrix(s, work, work + n);
  for (int part = 0; part < (s->turns ? PARTS : 3); part++)
    SW_TRY(solve_part(s, part, work, work + n, work + 2 * n, work + 3 * n));
  return SW_OK;
}

static sw_status fill(spline *s, const sw_route *route, sw_error *err) {
  double t = 0;
  for (size_t i = 0; i < s->count; i++) {
    knot *k = &s->knots[i];
    sw_quat q = route->q[i];
    if (i > 0) t = route->timed ? route->t[i] - route->t[0] : t + route->legs[i - 1].time;
    k->t = t;
    sw_store(k->y, route->p[i]);
    if (i > 0 && route->legs[i - 1].angle > 3.1)
      return sw_fail(err, SW_EINVAL,
                     "%s: law 'spline' needs turns below 3.1 rad from way-point to way-point, but "
                     "number %zu turns by %.4g rad; add way-points or use 'minimum-jerk'",
                     route->name, i + 1, route->legs[i - 1].angle);
    const sw_quat near = i ? quat_at(k[-1].y + 3) : q;
    if (q.w * near.w + q.x * near.x + q.y * near.y + q.z * near.z < 0)
      q = (sw_quat){-q.w, -q.x, -q.y, -q.z};
    k->y[3] = q.w, k->y[4] = q.x, k->y[5] = q.y, k->y[6] = q.z;
  }
  return SW_OK;
}

/* Returns the factor by which to slow down so that the limits hold at t. */
static double excess(const spline *s, const sw_motion_plan *plan, const knot *k, double t) {
  sw_motion_state at;
  double most = 0;
  state_at(s, k, t, &at);
  if (!isnan(plan->speed)) most = fmax(most, sw_norm(at.v) / plan->speed);
  if (!isnan(plan->angular_speed)) most = fmax(most, sw_norm(at.omega) / plan->angular_speed);
  if (!isnan(plan->acceleration)) most = fmax(most, sqrt(sw_norm(at.a) / plan->acceleration));
  if (!isnan(plan->angular_acceleration))
    most = fmax(most, sqrt(sw_norm(at.alpha) / plan->angular_acceleration));
  return most;
}

/* Returns the largest excess between two knots, by samples and a golden-section search. */
static double leg_excess(const spline *s, const sw_motion_plan *plan, const knot *k) {
  enum { SAMPLES = 24, STEPS = 60 };
  const double h = (k[1].t - k->t) / SAMPLES, golden = 0.61803398874989484820;
  double most = 0, best = k->t;
  for (int i = 0; i <= SAMPLES; i++) {
    const double value = excess(s, plan, k, k->t + i * h);
    if (value > most) most = value, best = k->t + i * h;
  }
  double low = fmax(best - h, k->t), high = fmin(best + h, k[1].t);
  for (int i = 0; i < STEPS; i++) {
    const double left = high - golden * (high - low), right = low + golden * (high - low);
    const double a = excess(s, plan, k, left), b = excess(s, plan, k, right);
    most = fmax(most, fmax(a, b));
    if (a > b)
      high = right;
    else
      low = left;
  }
  return most;
}

static void slow_down(spline *s, double factor) {
  for (size_t i = 0; i < s->count; i++) {
    s->knots[i].t *= factor;
    for (int part = 0; part < PARTS; part++) s->knots[i].slope[part] /= factor;
  }
}

static sw_status keep_limits(spline *s, const sw_motion_plan *plan, const sw_route *route,
                             sw_error *err) {
  const int limited = !isnan(plan->acceleration) || !isnan(plan->angular_acceleration);
  const int free = !isnan(plan->speed) || !isnan(plan->angular_speed);
  double most = 0;
  if (!isnan(plan->duration)) slow_down(s, plan->duration / s->knots[s->count - 1].t);
  if (!free && !limited) return SW_OK;
  for (size_t i = 0; i + 1 < s->count; i++) most = fmax(most, leg_excess(s, plan, &s->knots[i]));
  if (free) slow_down(s, most * (1 + 1e-12));
  if (!free && most > 1 + 1e-9)
    return sw_fail(
        err, SW_EINVAL,
        "%s: the times are too short for the acceleration; they must be %.4g times as long",
        route->name, most);
  return SW_OK;
}

static double length_of(const spline *s) {
  static const double node[] = {0, 0.53846931010568309104, 0.90617984593866399280};
  static const double weight[] = {0.56888888888888888889, 0.47862867049936646804,
                                  0.23692688505618908751};
  enum { PIECES = 8 }; /* between two knots, with five Gauss points each */
  double sum = 0;
  sw_motion_state at;
  for (const knot *k = s->knots; k < s->knots + s->count - 1; k++)
    for (int piece = 0; piece < PIECES; piece++) {
      const double half = 0.5 * (k[1].t - k->t) / PIECES, middle = k->t + (2 * piece + 1) * half;
      for (int i = -2; i <= 2; i++) {
        const int j = i < 0 ? -i : i;
        state_at(s, k, middle + (i < 0 ? -half : half) * node[j], &at);
        sum += half * weight[j] * sw_norm(at.v);
      }
    }
  return sum;
}

static sw_status plan_spline(const sw_motion_law *law SW_UNUSED, const sw_motion_plan *plan,
                             sw_route *route, sw_motion *motion, sw_error *err) {
  if (plan->stop > 0 || plan->blend > 0)
    return sw_fail(err, SW_EINVAL,
                   "%s: law 'spline' passes through every way-point smoothly; stop and blend have "
                   "no use",
                   route->name);
  spline *s = sw_alloc(1, sizeof *s);
  if (!s) return SW_ENOMEM;
  motion->body = s; /* freed with the motion */
  s->count = route->count;
  s->turns = route->angle > 0;
  s->knots = sw_alloc(s->count, sizeof *s->knots);
  if (!s->knots) return SW_ENOMEM;
  SW_TRY(fill(s, route, err));
  SW_TRY(solve_slopes(s));
  SW_TRY(keep_limits(s, plan, route, err));
  motion->duration = s->knots[s->count - 1].t;
  motion->length = length_of(s);
  return SW_OK;
}

const sw_motion_law sw_motion_law_spline = {"spline", NULL, plan_spline, eval, destroy};
