/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The unloaded shape of fed wire: a copy of the mesh (with frames) made when a feed took hold of
 * the wire, continued by the wire on the spool. Used in csrc/link and by guides (body/guide.h). */
#ifndef SW_LINK_SPOOL_H
#define SW_LINK_SPOOL_H

#include "state/mesh.h"

/* Returns the orientation whose first two axes are a unit tangent and a normal across it. */
sw_quat sw_spool_turn(sw_vec tangent, sw_vec normal);
sw_vec sw_spool_tangent(sw_quat turn);
sw_vec sw_spool_normal(sw_quat turn);

typedef struct sw_rest_place {
  sw_vec x;  /* [m] */
  sw_quat q; /* its tangent and normal are the first two axes */
} sw_rest_place;

/* Returns the unloaded wire at arc length s. Beyond either end the wire keeps the curvature and
 * twist of that end: wire on the spool is like the wire that came off it. */
sw_rest_place sw_spool_at(const sw_mesh *shape, double s);

/* Sets a node's unloaded place in the mesh and the unloaded frames of the edges beside it, for the
 * node's present arc length. */
void sw_spool_node(sw_mesh *mesh, const sw_mesh *shape, size_t node);

#endif
