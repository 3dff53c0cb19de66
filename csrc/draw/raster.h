/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rasterises a drawing: finds the nearest face or ball at each sample of a view. */
#ifndef SW_DRAW_RASTER_H
#define SW_DRAW_RASTER_H

#include "draw/drawing.h"

enum { SW_NOTHING = 0, SW_BALL = 1u << 31 }; /* ids: nothing, ball's number + flag, face's + 1 */

typedef struct sw_layer {
  size_t width, height;
  float *near;  /* 0: nothing; view: 1 / distance ahead [1/m]; lamp: height toward the lamp [m] */
  uint32_t *id; /* NULL: no ids */
} sw_layer;

/* SW_ENOMEM. */
sw_status sw_layer_new(size_t width, size_t height, int ids, sw_layer *out);
void sw_layer_free(sw_layer *layer);

/* A camera's view; sizes in samples. */
typedef struct sw_view {
  sw_camera camera;
  double width, height;
  double near; /* nothing is seen nearer than this [m] */
} sw_view;

sw_view sw_view_of(const sw_camera *camera, double width, double height, const sw_drawing *d);
/* Returns sample coordinates and 1 / distance ahead; 0: p is too near, or behind the camera. */
int sw_view_project(const sw_view *v, sw_vec p, double out[3]);
/* Returns the direction through a sample; its part along camera.forward is 1 [-]. */
sw_vec sw_view_ray(const sw_view *v, double x, double y);

/* Rasterises all faces and balls; without_tubes: not the faces of tubes. SW_EINTR. */
sw_status sw_raster(const sw_drawing *d, const sw_view *v, int without_tubes, sw_layer *layer,
                    int (*interrupted)(void));

/* A lamp at infinity and the map of the surfaces that it lights. */
typedef struct sw_lamp {
  sw_vec toward, right, up;           /* direction to the lamp, axes of the map [-] */
  double left, bottom, scale, middle; /* map's edges [m], cells a metre [1/m], zero of near [m] */
} sw_lamp;
sw_lamp sw_lamp_of(sw_vec toward, sw_vec low, sw_vec high, size_t side);
void sw_raster_lamp(const sw_drawing *d, const sw_lamp *lamp, sw_layer *layer);

#endif
