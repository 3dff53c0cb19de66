/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Straight pieces of a wire, from which the distance of its surface to a zone is measured: edges of
 * a line; of a mesh of rings its particles, and lines along its surface from ring to ring, so close
 * to one another that nothing fits between them. Of other objects: their particles. */
#ifndef SW_WATCH_ZONE_PIECE_H
#define SW_WATCH_ZONE_PIECE_H

#include "system/system.h"

typedef struct sw_zone_body {
  const sw_system *system;
  const sw_body *body;
  size_t count; /* pieces [-] */
  size_t times; /* lines along a mesh for each particle round its section [-] */
  double bulge; /* half the angle between particles round a section; 0: it is not round [rad] */
} sw_zone_body;

typedef struct sw_zone_piece {
  sw_vec end[2]; /* [m] */
  double s[2];   /* arc lengths of the ends [m] */
  double skin;   /* distance of the surface from the piece [m] */
} sw_zone_piece;

sw_zone_body sw_zone_body_of(const sw_system *system, const sw_body *body);
/* Returns piece number e. */
sw_zone_piece sw_zone_piece_of(const sw_zone_body *body, size_t e);

#endif
