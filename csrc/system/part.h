/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The parts of a stage. Bodies without coupling are solved one after another: each iterates until
 * it converges, with its data in the cache. Then the coupled bodies (joined, or possibly touching)
 * are solved together. */
#ifndef SW_SYSTEM_PART_H
#define SW_SYSTEM_PART_H

#include "system/system.h"

/* Bits of sw_body.coupled. */
enum { SW_JOINED = 1, SW_TOUCHING = 2 };

/* 1 if some body can be solved by itself in this stage. */
int sw_parts_any(const sw_system *system, const sw_newton *newton);
/* A stage begins: selects all bodies, marks only the joined ones as coupled, and lists each body's
 * held nodes. */
void sw_parts_begin(sw_system *system);

/* 1 if the part is one body of several, without coupling. */
static inline int sw_part_is_single(const sw_system *s) {
  return !s->group && s->part_end - s->part < s->body_count;
}

/* Returns the part's first body from number b on; part_end or more: none. */
static inline size_t sw_part_next(const sw_system *s, size_t b) {
  while (s->group && b < s->part_end && !s->bodies[b].coupled) b++;
  return b;
}
/* For each body number b of the part. */
#define SW_PART_EACH(s, b)                                           \
  for (size_t b = sw_part_next((s), (s)->part); (b) < (s)->part_end; \
       (b) = sw_part_next((s), (b) + 1))

#endif
