/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies without coupling are solved one after another. Each iterates until it has converged, with
 * its data in the cache. Of this room only. */
#ifndef SW_SYSTEM_PART_H
#define SW_SYSTEM_PART_H

#include "system/system.h"

/* Does nothing couple the bodies in this stage? */
int sw_parts_any(const sw_system *system, const sw_newton *newton);
/* A stage begins: all bodies at once, with each one's list of held nodes. */
void sw_parts_begin(sw_system *system);

/* The nodes and edges of the bodies that are solved now. */
static inline size_t sw_part_node(const sw_system *s, size_t body) {
  return body < s->body_count ? s->bodies[body].first_node : s->nodes;
}
static inline size_t sw_part_edge(const sw_system *s, size_t body) {
  return body < s->body_count ? s->bodies[body].first_edge : s->edges;
}

#endif
