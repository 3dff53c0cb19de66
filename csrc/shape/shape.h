/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rigid shapes in their own coordinates: immutable, reference-counted. A wire
 * asks three questions of a shape: how far is this point, where along this
 * segment is the nearest place, and does this moving segment cross you. */
#ifndef SW_SHAPE_SHAPE_H
#define SW_SHAPE_SHAPE_H

#include <stddef.h>

#include "base/param.h"
#include "base/status.h"
#include "base/vec.h"

typedef struct sw_shape sw_shape;

enum { SW_CLOSEST_MAX = 8 }; /* most contacts one segment can have with one shape [-] */

/* A nearest place. gap and normal are signed and outward: a point inside has a
 * negative gap and the normal of the surface place nearest to it. */
typedef struct sw_closest {
  double gap;    /* distance from the shape's surface, negative inside [m] */
  double at;     /* place along the segment, 0 = its first end [-] */
  sw_vec normal; /* outward unit normal at the shape's place [-] */
  sw_vec point;  /* place on the shape's surface [m] */
  int feature;   /* which face, edge or corner, for matching between steps [-] */
} sw_closest;

typedef struct sw_bounds {
  sw_vec min, max; /* corners; +-INFINITY for unbounded shapes [m] */
} sw_bounds;

/* The nearest surface place to the point p. Returns 1 and fills out when the
 * gap is below reach, else 0 (out is then undefined). */
int sw_shape_point(const sw_shape *shape, sw_vec p, double reach, sw_closest *out);

/* Nearest places to the segment a-b that lie strictly between its ends and are
 * nearer than both ends would be by interpolation (a segment lying flat on a
 * face has none): the contacts that points at the ends would miss. Fills up to
 * SW_CLOSEST_MAX with gap below reach and returns their number. */
int sw_shape_segment(const sw_shape *shape, sw_vec a, sw_vec b, double reach,
                     sw_closest out[SW_CLOSEST_MAX]);

/* A segment moving from (a0, b0) to (a1, b1), each end on a straight line, that
 * starts outside: does any of its points come closer than margin (>= 0) to the
 * surface on the way, having been further away? Returns 1, with the place at
 * the moment of first touch and that moment in [0, 1] in *when. */
int sw_shape_sweep(const sw_shape *shape, sw_vec a0, sw_vec b0, sw_vec a1, sw_vec b1,
                   double margin, sw_closest *out, double *when);

sw_bounds sw_shape_bounds(const sw_shape *shape);
const char *sw_shape_kind(const sw_shape *shape); /* "box", "mesh", ... */

/* Triangles of a mesh or a hull for drawing: vertices (n x 3) [m] and indices
 * (m x 3); both stay the shape's. Counts of 0 for the other kinds. */
void sw_shape_triangles(const sw_shape *shape, const double **vertices, size_t *vertex_count,
                        const int **indices, size_t *triangle_count);

sw_shape *sw_shape_retain(sw_shape *shape); /* NULL gives NULL */
void sw_shape_release(sw_shape *shape);     /* NULL is allowed */

#endif
