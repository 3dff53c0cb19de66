/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The parts of a line that are in front of the surfaces of a layer. */
#ifndef SW_DRAW_PIECES_H
#define SW_DRAW_PIECES_H

#include "draw/raster.h"

typedef struct sw_stretch {
  double from[2], to[2]; /* samples */
  int hidden;
} sw_stretch;

typedef struct sw_pieces {
  const sw_drawing *d;
  const sw_view *view;
  const sw_layer *layer;
  sw_stretch *list;
  size_t count, room;
} sw_pieces;

/* 1: nothing of the layer or of a floor is in front of a sample that is 1 / near ahead. */
int sw_in_front(const sw_pieces *p, double x, double y, double near);
/* The stretches of a line, in order; what is out of the view is left out. lift: how much nearer it
 * counts as it is [m]. SW_ENOMEM. */
sw_status sw_line_stretches(sw_pieces *p, const float from[3], const float to[3], double lift);

#endif
