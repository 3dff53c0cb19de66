/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A clip's potential along one edge of a wire's centre line (axis.h). */
#ifndef SW_FORCE_CLIP_SUM_H
#define SW_FORCE_CLIP_SUM_H

#include <math.h>
#include <stddef.h>

#include "base/param.h"
#include "base/vec.h"
#include "force/axis.h"
#include "force/clip_law.h"

typedef struct sw_clip_args {
  sw_vec at;                   /* the wire's centre line in the seat [m] */
  sw_vec direction, axis;      /* [-] */
  double width;                /* [m] */
  double insertion, retention; /* [N] */
  double radius;               /* radius of the seat; NAN = the wire's [m] */
  double friction;             /* [-] */
  double way;                  /* way of the wire over the lips; NAN = chosen [m] */
  double stiffness;            /* stiffness of floor and walls; NAN = chosen [N/m] */
  double strength;             /* strength of floor and walls; NAN = chosen [N] */
} sw_clip_args;

/* Parameter rows shared by the clip's forces. */
#define SW_CLIP_ROW(field, unit, def, flags, doc) \
  SW_NUMBER_ROW(sw_clip_args, field, unit, def, 0, HUGE_VAL, (flags) | SW_PARAM_ABOVE_MIN, doc)
#define SW_CLIP_ROWS                                                                              \
  SW_VECTOR_ROW(sw_clip_args, at, "m", 0, SW_PARAM_REQUIRED,                                      \
                "the wire's centre line in the seat"),                                            \
      SW_VECTOR_ROW(sw_clip_args, direction, "-", 0, SW_PARAM_REQUIRED,                           \
                    "from the seat to the mouth"),                                                \
      SW_VECTOR_ROW(sw_clip_args, axis, "-", 0, SW_PARAM_REQUIRED, "along the wire in the seat"), \
      SW_CLIP_ROW(width, "m", 0, SW_PARAM_REQUIRED, "along the axis"),                            \
      SW_CLIP_ROW(insertion, "N", 0, SW_PARAM_REQUIRED,                                           \
                  "largest force of the lips on the way in"),                                     \
      SW_CLIP_ROW(retention, "N", 0, SW_PARAM_REQUIRED,                                           \
                  "largest force of the lips on the way out"),                                    \
      SW_CLIP_ROW(radius, "m", NAN, 0, "radius of the seat (default: that of the wire)"),         \
      SW_CLIP_ROW(way, "m", NAN, 0,                                                               \
                  "travel of the wire over the lips (default: 1.5 of its radius)")

/* A clip with the law for one wire. */
typedef struct sw_clip {
  sw_clip_law law;
  sw_vec at, direction, across, axis; /* [m], three unit vectors [-] */
  double width, friction;             /* [m], [-] */
  double insertion, retention;        /* [N] */
  double strongest;                   /* the larger of both [N] */
} sw_clip;

/* SW_EINVAL if lips cannot have this insertion and retention. kind: the force's name, for the
 * error. */
sw_status sw_clip_check_lips(const sw_clip_args *args, const char *kind, sw_error *err);

sw_clip sw_clip_of(const sw_clip_args *args, const sw_beam *beam);

/* What to sum beside energy and forces: they take the most time of a run with a clip. */
enum { SW_CLIP_WANT_STIFFNESS = 1, SW_CLIP_WANT_PUSH = 2, SW_CLIP_WANT_MIDDLE = 4 };

/* Contribution of one edge; vectors and matrices in the clip's axes u, v, a. What was not asked for
 * is 0. */
typedef struct sw_clip_sum {
  double energy;         /* [J] */
  double g[2][3];        /* derivatives with respect to the two ends [N] */
  double own[2][6];      /* stiffness: second derivatives for each end, upper half [N/m] */
  double next[9];        /* stiffness: coupling of both ends, rows of the first one [N/m] */
  double push[2];        /* push: |grad U| across the axis, shared between the ends [N] */
  double share, u, v, s; /* middle: share of the window between the walls; its u, v, arc length [-],
                            [m] */
  double all[3];         /* middle: share of the whole window; its u, v (weighted) [-], [m] */
} sw_clip_sum;

/* Steps through the integration places of one edge. */
typedef struct sw_clip_walk {
  double a[3], b[3];   /* u, v, a of the edge's ends [m] */
  double s, length;    /* arc length at the first end; length of the edge [m] */
  long count, k, last; /* number of places on the edge, next place, last place in the window */
  int begun;           /* 1: the window's phase is set */
  double half, weight; /* half the clip's width; weight of a place, without chi [m], [-] */
  double slope, curve; /* its derivatives by the edge's way along the axis [1/m], [1/m2] */
  double rate;         /* phase of the window over the way along the axis [rad/m] */
  double now[2];       /* cosine and sine of the window's phase at the next place [-] */
  double turn[2];      /* the same of the phase from place to place [-] */
} sw_clip_walk;

enum { SW_CLIP_NO_EDGE = -1 };
/* Returns the first edge, from number `from` on, within the clip's width, or SW_CLIP_NO_EDGE. */
long sw_clip_find(const sw_clip *clip, const sw_field *field, long from);

/* Starts a walk along the edge from place e to the next; 0: the edge is outside the clip's
 * width. */
int sw_clip_begin(const sw_clip *clip, const sw_field *field, size_t e, sw_clip_walk *walk);
/* The same for an edge with these ends [m]. */
int sw_clip_begin_at(const sw_clip *clip, const sw_plan *plan, size_t e, const sw_vec end[2],
                     sw_clip_walk *walk);
/* Sets the window's phase at the first place. */
void sw_clip_begin_window(sw_clip_walk *walk);
/* Returns the next place: u, v, a [m] and its share of the way along the edge [-]; the window chi
 * there, with its first and second derivative [-], [1/m], [1/m2]. 0: no more places. */
static inline int sw_clip_next(sw_clip_walk *w, double x[3], double *along, double chi[3]) {
  if (!w->begun) sw_clip_begin_window(w);
  while (w->k <= w->last) {
    const double t = ((double)w->k++ + 0.5) / (double)w->count;
    const double cosine = w->now[0], sine = w->now[1];
    for (int i = 0; i < 3; i++) x[i] = w->a[i] + t * (w->b[i] - w->a[i]);
    *along = t;
    chi[0] = 1.0 + cosine;
    chi[1] = -w->rate * sine;
    chi[2] = -w->rate * w->rate * cosine;
    /* four products instead of a sine and a cosine */
    w->now[0] = cosine * w->turn[0] - sine * w->turn[1];
    w->now[1] = sine * w->turn[0] + cosine * w->turn[1];
    if (fabs(x[2]) < w->half) return 1;
  }
  return 0;
}

/* Returns the middle of an edge's part within the clip's width, as a share of the edge [-]. */
static inline double sw_clip_middle_share(const sw_clip_walk *w) {
  const double a = w->a[2], b = w->b[2], half = w->half;
  const double from = fmax(-half, fmin(half, a)), to = fmax(-half, fmin(half, b));
  return fabs(b - a) > 0 ? (0.5 * (from + to) - a) / (b - a) : 0.5;
}

/* Fills u and v at a share of an edge [m]. */
static inline void sw_clip_place_on(const sw_clip_walk *w, double share, double out[2]) {
  for (int k = 0; k < 2; k++) out[k] = w->a[k] + share * (w->b[k] - w->a[k]);
}

/* 1 if the clip does not act on any part of the edge. */
int sw_clip_far(const sw_clip *clip, const sw_clip_walk *walk);

/* Sums along the edge of a walk that was just begun. */
void sw_clip_sum_of(const sw_clip *clip, sw_clip_walk *walk, int what, sw_clip_sum *out);

/* The same along edge e, from place e to the next; 0: the edge is outside the clip's width. */
int sw_clip_edge(const sw_clip *clip, const sw_field *field, size_t e, int what, sw_clip_sum *out);

/* Turns (u, v, a) into world axes. */
sw_vec sw_clip_world(const sw_clip *clip, const double local[3]);

/* Adds the values selected by field->want from a sum to the field. */
void sw_clip_on_edge(const sw_clip *clip, sw_field *field, size_t e, const sw_clip_sum *sum);

/* Returns an upper bound of the clip's stiffness; its friction slips at a stretch of `slip` [m],
 * [N/m]. */
double sw_clip_stiffness(const sw_clip *clip, double slip);

#endif
