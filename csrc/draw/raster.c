/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fills triangles and balls into a layer of the nearest ones, for a camera or a lamp. */
#include "draw/raster.h"

#include "base/alloc.h"
#include "base/each.h"
#include "base/simd.h"

static const double NEAREST = 1e-4; /* near plane's distance over the drawing's size [-] */
enum { POLL = 4096 };               /* faces or balls between two polls for Ctrl-C [-] */

sw_status sw_layer_new(size_t width, size_t height, int ids, sw_layer *out) {
  *out = (sw_layer){width, height, sw_alloc(width * height, sizeof *out->near), NULL};
  if (ids) out->id = sw_alloc(width * height, sizeof *out->id);
  if (out->near && (out->id || !ids)) return SW_OK;
  sw_layer_free(out);
  return SW_ENOMEM;
}

void sw_layer_free(sw_layer *layer) {
  sw_free(layer->near), sw_free(layer->id);
  layer->near = NULL, layer->id = NULL;
}

sw_view sw_view_of(const sw_camera *camera, double width, double height, const sw_drawing *d) {
  sw_view v = {*camera, width, height, 1e-6};
  sw_vec low, high;
  if (sw_drawing_bounds(d, &low, &high)) v.near = fmax(NEAREST * sw_dist(low, high), 1e-9);
  return v;
}

static sw_vec seen_from(const sw_view *v, sw_vec p) {
  const sw_vec r = sw_sub(p, v->camera.at);
  return sw_v(sw_dot(r, v->camera.right), sw_dot(r, v->camera.up), sw_dot(r, v->camera.forward));
}

static void to_samples(const sw_view *v, sw_vec c, double out[3]) {
  out[0] = 0.5 * v->width * (1 + c.x / (c.z * v->camera.tx));
  out[1] = 0.5 * v->height * (1 - c.y / (c.z * v->camera.ty));
  out[2] = 1 / c.z;
}

int sw_view_project(const sw_view *v, sw_vec p, double out[3]) {
  const sw_vec c = seen_from(v, p);
  if (!(c.z > v->near)) return 0;
  to_samples(v, c, out);
  return 1;
}

sw_vec sw_view_ray(const sw_view *v, double x, double y) {
  const double a = (2 * x / v->width - 1) * v->camera.tx;
  const double b = (1 - 2 * y / v->height) * v->camera.ty;
  return sw_madd(sw_madd(v->camera.forward, v->camera.right, a), v->camera.up, b);
}

/* --- triangles --------------------------------------------------------------------- */

/* Finds where the line y crosses the triangle's sides; 0: it does not. */
static int span_at(const double p[3][3], double y, double *left, double *right) {
  *left = HUGE_VAL, *right = -HUGE_VAL;
  for (int k = 0; k < 3; k++) {
    const double *a = p[k], *b = p[(k + 1) % 3];
    if ((a[1] <= y) == (b[1] <= y)) continue;
    const double x = a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
    *left = x < *left ? x : *left, *right = x > *right ? x : *right;
  }
  return *left < *right;
}

static size_t clipped(double x, size_t most) {
  return x <= 0 ? 0 : x >= (double)most ? most : (size_t)x;
}

/* Fills a triangle. Sample centres have half-integer coordinates; the third coordinate (near) is
 * linear over the samples. */
SW_HOT static void fill(sw_layer *layer, const double p[3][3], uint32_t id) {
  const double low = fmin(p[0][1], fmin(p[1][1], p[2][1]));
  const double high = fmax(p[0][1], fmax(p[1][1], p[2][1]));
  const double ax = p[1][0] - p[0][0], ay = p[1][1] - p[0][1], az = p[1][2] - p[0][2];
  const double bx = p[2][0] - p[0][0], by = p[2][1] - p[0][1], bz = p[2][2] - p[0][2];
  const double area = ax * by - ay * bx;
  if (!(fabs(area) > 1e-12)) return;
  const double dx = (az * by - ay * bz) / area, dy = (ax * bz - az * bx) / area;
  const size_t last = clipped(ceil(high - 0.5), layer->height);
  for (size_t y = clipped(ceil(low - 0.5), layer->height); y < last; y++) {
    const double at = (double)y + 0.5;
    double left, right;
    if (!span_at(p, at, &left, &right)) continue;
    const size_t from = clipped(ceil(left - 0.5), layer->width);
    const size_t to = clipped(ceil(right - 0.5), layer->width);
    float *near = layer->near + layer->width * y;
    uint32_t *ids = layer->id ? layer->id + layer->width * y : NULL;
    float w = (float)(p[0][2] + dy * (at - p[0][1]) + dx * ((double)from + 0.5 - p[0][0]));
    const float step = (float)dx;
    for (size_t x = from; x < to; x++) {
      if (w > near[x]) {
        near[x] = w;
        if (ids) ids[x] = id;
      }
      w += step;
    }
  }
}

/* Cuts a triangle at the near plane; returns the number of corners that are left, up to four. */
static int cut(const sw_view *v, const sw_vec c[3], sw_vec out[4]) {
  int n = 0;
  for (int k = 0; k < 3; k++) {
    const sw_vec a = c[k], b = c[(k + 1) % 3];
    const int here = a.z > v->near, there = b.z > v->near;
    if (here) out[n++] = a;
    if (here != there) out[n++] = sw_lerp(a, b, (1.0001 * v->near - a.z) / (b.z - a.z));
  }
  return n;
}

static void raster_face(const sw_face *f, const sw_view *v, sw_layer *layer, uint32_t id) {
  sw_vec c[3], kept[4];
  double p[4][3];
  for (int k = 0; k < 3; k++) c[k] = seen_from(v, sw_vec_of(f->c[k].p));
  const int n = cut(v, c, kept);
  for (int k = 0; k < n; k++) to_samples(v, kept[k], p[k]);
  for (int k = 2; k < n; k++) {
    const double t[3][3] = {{p[0][0], p[0][1], p[0][2]},
                            {p[k - 1][0], p[k - 1][1], p[k - 1][2]},
                            {p[k][0], p[k][1], p[k][2]}};
    fill(layer, t, id);
  }
}

/* --- balls ---------------------------------------------------------------------------- */

static void raster_ball(const sw_ball *b, const sw_view *v, sw_layer *layer, uint32_t id) {
  const sw_vec c = seen_from(v, sw_vec_of(b->p));
  const double r = (double)b->radius;
  double mid[3];
  if (!(c.z - r > v->near)) return;
  to_samples(v, c, mid);
  const double reach = 1.1 * r / (c.z - r);
  const double wide = 0.5 * v->width * reach / v->camera.tx + 1;
  const double tall = 0.5 * v->height * reach / v->camera.ty + 1;
  const size_t last_y = clipped(mid[1] + tall, layer->height);
  const size_t last_x = clipped(mid[0] + wide, layer->width);
  for (size_t y = clipped(mid[1] - tall, layer->height); y < last_y; y++)
    for (size_t x = clipped(mid[0] - wide, layer->width); x < last_x; x++) {
      const double u = (2 * ((double)x + 0.5) / v->width - 1) * v->camera.tx;
      const double w = (1 - 2 * ((double)y + 0.5) / v->height) * v->camera.ty;
      const double aa = u * u + w * w + 1, ab = u * c.x + w * c.y + c.z;
      const double inside = ab * ab - aa * (sw_norm2(c) - r * r);
      if (!(inside > 0)) continue;
      const float near = (float)(aa / (ab - sqrt(inside)));
      const size_t at = layer->width * y + x;
      if (!(near > layer->near[at])) continue;
      layer->near[at] = near;
      if (layer->id) layer->id[at] = id;
    }
}

sw_status sw_raster(const sw_drawing *d, const sw_view *v, int without_tubes, sw_layer *layer,
                    int (*interrupted)(void)) {
  for (size_t i = 0; i < d->face_count; i++) {
    if (i % POLL == 0 && interrupted && interrupted()) return SW_EINTR;
    if (without_tubes && d->is_tube[d->faces[i].object]) continue;
    raster_face(&d->faces[i], v, layer, (uint32_t)i + 1);
  }
  for (size_t i = 0; i < d->ball_count; i++) {
    if (i % POLL == 0 && interrupted && interrupted()) return SW_EINTR;
    raster_ball(&d->balls[i], v, layer, SW_BALL | (uint32_t)i);
  }
  return SW_OK;
}

/* --- the lamp's map ---------------------------------------------------------------------- */

sw_lamp sw_lamp_of(sw_vec toward, sw_vec low, sw_vec high, size_t side) {
  sw_lamp l = {.toward = toward, .right = sw_perpendicular(toward)};
  const sw_vec middle = sw_lerp(low, high, 0.5);
  l.up = sw_cross(toward, l.right);
  const double reach = 0.51 * sw_dist(low, high) + 1e-12;
  l.left = sw_dot(middle, l.right) - reach, l.bottom = sw_dot(middle, l.up) - reach;
  l.scale = (double)side / (2 * reach), l.middle = sw_dot(middle, toward) - 2 * reach;
  return l;
}

void sw_raster_lamp(const sw_drawing *d, const sw_lamp *l, sw_layer *layer) {
  for (size_t i = 0; i < d->face_count; i++) {
    double p[3][3];
    for (int k = 0; k < 3; k++) {
      const sw_vec c = sw_vec_of(d->faces[i].c[k].p);
      p[k][0] = (sw_dot(c, l->right) - l->left) * l->scale;
      p[k][1] = (sw_dot(c, l->up) - l->bottom) * l->scale;
      p[k][2] = sw_dot(c, l->toward) - l->middle;
    }
    fill(layer, p, 0);
  }
  SW_ITEMS(const sw_ball, b, d->balls, d->ball_count) {
    const sw_vec c = sw_vec_of(b->p);
    const double x = (sw_dot(c, l->right) - l->left) * l->scale, r = (double)b->radius * l->scale;
    const double y = (sw_dot(c, l->up) - l->bottom) * l->scale,
                 z = sw_dot(c, l->toward) - l->middle;
    for (size_t k = clipped(y - r, layer->height); k < clipped(y + r + 1, layer->height); k++)
      for (size_t j = clipped(x - r, layer->width); j < clipped(x + r + 1, layer->width); j++) {
        const double h = r * r - pow((double)j + 0.5 - x, 2) - pow((double)k + 0.5 - y, 2);
        if (!(h >= 0)) continue;
        float *near = &layer->near[layer->width * k + j];
        *near = fmaxf(*near, (float)(z + sqrt(h) / l->scale));
      }
  }
}
