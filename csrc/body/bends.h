/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A wire's bends beside its clamping holds, which stay when it gets other edges. Of the scene's
 * inside. */
#ifndef SW_BODY_BENDS_H
#define SW_BODY_BENDS_H

#include "scene/scene.h"
#include "state/mesh.h"

/* The bends on one side of a hold. */
typedef struct sw_side_bends {
  size_t hold;    /* slot */
  int side;       /* 1: where arc lengths grow */
  double longest; /* edge there [m] */
  sw_mesh_bends bends;
} sw_side_bends;

typedef struct sw_wire_bends {
  sw_side_bends *list;
  size_t count;
} sw_wire_bends;

/* Reads the bends of a wire that is a line; the scene is not built. Free the list. SW_ENOMEM. */
sw_status sw_scene_keep_bends(const sw_scene *scene, size_t wire, sw_wire_bends *out);
/* Gives another mesh of the wire, which has the same holds, these bends. SW_ENOMEM. */
sw_status sw_scene_give_bends(const sw_scene *scene, size_t wire, const sw_wire_bends *bends,
                              sw_mesh *mesh);

#endif
