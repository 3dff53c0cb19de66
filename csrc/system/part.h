/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solves bodies without coupling one after another. Each iterates until it converges, with its data
 * in the cache. Private to this room. */
#ifndef SW_SYSTEM_PART_H
#define SW_SYSTEM_PART_H

#include "system/system.h"

/* 1 if nothing couples the bodies in this stage. */
int sw_parts_any(const sw_system *system, const sw_newton *newton);
/* A stage begins: selects all bodies at once and lists each body's held nodes. */
void sw_parts_begin(sw_system *system);

/* First node and first edge of a body, or the system's number of them after the last body. */
static inline size_t sw_part_node(const sw_system *s, size_t body) {
  return body < s->body_count ? s->bodies[body].first_node : s->nodes;
}
static inline size_t sw_part_edge(const sw_system *s, size_t body) {
  return body < s->body_count ? s->bodies[body].first_edge : s->edges;
}

#endif
