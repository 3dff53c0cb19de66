/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The content of a drawing, for the files that show it. */
#ifndef SW_DRAW_DRAWING_H
#define SW_DRAW_DRAWING_H

#include "draw/draw.h"

typedef struct sw_corner {
  float p[3], n[3]; /* position [m], outward normal [-] */
  float colour[3];
} sw_corner;

typedef struct sw_face {
  sw_corner c[3];
  uint32_t object;
  float gloss;
} sw_face;

typedef struct sw_ball {
  float p[3], radius;
  float colour[3], gloss;
} sw_ball;

typedef struct sw_line {
  float p[2][3];
  float colour[3];
  float width;   /* [px] */
  float n[2][3]; /* normals of its two faces if their edge is smooth; else 0 [-] */
} sw_line;

/* A tube's piece between two of its points, for the lines of an SVG; its faces are listed too. */
typedef struct sw_piece {
  float p[2][3], radius;
  float colour[3];
} sw_piece;

typedef struct sw_floor {
  sw_vec point, normal, across; /* across: unit vector in the floor along the squares' sides */
  double square, reach;
  float colour[3];
} sw_floor;

struct sw_drawing {
  sw_face *faces;
  sw_ball *balls;
  sw_line *lines, *edges; /* given lines; edges of meshes */
  sw_piece *pieces;
  sw_floor *floors;
  uint8_t *is_tube; /* of each object */
  size_t face_count, ball_count, line_count, edge_count, piece_count, floor_count, object_count;
  size_t face_room, ball_room, line_room, edge_room, piece_room, floor_room, object_room;
};

/* 1 if the line is drawn as seen from eye. An edge between smooth faces is drawn only as an
 * outline. */
static inline int sw_line_shows(const sw_line *l, sw_vec eye) {
  const sw_vec a = sw_vec_of(l->n[0]), b = sw_vec_of(l->n[1]), to = sw_sub(eye, sw_vec_of(l->p[0]));
  return sw_norm2(a) == 0 || (sw_dot(a, to) > 0) != (sw_dot(b, to) > 0);
}

/* Finds the smallest box around all faces and balls; 0: there are none. */
int sw_drawing_bounds(const sw_drawing *d, sw_vec *low, sw_vec *high);

#endif
