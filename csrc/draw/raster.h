/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which face or ball is nearest at each sample of a view. */
#ifndef SW_DRAW_RASTER_H
#define SW_DRAW_RASTER_H

#include "draw/drawing.h"

enum { SW_NOTHING = 0, SW_BALL = 1u << 31 }; /* else the number of a face plus 1 */

typedef struct sw_layer {
  size_t width, height;
  float *near;  /* larger is nearer; 0: nothing: 1 / ahead [1/m], of a lamp's what is left [m] */
  uint32_t *id; /* NULL: not wanted */
} sw_layer;

/* SW_ENOMEM. */
sw_status sw_layer_new(size_t width, size_t height, int ids, sw_layer *out);
void sw_layer_free(sw_layer *layer);

/* A camera's view, in samples. */
typedef struct sw_view {
  sw_camera camera;
  double width, height;
  double near; /* nothing is seen nearer than this [m] */
} sw_view;

sw_view sw_view_of(const sw_camera *camera, double width, double height, const sw_drawing *d);
/* Sample coordinates and 1 / ahead; 0: it is too near, or behind. */
int sw_view_project(const sw_view *v, sw_vec p, double out[3]);
/* The direction through a sample, one ahead long [-]. */
sw_vec sw_view_ray(const sw_view *v, double x, double y);

/* All faces, without those of tubes if so wanted, and balls. SW_EINTR. */
sw_status sw_raster(const sw_drawing *d, const sw_view *v, int without_tubes, sw_layer *layer,
                    int (*interrupted)(void));

/* A lamp far away. */
typedef struct sw_lamp {
  sw_vec toward, right, up;           /* to the lamp, and across [-] */
  double left, bottom, scale, middle; /* of its map [m], [m], [1/m], [m] */
} sw_lamp;
sw_lamp sw_lamp_of(sw_vec toward, sw_vec low, sw_vec high, size_t side);
void sw_raster_lamp(const sw_drawing *d, const sw_lamp *lamp, sw_layer *layer);

#endif
