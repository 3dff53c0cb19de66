/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the parts of a line that are in front of the surfaces of a layer. */
#ifndef SW_DRAW_PIECES_H
#define SW_DRAW_PIECES_H

#include "draw/raster.h"

typedef struct sw_stretch {
  double from[2], to[2]; /* [samples] */
  int hidden;
} sw_stretch;

typedef struct sw_pieces {
  const sw_drawing *d;
  const sw_view *view;
  const sw_layer *layer;
  sw_stretch *list;
  size_t count, room;
} sw_pieces;

/* 1 if nothing of the layer and no floor is in front of a sample at the distance 1 / near. */
int sw_in_front(const sw_pieces *p, double x, double y, double near);
/* Finds the visible and hidden stretches of a line, in order; parts outside the view are left out.
 * lift: the line is tested as if it were this much nearer to the camera [m]. SW_ENOMEM. */
sw_status sw_line_stretches(sw_pieces *p, const float from[3], const float to[3], double lift);

#endif
