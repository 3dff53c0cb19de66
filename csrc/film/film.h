/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes a film: the frames of a scene in compressed form, for players. Little-endian, deflated:
 *
 *   "SWFILM1\n"   number of frames, number of tracks (uint32 each)
 *   times         of the frames (float64 each) [s]
 *   tracks        head: kind, channel (uint8), width (uint16), object, line (uint32), scale, offset
 *                 (float64); then for each frame its number of items; then the codes of all frames
 *
 * An item has width numbers; each is code * scale + offset. For values (kind 1 and forces) code 0
 * means: no number. Counts and codes are varints (7 bits a byte, low bits first). A code is stored
 * as its difference, in zigzag form, from  before + beside - beside before  (modulo 2^32). before:
 * the same item in the previous frame, if that frame has as many items. beside: the item `line`
 * places earlier in the same frame. Terms that do not exist are 0. The differences are between
 * rounded numbers, so rounding errors do not accumulate. */
#ifndef SW_FILM_FILM_H
#define SW_FILM_FILM_H

#include "read/frames.h"

enum {
  SW_FILM_WIRE,      /* nodes: x y z [m] */
  SW_FILM_VALUE,     /* at nodes: channel SW_FRAME_...; the force is one item of width 3 */
  SW_FILM_SURFACE,   /* points of a mesh's surface, `line` points for each section [m] */
  SW_FILM_PRESSED,   /* force of obstacles at these points [N] */
  SW_FILM_PARTICLES, /* of an object of particles: x y z [m] */
  SW_FILM_OBSTACLE,  /* channel 0: x y z [m], 1: qw qx qy qz, 2: force [N]; no item if removed */
  SW_FILM_HOLD,      /* the same; no item while it is not there, or does not hold */
  SW_FILM_TOOL,      /* the same for a gripper's tool */
  SW_FILM_KINDS
};

typedef struct sw_film_args {
  double from, to; /* only frames with times in this range [s] */
  int values;      /* 0: positions only, no values and forces */
  size_t first;    /* only frames from this number on [-] */
} sw_film_args;

typedef struct sw_film {
  unsigned char *bytes;
  size_t size;
  size_t frames, broken; /* frames in the film; frames left out: positions not finite [-] */
} sw_film;

/* Makes the film. Positions are rounded to a thousandth of the wire's radius, values to a 4095th of
 * their range. Wires and objects of particles are numbered separately, in the order of making;
 * obstacles, holds and tools by slot. interrupted (may be NULL) is polled. SW_ENOMEM, SW_EINTR. */
sw_status sw_film_make(const sw_scene *scene, const sw_film_args *args, int (*interrupted)(void),
                       sw_film *out, sw_error *err);
/* The same for the present state as the only frame. */
sw_status sw_film_now(sw_scene *scene, int values, sw_film *out, sw_error *err);
void sw_film_free(sw_film *film);

#endif
