/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lamp's shadow map, smoothed over 3 x 3 cells, and the light on a point. sRGB as IEC
 * 61966-2-1. */
#include "draw/light.h"

#include "base/simd.h"

enum { MAP = 2048, BLOCK = 16, ROUGH = MAP / BLOCK, STEPS = 1024 };
static const double AMBIENT = 0.30, SKY = 0.26, KEY = 0.62, FILL = 0.16;
static const double SHARP = 36; /* exponent of the gloss (Blinn 1977) [-] */
static const double BEHIND =
    2.0; /* a shadow begins this far behind its caster: no self-shadowing [cells of the map] */

/* IEC 61966-2-1, from a table, because pictures have many points. */
float sw_linear(float c) {
  static float table[STEPS + 2];
  if (table[STEPS] == 0)
    for (int i = 0; i <= STEPS; i++) {
      const float x = (float)i / STEPS;
      table[i] = x <= 0.04045f ? x / 12.92f : powf((x + 0.055f) / 1.055f, 2.4f);
    }
  const float at = STEPS * (c > 1 ? 1 : c > 0 ? c : 0);
  const int i = (int)at;
  return table[i] + (at - (float)i) * (table[i < STEPS ? i + 1 : i] - table[i]);
}

uint8_t sw_srgb_table[SW_SRGB_STEPS + 1];

static void fill_table(void) {
  for (int i = 0; i <= SW_SRGB_STEPS; i++) {
    const float x = (float)i / SW_SRGB_STEPS;
    const float s = x <= 0.0031308f ? 12.92f * x : 1.055f * powf(x, 1 / 2.4f) - 0.055f;
    sw_srgb_table[i] = (uint8_t)(255 * s + 0.5f);
  }
}

static float larger(float a, float b) { return a > b ? a : b; }

static void roughen(sw_light *l) {
  for (size_t k = 0; k < ROUGH; k++)
    for (size_t j = 0; j < ROUGH; j++) {
      const float *map = l->map.near + MAP * BLOCK * k + BLOCK * j;
      float most = 0;
      for (size_t b = 0; b < BLOCK; b++)
        for (size_t a = 0; a < BLOCK; a++) most = larger(most, map[MAP * b + a]);
      /* sw_light_seen reads up to two cells beside */
      for (size_t y = k ? k - 1 : 0; most > 0 && y <= k + 1 && y < ROUGH; y++)
        for (size_t x = j ? j - 1 : 0; x <= j + 1 && x < ROUGH; x++)
          l->rough.near[ROUGH * y + x] = larger(l->rough.near[ROUGH * y + x], most);
    }
}

sw_status sw_light_new(const sw_drawing *d, const sw_camera *c, sw_light *out) {
  if (!sw_srgb_table[SW_SRGB_STEPS]) fill_table();
  sw_vec low, high;
  const sw_vec level = sw_unit_or(sw_madd(c->forward, c->sky, -sw_dot(c->forward, c->sky)), c->up);
  *out = (sw_light){.sky = c->sky, .eye = c->at};
  out->key = sw_unit_or(
      sw_add(sw_scale(c->right, -0.8), sw_add(sw_scale(c->sky, 1.9), sw_scale(level, -0.55))),
      c->sky);
  out->fill = sw_unit_or(
      sw_add(sw_scale(c->right, 1.4), sw_add(sw_scale(c->sky, 0.7), sw_scale(level, -1.2))),
      c->sky);
  if (!sw_drawing_bounds(d, &low, &high)) return SW_OK;
  out->lamp = sw_lamp_of(out->key, low, high, MAP);
  SW_TRY(sw_layer_new(MAP, MAP, 0, &out->map));
  SW_TRY(sw_layer_new(ROUGH, ROUGH, 0, &out->rough));
  sw_raster_lamp(d, &out->lamp, &out->map);
  roughen(out);
  return SW_OK;
}

void sw_light_free(sw_light *light) { sw_layer_free(&light->map), sw_layer_free(&light->rough); }

/* The mean over 3 x 3 cells of the lamp's map. */
double sw_light_seen(const sw_light *l, sw_vec p, sw_vec n) {
  const double dot = 1 / l->lamp.scale;
  if (!l->map.near) return 1;
  p = sw_madd(sw_madd(p, n, 0.8 * BEHIND * dot), l->key, 0.6 * BEHIND * dot);
  const double x = (sw_dot(p, l->lamp.right) - l->lamp.left) * l->lamp.scale - 0.5;
  const double y = (sw_dot(p, l->lamp.up) - l->lamp.bottom) * l->lamp.scale - 0.5;
  const double above = sw_dot(p, l->lamp.toward) - l->lamp.middle;
  const float z = above > 0 ? (float)above : 0; /* the map is 0 where there is nothing */
  if (!(x >= 1 && y >= 1 && x < MAP - 3 && y < MAP - 3)) return 1;
  const size_t j = (size_t)x, k = (size_t)y;
  if (l->rough.near[ROUGH * (k / BLOCK) + j / BLOCK] <= z) return 1;
  const float fx = (float)(x - (double)j), fy = (float)(y - (double)k);
  const float wx[4] = {1 - fx, 1, 1, fx}, wy[4] = {1 - fy, 1, 1, fy};
  float sum = 0;
  for (size_t b = 0; b < 4; b++) {
    const float *row = l->map.near + MAP * (k + b - 1) + j - 1;
    for (size_t a = 0; a < 4; a++) sum += row[a] <= z ? wx[a] * wy[b] : 0;
  }
  return (double)sum / 9;
}

void sw_light_parts(const sw_light *l, const sw_lit *at, float *shade, float *sun) {
  const double ahead = sw_dot(at->n, l->key), side = sw_dot(at->n, l->fill);
  const double sky = 0.5 + 0.5 * sw_dot(at->n, l->sky);
  *shade = (float)(AMBIENT + SKY * sky + FILL * (side > 0 ? side : 0));
  *sun = (float)(KEY * (ahead > 0 ? ahead : 0));
}

SW_HOT void sw_light_on(const sw_light *l, const sw_lit *at, float out[3]) {
  const sw_vec eye = sw_unit_or(sw_sub(l->eye, at->p), l->sky);
  sw_lit to = *at;
  float shade, sun;
  if (sw_dot(at->n, eye) < 0) to.n = sw_neg(at->n);
  sw_light_parts(l, &to, &shade, &sun);
  const double seen = sun > 0 ? sw_light_seen(l, at->p, to.n) : 0;
  double shine = 0;
  if (at->gloss > 0 && seen > 0) {
    const double h = sw_dot(to.n, sw_unit_or(sw_add(eye, l->key), to.n));
    shine = h > 0.8 ? (double)at->gloss * seen * pow(h, SHARP) : 0;
  }
  for (int c = 0; c < 3; c++) out[c] = at->colour[c] * (shade + sun * (float)seen) + (float)shine;
}
