/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rigid shapes in their own coordinates: immutable, reference-counted. A wire
 * asks three questions of a shape: how far is this point, where along this
 * segment is the nearest place, and does this moving segment cross you. */
#ifndef SW_SHAPE_SHAPE_H
#define SW_SHAPE_SHAPE_H

#include <stddef.h>

#include "base/param.h"
#include "base/status.h"
#include "base/tape.h"
#include "base/vec.h"

typedef struct sw_shape sw_shape;
typedef struct sw_shape_class sw_shape_class;

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

/* Input of a shape besides its rows: a hull's points, a mesh's file. Only read while the shape is
 * made. */
typedef struct sw_shape_source {
  const double *points; /* n x 3 [m] */
  size_t point_count;   /* n [-] */
  const char *bytes;    /* content of a mesh file */
  size_t byte_count;    /* its length [B] */
} sw_shape_source;

/* A surface of triangles that wind so that their normals point outwards. */
typedef struct sw_triangles {
  double *vertices;                    /* vertex_count x 3 [m] */
  int *indices;                        /* triangle_count x 3, from 0 */
  size_t vertex_count, triangle_count; /* [-] */
} sw_triangles;
void sw_triangles_free(sw_triangles *triangles);

/* Called for each bone of a shape; a = b: a point. All places within skin of it are inside. */
typedef void (*sw_bone_visit)(void *user, sw_vec a, sw_vec b, double skin);

/* What is particular about a kind. */
enum {
  SW_SHAPE_FLAT = 1,   /* a half space: a segment is nearest to it at an end */
  SW_SHAPE_FACED = 2,  /* bounded by flat faces */
  SW_SHAPE_LISTED = 4, /* made from a list or a file, maybe of very many places */
  SW_SHAPE_SQUARE = 8  /* its faces meet at right angles: never nearly round */
};

/* Kinds of shape. Names are NULL-terminated, in the order of list.def. */
const char *const *sw_shape_kinds(void);
const sw_shape_class *sw_shape_class_find(const char *kind);         /* NULL when unknown */
const sw_params *sw_shape_class_params(const sw_shape_class *class); /* "obstacle box" */

/* How a kind introduces itself to help, specs and fuzzers: arguments that it takes, about 1 m
 * large, and arguments that it refuses with a part of the message, as Lua text of a table's
 * inside. */
typedef struct sw_shape_wrong {
  const char *args, *message; /* args NULL: the end of a list */
} sw_shape_wrong;

const char *sw_shape_class_summary(const sw_shape_class *class);
unsigned sw_shape_class_traits(const sw_shape_class *class); /* SW_SHAPE_FLAT | ... */
int sw_shape_class_convex(const sw_shape_class *class);
const char *sw_shape_class_sample(const sw_shape_class *class);
const sw_shape_wrong *sw_shape_class_wrong(const sw_shape_class *class);

/* Room for any kind's argument struct: fill it by the kind's rows. */
typedef union sw_shape_args {
  double align;
  char bytes[64];
} sw_shape_args;

/* Make a shape of the class from checked arguments; source may be NULL for
 * kinds that need none. *out holds one reference, or NULL on failure. */
sw_status sw_shape_new(const sw_shape_class *class, const sw_shape_args *args,
                       const sw_shape_source *source, sw_shape **out, sw_error *err);

/* Coordinates beyond SW_SHAPE_FAR and NaN are near nothing: the three queries
 * return 0 for them. For all others every number they return is finite. */
#define SW_SHAPE_FAR 1e50    /* [m] */
#define SW_SHAPE_LARGEST 1e6 /* largest size of a shape [m] */

/* The nearest surface place to the point p. Returns 1 and fills out when the
 * gap is below reach, else 0 (out is then undefined). Of an open mesh, a sheet,
 * the back counts as inside, but not beyond its border, and outside its bounds
 * only within reach. */
int sw_shape_point(const sw_shape *shape, sw_vec p, double reach, sw_closest *out);

/* Contacts of the segment a-b strictly between its ends, which points at the
 * ends would miss: local minima of the distance along it. A contact is dropped
 * when its gap is not below the line between the two end gaps, so a segment
 * lying flat on a face has none; one that bridges a flat face or a straight
 * side has a contact at each end of it, of which one fades away as it tilts.
 * normal is perpendicular to the segment except for the second edge of such a
 * bridge; for a segment cut by an edge, gap is minus the way out along normal.
 * A mesh finds places with |gap| below reach, the others gap below reach.
 * Fills up to SW_CLOSEST_MAX, nearest first, and returns their number. */
int sw_shape_segment(const sw_shape *shape, sw_vec a, sw_vec b, double reach,
                     sw_closest out[SW_CLOSEST_MAX]);

/* A segment moving from (a0, b0) to (a1, b1) in the time 0 to 1, each end on a
 * straight line. With g(t) the smallest gap of all its points and
 * level = min(margin, g(0)): is g(t) < level - tolerance at some t in (0, 1]?
 * So one that starts further away than margin (>= 0) is reported when it comes
 * as near as margin, to within the tolerance; one that starts nearer, when it
 * gets deeper or crosses.
 * Returns 1 with the place at the first such moment and the moment in *when.
 * The tolerance is 1e-10 of the largest coordinate. A crossing is never missed;
 * when the iterations run out (grazing), the moment reached is reported. For a
 * mesh that the segment already pierces at the start, the pierced triangles
 * are left out. */
int sw_shape_sweep(const sw_shape *shape, sw_vec a0, sw_vec b0, sw_vec a1, sw_vec b1, double margin,
                   sw_closest *out, double *when);

/* What a feature is. Of an edge: its unit direction. Places found inside of a solid may name a face
 * where they lie on an edge. */
typedef enum sw_sharp {
  SW_SHARP_NOT,
  SW_SHARP_EDGE,
  SW_SHARP_CORNER,
  SW_SHARP_ROUND /* a thin round side, to a wire of longer edges */
} sw_sharp;
sw_sharp sw_shape_sharp(const sw_shape *shape, int feature, sw_vec *along);
/* A convex edge or corner. */
typedef struct sw_ridge {
  sw_sharp sharp;
  int feature;
  sw_vec from, along; /* its first end [m]; unit, of an edge [-] */
  double length;      /* of an edge [m] */
} sw_ridge;
typedef void (*sw_ridge_visit)(void *user, const sw_ridge *ridge);
/* All that are less than reach away from the segment a-b, and perhaps some more. */
void sw_shape_ridges(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_ridge_visit visit,
                     void *user);
/* 1: n points away from all that meets at the edge or corner, or leans inward by no more than this
 * share of the angle of its faces, of small angles [-]. */
int sw_shape_points_out(const sw_shape *shape, const sw_ridge *ridge, sw_vec n, double share);
/* 0: no place of the segment a-b is nearer than reach to the shape's box. */
int sw_shape_meets(const sw_shape *shape, sw_vec a, sw_vec b, double reach);
/* 1: of all places, and of all between them, one and the same face is what is nearest, and they are
 * outside of it. 0: perhaps not. */
int sw_shape_over_face(const sw_shape *shape, const sw_vec *p, size_t count);
/* 1: all that is not flat about it are edges and corners: none that many small faces stand for what
 * is round. */
int sw_shape_has_edges(const sw_shape *shape);
/* Of a shape whose surface, or its side, is as far from a middle line everywhere: that distance
 * [m], the place q of the line nearest to p and the line's direction there, 0 of a ball's middle
 * [-]. 0: it is none, or p is beside an end where the surface is another one. */
double sw_shape_middle(const sw_shape *shape, sw_vec p, sw_vec *q, sw_vec *along);

sw_bounds sw_shape_bounds(const sw_shape *shape);
const char *sw_shape_kind(const sw_shape *shape); /* "box", "mesh", ... */

int sw_shape_is(const sw_shape *shape, unsigned trait);

/* The shape's surface, to be drawn: round ones with so many vertices around (a multiple of 4, at
 * least 8). Triangles of a mesh or hull are its own. None of a half space. */
sw_status sw_shape_triangles(const sw_shape *shape, int around, sw_triangles *out);

/* The bones of a shape, by which overlaps are found: its corners and edges, or the middle line of a
 * round shape. A half space has none. */
void sw_shape_bones(const sw_shape *shape, sw_bone_visit visit, void *user);

/* A shape; reading makes it anew from what it was made from, which gives the same bits. */
void sw_tape_shape(sw_tape *tape, sw_shape **shape);

sw_shape *sw_shape_retain(sw_shape *shape); /* NULL gives NULL */
void sw_shape_release(sw_shape *shape);     /* NULL is allowed */

#endif
