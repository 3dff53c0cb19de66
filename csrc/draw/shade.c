/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shades a drawing on a canvas: four samples a pixel; each object among them is lit once. */
#include <string.h>

#include "base/each.h"
#include "base/simd.h"
#include "draw/light.h"
#include "draw/show.h"

/* Functions that are compiled into the hot loop, for each of its instruction sets. */
#define INSIDE static inline __attribute__((always_inline))

enum { SS = 2, SAMPLES = SS * SS };
static const float RIM = 0.72f;   /* factor on light where an object ends before another one [-] */
static const float PAPER = 0.93f; /* linear light of the background at its top [-] */

/* A floor, prepared for shading. */
typedef struct tile {
  sw_vec normal, a, b;           /* a, b: along the squares, of length 1 / side [1/m] */
  double height, from_a, from_b; /* of the camera [m], [squares], [squares] */
  double reach, dot;             /* [squares]; width of a pixel 1 m ahead [squares/m] */
  float shade, sun, colour[3];
} tile;

enum { TILES = 8 };

typedef struct stage {
  const sw_drawing *d;
  sw_view view; /* in samples */
  sw_light light;
  sw_layer layer;
  tile tiles[TILES];
  size_t tile_count;
} stage;

static uint32_t object_of(const sw_drawing *d, uint32_t id) {
  if (id == SW_NOTHING) return UINT32_MAX;
  if (id & SW_BALL) return 0x40000000u + (id & ~SW_BALL);
  return d->faces[id - 1].object;
}

INSIDE void paper(const stage *g, double y, float out[3]) {
  const float down = (float)(y / g->view.height);
  out[0] = PAPER - 0.16f * down, out[1] = PAPER - 0.14f * down,
  out[2] = PAPER + 0.02f - 0.12f * down;
}

/* --- the surface at a sample ------------------------------------------------------------ */

static void on_ball(const stage *g, const sw_ball *b, sw_vec ray, float near, sw_lit *at) {
  at->p = sw_madd(g->view.camera.at, ray, 1 / (double)near);
  at->n = sw_unit_or(sw_sub(at->p, sw_vec_of(b->p)), sw_neg(ray));
  for (int c = 0; c < 3; c++) at->colour[c] = sw_linear(b->colour[c]);
  at->gloss = b->gloss;
}

/* Finds position, normal, colour and gloss where the ray meets a face. They are interpolated
 * between the corners, at the point of the face nearest to where the ray meets its plane. */
static void on_face(const stage *g, const sw_face *f, sw_vec ray, float near, sw_lit *at) {
  const sw_vec a = sw_vec_of(f->c[0].p);
  const sw_vec u = sw_sub(sw_vec_of(f->c[1].p), a), v = sw_sub(sw_vec_of(f->c[2].p), a);
  const sw_vec across = sw_cross(u, v);
  const double slope = sw_dot(across, ray), size = sw_norm2(across);
  double ahead = 1 / (double)near;
  const double met = sw_dot(across, sw_sub(a, g->view.camera.at)) / slope;
  if (met > 0.98 * ahead && met < 1.02 * ahead) ahead = met;
  at->p = sw_madd(g->view.camera.at, ray, ahead);
  const sw_vec r = sw_sub(at->p, a);
  double s = sw_dot(sw_cross(r, v), across) / size, t = sw_dot(sw_cross(u, r), across) / size;
  s = fmin(1, fmax(0, s)), t = fmin(1 - s, fmax(0, t));
  const float w[3] = {(float)(1 - s - t), (float)s, (float)t};
  float n[3] = {0, 0, 0}, colour[3] = {0, 0, 0};
  for (int k = 0; k < 3; k++)
    for (int c = 0; c < 3; c++) {
      n[c] += w[k] * f->c[k].n[c];
      colour[c] += w[k] * f->c[k].colour[c];
    }
  at->n = sw_unit_or(sw_vec_of(n), sw_unit_or(across, ray));
  for (int c = 0; c < 3; c++) at->colour[c] = sw_linear(colour[c]);
  at->gloss = f->gloss;
}

/* --- floors -------------------------------------------------------------------------------- */

/* Prepares a floor: computes the values that are the same for all pixels. */
static tile tile_of(const stage *g, const sw_floor *f) {
  const sw_vec r = sw_sub(g->view.camera.at, f->point), side = sw_cross(f->normal, f->across);
  tile t = {.normal = f->normal};
  sw_lit at = {.p = g->view.camera.at, .n = f->normal, .colour = {1, 1, 1}};
  t.height = sw_dot(f->normal, r);
  t.a = sw_scale(f->across, 1 / f->square), t.b = sw_scale(side, 1 / f->square);
  t.from_a = sw_dot(t.a, r), t.from_b = sw_dot(t.b, r);
  t.reach = f->reach / f->square, t.dot = SS * 2 * g->view.camera.tx / g->view.width / f->square;
  sw_light_parts(&g->light, &at, &t.shade, &t.sun);
  for (int c = 0; c < 3; c++) t.colour[c] = sw_linear(f->colour[c]);
  return t;
}

/* Returns the floor that a ray meets first, in front of `near`; *ahead: how far ahead [m]. */
INSIDE const tile *floor_at(const stage *g, sw_vec ray, float near, double *ahead) {
  const tile *first = NULL;
  *ahead = near > 0 ? 1 / (double)near : HUGE_VAL;
  SW_ITEMS(const tile, t, g->tiles, g->tile_count) {
    const double down = -sw_dot(t->normal, ray);
    if (!(down > 0 && t->height < *ahead * down)) continue;
    *ahead = t->height / down, first = t;
  }
  return first;
}

/* Returns the share of dark squares (side 1) in a stretch of this width around x. */
INSIDE double squares(double x, double width) {
  const double from = 0.5 * (x - 0.5 * width), to = 0.5 * (x + 0.5 * width);
  const double low = floor(from), high = floor(to), a = from - low, b = to - high;
  if (low == high && (b < 0.5) == (a < 0.5)) return a < 0.5;
  return (0.5 * (high - low) + (b < 0.5 ? b : 0.5) - (a < 0.5 ? a : 0.5)) / (to - from);
}

/* Shades a floor. Distant squares blend to their mean; beyond the reach the floor fades to the
 * background. */
INSIDE void on_floor(const stage *g, const tile *t, sw_vec ray, double ahead, double y,
                     float out[3]) {
  const double u = t->from_a + ahead * sw_dot(t->a, ray), v = t->from_b + ahead * sw_dot(t->b, ray);
  const double away2 = u * u + v * v, near = 0.9 * t->reach;
  /* width of a pixel on the floor; it is foreshortened by height / ahead */
  double wide = t->dot * ahead * ahead / t->height;
  wide = wide > 60 ? 60 : wide > 1e-3 ? wide : 1e-3;
  const double a = squares(u, wide), b = squares(v, wide);
  const float dark = 1 - 0.13f * (float)(a + b - 2 * a * b);
  const sw_vec p = sw_madd(g->view.camera.at, ray, ahead);
  const float light = t->shade + t->sun * (float)sw_light_seen(&g->light, p, t->normal);
  for (int c = 0; c < 3; c++) out[c] = t->colour[c] * dark * light;
  if (away2 <= near * near) return;
  const float left = 1 - (float)((sqrt(away2) / t->reach - 0.9) / 1.3),
              share = left > 0 ? left * left : 0;
  float behind[3];
  paper(g, y, behind);
  for (int c = 0; c < 3; c++) out[c] = behind[c] + (out[c] - behind[c]) * share;
}

/* --- pixels ---------------------------------------------------------------------------------- */

INSIDE void shade_sample(const stage *g, uint32_t id, float near, double x, double y,
                         float out[3]) {
  const sw_vec ray = sw_view_ray(&g->view, x, y);
  double ahead;
  const tile *f = g->tile_count ? floor_at(g, ray, near, &ahead) : NULL;
  sw_lit at;
  if (f) {
    on_floor(g, f, ray, ahead, y, out);
  } else if (id == SW_NOTHING) {
    paper(g, y, out);
  } else {
    if (id & SW_BALL)
      on_ball(g, &g->d->balls[id & ~SW_BALL], ray, near, &at);
    else
      on_face(g, &g->d->faces[id - 1], ray, near, &at);
    sw_light_on(&g->light, &at, out);
  }
}

/* 1 if an object ends in front of another one between a pixel and its right or lower neighbour. */
INSIDE int is_rim(const stage *g, size_t x, size_t y) {
  const sw_layer *l = &g->layer;
  const size_t right = x + SS < l->width ? x + SS : x, below = y + SS < l->height ? y + SS : y;
  const size_t here = l->width * y + x, others[2] = {l->width * y + right, l->width * below + x};
  const uint32_t own = object_of(g->d, l->id[here]);
  for (int k = 0; k < 2; k++) {
    if (object_of(g->d, l->id[others[k]]) == own) continue;
    const float a = l->near[here], b = l->near[others[k]];
    if (fabsf(a - b) > 0.004f * fmaxf(a, b)) return 1;
  }
  return 0;
}

/* Shades one pixel: each object among its samples is lit once, in the middle of its samples. */
INSIDE void shade_dot(const stage *g, size_t x, size_t y, float out[3]) {
  const sw_layer *l = &g->layer;
  const size_t first = l->width * y + x, next = first + l->width;
  int done[SAMPLES] = {0};
  if (l->id[first] == l->id[first + 1] && l->id[first] == l->id[next] &&
      l->id[first] == l->id[next + 1]) {
    const float near =
        0.25f * (l->near[first] + l->near[first + 1] + l->near[next] + l->near[next + 1]);
    shade_sample(g, l->id[first], near, (double)x + 1, (double)y + 1, out);
    return;
  }
  memset(out, 0, 3 * sizeof *out);
  for (size_t k = 0; k < SAMPLES; k++) {
    const size_t at = l->width * (y + k / SS) + x + k % SS;
    const uint32_t own = object_of(g->d, l->id[at]);
    double sx = 0, sy = 0, near = 0;
    int n = 0;
    for (size_t j = k; j < SAMPLES && !done[k]; j++) {
      const size_t column = x + j % SS, row = y + j / SS, other = l->width * row + column;
      if (done[j] || object_of(g->d, l->id[other]) != own) continue;
      sx += (double)column + 0.5, sy += (double)row + 0.5;
      near += (double)l->near[other];
      n++;
      if (j != k) done[j] = 1;
    }
    if (!n) continue;
    float part[3];
    shade_sample(g, l->id[at], (float)(near / n), sx / n, sy / n, part);
    for (int c = 0; c < 3; c++) out[c] += part[c] * (float)n / SAMPLES;
  }
}

SW_HOT static sw_status shade_all(const stage *g, sw_canvas *canvas, sw_canvas_part w,
                                  int (*interrupted)(void)) {
  for (size_t y = 0; y < w.height; y++) {
    uint8_t *to = canvas->rgb + 3 * (canvas->width * (w.y + y) + w.x);
    if (interrupted && interrupted()) return SW_EINTR;
    for (size_t x = 0; x < w.width; x++) {
      float light[3];
      shade_dot(g, SS * x, SS * y, light);
      const float left = is_rim(g, SS * x, SS * y) ? RIM : 1.0f;
      for (int c = 0; c < 3; c++) *to++ = sw_srgb(left * light[c]);
    }
  }
  return SW_OK;
}

sw_status sw_show_shaded(sw_canvas *canvas, sw_canvas_part w, const sw_drawing *d,
                         const sw_camera *camera, int (*interrupted)(void)) {
  stage g = {.d = d};
  g.view = sw_view_of(camera, (double)(SS * w.width), (double)(SS * w.height), d);
  sw_status status = sw_layer_new(SS * w.width, SS * w.height, 1, &g.layer);
  if (status == SW_OK) status = sw_raster(d, &g.view, 0, &g.layer, interrupted);
  if (status == SW_OK) status = sw_light_new(d, camera, &g.light);
  for (size_t k = 0; k < d->floor_count && g.tile_count < TILES; k++) {
    g.tiles[g.tile_count] = tile_of(&g, &d->floors[k]);
    if (g.tiles[g.tile_count].height > 0) g.tile_count++;
  }
  if (status == SW_OK) status = shade_all(&g, canvas, w, interrupted);
  sw_light_free(&g.light), sw_layer_free(&g.layer);
  return status;
}
