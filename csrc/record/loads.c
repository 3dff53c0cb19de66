/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peaks, means and the impulse of recorded loads. */
#include "record/loads.h"

#include <math.h>

/* 1 if nothing was held at this time. */
static int is_gap(const sw_loads_args *a, double time) {
  for (size_t i = 0; i < a->spans; i++)
    if (time >= a->held[2 * i] && time <= a->held[2 * i + 1]) return 0;
  return a->held != NULL;
}

/* Integrals so far. */
typedef struct totals {
  sw_loads *out;
  double force, moment; /* of the magnitudes [N s], [N m s] */
} totals;

static void add(totals *sum, double h, const sw_load_row *r) {
  sum->out->duration += h;
  sum->force += h * sw_norm(r->force), sum->moment += h * sw_norm(r->moment);
  sum->out->impulse = sw_madd(sum->out->impulse, r->force, h);
}

/* Adds a value at the end of a step: a trapezoid. before: the value at its start, or NULL if it is
 * not known; then the end value counts for all of the step, as far as that begins after t1. Steps
 * without a load at both ends do not count as time. */
static void add_value(totals *sum, const sw_loads_args *a, const sw_load_row *before,
                      const sw_load_row *r) {
  const double from = r->t + r->span;
  if (r->idle && (!before || before->idle)) return;
  if (!before || is_gap(a, 0.5 * (before->t + r->t))) {
    if (from >= a->t1 - 1e-12 * (1 + fabs(a->t1))) add(sum, -r->span, r);
    return;
  }
  const double share = before->span > 0 ? 0.0 : 0.5; /* nothing is known of the end of a mean */
  add(sum, share * (r->t - before->t), before);
  add(sum, (1 - share) * (r->t - before->t), r);
}

/* Integrates force and moment from t1 to t2: means of steps times their duration, other values by
 * trapezoids. */
static void add_up(const sw_load_row *rows, size_t n, const sw_loads_args *a, sw_loads *out) {
  const sw_load_row *before = NULL;
  totals sum = {.out = out};
  for (size_t i = 0; i < n; i++) {
    const sw_load_row *r = &rows[i];
    const int within = r->t >= a->t1 && r->t <= a->t2;
    if (r->span > 0) {
      const double h = fmin(r->t, a->t2) - fmax(r->t - r->span, a->t1);
      if (h > 0 && !r->idle) add(&sum, h, r);
      before = within ? r : NULL;
    } else if (within) {
      add_value(&sum, a, before, r);
      before = r;
    }
  }
  out->mean_force = out->duration > 0 ? sum.force / out->duration : out->force.raw;
  out->mean_moment = out->duration > 0 ? sum.moment / out->duration : out->moment.raw;
}

/* 1 if a row tells of the time from t1 to t2. A step that ends at t1 is before that time. */
static int is_within(const sw_load_row *r, const sw_loads_args *a) {
  return r->t <= a->t2 && (r->t > a->t1 || (r->t == a->t1 && (r->span == 0 || a->t1 == a->t2)));
}

enum { FORCE, MOMENT, MARGIN };

static sw_vec value_of(const sw_load_row *r, int what) {
  if (what == MARGIN) return sw_v(isnan(r->margin) ? 0.0 : r->margin, 0, 0);
  return what == FORCE ? r->force : r->moment;
}

/* Fills the spans of the rows between t1 and t2: each holds from the end of the row before it. */
static size_t spans_of(const sw_load_row *rows, size_t n, const sw_loads_args *a, int what,
                       sw_lapse *out) {
  double last = a->t1 < a->t2 ? a->t1 : -HUGE_VAL;
  size_t count = 0;
  for (size_t i = 0; i < n; i++) {
    const sw_load_row *r = &rows[i];
    if (!is_within(r, a)) continue;
    const double t0 = fmax(r->t - fabs(r->span), fmin(last, r->t));
    const sw_vec v = value_of(r, what);
    last = r->t;
    if (what == MARGIN && isnan(r->squeeze)) continue;
    out[count++] = (sw_lapse){t0, r->t, {v.x, v.y, v.z}};
  }
  return count;
}

/* Reads what only pads have. */
static void read_pads(const sw_load_row *rows, size_t n, const sw_loads_args *a, sw_loads *out) {
  out->squeeze = out->slip = NAN;
  for (size_t i = 0; i < n; i++) {
    const sw_load_row *r = &rows[i];
    if (isnan(r->squeeze) || !is_within(r, a)) continue;
    out->squeeze = fmax(isnan(out->squeeze) ? 0.0 : out->squeeze, r->squeeze);
    out->slip = r->slip;
    out->holds |= !isnan(r->margin);
  }
}

sw_loads sw_loads_over(const sw_load_row *rows, size_t n, const sw_loads_args *a, sw_lapse *room,
                       double (*sums)[3]) {
  sw_loads out = {0};
  sw_lapses s = {room, sums, spans_of(rows, n, a, FORCE, room)};
  out.force = sw_peak_of(&s, a->width);
  s.count = spans_of(rows, n, a, MOMENT, room);
  out.moment = sw_peak_of(&s, a->width);
  read_pads(rows, n, a, &out);
  if (out.holds) {
    s.count = spans_of(rows, n, a, MARGIN, room);
    out.margin = sw_peak_largest(&s, a->width);
  }
  add_up(rows, n, a, &out);
  return out;
}
