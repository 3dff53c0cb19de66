/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes pictures without display or browser. Bodies are added to a drawing. The drawing is then
 * shown on a canvas of pixels (z-buffer, one lamp that casts shadows) or as lines and areas of an
 * SVG. Colours are sRGB from 0 to 1. */
#ifndef SW_DRAW_DRAW_H
#define SW_DRAW_DRAW_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"
#include "base/vec.h"

typedef struct sw_camera {
  sw_vec at;                 /* [m] */
  sw_vec forward, right, up; /* orthogonal unit vectors [-] */
  double tx, ty;             /* tangents of half the angles of view [-] */
  sw_vec sky;                /* unit vector against gravity, from which light comes [-] */
} sw_camera;

typedef struct sw_paint {
  float colour[3];      /* [-] */
  float gloss;          /* share of mirrored light: 0 (matt) to 1 [-] */
  const float *colours; /* (points x 3) a colour for each point; NULL: one colour for all [-] */
} sw_paint;

typedef enum sw_technique {
  SW_DRAW_SHADED,
  SW_DRAW_PARTICLES, /* as shaded; the caller adds particles as balls */
  SW_DRAW_WIREFRAME  /* edges and lines; hidden ones are pale */
} sw_technique;

typedef struct sw_drawing sw_drawing;

/* Errors, also of the functions below: SW_ENOMEM; SW_EINVAL: a number that is not finite, an index
 * out of range, or more than 1e7 triangles. After an error the drawing is unchanged. */
sw_status sw_drawing_new(sw_drawing **out);
void sw_drawing_free(sw_drawing *drawing); /* NULL is allowed */
/* Adds a mesh: count triangles of three corners each, of points (x y z each) in the axes of the
 * pose. Faces that meet at less than 30 degrees are shaded as one smooth surface. Each call makes
 * one object. */
sw_status sw_drawing_mesh(sw_drawing *drawing, const double *points, size_t point_count,
                          const uint32_t *corners, size_t count, sw_pose pose,
                          const sw_paint *paint);
/* Adds a round tube along points [m]. */
sw_status sw_drawing_tube(sw_drawing *drawing, const double *points, size_t count, double radius,
                          const sw_paint *paint);
sw_status sw_drawing_balls(sw_drawing *drawing, const double *points, size_t count, double radius,
                           const sw_paint *paint);
/* Adds straight lines from point 2 k to point 2 k + 1. Only wireframes show them. */
sw_status sw_drawing_lines(sw_drawing *drawing, const double *points, size_t count,
                           const sw_paint *paint);
/* Adds a floor (the surface of a half space) with squares of this side [m], visible up to reach
 * from the point [m]. */
sw_status sw_drawing_floor(sw_drawing *drawing, sw_vec point, sw_vec normal, double square,
                           double reach, const sw_paint *paint);

typedef struct sw_canvas {
  size_t width, height; /* [px] */
  uint8_t *rgb;
} sw_canvas;

enum { SW_CANVAS_MOST = 16384 }; /* longest side of a canvas [px] */

/* Makes a white canvas. SW_EINVAL: a side of 0 or above SW_CANVAS_MOST, or above 25e6 pixels. */
sw_status sw_canvas_new(size_t width, size_t height, sw_canvas *out);
void sw_canvas_free(sw_canvas *canvas);

typedef struct sw_canvas_part {
  size_t x, y, width, height; /* of a canvas, from its upper left corner [px] */
} sw_canvas_part;

/* Shows the drawing in the window. interrupted (may be NULL) is polled. SW_EINVAL: the window
 * leaves the canvas. SW_EINTR. */
sw_status sw_canvas_show(sw_canvas *canvas, sw_canvas_part window, const sw_drawing *drawing,
                         const sw_camera *camera, sw_technique technique, int (*interrupted)(void));
/* Fills a rectangle with one colour; parts outside the canvas are cut off. */
void sw_canvas_fill(sw_canvas *canvas, sw_canvas_part window, const float colour[3]);
/* Writes letters of height size [px], from x on the base line y [px]; parts outside the canvas are
 * cut off. Returns the width of the text [px]; canvas NULL: only returns it. Letters that the font
 * lacks become question marks. */
double sw_canvas_text(sw_canvas *canvas, const char *utf8, size_t bytes, double x, double y,
                      double size, const float colour[3]);
/* Makes a PNG file of the canvas; sw_free *bytes. */
sw_status sw_canvas_png(const sw_canvas *canvas, uint8_t **bytes, size_t *size);

/* Shows the drawing as SVG lines and areas within <g>...</g>, in the area 0 0 width height; sw_free
 * *text. */
sw_status sw_drawing_svg(const sw_drawing *drawing, const sw_camera *camera, sw_technique technique,
                         double width, double height, int (*interrupted)(void), char **text,
                         size_t *size);

#endif
