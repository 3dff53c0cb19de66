/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Means over a window of time that moves along with a run, of one value for each edge of a wire. A
 * running integral of each value is kept at some moments (marks) of the last window. A step costs
 * one sum per edge, and memory is only allocated when the number of edges changes. */
#ifndef SW_RECORD_WINDOW_H
#define SW_RECORD_WINDOW_H

#include <stddef.h>

#include "base/status.h"
#include "base/tape.h"

/* Usual window for peaks: longer than an impact, shorter than any motion of a gripper [s]. */
#define SW_WINDOW 0.01

enum { SW_WINDOW_PARTS = 16, SW_WINDOW_MARKS = SW_WINDOW_PARTS + 2 };

typedef struct sw_window {
  size_t edges;
  size_t marks, first;          /* number of marks, slot of the oldest; 0: nothing was added */
  double now;                   /* [s] */
  double time[SW_WINDOW_MARKS]; /* of the marks; the first mark ever is the record's begin [s] */
  double begun;                 /* [s] */
  double *room; /* (edges) each: places [m], present values, integral; then one for each mark */
} sw_window;

void sw_window_free(sw_window *w);
/* Starts the record anew. */
void sw_window_forget(sw_window *w);

/* Returns the number of doubles in its room. */
static inline size_t sw_window_size(size_t edges) { return (3 + SW_WINDOW_MARKS) * edges; }

/* Fits the window to a number of edges: kept integrals go to the nearest places. SW_ENOMEM. */
sw_status sw_window_fit(sw_window *w, size_t edges, const double *places);
/* Returns the room for the present values, one per edge. */
static inline double *sw_window_values(sw_window *w) { return w->room + w->edges; }

/* Adds a step of size h that ends at `time`, with these values. Returns 1 if the mean over the
 * whole window should be evaluated. */
int sw_window_add(sw_window *w, const double *values, double time, double h, double window);
/* Returns where to divide a step from `begin` to `time`, with the same values in both parts: the
 * next moment at which a window ends that begins at a mark before the step. Means are largest where
 * windows begin or end with a step, and windows within the step all have its own values. Returns
 * `time` if there is no such moment [s]. */
double sw_window_cut(const sw_window *w, double begin, double time, double window);
/* Returns the edge with the largest mean over the window that ends at present, and the mean. While
 * the record is shorter than the window, the mean is over the whole record. */
size_t sw_window_largest(const sw_window *w, double window, double *mean);

/* The window that ends at present: the integrals at its ends, and the means of all edges. */
typedef struct sw_window_last {
  const double *sum, *one, *two; /* now, and at both marks beside its begin (edges) */
  double a, b;                   /* weights of the marks [-] */
  double length;                 /* [s] */
} sw_window_last;

/* The record must not be empty. While it is shorter than the window, all of it counts. */
sw_window_last sw_window_present(const sw_window *w, double window);
static inline double sw_window_mean(const sw_window_last *p, size_t e) {
  return (p->sum[e] - (p->a * p->one[e] + p->b * p->two[e])) / p->length;
}
/* 1 if the record is at least as long as the window. */
int sw_window_full(const sw_window *w, double window);
/* 1 if something was added since the mean was last due. */
int sw_window_waits(const sw_window *w);

void sw_tape_window(sw_tape *tape, sw_window *w);

#endif
