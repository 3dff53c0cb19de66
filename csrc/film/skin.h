/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes the surfaces of wires in frames, for export to other programs: round tubes along a wire's
 * nodes, the outside of a mesh of particles, or the particles themselves. */
#ifndef SW_FILM_SKIN_H
#define SW_FILM_SKIN_H

#include <stdint.h>

#include "read/frames.h"

typedef struct sw_skin_args {
  size_t wire;          /* number of the wire in the scene, from 0 [-] */
  const size_t *frames; /* (count) numbers of frames */
  size_t count;
  size_t sides;     /* of a tube, 3 to 64 [-] */
  double thickness; /* factor on the radius [-] */
  int differences;  /* 1: all frames after the first contain differences from the first */
} sw_skin_args;

/* The corners run round each section, section by section. Then come both ends: a separate ring and
 * its middle point for each. An object of particles has no normals and no triangles. */
typedef struct sw_skin {
  float *data;        /* for each frame: corners, three numbers each [m], then their normals [-] */
  float *bounds;      /* for each frame: smallest x y z, largest x y z of its data [m] */
  uint32_t *triangle; /* three corners each; they face outwards */
  size_t corners, triangles;
  int normals;
} sw_skin;

/* Makes the skin. All frames get the number of sections of the first frame that has the wire. A
 * frame without the wire gets the points of the nearest frame that has it. SW_EINVAL: no frame has
 * the wire. SW_ENOMEM, SW_EINTR. */
sw_status sw_skin_make(const sw_scene *scene, const sw_skin_args *args, int (*interrupted)(void),
                       sw_skin *out, sw_error *err);
void sw_skin_free(sw_skin *skin);

#endif
