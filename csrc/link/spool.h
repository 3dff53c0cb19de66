/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The unloaded shape of wire that is fed: a mesh with frames as it was when a feed took hold of
 * it, and the wire on the spool before it. Of this room, and of guides (body/guide.h). */
#ifndef SW_LINK_SPOOL_H
#define SW_LINK_SPOOL_H

#include "state/mesh.h"

/* The orientation whose first two axes are a unit tangent and a normal across it. */
sw_quat sw_spool_turn(sw_vec tangent, sw_vec normal);
sw_vec sw_spool_tangent(sw_quat turn);
sw_vec sw_spool_normal(sw_quat turn);

typedef struct sw_rest_place {
  sw_vec x;  /* [m] */
  sw_quat q; /* its tangent and normal are the first two axes */
} sw_rest_place;

/* The unloaded wire at arc length s. Beyond its ends it goes on with the curvature and twist
 * that it has there: wire on the spool is like the wire that has come from it. */
sw_rest_place sw_spool_at(const sw_mesh *shape, double s);

/* Give a node of mesh its unloaded place, and the edges beside it their frames, for its arc
 * length there. */
void sw_spool_node(sw_mesh *mesh, const sw_mesh *shape, size_t node);

#endif
