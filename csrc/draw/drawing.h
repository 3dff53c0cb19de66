/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is in a drawing, for those who show it. */
#ifndef SW_DRAW_DRAWING_H
#define SW_DRAW_DRAWING_H

#include "draw/draw.h"

typedef struct sw_corner {
  float p[3], n[3]; /* [m], outward [-] */
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
  uint32_t object;
} sw_ball;

typedef struct sw_line {
  float p[2][3];
  float colour[3];
  float width;   /* [px] */
  float n[2][3]; /* of the faces beside it, where these meet flatly; else 0 [-] */
} sw_line;

/* A tube's piece between two of its points, for lines of an SVG; its faces are in the list too. */
typedef struct sw_piece {
  float p[2][3], radius;
  float colour[3];
  uint32_t object;
} sw_piece;

typedef struct sw_floor {
  sw_vec point, normal, across; /* a unit vector in it, along which squares lie */
  double square, reach;
  float colour[3];
} sw_floor;

struct sw_drawing {
  sw_face *faces;
  sw_ball *balls;
  sw_line *lines, *edges; /* edges of meshes, drawn in wireframes */
  sw_piece *pieces;
  sw_floor *floors;
  uint8_t *is_tube; /* of each object */
  size_t face_count, ball_count, line_count, edge_count, piece_count, floor_count, object_count;
  size_t face_room, ball_room, line_room, edge_room, piece_room, floor_room, object_room;
};

/* 1: a line shows from there; those where faces meet flatly do as outlines only. */
static inline int sw_line_shows(const sw_line *l, sw_vec eye) {
  const sw_vec a = sw_vec_of(l->n[0]), b = sw_vec_of(l->n[1]), to = sw_sub(eye, sw_vec_of(l->p[0]));
  return sw_norm2(a) == 0 || (sw_dot(a, to) > 0) != (sw_dot(b, to) > 0);
}

/* Smallest box around all but floors; 0: there is nothing. */
int sw_drawing_bounds(const sw_drawing *d, sw_vec *low, sw_vec *high);

#endif
