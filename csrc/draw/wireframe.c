/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draws edges and lines on white; hidden ones are pale. */
#include <string.h>

#include "base/alloc.h"
#include "draw/pieces.h"
#include "draw/show.h"

enum { SS = 3, POLL = 256 };
static const float PALE = 0.80f; /* share of white in hidden lines [-] */
static const double PART = 24;   /* length of line that is drawn at once [samples] */

typedef struct sheet {
  size_t width, height; /* [samples] */
  uint8_t *rgb;
  sw_pieces pieces;
} sheet;

static size_t clipped(double x, size_t most) {
  return x <= 0 ? 0 : x >= (double)most ? most : (size_t)x;
}

/* Colours all samples up to half the width from a line. */
static void stroke(sheet *g, const double a[2], const double b[2], double half,
                   const uint8_t colour[3]) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], long2 = dx * dx + dy * dy;
  const size_t last_x = clipped(fmax(a[0], b[0]) + half + 1, g->width);
  const size_t last_y = clipped(fmax(a[1], b[1]) + half + 1, g->height);
  for (size_t y = clipped(fmin(a[1], b[1]) - half, g->height); y < last_y; y++)
    for (size_t x = clipped(fmin(a[0], b[0]) - half, g->width); x < last_x; x++) {
      const double px = (double)x + 0.5 - a[0], py = (double)y + 0.5 - a[1];
      const double t = long2 > 0 ? fmin(1, fmax(0, (px * dx + py * dy) / long2)) : 0;
      if (pow(px - t * dx, 2) + pow(py - t * dy, 2) <= half * half)
        memcpy(g->rgb + 3 * (g->width * y + x), colour, 3);
    }
}

static void draw_stretch(sheet *g, const sw_stretch *s, const sw_line *l) {
  const double length = hypot(s->to[0] - s->from[0], s->to[1] - s->from[1]);
  const size_t parts = 1 + (size_t)(length / PART);
  uint8_t colour[3];
  for (int c = 0; c < 3; c++) {
    const float x = s->hidden ? PALE + (1 - PALE) * l->colour[c] : l->colour[c];
    colour[c] = (uint8_t)(255 * fminf(1, fmaxf(0, x)) + 0.5f);
  }
  double before[2] = {s->from[0], s->from[1]};
  for (size_t k = 1; k <= parts; k++) {
    double at[2];
    for (int c = 0; c < 2; c++)
      at[c] = s->from[c] + (s->to[c] - s->from[c]) * (double)k / (double)parts;
    stroke(g, before, at, 0.5 * SS * (double)l->width, colour);
    memcpy(before, at, sizeof at);
  }
}

/* Draws the hidden or the visible stretches. The caller draws the hidden ones first, so that they
 * never cover visible ones. */
static sw_status draw_lines(sheet *g, const sw_line *lines, size_t count, int hidden,
                            int (*interrupted)(void)) {
  for (size_t i = 0; i < count; i++) {
    if (i % POLL == 0 && interrupted && interrupted()) return SW_EINTR;
    if (!sw_line_shows(&lines[i], g->pieces.view->camera.at)) continue;
    SW_TRY(sw_line_stretches(&g->pieces, lines[i].p[0], lines[i].p[1], 0));
    for (size_t k = 0; k < g->pieces.count; k++)
      if (g->pieces.list[k].hidden == hidden) draw_stretch(g, &g->pieces.list[k], &lines[i]);
  }
  return SW_OK;
}

static void shrink(const sheet *g, sw_canvas *canvas, sw_canvas_part w) {
  for (size_t y = 0; y < w.height; y++) {
    uint8_t *to = canvas->rgb + 3 * (canvas->width * (w.y + y) + w.x);
    for (size_t x = 0; x < 3 * w.width; x++) {
      unsigned sum = 0;
      for (size_t k = 0; k < SS * SS; k++)
        sum += g->rgb[3 * (g->width * (SS * y + k / SS) + SS * (x / 3) + k % SS) + x % 3];
      *to++ = (uint8_t)((sum + SS * SS / 2) / (SS * SS));
    }
  }
}

sw_status sw_show_wireframe(sw_canvas *canvas, sw_canvas_part w, const sw_drawing *d,
                            const sw_camera *camera, int (*interrupted)(void)) {
  sheet g = {.width = SS * w.width, .height = SS * w.height};
  const sw_view view = sw_view_of(camera, (double)g.width, (double)g.height, d);
  sw_layer layer;
  SW_TRY(sw_layer_new(g.width, g.height, 0, &layer));
  g.pieces = (sw_pieces){.d = d, .view = &view, .layer = &layer};
  g.rgb = sw_alloc_bytes(3 * g.width * g.height);
  sw_status status = g.rgb ? sw_raster(d, &view, 0, &layer, interrupted) : SW_ENOMEM;
  if (g.rgb) memset(g.rgb, 255, 3 * g.width * g.height);
  for (int hidden = 1; hidden >= 0; hidden--) {
    if (status == SW_OK) status = draw_lines(&g, d->edges, d->edge_count, hidden, interrupted);
    if (status == SW_OK) status = draw_lines(&g, d->lines, d->line_count, hidden, interrupted);
  }
  if (status == SW_OK) shrink(&g, canvas, w);
  sw_free(g.rgb), sw_free(g.pieces.list), sw_layer_free(&layer);
  return status;
}
