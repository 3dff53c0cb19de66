/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pictures without display or browser: bodies are put into a drawing, which is then shown on a
 * canvas of pixels (z-buffer, one shadow-casting lamp) or as lines and areas of an SVG. Colours are
 * sRGB from 0 to 1. */
#ifndef SW_DRAW_DRAW_H
#define SW_DRAW_DRAW_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"
#include "base/vec.h"

typedef struct sw_camera {
  sw_vec at;                 /* [m] */
  sw_vec forward, right, up; /* of unit length, across each other [-] */
  double tx, ty;             /* tangents of half the angles of view [-] */
  sw_vec sky;                /* against gravity: where light comes from [-] */
} sw_camera;

typedef struct sw_paint {
  float colour[3];      /* [-] */
  float gloss;          /* share of light that is mirrored: 0 matt to 1 [-] */
  const float *colours; /* or of each point, three numbers, of this many; NULL: one for all [-] */
} sw_paint;

typedef enum sw_technique {
  SW_DRAW_SHADED,
  SW_DRAW_PARTICLES, /* as shaded: what is drawn as balls differs */
  SW_DRAW_WIREFRAME  /* edges and lines; those behind something are pale */
} sw_technique;

typedef struct sw_drawing sw_drawing;

/* SW_ENOMEM, also below; SW_EINVAL: a number that is not finite, an index out of range, or more
 * than 1e7 triangles. What failed has put nothing in. */
sw_status sw_drawing_new(sw_drawing **out);
void sw_drawing_free(sw_drawing *drawing); /* NULL is allowed */
/* Triangles (count of three corners) of points (x y z each) in the axes of the pose; faces that
 * meet at less than 30 degrees are shaded as one smooth surface. Each call is an object. */
sw_status sw_drawing_mesh(sw_drawing *drawing, const double *points, size_t point_count,
                          const uint32_t *corners, size_t count, sw_pose pose,
                          const sw_paint *paint);
/* A round tube along points [m]. */
sw_status sw_drawing_tube(sw_drawing *drawing, const double *points, size_t count, double radius,
                          const sw_paint *paint);
sw_status sw_drawing_balls(sw_drawing *drawing, const double *points, size_t count, double radius,
                           const sw_paint *paint);
/* Straight lines from point 2 k to point 2 k + 1, seen in wireframes, and in front of all else by a
 * hair. */
sw_status sw_drawing_lines(sw_drawing *drawing, const double *points, size_t count,
                           const sw_paint *paint);
/* A half space's surface with squares of this side [m], seen up to reach from the point [m]. */
sw_status sw_drawing_floor(sw_drawing *drawing, sw_vec point, sw_vec normal, double square,
                           double reach, const sw_paint *paint);

typedef struct sw_canvas {
  size_t width, height; /* [px] */
  uint8_t *rgb;
} sw_canvas;

enum { SW_CANVAS_MOST = 16384 }; /* [px] */

/* White. SW_EINVAL: a side of 0 or above SW_CANVAS_MOST. */
sw_status sw_canvas_new(size_t width, size_t height, sw_canvas *out);
void sw_canvas_free(sw_canvas *canvas);

typedef struct sw_canvas_part {
  size_t x, y, width, height; /* of a canvas, from its upper left corner [px] */
} sw_canvas_part;

/* interrupted (may be NULL) is polled. SW_EINVAL: the window leaves the canvas. SW_EINTR. */
sw_status sw_canvas_show(sw_canvas *canvas, sw_canvas_part window, const sw_drawing *drawing,
                         const sw_camera *camera, sw_technique technique, int (*interrupted)(void));
/* A rectangle of one colour; what leaves the canvas is cut. */
void sw_canvas_fill(sw_canvas *canvas, sw_canvas_part window, const float colour[3]);
/* Letters, size high [px], from x on the line y [px]; what leaves the canvas is cut. Returns how
 * far it goes [px]. canvas NULL: only that. Letters that the font lacks become question marks. */
double sw_canvas_text(sw_canvas *canvas, const char *utf8, size_t bytes, double x, double y,
                      double size, const float colour[3]);
/* As a PNG file; sw_free *bytes. */
sw_status sw_canvas_png(const sw_canvas *canvas, uint8_t **bytes, size_t *size);

/* The same as lines and areas within <g>...</g>, 0 0 width height; sw_free *text. */
sw_status sw_drawing_svg(const sw_drawing *drawing, const sw_camera *camera, sw_technique technique,
                         double width, double height, int (*interrupted)(void), char **text,
                         size_t *size);

#endif
