/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rigid shapes in their own coordinates: immutable, reference-counted. The three main queries: the
 * distance of a point, the nearest places along a segment, and the first touch of a moving
 * segment. */
#ifndef SW_SHAPE_SHAPE_H
#define SW_SHAPE_SHAPE_H

#include <stddef.h>

#include "base/param.h"
#include "base/status.h"
#include "base/tape.h"
#include "base/vec.h"

typedef struct sw_shape sw_shape;
typedef struct sw_shape_class sw_shape_class;

enum { SW_CLOSEST_MAX = 8 }; /* most contacts of one segment with one shape [-] */

/* A nearest place. gap and normal are signed and outward: a point inside has a negative gap and the
 * normal of the nearest surface place. */
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

/* Input of a shape besides its parameters: a hull's points, a mesh's file. It is only read while
 * the shape is made. */
typedef struct sw_shape_source {
  const double *points; /* n x 3 [m] */
  size_t point_count;   /* n [-] */
  const char *bytes;    /* content of a mesh file */
  size_t byte_count;    /* its length [B] */
} sw_shape_source;

/* A surface of triangles with outward winding. */
typedef struct sw_triangles {
  double *vertices;                    /* vertex_count x 3 [m] */
  int *indices;                        /* triangle_count x 3, from 0 */
  size_t vertex_count, triangle_count; /* [-] */
} sw_triangles;
void sw_triangles_free(sw_triangles *triangles);

/* Called for each bone of a shape; a = b: a point. All places within skin of the bone are inside
 * the shape. */
typedef void (*sw_bone_visit)(void *user, sw_vec a, sw_vec b, double skin);

/* Traits of a kind. */
enum {
  SW_SHAPE_FLAT = 1,   /* a half space: a segment is nearest at one of its ends */
  SW_SHAPE_FACED = 2,  /* bounded by flat faces */
  SW_SHAPE_LISTED = 4, /* made from a list or a file, possibly very large */
  SW_SHAPE_SQUARE = 8  /* its faces meet at right angles: never nearly round */
};

/* Returns the kinds of shape, NULL-terminated, in the order of list.def. */
const char *const *sw_shape_kinds(void);
const sw_shape_class *sw_shape_class_find(const char *kind);         /* NULL when unknown */
const sw_params *sw_shape_class_params(const sw_shape_class *class); /* "obstacle box" */

/* Examples of a kind for help, specs and fuzzers, as Lua text inside a table: arguments that it
 * accepts (size about 1 m), and arguments that it refuses with a part of the message. */
typedef struct sw_shape_wrong {
  const char *args, *message; /* args NULL: the end of a list */
} sw_shape_wrong;

const char *sw_shape_class_summary(const sw_shape_class *class);
unsigned sw_shape_class_traits(const sw_shape_class *class); /* SW_SHAPE_FLAT | ... */
int sw_shape_class_convex(const sw_shape_class *class);
const char *sw_shape_class_sample(const sw_shape_class *class);
const sw_shape_wrong *sw_shape_class_wrong(const sw_shape_class *class);

/* Room for any kind's argument struct, to be filled by the kind's rows. */
typedef union sw_shape_args {
  double align;
  char bytes[64];
} sw_shape_args;

/* Makes a shape of the class from checked arguments. source may be NULL for kinds that need none.
 * *out holds one reference, or NULL on failure. */
sw_status sw_shape_new(const sw_shape_class *class, const sw_shape_args *args,
                       const sw_shape_source *source, sw_shape **out, sw_error *err);

/* Places with a coordinate beyond SW_SHAPE_FAR or NaN are far from everything: the three queries
 * return 0. For all other places every returned number is finite. */
#define SW_SHAPE_FAR 1e50    /* [m] */
#define SW_SHAPE_LARGEST 1e6 /* largest size of a shape [m] */

/* Finds the nearest surface place to the point p. Returns 1 and fills out if the gap is below
 * reach, else 0 (out is then undefined). In an open mesh (a sheet) the back counts as inside, but
 * not beyond the border, and outside the mesh's bounds only within reach. */
int sw_shape_point(const sw_shape *shape, sw_vec p, double reach, sw_closest *out);

/* Lists the further near places of a point outside a hollow shape, nearest first: those of the
 * other flanks of a groove, for example. nearest: the result of sw_shape_point. Fills up to
 * SW_CLOSEST_MAX places less than reach away [m], and returns their number. */
int sw_shape_beside(const sw_shape *shape, sw_vec p, double reach, const sw_closest *nearest,
                    sw_closest out[SW_CLOSEST_MAX]);
/* Like sw_shape_point, but of several near places takes the one whose normal is most like `way`
 * [-]. */
int sw_shape_point_like(const sw_shape *shape, sw_vec p, double reach, sw_vec way, sw_closest *out);

/* Finds contacts strictly between the ends of the segment a-b, which queries at its ends would
 * miss: local minima of the distance along the segment. A contact is dropped if its gap is not
 * below the linear interpolation of the two end gaps, so a segment lying flat on a face has none. A
 * segment that bridges a flat face or a straight side has a contact at both ends of the bridge; one
 * of them fades away as the segment tilts. normal is perpendicular to the segment, except at the
 * second edge of such a bridge. For a segment cut by an edge, gap is minus the way out along
 * normal. On the facets of a round surface a mesh or hull also gives places on edges beside the
 * nearest one, nearly as near (up to 3 % of reach, and 0.1 mm), so that a segment rocks from edge
 * to edge without a jump. A mesh finds places with |gap| below reach, other shapes with gap below
 * reach. Fills up to SW_CLOSEST_MAX contacts, nearest first, and returns their number. */
int sw_shape_segment(const sw_shape *shape, sw_vec a, sw_vec b, double reach,
                     sw_closest out[SW_CLOSEST_MAX]);

/* Finds the first touch of a segment that moves from (a0, b0) to (a1, b1) in the time 0 to 1, each
 * end on a straight line. Let g(t) be the smallest gap of all its points and level = min(margin,
 * g(0)). A touch is a t in (0, 1] with g(t) < level - tolerance. A segment that starts further away
 * than margin (>= 0) is thus reported when it comes within margin, up to the tolerance; a segment
 * that starts nearer is reported when it gets deeper or crosses. Returns 1 with the place of the
 * first touch, and its time in *when. The tolerance is 1e-10 of the largest coordinate. A crossing
 * is never missed. If the iterations run out (grazing), the time reached is reported. In a mesh,
 * triangles that the segment pierces at the start are left out. */
int sw_shape_sweep(const sw_shape *shape, sw_vec a0, sw_vec b0, sw_vec a1, sw_vec b1, double margin,
                   sw_closest *out, double *when);

/* Returns the kind of a feature, and the unit direction of an edge. A place found inside a solid
 * may name a face although it lies on an edge. */
typedef enum sw_sharp {
  SW_SHARP_NOT,
  SW_SHARP_EDGE,
  SW_SHARP_CORNER,
  SW_SHARP_ROUND /* a round side thin compared with the wire's edges */
} sw_sharp;
sw_sharp sw_shape_sharp(const sw_shape *shape, int feature, sw_vec *along);
/* A convex edge or corner. */
typedef struct sw_ridge {
  sw_sharp sharp;
  int feature;
  sw_vec from, along; /* first end of an edge, or the corner [m]; unit direction [-] */
  double length;      /* of an edge [m] */
} sw_ridge;
typedef void (*sw_ridge_visit)(void *user, const sw_ridge *ridge);
/* Visits all ridges less than reach away from the segment a-b, and possibly some more. */
void sw_shape_ridges(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_ridge_visit visit,
                     void *user);
/* 1: n points away from all faces and edges that meet at the ridge, or leans inward by at most this
 * share of the angle between its faces (for small angles) [-]. */
int sw_shape_points_out(const sw_shape *shape, const sw_ridge *ridge, sw_vec n, double share);
/* 0: the whole segment a-b is further than reach from the shape's box. */
int sw_shape_meets(const sw_shape *shape, sw_vec a, sw_vec b, double reach);
/* 1: all these places, and all places between them, lie outside the same face, which is nearest to
 * them. 0: not certain. */
int sw_shape_over_face(const sw_shape *shape, const sw_vec *p, size_t count);
/* 1: the shape has edges and corners, and none of its edges approximate a round surface by small
 * faces. */
int sw_shape_has_edges(const sw_shape *shape);
/* Returns the mean width of the facets that approximate a round surface. 0: there are none, or some
 * of the surface is hollow in facets. *radius: about that of the round surface [m]. */
double sw_shape_facet(const sw_shape *shape, double *radius);
/* 1: a mesh with a border. It is a sheet, solid on its back only. */
int sw_shape_is_open(const sw_shape *shape);
/* Returns the radius of the round surface that facets of a mesh approximate, about [m]. 0: there is
 * none. */
double sw_shape_roundness(const sw_shape *shape);
/* For a shape whose surface, or side, has a constant distance from a middle line: returns this
 * distance [m], with the line's place q nearest to p and its direction there (0 at a ball's centre)
 * [-]. 0: there is no such line, or p is beyond an end with another surface. */
double sw_shape_middle(const sw_shape *shape, sw_vec p, sw_vec *q, sw_vec *along);

sw_bounds sw_shape_bounds(const sw_shape *shape);
const char *sw_shape_kind(const sw_shape *shape); /* "box", "mesh", ... */

int sw_shape_is(const sw_shape *shape, unsigned trait);

/* Makes triangles of the shape's surface for drawing. Round shapes get `around` vertices around (a
 * multiple of 4, at least 8); meshes and hulls give their own triangles; a half space gives
 * none. */
sw_status sw_shape_triangles(const sw_shape *shape, int around, sw_triangles *out);

/* Visits the shape's bones, by which overlaps are found: corners and edges, or the middle line of a
 * round shape. A half space has none. */
void sw_shape_bones(const sw_shape *shape, sw_bone_visit visit, void *user);

/* Puts a shape on a tape. Reading makes the shape anew from its original input, with identical
 * bits. */
void sw_tape_shape(sw_tape *tape, sw_shape **shape);

sw_shape *sw_shape_retain(sw_shape *shape); /* NULL gives NULL */
void sw_shape_release(sw_shape *shape);     /* NULL is allowed */

#endif
