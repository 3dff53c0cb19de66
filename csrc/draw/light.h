/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Light on surfaces: a lamp that casts shadows (key), a weak lamp (fill), and the sky. Light values
 * are linear, not sRGB. */
#ifndef SW_DRAW_LIGHT_H
#define SW_DRAW_LIGHT_H

#include "draw/raster.h"

typedef struct sw_light {
  sw_vec key, fill, sky, eye;
  sw_lamp lamp;
  sw_layer map;   /* what the lamp sees; near = NULL: no shadows */
  sw_layer rough; /* for each block of the map: the largest near in it and its neighbours */
} sw_light;

/* A lit place: position, normal n (outward or inward), linear colour. */
typedef struct sw_lit {
  sw_vec p, n;
  float colour[3], gloss;
} sw_lit;

/* SW_ENOMEM. */
sw_status sw_light_new(const sw_drawing *d, const sw_camera *camera, sw_light *out);
void sw_light_free(sw_light *light);
void sw_light_on(const sw_light *light, const sw_lit *at, float out[3]);

/* Returns the share of the lamp that a place sees [-]. */
double sw_light_seen(const sw_light *light, sw_vec p, sw_vec n);
/* Returns the light on a surface in the shadow, and the light that the lamp adds. */
void sw_light_parts(const sw_light *light, const sw_lit *at, float *shade, float *sun);

float sw_linear(float srgb);
enum { SW_SRGB_STEPS = 4096 };
extern uint8_t sw_srgb_table[SW_SRGB_STEPS + 1]; /* filled by the first sw_light_new */
static inline uint8_t sw_srgb(float x) {
  return sw_srgb_table[x <= 0 ? 0 : x >= 1 ? SW_SRGB_STEPS : (int)(x * SW_SRGB_STEPS + 0.5f)];
}

#endif
