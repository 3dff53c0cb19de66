/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inside of a frozen grip: what pads held, and what both changes between pads and a rigid
 * grip need. */
#ifndef SW_SCENE_FROZEN_INNER_H
#define SW_SCENE_FROZEN_INNER_H

#include "scene/remodel_inner.h"

struct sw_frozen {
  int references;
  sw_handle wire, hold;
  const sw_wire_class *cls;
  sw_mesh mesh;          /* one node for each ring, as they lay */
  sw_strand strand;      /* likewise */
  sw_pose pose;          /* of the tool then */
  size_t first, last;    /* rings that were pressed */
  double inside[2];      /* so far inside of them a rod's grip ends before, and after [m] */
  sw_clamp_give give[2]; /* how it gives way there; axes in the world's then */
  sw_vec across;         /* how the pads close, in the tool's axes [-] */
  double *frame;         /* (rings x 6) tangent, direction across then [-] */
  sw_stations stations;
  void *memory; /* of contact then */
  size_t bytes;
  size_t node, nodes; /* the wire's first one in it, how many it had */
  sw_jaw jaw;
};

/* Accelerations of a wire's rings, or of its nodes (count x 3), to be freed; NULL: no memory. */
double *sw_frozen_accelerations(const sw_scene *scene, size_t wire, size_t *count);
/* Put the built scene where it is in balance with the accelerations that it has: of the wire those
 * of its rings or nodes before (count x 3). Velocities stay. */
sw_status sw_frozen_balance(sw_scene *scene, size_t wire, const double *rings, size_t count);
/* Find inside and give: how a rod's grip has to be to give way like the mesh between the pads. The
 * scene is built. */
sw_status sw_frozen_find_give(sw_scene *scene, const sw_tool *tool, sw_frozen *f, sw_error *err);

#endif
