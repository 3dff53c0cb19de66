/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A clip's potential along one edge of a wire's centre line (axis.h). */
#ifndef SW_FORCE_CLIP_SUM_H
#define SW_FORCE_CLIP_SUM_H

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
  double radius;               /* of the seat; NAN = that of the wire [m] */
  double friction;             /* [-] */
  double way;                  /* of the wire over the lips; NAN = chosen [m] */
  double stiffness;            /* of floor and walls; NAN = chosen [N/m] */
  double strength;             /* what these bear; NAN = chosen [N] */
} sw_clip_args;

/* Rows of parameters that every force of a clip takes. */
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
      SW_CLIP_ROW(radius, "m", NAN, 0, "of the seat (default: that of the wire)"),                \
      SW_CLIP_ROW(way, "m", NAN, 0, "of the wire over the lips (default: 1.5 of its radius)")

/* The clip as one wire meets it. */
typedef struct sw_clip {
  sw_clip_law law;
  sw_vec at, direction, across, axis; /* [m], three unit vectors [-] */
  double width, friction;             /* [m], [-] */
  double strongest;                   /* of both forces of the lips [N] */
} sw_clip;

/* Can lips be made of insertion and retention? kind: of the force, for the error. */
sw_status sw_clip_check_lips(const sw_clip_args *args, const char *kind, sw_error *err);

sw_clip sw_clip_of(const sw_clip_args *args, const sw_beam *beam);

/* Share of one edge in the clip; vectors and matrices in the clip's u, v, a. */
typedef struct sw_clip_sum {
  double energy;         /* [J] */
  double g[2][3];        /* derivatives by the two ends [N] */
  double own[2][6];      /* second ones by each end, upper half [N/m] */
  double next[6];        /* by both, which is symmetric too [N/m] */
  double push[2];        /* |grad U| across the axis, shared between the ends [N] */
  double share, u, v, s; /* of the window within the walls; times u, v and arc length [-], [m] */
  double all[3];         /* of all of the window, and times u and v [-], [m] */
} sw_clip_sum;

/* The places of the sum along one edge, one after another. */
typedef struct sw_clip_walk {
  double a[3], b[3];   /* u, v, a of the edge's ends [m] */
  double s, length;    /* arc length at the first end, of the edge [m] */
  long count, k, last; /* places on the edge, the next one, the last one that may count */
  double half, weight; /* of the clip's width; of a place, without chi [m], [-] */
} sw_clip_walk;

enum { SW_CLIP_NO_EDGE = -1 };
/* The first edge from number `from` on that is within the clip's width, or SW_CLIP_NO_EDGE. */
long sw_clip_find(const sw_clip *clip, const sw_field *field, long from);

/* 0: the edge from place e to the next is outside of the clip's width. */
int sw_clip_begin(const sw_clip *clip, const sw_field *field, size_t e, sw_clip_walk *walk);
/* The next place: u, v, a and how far along the edge it is [m], [-]; 0: there is none. */
int sw_clip_next(sw_clip_walk *walk, double x[3], double *along);

/* chi at a and its derivatives [-], [1/m], [1/m2]. */
void sw_clip_window(const sw_clip *clip, double a, double chi[3]);

/* 1: nothing acts on any part of the edge. */
int sw_clip_far(const sw_clip *clip, const sw_clip_walk *walk);

/* The sum along edge e, from place e to the next; 0: it has none. */
int sw_clip_edge(const sw_clip *clip, const sw_field *field, size_t e, int stiffness,
                 sw_clip_sum *out);

/* (u, v, a) as a vector of the world. */
sw_vec sw_clip_world(const sw_clip *clip, const double local[3]);

/* Add what is wanted of a sum to the field. */
void sw_clip_on_edge(const sw_clip *clip, sw_field *field, size_t e, const sw_clip_sum *sum);

/* Largest stiffness that all of the clip can have, with friction that slips after slip [N/m]. */
double sw_clip_stiffness(const sw_clip *clip, double slip);

#endif
