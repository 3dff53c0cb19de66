/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Surfaces of wires in frames, as other programs read them: round tubes along a wire's nodes, the
 * outside of a mesh of particles, or the particles themselves. */
#ifndef SW_FILM_SKIN_H
#define SW_FILM_SKIN_H

#include <stdint.h>

#include "read/frames.h"

typedef struct sw_skin_args {
  size_t wire;          /* its number in the scene */
  const size_t *frames; /* numbers of frames */
  size_t count;         /* of them */
  size_t sides;         /* of a tube, 3 to 64 [-] */
  double thickness;     /* factor on its radius [-] */
  int differences;      /* 1: all frames but the first are what they differ from it by */
} sw_skin_args;

/* Corners run round each section, section by section, then both ends: a ring of their own and its
 * middle. Of an object of particles there are no normals and no triangles. */
typedef struct sw_skin {
  float *data;        /* of each frame: corners, three numbers each [m], then their normals [-] */
  float *bounds;      /* of each frame: least x y z, largest x y z of its corners [m] */
  uint32_t *triangle; /* three corners each, outwards */
  size_t corners, triangles;
  int normals;
} sw_skin;

/* As many sections in all frames: those of the first one that has the wire; a frame without it has
 * the nearest one's. SW_EINVAL: no frame has it. SW_ENOMEM, SW_EINTR. */
sw_status sw_skin_make(const sw_scene *scene, const sw_skin_args *args, int (*interrupted)(void),
                       sw_skin *out, sw_error *err);
void sw_skin_free(sw_skin *skin);

#endif
