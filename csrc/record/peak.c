/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The largest mean over a window that begins or ends with a step. */
#include "record/peak.h"

#include <math.h>
#include <string.h>

static const double SLACK = 1e-9; /* relative rounding of times [-] */
/* Steps in a peak's window that show a blow to 15 % (make stability: laying, drops, pegs) [-]. */
static const double FEW = 3;
/* Largest mean before a blow over its own mean [-]; shortest known time before it, over its length
 * [-]. */
static const double SHARP = 0.55, KNOWN = 0.25;

static double size(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

static void sum_up(const sw_lapses *s) {
  double sum[3] = {0};
  for (size_t i = 0; i < s->count; i++) {
    const double h = s->span[i].t1 - s->span[i].t0;
    memcpy(s->sum[i], sum, sizeof sum);
    for (int k = 0; k < 3; k++) sum[k] += h * s->span[i].v[k];
  }
}

/* Fills the integral up to a time. *i: a span that begins no later, 0 at first; times must not fall
 * from call to call. */
static void integral(const sw_lapses *s, size_t *i, double time, double out[3]) {
  while (*i + 1 < s->count && s->span[*i + 1].t0 <= time) (*i)++;
  const sw_lapse *now = &s->span[*i];
  const double h = fmax(0.0, fmin(time, now->t1) - now->t0);
  for (int k = 0; k < 3; k++) out[k] = s->sum[*i][k] + h * now->v[k];
}

/* Windows in the order of time, and the largest mean so far. */
typedef struct search {
  const sw_lapses *s;
  size_t from, to; /* spans at the window's ends */
  double most, time;
} search;

static double mean(search *x, double begins, double ends) {
  double a[3], b[3];
  integral(x->s, &x->from, begins, a);
  integral(x->s, &x->to, ends, b);
  for (int k = 0; k < 3; k++) b[k] -= a[k];
  return size(b) / (ends - begins);
}

static void try_window(search *x, double begins, double ends) {
  const double now = mean(x, begins, ends);
  if (now > x->most) x->most = now, x->time = ends;
}

/* Returns the largest mean over whole windows, or over the whole record if it is shorter. */
static search largest_mean(const sw_lapses *s, double width) {
  const double first = s->span[0].t0, last = s->span[s->count - 1].t1;
  search x = {s, 0, 0, 0.0, NAN};
  sum_up(s);
  if (last - first < width * (1 - SLACK)) {
    try_window(&x, first, last);
    return x;
  }
  for (size_t i = 0; i < s->count; i++) {
    const double end = s->span[i].t1;
    if (end - width >= first - SLACK * width) try_window(&x, fmax(first, end - width), end);
  }
  x.from = x.to = 0;
  for (size_t i = 0; i < s->count; i++)
    if (s->span[i].t0 + width <= last) try_window(&x, s->span[i].t0, s->span[i].t0 + width);
  return x;
}

sw_peak sw_peak_largest(const sw_lapses *s, double width) {
  sw_peak p = {.time = NAN, .raw_time = NAN, .whole = NAN, .span = NAN};
  int averaged = 0;
  for (size_t i = 0; i < s->count; i++) {
    const sw_lapse *now = &s->span[i];
    const double value = size(now->v), span = now->t1 - now->t0;
    if (value > p.raw) p.raw = value, p.raw_time = now->t1, p.raw_span = span;
    if (!(span == 0 || span >= width * (1 - SLACK)))
      averaged = 1;
    else if (value > p.value)
      p.value = value, p.time = now->t1;
  }
  if (!averaged) return p;
  const search found = largest_mean(s, width);
  if (found.most > p.value) p.value = found.most, p.time = found.time;
  const double whole = s->span[s->count - 1].t1 - s->span[0].t0;
  if (whole < width * (1 - SLACK)) p.whole = whole;
  return p;
}

double sw_peak_longest(const sw_lapses *s, double time, double width) {
  double most = 0;
  for (size_t i = 0; i < s->count; i++) {
    const sw_lapse *now = &s->span[i];
    if (now->t1 > time - width * (1 - SLACK) && now->t0 < time)
      most = fmax(most, now->t1 - now->t0);
  }
  return most;
}

int sw_peak_is_coarse(const sw_lapses *s, const sw_peak *p, double width) {
  const double length = fmax(width, p->span);
  if (!s->count || p->span * FEW < length) return 0;
  const double till = p->time - length, from = fmax(till - length, s->span[0].t0);
  if (till - from < KNOWN * length) return 0; /* nothing is known before */
  search before = {.s = s};
  sum_up(s);
  return mean(&before, from, till) < SHARP * p->value;
}

sw_peak sw_peak_of(const sw_lapses *s, double width) {
  sw_peak p = sw_peak_largest(s, width);
  if (isnan(p.time) || !(p.value > 0) || !(width > 0)) return p;
  p.span = sw_peak_longest(s, p.time, width);
  p.coarse = sw_peak_is_coarse(s, &p, width);
  return p;
}
