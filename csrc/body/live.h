/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The state of a built scene, of contact and of the stepper. Of the scene's inside. */
#ifndef SW_BODY_LIVE_H
#define SW_BODY_LIVE_H

#include "base/tape.h"
#include "integrate/integrate.h"
#include "scene/scene.h"

/* The live part of a built scene, besides its objects, by its addresses: those in the scene, to be
 * put on a tape, or those on the tape, to be copied into a scene that is built of the same objects.
 */
typedef struct sw_live {
  const void *state;           /* x v a tension and so on of the built system */
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
  const void *grains; /* the same of objects of particles */
  size_t grains_size;
  const void *seen[3]; /* for read-outs: what touches obstacles, wires each other, particles */
  size_t seen_size[3];
} sw_live;
sw_live sw_live_of(const sw_scene *scene);
size_t sw_live_size(const sw_live *live); /* of its blocks [B] */
sw_status sw_live_put(sw_scene *scene, const sw_live *live, sw_error *err);
/* The same by way of a tape of one's own, for as long as the system stays. SW_ENOMEM leaves *out to
 * be freed. */
sw_status sw_live_take(const sw_scene *scene, sw_tape *out);
sw_status sw_live_back(sw_scene *scene, const sw_tape *taken, sw_error *err);
int sw_live_fits(const sw_scene *scene, const sw_live *live);
/* Particles of meshes to where they are in it, before the scene is built. SW_ENOMEM; SW_EINVAL: it
 * has not so many. */
sw_status sw_live_place(sw_scene *scene, const sw_live *live);

/* The state of one that is. */
void sw_tape_live(sw_tape *tape, sw_live *live);

#endif
