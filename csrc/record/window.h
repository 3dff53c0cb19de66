/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Means over a window of time that moves along with a run, of a value on each edge of a wire. A
 * running integral of each is kept at some moments of the last window: a step costs one sum for an
 * edge, and nothing is allocated unless the edges are others. */
#ifndef SW_RECORD_WINDOW_H
#define SW_RECORD_WINDOW_H

#include <stddef.h>

#include "base/status.h"
#include "base/tape.h"

/* Usual window of peaks: longer than a blow, shorter than any move of a gripper [s]. */
#define SW_WINDOW 0.01

enum { SW_WINDOW_PARTS = 16, SW_WINDOW_MARKS = SW_WINDOW_PARTS + 2 };

typedef struct sw_window {
  size_t edges;
  size_t marks, first;          /* how many are kept, the oldest; 0: nothing was added */
  double now;                   /* [s] */
  double time[SW_WINDOW_MARKS]; /* of the marks; the first of all is where the record begins [s] */
  double begun;                 /* [s] */
  double *room; /* (edges) each: places [m], present values, integral; then one for each mark */
} sw_window;

void sw_window_free(sw_window *w);
/* The record is to begin anew. */
void sw_window_forget(sw_window *w);

/* Doubles in its room. */
static inline size_t sw_window_size(size_t edges) { return (3 + SW_WINDOW_MARKS) * edges; }

/* Fit the window to so many edges: kept integrals go over to the nearest places. SW_ENOMEM. */
sw_status sw_window_fit(sw_window *w, size_t edges, const double *places);
/* Room for the present values, one for an edge. */
static inline double *sw_window_values(sw_window *w) { return w->room + w->edges; }

/* Add a step of size h up to a time, with these values. 1: the mean over the whole window up to
 * then is due to be looked at. */
int sw_window_add(sw_window *w, const double *values, double time, double h, double window);
/* A step up to a time is to be added in two, of the same values: the next moment before its end at
 * which a window ends that begins with a mark, for means are largest where windows begin or end
 * with a step. The time itself: none [s]. */
double sw_window_cut(const sw_window *w, double time, double window);
/* Largest of the edges' means over the window up to now, or over the whole record while that is
 * shorter: its edge, and the mean. */
size_t sw_window_largest(const sw_window *w, double window, double *mean);
/* 1: the record is at least as long as the window. */
int sw_window_full(const sw_window *w, double window);
/* 1: something was added since the mean was due to be looked at. */
int sw_window_waits(const sw_window *w);

void sw_tape_window(sw_tape *tape, sw_window *w);

#endif
