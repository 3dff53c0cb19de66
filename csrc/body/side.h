/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sides of nodes that have a bend of their own: at a clamp, where the wire's director is held, and
 * at a rigid joint, whose moment enters the wire there. All read-outs of a line's bend take them
 * from here. */
#ifndef SW_BODY_SIDE_H
#define SW_BODY_SIDE_H

#include "system/join.h"
#include "system/system.h"

typedef struct sw_bent_side {
  size_t node, edge;
  int side;                    /* 1: the edge leaves the node, -1: it arrives there */
  const sw_clamp_hinge *clamp; /* the node's clamp towards this edge, or NULL */
  int joined;                  /* 1: a rigid joint is at the node */
  sw_vec moment;               /* of all rigid joints on the node [N m] */
} sw_bent_side;

/* Finds the body's next side from *next on, which is 0 at first: those of its clamps, in the plan's
 * order, then those of joints without a clamp. Returns 0 after the last. out: the side found
 * before, or anything at first. */
int sw_scene_next_side(const sw_system *system, const sw_body *body, size_t *next,
                       sw_bent_side *out);
/* Finds the side of a node towards an edge; returns 0 if there is none. */
int sw_scene_side_at(const sw_system *system, const sw_body *body, size_t node, size_t edge,
                     sw_bent_side *out);
/* The following are for refreshed lines. */
/* Returns the curvature there [1/m]. */
double sw_scene_side_curvature(const sw_system *system, const sw_body *body,
                               const sw_bent_side *side);
/* Returns the change of the tangent along the wire, across the side's edge; its size is the
 * curvature [1/m]. */
sw_vec sw_scene_side_bend(const sw_system *system, const sw_body *body, const sw_bent_side *side);
/* Returns the bend beyond that at rest of a wire with frames [1/m]. */
double sw_scene_side_flexure(const sw_system *system, const sw_body *body,
                             const sw_bent_side *side);

#endif
