/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inside of a frozen grip: the kept state of the wire between the pads. It serves the change to
 * a rigid grip and back. */
#ifndef SW_GRIP_FROZEN_H
#define SW_GRIP_FROZEN_H

#include "base/tape.h"
#include "body/region.h"
#include "scene/gripper.h"
#include "state/mesh.h"
#include "strand/strand.h"

/* Where a pad pressed; in the tool's axes, from the tool's centre. */
typedef struct sw_frozen_touch {
  sw_vec at, normal; /* towards the wire [m], [-] */
  double force;      /* across the surface [N] */
  double friction;   /* [-] */
} sw_frozen_touch;

struct sw_frozen {
  int references;
  sw_handle wire, hold;
  const sw_wire_class *cls;
  sw_mesh mesh;       /* one node for each ring, as the rings lay */
  sw_strand strand;   /* its particles, as they lay */
  sw_pose pose;       /* of the tool at that time */
  size_t first, last; /* first and last ring that was pressed */
  sw_vec across;      /* how the pads close, in the tool's axes [-] */
  double *rod;        /* (rings x 3) places of the rod that replaced the mesh [m] */
  double *frame;      /* (rings x 6) tangent and direction across at that time [-] */
  sw_stations stations;
  void *memory; /* of contact at that time */
  size_t bytes;
  sw_frozen_touch *touch; /* (touches) */
  size_t touches;
  size_t node, nodes; /* the wire's first node in the system then, number of nodes */
  sw_jaw jaw;
};

/* Keeps the touches of the tool's pads as they press at present. SW_ENOMEM. */
sw_status sw_frozen_keep_touches(sw_scene *scene, const sw_tool *tool, sw_frozen *f, sw_error *err);

void sw_frozen_release(sw_frozen *frozen);
/* Returns the load on the rigid grip over the load that the pads could bear in its place [-]. The
 * load is a force on the wire and its moment about the tool's centre, in the tool's axes. */
double sw_frozen_margin(const sw_frozen *frozen, sw_vec force, sw_vec moment);
/* The same of touches that press with the forces that they have, and of their friction on the wire
 * and its moment about the origin. axle: along a rod whose touches lie on its axis, as long as
 * their distance from its surface; else 0 [m]. */
double sw_touches_margin(const sw_frozen_touch *touch, size_t touches, sw_vec axle, sw_vec force,
                         sw_vec moment);
void sw_tape_frozen(sw_tape *tape, sw_frozen **frozen); /* *frozen may be NULL */
int sw_frozen_fits(const sw_frozen *frozen, const sw_scene *scene);

#endif
