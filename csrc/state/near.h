/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of a mesh whose nodes move near a hold. */
#ifndef SW_STATE_NEAR_H
#define SW_STATE_NEAR_H

#include "state/mesh.h"

/* Returns nodes lo to hi of a mesh, in the mesh's own arrays. */
sw_mesh sw_mesh_stretch(const sw_mesh *mesh, size_t lo, size_t hi);
/* Copies inner nodes, and the frames of edges. */
void sw_mesh_copy_inner(const sw_mesh *from, sw_mesh *to);
/* 1 if no inner node, but node i, moved far. */
int sw_mesh_is_near(const sw_mesh *from, const sw_mesh *to, size_t i);
/* 1 if s is one of the arc lengths to keep (count) [m]. */
int sw_mesh_is_kept(const double *keep, size_t count, double s);

#endif
