/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A film: the frames of a scene in few bytes, for players. Little-endian, deflated:
 *
 *   "SWFILM1\n"   number of frames, number of tracks (uint32 each)
 *   times         of the frames (float64 each) [s]
 *   tracks        head: kind, channel (uint8), width (uint16), object, line (uint32), scale, offset
 *                 (float64); then of each frame how many items it has, then their codes
 *
 * An item has width numbers; each is code * scale + offset, of values (kind 1 and forces) code 0
 * says that there is none. Counts and codes are varints (7 bits a byte, low ones first), codes what
 * they differ by, zigzag, from  before + beside - beside before  modulo 2^32: before is the same
 * item of the frame before, if that has as many; beside the item line places earlier in the frame;
 * those that do not exist are 0. Differences are of rounded numbers: errors do not add up. */
#ifndef SW_FILM_FILM_H
#define SW_FILM_FILM_H

#include "read/frames.h"

enum {
  SW_FILM_WIRE,      /* nodes: x y z [m] */
  SW_FILM_VALUE,     /* at nodes: channel of SW_FRAME_...; the force is one item */
  SW_FILM_SURFACE,   /* points of a mesh's surface, line of them a section [m] */
  SW_FILM_PRESSED,   /* force of obstacles at these [N] */
  SW_FILM_PARTICLES, /* of an object of particles: x y z [m] */
  SW_FILM_OBSTACLE,  /* channel 0: x y z [m], 1: qw qx qy qz, 2: force [N] */
  SW_FILM_HOLD,      /* the same; no item while it is not there, or does not hold */
  SW_FILM_TOOL,      /* the same of a gripper's tool */
  SW_FILM_KINDS
};

typedef struct sw_film_args {
  double from, to; /* frames of these times only [s] */
  int values;      /* 0: places only, nothing that is a result */
  size_t first;    /* frames from this number on only [-] */
} sw_film_args;

typedef struct sw_film {
  unsigned char *bytes;
  size_t size;
  size_t frames, broken; /* in it; left out since they have places that are no numbers */
} sw_film;

/* Places are rounded to a thousandth of the wire's radius, values to a 4095th of their range. */
/* Wires and objects of particles are numbered each by themselves, in the order made; obstacles,
 * holds, tools by slot. interrupted (may be NULL) is polled. SW_ENOMEM, SW_EINTR. */
sw_status sw_film_make(const sw_scene *scene, const sw_film_args *args, int (*interrupted)(void),
                       sw_film *out, sw_error *err);
/* The same of the state as it is, as the only frame. */
sw_status sw_film_now(sw_scene *scene, int values, sw_film *out, sw_error *err);
void sw_film_free(sw_film *film);

#endif
