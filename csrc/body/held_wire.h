/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A wire that is a line, with its present or planned holds, before the scene is built. */
#ifndef SW_BODY_HELD_WIRE_H
#define SW_BODY_HELD_WIRE_H

#include "body/bends.h"
#include "link/hold.h"
#include "scene/parts.h"
#include "state/mesh.h"
#include "state/plan.h"

typedef struct sw_held_wire {
  const sw_mesh *mesh;
  int unloaded;                  /* 1: with the shape of the unloaded wire */
  const double *nodes, *normals; /* (nodes x 3) of the mesh, in that shape; as in sw_mesh */
  const sw_hold *fresh;          /* about to grasp the wire; NULL: none */
  const sw_hold **holds;         /* (count) */
  size_t count;
  double *joined; /* (joins) places of joints [m] */
  size_t joins;
  sw_plan *plan;
} sw_held_wire;

/* 1 if a force on a wire remembers how it was bent, node by node. */
int sw_held_remembers(const sw_scene *s, size_t wire);

/* 1 if a wire with these bends moves: its kinetic energy is a large share of its bending energy. */
int sw_held_moves(const sw_scene *s, size_t wire, const sw_bends *bends);

/* Returns the hold that holds arc length s, or NULL [m]. */
const sw_hold *sw_held_by(const sw_held_wire *v, double s);
/* Returns the hinge of a clamp at node i on this side (1 or -1), or NULL. */
const sw_clamp_hinge *sw_held_clamp(const sw_held_wire *v, size_t i, int side);
/* Returns the present direction of a hold where the wire arrives (-1) or leaves (1) [-]. */
sw_vec sw_held_director(const sw_held_wire *v, const sw_hold *h, int end);

/* Return the length of wire that bends at node i between edges, and at a clamp's hinge. That of a
 * clamp makes moments right; the unloaded wire bends over half an edge [m]. */
double sw_held_joint(const sw_held_wire *v, size_t i);
double sw_held_clamp_joint(const sw_held_wire *v, const sw_clamp_hinge *h);

/* Return the turn of the unloaded wire, in its present directions (rest_turn), and the difference
 * of the present turn from it (flexure): at a node between edges; `beside`: between the edge on
 * this side of node i and a hold's direction [rad]. */
sw_vec sw_held_rest_turn(const sw_held_wire *v, size_t i);
sw_vec sw_held_flexure(const sw_held_wire *v, size_t i);
sw_vec sw_held_rest_turn_beside(const sw_held_wire *v, const sw_hold *h, size_t i, int side,
                                int end);
sw_vec sw_held_flexure_beside(const sw_held_wire *v, const sw_hold *h, size_t i, int side, int end);

#endif
