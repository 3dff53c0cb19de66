/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes a drawing as SVG: first the visible faces, from back to front; over them the edges, wires
 * and balls that have nothing in front of them. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "draw/light.h"
#include "draw/pieces.h"

enum { FINE = 2, RIM_SIDES = 72, LONGEST = 240, POLL = 1024, SQUARES = 60, RINGS = 14 };
static const float BACKGROUND = 0.84f; /* linear light of the background [-] */
/* Least visible share of a face seen from within; a smaller one is a rounding error [-] */
static const double GLIMPSE = 0.1;

typedef struct item {
  double depth; /* [m] */
  size_t index;
  int ball;
} item;

typedef struct paper {
  const sw_drawing *d;
  sw_view view;
  sw_layer layer;
  sw_light light;
  sw_pieces pieces;
  item *items;
  size_t item_count, item_room;
  char *text;
  size_t size, room;
  double scale; /* units of the picture a sample [-] */
  sw_status status;
  int (*interrupted)(void);
} paper;

__attribute__((format(printf, 2, 3))) static void put(paper *g, const char *format, ...) {
  char line[LONGEST];
  va_list args;
  va_start(args, format);
  const int n = vsnprintf(line, sizeof line, format, args);
  va_end(args);
  if (g->status != SW_OK || n < 0) return;
  g->status = SW_GROW(g->text, g->room, g->size + (size_t)n + 1);
  if (g->status != SW_OK) return;
  memcpy(g->text + g->size, line, (size_t)n + 1);
  g->size += (size_t)n;
}

/* Writes a number with a decimal point, in any locale. */
static void put_number(paper *g, double x) {
  const long hundredths = lrint(100 * fmin(1e7, fmax(-1e7, x)));
  put(g, "%s%ld.%02ld", hundredths < 0 ? "-" : "", labs(hundredths) / 100, labs(hundredths) % 100);
}

static void put_point(paper *g, char before, const double at[2]) {
  put(g, "%c", before);
  put_number(g, at[0] * g->scale);
  put(g, " ");
  put_number(g, at[1] * g->scale);
}

static void put_colour(paper *g, const char *name, const float linear[3]) {
  put(g, " %s=\"#%02x%02x%02x\"", name, sw_srgb(linear[0]), sw_srgb(linear[1]), sw_srgb(linear[2]));
}

static int stopped(paper *g, size_t i) {
  if (i % POLL == 0 && g->status == SW_OK && g->interrupted && g->interrupted())
    g->status = SW_EINTR;
  return g->status != SW_OK;
}

static sw_status add_item(paper *g, double depth, size_t index, int ball) {
  SW_TRY(SW_GROW(g->items, g->item_room, g->item_count + 1));
  g->items[g->item_count++] = (item){depth, index, ball};
  return SW_OK;
}

static int farther(const void *a, const void *b) {
  const item *x = a, *y = b;
  if (x->depth != y->depth) return x->depth < y->depth ? 1 : -1;
  return (x->index > y->index) - (x->index < y->index);
}

static double ahead_of(const paper *g, const float *p) {
  return sw_dot(sw_sub(sw_vec_of(p), g->view.camera.at), g->view.camera.forward);
}

/* --- floors ------------------------------------------------------------------------------ */

/* Writes a polygon on a floor; nothing if one of its points is behind the camera. */
static void put_polygon(paper *g, const sw_vec *p, size_t count, const float linear[3]) {
  double at[RIM_SIDES][3];
  for (size_t k = 0; k < count; k++)
    if (!sw_view_project(&g->view, p[k], at[k])) return;
  put(g, "<path d=\"");
  for (size_t k = 0; k < count; k++) put_point(g, k ? 'L' : 'M', at[k]);
  put(g, "Z\"");
  put_colour(g, "fill", linear);
  put(g, "/>\n");
}

static float mixed(float a, float b, double share) { return a + (b - a) * (float)share; }

/* Writes a floor's base as discs, the largest first; outer rings fade to the background. */
static void put_disc(paper *g, const sw_floor *f, const float light[3]) {
  const sw_vec side = sw_cross(f->normal, f->across);
  sw_vec p[RIM_SIDES];
  for (int ring = RINGS; ring >= 0; ring--) {
    const double share = pow((double)ring / (RINGS + 1), 1.5), r = (1 + 1.2 * share) * f->reach;
    float colour[3];
    for (int c = 0; c < 3; c++) colour[c] = mixed(light[c], BACKGROUND, share);
    for (int k = 0; k < RIM_SIDES; k++) {
      const double a = 2 * M_PI * k / RIM_SIDES;
      p[k] = sw_madd(sw_madd(f->point, f->across, r * cos(a)), side, r * sin(a));
    }
    put_polygon(g, p, RIM_SIDES, colour);
  }
}

static void put_floor(paper *g, const sw_floor *f) {
  if (sw_dot(f->normal, sw_sub(g->view.camera.at, f->point)) <= 0) return;
  const sw_vec side = sw_cross(f->normal, f->across);
  sw_lit at = {.p = f->point, .n = f->normal};
  float light[3], dark[3];
  sw_vec p[4];
  for (int c = 0; c < 3; c++) at.colour[c] = sw_linear(f->colour[c]);
  sw_light_on(&g->light, &at, light);
  put_disc(g, f, light);
  const int n = (int)fmin(SQUARES, ceil(f->reach / f->square));
  for (int j = -n; j < n; j++)
    for (int k = -n; k < n; k++) {
      const double x = (j + 0.5) * f->square, y = (k + 0.5) * f->square;
      const double share = fmin(1, 1.5 * (1.02 - hypot(x, y) / f->reach));
      if ((j + k) % 2 == 0 || share <= 0) continue;
      for (int c = 0; c < 3; c++) dark[c] = mixed(light[c], 0.87f * light[c], share);
      for (int c = 0; c < 4; c++)
        p[c] = sw_madd(sw_madd(f->point, f->across, (j + (c == 1 || c == 2)) * f->square), side,
                       (k + (c > 1)) * f->square);
      put_polygon(g, p, 4, dark);
    }
}

/* --- faces -------------------------------------------------------------------------------- */

/* Returns twice the area of a face in samples; below 0: seen from within; 0: it reaches behind the
 * camera. */
static double area_of(const paper *g, const sw_face *f) {
  double p[3][3];
  for (int k = 0; k < 3; k++)
    if (!sw_view_project(&g->view, sw_vec_of(f->c[k].p), p[k])) return 0;
  return (p[2][0] - p[0][0]) * (p[1][1] - p[0][1]) - (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]);
}

static void list_faces(paper *g) {
  uint32_t *seen SW_LOCAL = sw_alloc(g->d->face_count, sizeof *seen);
  if (!seen) g->status = SW_ENOMEM;
  for (size_t i = 0; seen && i < g->layer.width * g->layer.height; i++) {
    const uint32_t id = g->layer.id[i];
    if (id != SW_NOTHING && !(id & SW_BALL)) seen[id - 1]++;
  }
  for (size_t i = 0; seen && i < g->d->face_count && g->status == SW_OK; i++) {
    const sw_face *f = &g->d->faces[i];
    double depth = 0;
    for (int k = 0; k < 3; k++) depth += ahead_of(g, f->c[k].p) / 3;
    if (seen[i] && (double)seen[i] > -0.5 * GLIMPSE * area_of(g, f))
      g->status = add_item(g, depth, i, 0);
  }
}

static void put_face(paper *g, const sw_face *f) {
  sw_lit at = {.p = sw_v(0, 0, 0), .n = sw_v(0, 0, 0)};
  double p[3][3];
  float light[3];
  for (int k = 0; k < 3; k++) {
    if (!sw_view_project(&g->view, sw_vec_of(f->c[k].p), p[k])) return;
    at.p = sw_madd(at.p, sw_vec_of(f->c[k].p), 1.0 / 3);
    at.n = sw_add(at.n, sw_vec_of(f->c[k].n));
    for (int c = 0; c < 3; c++) at.colour[c] += sw_linear(f->c[k].colour[c]) / 3;
  }
  at.n = sw_unit_or(at.n, g->view.camera.forward);
  sw_light_on(&g->light, &at, light);
  put(g, "<path d=\"");
  for (int k = 0; k < 3; k++) put_point(g, k ? 'L' : 'M', p[k]);
  put(g, "Z\"");
  put_colour(g, "fill", light);
  put_colour(g, "stroke", light);
  put(g, "/>\n");
}

static void put_faces(paper *g) {
  list_faces(g);
  if (g->status != SW_OK) return;
  if (g->item_count) qsort(g->items, g->item_count, sizeof *g->items, farther);
  put(g, "<g stroke-width=\"0.5\" stroke-linejoin=\"round\">\n");
  for (size_t i = 0; i < g->item_count && !stopped(g, i); i++)
    put_face(g, &g->d->faces[g->items[i].index]);
  put(g, "</g>\n");
  g->item_count = 0;
}

/* --- lines --------------------------------------------------------------------------------- */

static void put_stretch(paper *g, const double a[2], const double b[2], const float linear[3],
                        double width) {
  put(g, "<path d=\"");
  put_point(g, 'M', a);
  put_point(g, 'L', b);
  put(g, "\" stroke-width=\"");
  put_number(g, width);
  put(g, "\"");
  put_colour(g, "stroke", linear);
  put(g, "/>\n");
}

static void put_lines(paper *g, const sw_line *lines, size_t count, int hidden, float pale) {
  for (size_t i = 0; i < count && !stopped(g, i); i++) {
    float linear[3];
    if (!sw_line_shows(&lines[i], g->view.camera.at)) continue;
    g->status = sw_line_stretches(&g->pieces, lines[i].p[0], lines[i].p[1], 0);
    for (int c = 0; c < 3; c++) linear[c] = sw_linear(pale + (1 - pale) * lines[i].colour[c]);
    SW_ITEMS(const sw_stretch, s, g->pieces.list, g->pieces.count) {
      if (s->hidden == hidden) put_stretch(g, s->from, s->to, linear, (double)lines[i].width);
    }
  }
}

/* --- wires and balls ------------------------------------------------------------------------- */

/* Writes a piece of a wire: its dark rim, its body, and its highlight. */
static void put_piece(paper *g, const sw_piece *q) {
  const double ahead = 0.5 * (ahead_of(g, q->p[0]) + ahead_of(g, q->p[1]));
  const double width = (double)q->radius * g->scale * g->view.width / (g->view.camera.tx * ahead);
  float body[3], rim[3], shine[3];
  g->status = sw_line_stretches(&g->pieces, q->p[0], q->p[1], (double)q->radius);
  for (int c = 0; c < 3; c++) {
    const float x = sw_linear(q->colour[c]);
    body[c] = 0.86f * x, rim[c] = 0.38f * x, shine[c] = 0.75f * x + 0.25f;
  }
  SW_ITEMS(const sw_stretch, s, g->pieces.list, g->pieces.count) {
    if (s->hidden) continue;
    put_stretch(g, s->from, s->to, rim, width + 0.9);
    put(g, "<g stroke-linecap=\"round\">");
    put_stretch(g, s->from, s->to, body, fmax(0.5 * width, width - 0.9));
    if (width > 2.5) {
      put(g, "<g transform=\"translate(-");
      put_number(g, 0.10 * width);
      put(g, " -");
      put_number(g, 0.14 * width);
      put(g, ")\">");
      put_stretch(g, s->from, s->to, shine, 0.22 * width);
      put(g, "</g>");
    }
    put(g, "</g>\n");
  }
}

static void put_ball(paper *g, const sw_ball *b) {
  const double ahead = ahead_of(g, b->p);
  double at[3];
  float colour[3];
  if (!sw_view_project(&g->view, sw_vec_of(b->p), at) || ahead <= (double)b->radius) return;
  if (!sw_in_front(&g->pieces, at[0], at[1], 1 / (ahead - (double)b->radius))) return;
  const double r = 0.5 * (double)b->radius * g->scale * g->view.width / (g->view.camera.tx * ahead);
  for (int part = 0; part < 3; part++) {
    const float dark = part == 0 ? 0.35f : part == 1 ? 0.85f : 0.8f, white = part == 2 ? 0.2f : 0;
    const double shift = part == 2 ? 0.3 * r : 0, size = part == 0   ? r
                                                         : part == 1 ? 0.9 * r
                                                                     : 0.35 * r;
    for (int c = 0; c < 3; c++) colour[c] = dark * sw_linear(b->colour[c]) + white;
    put(g, "<circle cx=\"");
    put_number(g, at[0] * g->scale - shift);
    put(g, "\" cy=\"");
    put_number(g, at[1] * g->scale - shift);
    put(g, "\" r=\"");
    put_number(g, size);
    put(g, "\"");
    put_colour(g, "fill", colour);
    put(g, "/>");
  }
  put(g, "\n");
}

static void put_bodies(paper *g) {
  for (size_t i = 0; i < g->d->piece_count && g->status == SW_OK; i++) {
    const sw_piece *q = &g->d->pieces[i];
    g->status = add_item(g, 0.5 * (ahead_of(g, q->p[0]) + ahead_of(g, q->p[1])), i, 0);
  }
  for (size_t i = 0; i < g->d->ball_count && g->status == SW_OK; i++)
    g->status = add_item(g, ahead_of(g, g->d->balls[i].p), i, 1);
  if (g->status != SW_OK) return;
  if (g->item_count) qsort(g->items, g->item_count, sizeof *g->items, farther);
  for (size_t i = 0; i < g->item_count && !stopped(g, i); i++)
    if (g->items[i].ball)
      put_ball(g, &g->d->balls[g->items[i].index]);
    else
      put_piece(g, &g->d->pieces[g->items[i].index]);
}

static void put_all(paper *g, sw_technique technique) {
  put(g, "<g fill=\"none\">\n");
  if (technique == SW_DRAW_WIREFRAME) {
    for (int hidden = 1; hidden >= 0; hidden--) {
      put_lines(g, g->d->edges, g->d->edge_count, hidden, hidden ? 0.8f : 0);
      put_lines(g, g->d->lines, g->d->line_count, hidden, hidden ? 0.8f : 0);
    }
  } else {
    for (size_t k = 0; k < g->d->floor_count; k++) put_floor(g, &g->d->floors[k]);
    put_faces(g);
    put_lines(g, g->d->edges, g->d->edge_count, 0, 0);
    put_bodies(g);
  }
  put(g, "</g>\n");
}

sw_status sw_drawing_svg(const sw_drawing *d, const sw_camera *camera, sw_technique technique,
                         double width, double height, int (*interrupted)(void), char **text,
                         size_t *size) {
  const double most = (double)SW_CANVAS_MOST / FINE;
  if (!(width >= 1 && height >= 1 && width <= most && height <= most)) return SW_EINVAL;
  paper g = {.d = d, .scale = 1.0 / FINE, .interrupted = interrupted};
  g.view = sw_view_of(camera, FINE * width, FINE * height, d);
  g.pieces = (sw_pieces){.d = d, .view = &g.view, .layer = &g.layer};
  g.status = sw_light_new(d, camera, &g.light);
  sw_light_free(&g.light); /* no shadows */
  if (g.status == SW_OK)
    g.status = sw_layer_new((size_t)(FINE * width), (size_t)(FINE * height), 1, &g.layer);
  sw_drawing bare = *d; /* without balls, which are drawn separately */
  bare.ball_count = 0;
  if (g.status == SW_OK)
    g.status = sw_raster(&bare, &g.view, technique != SW_DRAW_WIREFRAME, &g.layer, interrupted);
  if (g.status == SW_OK) put_all(&g, technique);
  sw_layer_free(&g.layer), sw_free(g.items), sw_free(g.pieces.list);
  if (g.status != SW_OK) sw_free(g.text), g.text = NULL;
  *text = g.text, *size = g.size;
  return g.status;
}
