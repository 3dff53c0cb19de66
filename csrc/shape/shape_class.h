/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a kind of shape provides; only files of this room include it. */
#ifndef SW_SHAPE_SHAPE_CLASS_H
#define SW_SHAPE_SHAPE_CLASS_H

#include "shape/shape.h"

/* Every kind's struct starts with this. */
struct sw_shape {
  const sw_shape_class *class;
  long references; /* [-] */
  sw_bounds bounds;
  sw_shape_args args;     /* what it was made from, to be made again from a file, */
  sw_shape_source source; /* the shape's own copies */
};

/* A segment on the way from a0-b0 to a1-b1. */
typedef struct sw_sweep {
  sw_vec a0, b0, a1, b1; /* [m] */
  double margin;         /* [m] */
  double tolerance;      /* of all distances on the way [m] */
} sw_sweep;

struct sw_shape_class {
  const char *kind;
  const char *summary; /* one line without a full stop */
  const char *sample;  /* see sw_shape_class_sample */
  const sw_shape_wrong *wrong;
  unsigned traits; /* SW_SHAPE_FLAT | ... */
  sw_params params;
  size_t args_size; /* of the struct the rows fill [B] */
  size_t size;      /* of the kind's struct [B] */

  /* Fill the zeroed struct, bounds included. On failure destroy is called. */
  sw_status (*create)(sw_shape *shape, const void *args, const sw_shape_source *source,
                      sw_error *err);
  void (*destroy)(sw_shape *shape); /* frees what create took; NULL when nothing */

  /* As sw_shape_point; exact, and reach may be INFINITY. */
  int (*distance)(const sw_shape *shape, sw_vec p, double reach, sw_closest *out);
  /* The furthest place along the unit vector n; NULL when not convex and bounded. */
  sw_vec (*support)(const sw_shape *shape, sw_vec n);
  /* As sw_shape_segment. */
  int (*segment)(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_closest *out);
  /* As sw_shape_sweep; NULL = sw_convex_sweep for a convex shape, else sw_any_sweep. */
  int (*sweep)(const sw_shape *shape, const sw_sweep *path, sw_closest *out, double *when);
  /* As sw_shape_triangles and sw_shape_bones; NULL = none. */
  sw_status (*triangles)(const sw_shape *shape, int around, sw_triangles *out);
  void (*bones)(const sw_shape *shape, sw_bone_visit visit, void *user);
  /* As sw_shape_over_face; NULL = it is not known. */
  int (*over_face)(const sw_shape *shape, const sw_vec *p, size_t count);
  /* As sw_shape_sharp; NULL = not of flat faces. */
  sw_sharp (*sharp)(const sw_shape *shape, int feature, sw_vec *along);
  /* Are some of its edges there for what is round? NULL = none. */
  int (*faceted)(const sw_shape *shape);
  /* As sw_shape_ridges and sw_shape_points_out, for shapes with edges. */
  void (*ridges)(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_ridge_visit visit,
                 void *user);
  int (*points_out)(const sw_shape *shape, const sw_ridge *ridge, sw_vec n, double share);
  /* As sw_shape_middle; NULL = it has none. */
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

/* A segment nearly parallel to a face (or a straight side) under its one contact
 * out[0], which it passes over between the places part[0] and part[1]: add the
 * places where it enters and leaves as contacts. Returns how many there are. */
int sw_convex_bridge(const sw_shape *shape, sw_vec a, sw_vec b, double reach, const double part[2],
                     sw_closest *out);
#define SW_NEARLY_FLAT 0.05 /* tilt up to which both ends of a bridge count [rad] */

/* Shorten the part [*from, *to] of a line x + t d to where it is in [low, high]. */
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

/* For convex kinds: the segment query by the minimum of the distance, which is
 * convex along the segment. */
int sw_convex_segment(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_closest *out);

/* The nearest place of the whole segment, ends included. */
void sw_convex_nearest(const sw_shape *shape, sw_vec a, sw_vec b, sw_closest *out);

int sw_convex_sweep(const sw_shape *shape, const sw_sweep *path, sw_closest *out, double *when);
/* The same of any kind, by its point and segment queries; slower where the path grazes it. */
int sw_any_sweep(const sw_shape *shape, const sw_sweep *path, sw_closest *out, double *when);

/* Room for a surface's lists; nothing when it fails. */
sw_status sw_triangles_new(size_t vertices, size_t triangles, sw_triangles *out);
/* Triangles one after the other: where the next one goes. */
static inline int *sw_triangle_put(int *to, size_t a, size_t b, size_t c) {
  to[0] = (int)a, to[1] = (int)b, to[2] = (int)c;
  return to + 3;
}

/* A body of revolution about z: rings of so many points between two poles. */
typedef struct sw_ring {
  double radius, z; /* [m] */
} sw_ring;
sw_status sw_revolve(const sw_ring *rings, size_t count, double bottom, double top, int around,
                     sw_triangles *out);
/* So many rings from one angle to the other on a circle in the half plane, whose middle is on the
 * axis at this height; returns the end of what was written. */
sw_ring *sw_ring_arc(sw_ring *to, double radius, double z, double from, double end, int steps);
enum { SW_MOST_AROUND = 1024 }; /* vertices around a round shape [-] */

/* The nearest place of the segment a-b to a convex thing; exact. */
typedef void (*sw_nearest_function)(const void *thing, sw_vec a, sw_vec b, sw_closest *out);

/* Move along the path until the gap to the convex thing, which is start at time
 * 0, comes down to level + tolerance; 0 when that does not happen before limit. */
int sw_sweep_advance(sw_nearest_function nearest, const void *thing, const sw_sweep *path,
                     const sw_closest *start, double level, double limit, sw_closest *out,
                     double *when);

/* The gap a sweep may not come down to: the margin, or for one that starts
 * within it a little less than the start's. */
static inline double sw_sweep_level(const sw_sweep *path, double start_gap) {
  const double noise = 2 * path->tolerance;
  return start_gap > path->margin + noise ? path->margin : fmin(path->margin, start_gap) - noise;
}

/* Is this gap at place `at` no better than the line between the end gaps says? */
static inline int sw_no_better(double gap, double gap_a, double gap_b, double at, double length) {
  const double flat = 1e-9; /* closer to the line than this part of the length is flat [-] */
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
/* Lengths below this have no direction: their squares lose digits [m] */
#define SW_SHAPE_TINY 1e-150
/* w / r where r = |w|, or the fallback. */
static inline sw_vec sw_direction(sw_vec w, double r, sw_vec fallback) {
  return r > SW_SHAPE_TINY ? sw_scale(w, 1 / r) : fallback;
}

#endif
