/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Running integrals, and means over the last window. */
#include "record/window.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/simd.h"

static const double SLACK = 1e-9; /* of a window, for rounded times [-] */

static double *sum_of(const sw_window *w) { return w->room + 2 * w->edges; }

/* Returns the slot of mark number k, the oldest first. */
static size_t slot(const sw_window *w, size_t k) { return (w->first + k) % SW_WINDOW_MARKS; }

static double *mark_of(const sw_window *w, size_t k) {
  return w->room + (3 + slot(w, k)) * w->edges;
}

void sw_window_free(sw_window *w) {
  sw_free(w->room);
  memset(w, 0, sizeof *w);
}

void sw_window_forget(sw_window *w) { w->marks = 0; }

sw_status sw_window_fit(sw_window *w, size_t edges, const double *places) {
  if (w->edges == edges) {
    if (edges) memcpy(w->room, places, edges * sizeof *places);
    return SW_OK;
  }
  double *room = edges ? sw_alloc(sw_window_size(edges), sizeof *room) : NULL;
  if (edges && !room) return SW_ENOMEM;
  for (size_t e = 0, old = 0; e < edges; e++) {
    const double *was = w->room;
    while (old + 1 < w->edges && fabs(was[old + 1] - places[e]) <= fabs(was[old] - places[e]))
      old++;
    room[e] = places[e];
    for (size_t k = 1; w->edges && k < 3 + SW_WINDOW_MARKS; k++)
      room[k * edges + e] = w->room[k * w->edges + old];
  }
  if (!w->edges || !edges) w->marks = 0;
  sw_free(w->room);
  w->room = room;
  w->edges = edges;
  return SW_OK;
}

SW_HOT
static void add(size_t n, double h, const double *restrict values, double *restrict sum) {
  for (size_t e = 0; e < n; e++) sum[e] += h * values[e];
}

SW_HOT
static double largest_rise(size_t n, const double *restrict sum, double a,
                           const double *restrict one, double b, const double *restrict two) {
  double most[4] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL, -HUGE_VAL}; /* independent, for speed */
  size_t e = 0;
  for (; e + 4 <= n; e += 4)
    for (size_t k = 0; k < 4; k++) {
      const double rise = sum[e + k] - (a * one[e + k] + b * two[e + k]);
      most[k] = most[k] > rise ? most[k] : rise;
    }
  for (; e < n; e++) {
    const double rise = sum[e] - (a * one[e] + b * two[e]);
    most[0] = most[0] > rise ? most[0] : rise;
  }
  return fmax(fmax(most[0], most[1]), fmax(most[2], most[3]));
}

static void put_mark(sw_window *w, double time) {
  if (w->marks == SW_WINDOW_MARKS)
    w->first = slot(w, 1);
  else
    w->marks++;
  w->time[slot(w, w->marks - 1)] = time;
  memcpy(mark_of(w, w->marks - 1), sum_of(w), w->edges * sizeof(double));
}

/* 1 if a window that begins at a mark ends now. */
static int ends_now(const sw_window *w, double window) {
  for (size_t k = 0; k < w->marks; k++)
    if (fabs(w->time[slot(w, k)] + window - w->now) <= SLACK * window) return 1;
  return 0;
}

int sw_window_add(sw_window *w, const double *values, double time, double h, double window) {
  if (!w->edges) return 0;
  if (!w->marks) {
    memset(sum_of(w), 0, w->edges * sizeof(double));
    w->first = 0;
    w->begun = time - h;
    put_mark(w, w->begun);
  }
  add(w->edges, h, values, sum_of(w));
  w->now = time;
  if (time - w->time[slot(w, w->marks - 1)] < (1 - SLACK) / SW_WINDOW_PARTS * window)
    return ends_now(w, window); /* too near for a mark */
  put_mark(w, time);
  return sw_window_full(w, window);
}

double sw_window_cut(const sw_window *w, double begin, double time, double window) {
  if (!w->edges || !w->marks) return time;
  const double least = w->now + SLACK * window, latest = begin + SLACK * window;
  for (size_t k = 0; k < w->marks && w->time[slot(w, k)] <= latest; k++) {
    const double at = w->time[slot(w, k)] + window;
    if (at > least && at <= time - SLACK * window) return at;
  }
  return time;
}

int sw_window_full(const sw_window *w, double window) {
  return w->marks && w->now - w->begun >= (1 - SLACK) * window;
}

int sw_window_waits(const sw_window *w) {
  return w->marks && w->now > w->time[slot(w, w->marks - 1)];
}

sw_window_last sw_window_present(const sw_window *w, double window) {
  const double length = fmin(window, w->now - w->begun), from = w->now - length;
  size_t k = w->marks; /* the first mark inside the window; the search starts at the newest */
  while (k > 0 && !(w->time[slot(w, k - 1)] < from)) k--;
  const double *sum = sum_of(w), *two = k < w->marks ? mark_of(w, k) : sum;
  const double *one = k > 0 ? mark_of(w, k - 1) : two;
  const double t2 = k < w->marks ? w->time[slot(w, k)] : w->now;
  const double t1 = k > 0 ? w->time[slot(w, k - 1)] : t2;
  const double b = t2 > t1 ? fmax(0.0, (from - t1) / (t2 - t1)) : 1.0;
  return (sw_window_last){sum, one, two, 1.0 - b, b, length};
}

size_t sw_window_largest(const sw_window *w, double window, double *mean) {
  const sw_window_last p = sw_window_present(w, window);
  const double largest = largest_rise(w->edges, p.sum, p.a, p.one, p.b, p.two);
  size_t edge = 0;
  for (size_t e = 0; e < w->edges; e++)
    if (!(p.sum[e] - (p.a * p.one[e] + p.b * p.two[e]) < largest)) {
      edge = e;
      break;
    }
  *mean = largest / p.length;
  return edge;
}

/* --- on a tape ------------------------------------------------------------------- */

static void tape_times(sw_tape *t, sw_window *w) {
  double before;
  sw_tape_double(t, &w->now), sw_tape_double(t, &w->begun);
  sw_tape_expect(t, w->begun <= w->now, "a window");
  before = w->begun;
  for (size_t k = 0; k < w->marks && sw_tape_good(t); k++) {
    double *time = &w->time[slot(w, k)];
    sw_tape_double(t, time);
    sw_tape_expect(t, *time >= before && *time <= w->now, "a window");
    before = *time;
  }
}

/* Writes or reads a window. Nothing is kept of a record that was started anew. */
void sw_tape_window(sw_tape *t, sw_window *w) {
  size_t edges = w->marks ? w->edges : 0, marks = w->marks;
  SW_TAPE_STRUCT(t, sw_window, 192);
  sw_tape_count(t, &edges, 3 * sizeof *w->room);
  sw_tape_size(t, &marks);
  sw_tape_expect(t, (marks > 0) == (edges > 0) && marks <= SW_WINDOW_MARKS, "a window");
  if (!sw_tape_good(t)) return;
  if (sw_tape_reads(t) && marks && w->edges != edges) {
    sw_window_free(w);
    w->room = sw_alloc(sw_window_size(edges), sizeof *w->room);
    if (!w->room) sw_tape_fail(t, SW_ENOMEM);
    w->edges = w->room ? edges : 0;
  }
  if (sw_tape_reads(t)) memset(w->time, 0, sizeof w->time);
  if (sw_tape_reads(t)) w->marks = w->edges ? marks : 0, w->first = 0;
  if (!w->marks || !sw_tape_good(t)) return;
  tape_times(t, w);
  sw_tape_raw(t, w->room, edges * sizeof *w->room);
  sw_tape_raw(t, sum_of(w), edges * sizeof *w->room);
  for (size_t k = 0; k < w->marks; k++) sw_tape_raw(t, mark_of(w, k), edges * sizeof *w->room);
  if (!sw_tape_reads(t) || t->home) return;
  sw_tape_finite(t, w->room, sw_window_size(edges), "a window");
  for (size_t e = 0; e + 1 < edges; e++) sw_tape_expect(t, w->room[e] < w->room[e + 1], "a window");
}
