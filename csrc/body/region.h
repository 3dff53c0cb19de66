/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wires of which only a region is a mesh of rings; the rest are lines of particles. */
#ifndef SW_BODY_REGION_H
#define SW_BODY_REGION_H

#include "scene/scene.h"

typedef struct sw_stations {
  size_t n;
  double *s;           /* (n) arc lengths [m] */
  unsigned char *ring; /* (n) 1: a ring, 0: a particle of a line */
  double spacing;      /* of rings [m] */
} sw_stations;

/* Plans rings of this spacing in the region (from, to) and around clamps, and lines of about the
 * spacing `line` elsewhere. SW_EINVAL when nothing is left for lines. */
sw_status sw_region_plan(const sw_scene *scene, size_t wire, const double region[2], double spacing,
                         double line, sw_stations *out, sw_error *err);
void sw_region_free(sw_stations *stations);

#endif
