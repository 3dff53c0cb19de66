/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inside of a frozen grip: the state of the wire between the pads, for the change to a rigid
 * grip and back. */
#ifndef SW_GRIP_FROZEN_H
#define SW_GRIP_FROZEN_H

#include "base/tape.h"
#include "body/region.h"
#include "scene/gripper.h"
#include "state/mesh.h"
#include "strand/strand.h"

/* Where a pad pressed; in the tool's axes, from its centre. */
typedef struct sw_frozen_touch {
  sw_vec at, normal; /* towards the wire [m], [-] */
  double force;      /* across the surface [N] */
  double friction;   /* [-] */
} sw_frozen_touch;

struct sw_frozen {
  int references;
  sw_handle wire, hold;
  const sw_wire_class *cls;
  sw_mesh mesh;       /* one node for each ring, as they lay */
  sw_strand strand;   /* likewise */
  sw_pose pose;       /* of the tool then */
  size_t first, last; /* rings that were pressed */
  sw_vec across;      /* how the pads close, in the tool's axes [-] */
  double *rod;        /* (rings x 3) where the rod that it became lay there [m] */
  double *frame;      /* (rings x 6) tangent, direction across then [-] */
  sw_stations stations;
  void *memory; /* of contact then */
  size_t bytes;
  sw_frozen_touch *touch; /* (touches) */
  size_t touches;
  size_t node, nodes; /* the wire's first one in it, how many it had */
  sw_jaw jaw;
};

/* The tool's pads press as they do now. SW_ENOMEM. */
sw_status sw_frozen_keep_touches(sw_scene *scene, const sw_tool *tool, sw_frozen *f, sw_error *err);

void sw_frozen_release(sw_frozen *frozen);
/* A force on the wire and its moment about the tool's centre, in the tool's axes, as a share of the
 * load that the pads could bear in place of the rigid grip [-]. */
double sw_frozen_margin(const sw_frozen *frozen, sw_vec force, sw_vec moment);
void sw_tape_frozen(sw_tape *tape, sw_frozen **frozen); /* or NULL */
int sw_frozen_fits(const sw_frozen *frozen, const sw_scene *scene);

#endif
