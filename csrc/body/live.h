/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The state of a built scene, of contact and of the stepper. */
#ifndef SW_BODY_LIVE_H
#define SW_BODY_LIVE_H

#include "base/tape.h"
#include "integrate/integrate.h"
#include "scene/scene.h"

/* The live part of a built scene, without its objects, by addresses: in the scene, to be put on a
 * tape; or on the tape, to be copied into a scene built of the same objects. */
typedef struct sw_live {
  const void *state;           /* the built system's state: x v a tension and so on */
  size_t state_size;           /* in doubles */
  const sw_integrator *method; /* NULL: before the first run */
  double last_h;               /* [s] */
  int restart;
  const void *history; /* xp, vp of a method with history, or NULL */
  size_t history_size; /* in doubles */
  const void *memory;  /* contact anchors */
  size_t memory_size;  /* [B] */
  int fresh;
  const void *pairs; /* the same between wires */
  size_t pairs_size;
  const void *grains; /* the same for objects of particles */
  size_t grains_size;
  const void *seen[3]; /* touches for read-outs: with obstacles, of wires with each other, of
                          particles */
  size_t seen_size[3];
} sw_live;
sw_live sw_live_of(const sw_scene *scene);
size_t sw_live_size(const sw_live *live); /* of its blocks [B] */
sw_status sw_live_put(sw_scene *scene, const sw_live *live, sw_error *err);
/* Takes the live part into a tape in memory, and puts it back, while the system stays the same.
 * SW_ENOMEM leaves *out to be freed. */
sw_status sw_live_take(const sw_scene *scene, sw_tape *out);
sw_status sw_live_back(sw_scene *scene, const sw_tape *taken, sw_error *err);
int sw_live_fits(const sw_scene *scene, const sw_live *live);
/* Puts the particles of meshes where they are in the live part, before the scene is built.
 * SW_ENOMEM; SW_EINVAL: the live part has fewer. */
sw_status sw_live_place(sw_scene *scene, const sw_live *live);

/* The live part on a tape. */
void sw_tape_live(sw_tape *tape, sw_live *live);

#endif
