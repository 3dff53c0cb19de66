/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keeps the bends of a wire when its edges change, or when a hold comes or goes. */
#ifndef SW_BODY_BENDS_H
#define SW_BODY_BENDS_H

#include "link/hold.h"
#include "scene/scene.h"

/* Bend at an arc length, as a vector that turns the wire's direction as arc lengths grow. Two in
 * sequence at the same place: before and after a jump. */
typedef struct sw_bend {
  double s;      /* [m] */
  sw_vec vector; /* [1/m] */
} sw_bend;

typedef struct sw_bends {
  sw_bend *list; /* (count) with growing s */
  size_t count;
} sw_bends;

typedef struct sw_wire_bends {
  sw_bends loads, unloaded; /* by loads; of the unloaded wire, if the wire has frames */
  double longest;           /* edge [m] */
} sw_wire_bends;

/* Reads the bends of a wire that is a line; the scene is not built. SW_ENOMEM. */
sw_status sw_scene_read_bends(const sw_scene *scene, size_t wire, sw_wire_bends *out);
void sw_wire_bends_free(sw_wire_bends *bends);

/* Shifts nodes near these ends of holds (count) of a wire, which has got other edges or holds,
 * until it has these bends there as nearly as it can. Living holds and joints stay, but not
 * `fresh`, a hold that is about to grasp the wire; NULL: none. *done: 0 where another shape would
 * have been found. SW_ENOMEM. */
sw_status sw_scene_give_bends(const sw_scene *scene, size_t wire, const sw_wire_bends *bends,
                              const double *places, size_t count, sw_hold *fresh, int *done);

/* The same near all of its living holds. A wire that moves keeps its nodes: one that falls is bent
 * so sharply beside a clamp that coarse edges with that bend would shift its end by centimetres. */
sw_status sw_scene_give_all_bends(const sw_scene *scene, size_t wire, const sw_wire_bends *bends);

#endif
