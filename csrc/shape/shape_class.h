/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The interface that a kind of shape implements. Private to this room. */
#ifndef SW_SHAPE_SHAPE_CLASS_H
#define SW_SHAPE_SHAPE_CLASS_H

#include "shape/shape.h"

/* First member of every kind's struct. */
struct sw_shape {
  const sw_shape_class *class;
  long references; /* [-] */
  sw_bounds bounds;
  sw_shape_args args;     /* its original input, kept for tapes: */
  sw_shape_source source; /* the shape's own copies of both */
};

/* A segment that moves from a0-b0 to a1-b1. */
typedef struct sw_sweep {
  sw_vec a0, b0, a1, b1; /* [m] */
  double margin;         /* [m] */
  double tolerance;      /* of all distances on the path [m] */
} sw_sweep;

struct sw_shape_class {
  const char *kind;
  const char *summary; /* one line without a full stop */
  const char *sample;  /* see sw_shape_class_sample */
  const sw_shape_wrong *wrong;
  unsigned traits; /* SW_SHAPE_FLAT | ... */
  sw_params params;
  size_t size; /* size of the kind's struct [B] */

  /* Fills the zeroed struct, bounds included. On failure destroy is called. */
  sw_status (*create)(sw_shape *shape, const void *args, const sw_shape_source *source,
                      sw_error *err);
  void (*destroy)(sw_shape *shape); /* frees the memory of create; NULL = nothing */

  /* Like sw_shape_point; exact, and reach may be INFINITY. */
  int (*distance)(const sw_shape *shape, sw_vec p, double reach, sw_closest *out);
  /* Like sw_shape_beside; NULL = a point has one near place. */
  int (*beside)(const sw_shape *shape, sw_vec p, double reach, const sw_closest *nearest,
                sw_closest *out);
  /* Returns the furthest place along the unit vector n; NULL unless convex and bounded. */
  sw_vec (*support)(const sw_shape *shape, sw_vec n);
  /* Like sw_shape_segment. */
  int (*segment)(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_closest *out);
  /* Like sw_shape_sweep; NULL = sw_convex_sweep for a convex shape, else sw_any_sweep. */
  int (*sweep)(const sw_shape *shape, const sw_sweep *path, sw_closest *out, double *when);
  /* Like sw_shape_triangles and sw_shape_bones; NULL = none. */
  sw_status (*triangles)(const sw_shape *shape, int around, sw_triangles *out);
  void (*bones)(const sw_shape *shape, sw_bone_visit visit, void *user);
  /* Like sw_shape_over_face; NULL = unknown. */
  int (*over_face)(const sw_shape *shape, const sw_vec *p, size_t count);
  /* Like sw_shape_sharp; NULL = no flat faces. */
  sw_sharp (*sharp)(const sw_shape *shape, int feature, sw_vec *along);
  /* 1 if some edges approximate a round surface; NULL = none do. */
  int (*faceted)(const sw_shape *shape);
  /* Like sw_shape_facet; NULL = 0. */
  double (*facet)(const sw_shape *shape, double *radius);
  /* Like sw_shape_is_open; NULL = 0. */
  int (*open)(const sw_shape *shape);
  /* Like sw_shape_roundness; NULL = 0. */
  double (*roundness)(const sw_shape *shape);
  /* Like sw_shape_ridges and sw_shape_points_out, for shapes with edges. */
  void (*ridges)(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_ridge_visit visit,
                 void *user);
  int (*points_out)(const sw_shape *shape, const sw_ridge *ridge, sw_vec n, double share);
  /* Like sw_shape_middle; NULL = no middle line. */
  double (*middle)(const sw_shape *shape, sw_vec p, sw_vec *q, sw_vec *along);
};

#define X(name) extern const sw_shape_class sw_shape_class_##name;
#include "shape/list.def"
#undef X

/* A row for a length that must be positive. */
#define SW_LENGTH_ROW(struct_name, field, text)                                          \
  {                                                                                      \
#field, SW_PARAM_NUMBER, "m", NAN, 0, SW_SHAPE_LARGEST,                              \
        SW_PARAM_REQUIRED | SW_PARAM_ABOVE_MIN, NULL, offsetof(struct_name, field), text \
  }

/* Handles a segment nearly parallel to a face (or a straight side). It has one contact out[0] and
 * passes over the face between its places part[0] and part[1]. Adds contacts at the places where it
 * enters and leaves; returns the number of contacts. */
int sw_convex_bridge(const sw_shape *shape, sw_vec a, sw_vec b, double reach, const double part[2],
                     sw_closest *out);
#define SW_NEARLY_FLAT 0.05 /* largest tilt at which both ends of a bridge count [rad] */

/* Shortens the part [*from, *to] of a line x + t d to where x + t d is in [low, high]. */
static inline void sw_clip(double x, double d, double low, double high, double *from, double *to) {
  if (d == 0) {
    if (x < low || x > high) *to = -1;
    return;
  }
  const double one = (low - x) / d, two = (high - x) / d;
  *from = fmax(*from, fmin(one, two));
  *to = fmin(*to, fmax(one, two));
}

static const double SW_HALF_PI = 1.57079632679489661923;

/* The segment query for convex kinds: finds the minimum of the distance, which is convex along the
 * segment. */
int sw_convex_segment(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_closest *out);

/* Finds the nearest place of the whole segment, ends included. */
void sw_convex_nearest(const sw_shape *shape, sw_vec a, sw_vec b, sw_closest *out);

int sw_convex_sweep(const sw_shape *shape, const sw_sweep *path, sw_closest *out, double *when);
/* A sweep for any kind, by its point and segment queries; slower for grazing paths. */
int sw_any_sweep(const sw_shape *shape, const sw_sweep *path, sw_closest *out, double *when);

/* Allocates a surface's lists; nothing is allocated on failure. */
sw_status sw_triangles_new(size_t vertices, size_t triangles, sw_triangles *out);
/* Writes a triangle; returns the place of the next one. */
static inline int *sw_triangle_put(int *to, size_t a, size_t b, size_t c) {
  to[0] = (int)a, to[1] = (int)b, to[2] = (int)c;
  return to + 3;
}

/* A ring of a body of revolution about z, and the body's surface: each ring gets `around` points,
 * between two poles. */
typedef struct sw_ring {
  double radius, z; /* [m] */
} sw_ring;
sw_status sw_revolve(const sw_ring *rings, size_t count, double bottom, double top, int around,
                     sw_triangles *out);
/* Writes steps + 1 rings on a circular arc in the half plane, between two angles; the circle's
 * centre is on the axis at height z. Returns the end of the written rings. */
sw_ring *sw_ring_arc(sw_ring *to, double radius, double z, double from, double end, int steps);
enum { SW_MOST_AROUND = 1024 }; /* most vertices around a round shape [-] */

/* Finds the nearest place of the segment a-b to a convex thing; exact. */
typedef void (*sw_nearest_function)(const void *thing, sw_vec a, sw_vec b, sw_closest *out);

/* Moves along the path until the gap to the convex thing comes down to level + tolerance; 0 if this
 * does not happen before the time limit. start: the nearest place at time 0. */
int sw_sweep_advance(sw_nearest_function nearest, const void *thing, const sw_sweep *path,
                     const sw_closest *start, double level, double limit, sw_closest *out,
                     double *when);

/* Returns the gap that a sweep must not fall below: the margin, or slightly less than the start gap
 * for a segment that starts within the margin. */
static inline double sw_sweep_level(const sw_sweep *path, double start_gap) {
  const double noise = 2 * path->tolerance;
  return start_gap > path->margin + noise ? path->margin : fmin(path->margin, start_gap) - noise;
}

/* 1 if this gap at place `at` is not below the linear interpolation of the end gaps. */
static inline int sw_no_better(double gap, double gap_a, double gap_b, double at, double length) {
  const double flat = 1e-9; /* smaller differences, over the length, count as flat [-] */
  return gap >= gap_a + at * (gap_b - gap_a) - flat * length;
}

static inline sw_bounds sw_bounds_of(sw_vec a, sw_vec b, double margin) {
  return (sw_bounds){{fmin(a.x, b.x) - margin, fmin(a.y, b.y) - margin, fmin(a.z, b.z) - margin},
                     {fmax(a.x, b.x) + margin, fmax(a.y, b.y) + margin, fmax(a.z, b.z) + margin}};
}
static inline int sw_bounds_meet(const sw_bounds *a, const sw_bounds *b) {
  return a->min.x <= b->max.x && b->min.x <= a->max.x && a->min.y <= b->max.y &&
         b->min.y <= a->max.y && a->min.z <= b->max.z && b->min.z <= a->max.z;
}
/* Shorter vectors have no direction: their squares lose digits [m]. */
#define SW_SHAPE_TINY 1e-150
/* Returns w / r with r = |w|, or the fallback if r is too small. */
static inline sw_vec sw_direction(sw_vec w, double r, sw_vec fallback) {
  return r > SW_SHAPE_TINY ? sw_scale(w, 1 / r) : fallback;
}

#endif
