/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A wire's nodes while nothing runs: a growable list that can be edited (move a node to a given arc
 * length, insert a node). It becomes a plan before the next step. */
#ifndef SW_STATE_MESH_H
#define SW_STATE_MESH_H

#include <stddef.h>

#include "base/status.h"
#include "base/vec.h"

typedef struct sw_mesh {
  size_t n, capacity;
  double *s;     /* (n) arc length from the wire's original start; below 0 where wire was fed at the
                    start [m] */
  double *x, *v; /* (n x 3) [m], [m/s] */
  double *a;     /* (n x 3) of the last step; valid while nothing jumps [m/s2] */
  double *tension; /* (n) of the edge that starts at each node; last unused [N] */
  double *rate;    /* (n) the same: its strain rate, where dashpots know it [1/s] */
  double EA;       /* to keep edge strains when nodes move [N] */
  double spacing;  /* of the original even nodes, before holds moved and added some [m] */
  int drawn;       /* 1: as drawn, nothing has moved yet */
  double scale;    /* its length over that of the wire's first mesh [-] */

  /* of a wire with material frames; NULL without */
  double *rest;        /* (n x 3) nodes of the unloaded wire, somewhere in space [m] */
  double *normal;      /* (n x 3) first material axis of the edge that starts there [-] */
  double *rest_normal; /* (n x 3) the same when unloaded [-] */
  double *twist;       /* (n) of the hinge at each node, both sides of a clamp [rad] */
  double *turn, *spin; /* (n) for the edge that starts there, if it rolls: turn about itself, and
                          its rate [rad], [rad/s] */
} sw_mesh;

/* The frames at one arc length. */
typedef struct sw_mesh_frame {
  sw_vec tangent, normal;           /* [-] */
  sw_vec rest_tangent, rest_normal; /* of the unloaded wire [-] */
} sw_mesh_frame;

/* Unit direction of an edge between nodes (n x 3) [-]; middle of a mesh's edge in arc length [m].
 */
static inline sw_vec sw_edge_direction(const double *nodes, size_t e) {
  return sw_unit_or(sw_sub(sw_vec_at(nodes, e + 1), sw_vec_at(nodes, e)), sw_v(1, 0, 0));
}
static inline double sw_mesh_middle(const sw_mesh *m, size_t e) {
  return 0.5 * (m->s[e] + m->s[e + 1]);
}

/* Makes even nodes along the polyline through points (count x 3): segments + 1 nodes, at rest and
 * unstressed: the arc length of each edge is its chord. SW_ENOMEM. */
sw_status sw_mesh_along(sw_mesh *mesh, const double *points, size_t count, size_t segments);
/* Computes by which shares edges between arc lengths s (n) are shorter than arcs of the polyline
 * through points (count x 3), along which they were drawn with so many segments and this length;
 * its corners count nothing. any: 0 if all are zero, and shares (n - 1) is not set. SW_ENOMEM. */
sw_status sw_mesh_arcs(const double *points, size_t count, size_t segments, const double *s,
                       size_t n, double length, double *shares, int *any);
void sw_mesh_free(sw_mesh *mesh);

/* Makes an independent copy. SW_ENOMEM. */
sw_status sw_mesh_copy(const sw_mesh *from, sw_mesh *to);

/* Makes an empty mesh of n nodes, otherwise like the other one. SW_ENOMEM. */
sw_status sw_mesh_like(const sw_mesh *other, size_t n, sw_mesh *to);

/* Makes the same wire with nodes at other arc lengths s (count; from 0 to its length), keeping its
 * shape, motion, strains and frames. held: stretches (held_count x 2: from, to) that stay as they
 * are; both meshes have nodes at their ends. SW_ENOMEM. */
sw_status sw_mesh_resample(const sw_mesh *from, const double *s, size_t count, const double *held,
                           size_t held_count, sw_mesh *out);

/* Returns an edge quantity (edges) at arc length s, linear between the middles of edges, but not
 * across the ends of held stretches (held_count x 2: from, to). */
double sw_mesh_edge_value(const sw_mesh *mesh, const double *values, double s, const double *held,
                          size_t held_count);

/* Gives edges of a stretch that a hold keeps rigid the tension that their chords have, which they
 * cannot leave. */
void sw_mesh_strain_as_held(sw_mesh *mesh, double from, double to);

/* Puts node i, which was moved or inserted on its edges' chords, and its neighbours on the curve
 * through the nodes before, if the unloaded wire is curved there. keep: arc lengths (count) of
 * nodes that must stay. SW_ENOMEM. */
sw_status sw_mesh_smooth(sw_mesh *mesh, size_t i, const sw_mesh *before, const double *keep,
                         size_t keep_count);

/* 1 if the wire, or the unloaded wire, is bent where such neighbours are. */
int sw_mesh_is_bent_near(const sw_mesh *mesh, size_t i);

/* Halves every edge between the nodes at arc lengths low and high, with new nodes on the wire's
 * curve. keep: as above. SW_ENOMEM. */
sw_status sw_mesh_halve(sw_mesh *mesh, double low, double high, const double *keep, size_t count);

/* Shifts nodes first to last of a bent wire for a hold that is about to clamp them (way 1): the
 * hinges beside them then have the wire's bend there. Or shifts them back for a hold that has let
 * go (-1). keep: as above. SW_ENOMEM. */
sw_status sw_mesh_lean(sw_mesh *mesh, size_t first, size_t last, int way, const double *keep,
                       size_t count);

/* Gives the wire frames without twist in its present shape. Their first axis at the wire's start is
 * the part of normal across it. straight: 1 if the unloaded wire is straight, else it has the
 * present shape; rest_twist: twist of the unloaded wire [rad/m]. SW_ENOMEM. */
sw_status sw_mesh_add_frames(sw_mesh *mesh, sw_vec normal, int straight, double rest_twist);

/* Returns the frames at arc length s of a mesh that has frames. */
sw_mesh_frame sw_mesh_frame_at(const sw_mesh *mesh, double s);

/* Returns the wire's end if s is nearer to it than 0.4 % of the edge there, else s. A much shorter
 * stub would be stiffer than all else. */
double sw_mesh_snap(const sw_mesh *mesh, double s);

/* Makes s a node: moves the nearest node if allowed (not an end, not in keep), else inserts one.
 * keep: arc lengths (count) of nodes that must stay. SW_ENOMEM leaves the mesh as it was. */
sw_status sw_mesh_place(sw_mesh *mesh, double s, const double *keep, size_t keep_count,
                        double *placed);

/* Inserts a node inside an edge, on its chord. SW_ENOMEM leaves the mesh as it was. */
sw_status sw_mesh_insert(sw_mesh *mesh, size_t edge, double s);
/* Removes an inner node and joins the two edges beside it. */
void sw_mesh_remove(sw_mesh *mesh, size_t node);

/* Returns the node at arc length s exactly; the mesh must have one. */
size_t sw_mesh_node(const sw_mesh *mesh, double s);

/* Returns the wire's unit tangent at node i, second-order in the spacing. */
sw_vec sw_mesh_tangent(const sw_mesh *mesh, size_t i);

/* The same at any arc length s. */
sw_vec sw_mesh_tangent_at(const sw_mesh *mesh, double s);

#endif
