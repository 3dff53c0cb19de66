/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves from GSL's cubic splines, natural or periodic. The parameter is the sum of the chords
 * between points. Arc lengths are 5-point Gauss integrals; their error is below 1e-9 of a piece
 * that turns by less than 20 degrees. */
#include <gsl/gsl_interp.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "link/curve.h"

struct sw_curve {
  int references, closed;
  size_t count;       /* points; a closed curve repeats its first one; 0: a line */
  double *points;     /* (count x 3), then the knots, the arc lengths and the three coordinates */
  double *knot, *arc; /* (count) [m] */
  gsl_interp *spline[3];
  const double *coordinate[3]; /* (count) [m] */
  sw_vec direction;            /* of a line [-] */
};

void sw_curve_release(sw_curve *c) {
  if (!c || --c->references > 0) return;
  for (int k = 0; k < 3; k++)
    if (c->spline[k]) gsl_interp_free(c->spline[k]);
  sw_free(c->points);
  sw_free(c);
}

sw_status sw_curve_line(sw_vec direction, sw_curve **out) {
  sw_curve *c = sw_alloc(1, sizeof *c);
  if (!c) return SW_ENOMEM;
  c->references = 1;
  c->direction = sw_unit_or(direction, sw_v(1, 0, 0));
  *out = c;
  return SW_OK;
}

/* Place and its first two derivatives by the knots' parameter. */
static void raw(const sw_curve *c, double u, sw_vec out[3]) {
  double v[3][3];
  for (int k = 0; k < 3; k++) {
    v[0][k] = gsl_interp_eval(c->spline[k], c->knot, c->coordinate[k], u, NULL);
    v[1][k] = gsl_interp_eval_deriv(c->spline[k], c->knot, c->coordinate[k], u, NULL);
    v[2][k] = gsl_interp_eval_deriv2(c->spline[k], c->knot, c->coordinate[k], u, NULL);
  }
  for (int i = 0; i < 3; i++) out[i] = sw_load(v[i]);
}

/* Length of the curve between two parameters of one piece [m]. */
static double length_of(const sw_curve *c, double from, double to) {
  static const double place[5] = {0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640,
                                  -0.9061798459386640};
  static const double weight[5] = {0.5688888888888889, 0.4786286704993665, 0.4786286704993665,
                                   0.2369268850561891, 0.2369268850561891};
  double sum = 0;
  sw_vec at[3];
  for (int k = 0; k < 5; k++) {
    raw(c, 0.5 * (from + to) + 0.5 * (to - from) * place[k], at);
    sum += weight[k] * sw_norm(at[1]);
  }
  return 0.5 * (to - from) * sum;
}

static sw_status fill(sw_curve *c, const double *points, size_t given) {
  const size_t n = c->count;
  double *own = c->points + 5 * n;
  c->knot = c->points + 3 * n, c->arc = c->knot + n;
  memcpy(c->points, points, 3 * given * sizeof *points);
  if (c->closed) memcpy(c->points + 3 * given, points, 3 * sizeof *points);
  for (size_t i = 0; i < n; i++)
    for (size_t k = 0; k < 3; k++) own[k * n + i] = c->points[3 * i + k];
  for (size_t i = 1; i < n; i++) {
    const double chord = sw_dist(sw_vec_at(c->points, i - 1), sw_vec_at(c->points, i));
    if (!(chord > 0) || !isfinite(chord)) return SW_EINVAL;
    c->knot[i] = c->knot[i - 1] + chord;
  }
  for (size_t k = 0; k < 3; k++) {
    c->spline[k] =
        gsl_interp_alloc(c->closed ? gsl_interp_cspline_periodic : gsl_interp_cspline, n);
    if (!c->spline[k]) return SW_ENOMEM;
    c->coordinate[k] = own + k * n;
    gsl_interp_init(c->spline[k], c->knot, c->coordinate[k], n);
  }
  for (size_t i = 1; i < n; i++)
    c->arc[i] = c->arc[i - 1] + length_of(c, c->knot[i - 1], c->knot[i]);
  return SW_OK;
}

sw_status sw_curve_spline(const double *points, size_t count, int closed, sw_curve **out) {
  sw_curve *c = sw_alloc(1, sizeof *c);
  if (!c) return SW_ENOMEM;
  c->references = 1, c->closed = closed, c->count = count + (closed != 0);
  c->points = sw_alloc(8 * c->count, sizeof *c->points);
  const sw_status status = count < 3 ? SW_EINVAL : c->points ? fill(c, points, count) : SW_ENOMEM;
  if (status == SW_OK)
    *out = c;
  else
    sw_curve_release(c);
  return status;
}

/* Parameter of the place p in [0, length], by Newton's method within its piece. */
static double parameter_of(const sw_curve *c, double p) {
  const size_t i = gsl_interp_bsearch(c->arc, p, 0, c->count - 1);
  const double low = c->knot[i], high = c->knot[i + 1];
  double u = low + (high - low) * (p - c->arc[i]) / (c->arc[i + 1] - c->arc[i]);
  for (int k = 0; k < 4; k++) {
    sw_vec at[3];
    raw(c, u, at);
    u += (p - c->arc[i] - length_of(c, low, u)) / sw_norm(at[1]);
    u = fmin(fmax(u, low), high);
  }
  return u;
}

void sw_curve_at(const void *curve, double p, sw_rail_point *out) {
  const sw_curve *c = curve;
  if (!c->count) {
    *out = (sw_rail_point){sw_scale(c->direction, p), c->direction, {0, 0, 0}};
    return;
  }
  const double length = c->arc[c->count - 1];
  const double q = c->closed ? p - length * floor(p / length) : fmin(fmax(p, 0.0), length);
  sw_vec at[3];
  raw(c, parameter_of(c, q), at);
  const double speed = sw_norm(at[1]);
  out->along = sw_scale(at[1], 1.0 / speed);
  out->bend =
      sw_scale(sw_madd(at[2], out->along, -sw_dot(at[2], out->along)), 1.0 / (speed * speed));
  out->x = c->closed ? at[0] : sw_madd(at[0], out->along, p - q);
}

double sw_curve_end(const sw_curve *c) {
  return c->count && !c->closed ? c->arc[c->count - 1] : HUGE_VAL;
}

double sw_curve_nearest(const sw_curve *c, sw_vec point) {
  enum { PARTS = 16 };
  double best = 0, least = HUGE_VAL, step;
  sw_rail_point at;
  if (!c->count) return sw_dot(point, c->direction);
  for (size_t i = 0; i + 1 < c->count; i++)
    for (int k = 0; k < PARTS; k++) {
      const double p = c->arc[i] + (c->arc[i + 1] - c->arc[i]) * k / PARTS;
      sw_curve_at(c, p, &at);
      if (sw_dist(at.x, point) < least) least = sw_dist(at.x, point), best = p;
    }
  for (int k = 0; k < 20; k++) {
    sw_curve_at(c, best, &at);
    const sw_vec off = sw_sub(point, at.x);
    step = sw_dot(off, at.along) / fmax(0.1, 1.0 - sw_dot(off, at.bend));
    best += step;
    if (!c->closed) best = fmin(fmax(best, 0.0), c->arc[c->count - 1]);
  }
  return best;
}

static void retain(void *c) {
  if (c) ((sw_curve *)c)->references++;
}
static void release(void *c) { sw_curve_release(c); }

void sw_tape_curve(sw_tape *t, sw_curve **curve) {
  static const sw_sharing sharing = {retain, release};
  if (sw_tape_share(t, (void **)curve, &sharing)) return;
  sw_curve *c = sw_tape_reads(t) ? NULL : *curve;
  int is_line = c && !c->count, closed = c && c->closed;
  size_t count = c && c->count ? c->count - (size_t)closed : 0;
  sw_vec direction = c ? c->direction : sw_v(0, 0, 0);
  double *points = c ? c->points : NULL;
  sw_tape_int(t, &is_line), sw_tape_int(t, &closed), sw_tape_vec(t, &direction);
  sw_tape_count(t, &count, 3 * sizeof *points);
  SW_TAPE_ARRAY(t, points, 3 * count);
  if (!sw_tape_reads(t)) return;
  sw_curve_release(*curve);
  *curve = NULL;
  sw_status status = SW_OK;
  sw_tape_expect(t, count || fabs(sw_norm(direction) - 1.0) < 1e-9, "a rail");
  if (sw_tape_good(t) && is_line) status = sw_curve_line(direction, curve);
  if (*curve && is_line) (*curve)->direction = direction; /* exact to the last bit */
  if (sw_tape_good(t) && count) status = sw_curve_spline(points, count, closed, curve);
  sw_free(points);
  if (status == SW_EINVAL) sw_tape_damaged(t, "a rail");
  if (status == SW_ENOMEM) sw_tape_fail(t, SW_ENOMEM);
}
