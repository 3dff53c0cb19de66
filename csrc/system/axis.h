/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A wire's axis: the nodes of a line, or the rings of a mesh. */
#ifndef SW_SYSTEM_AXIS_H
#define SW_SYSTEM_AXIS_H

#include "system/system.h"

/* Number of edges, or of slices between two rings; 0: a mesh without rings [-]. */
static inline size_t sw_axis_edges(const sw_body *b) {
  const sw_web *web = b->plan->web;
  if (!web) return b->plan->edges;
  return web->per_ring && web->rings > 1 ? web->rings - 1 : 0;
}

/* First node, of the body, at node or ring k; k may be one more than the last [-]. */
static inline size_t sw_axis_first(const sw_body *b, size_t k) {
  return b->plan->web ? b->plan->web->first[k] : k;
}

/* Node or ring of a node of the body [-]. */
static inline size_t sw_axis_of(const sw_body *b, size_t node) {
  return b->plan->web ? sw_web_ring_of(b->plan->web, node) : node;
}

/* Place of node or ring k [m]. x: of the body's nodes [m]. */
static inline sw_vec sw_axis_place(const sw_body *b, const double *x, size_t k) {
  return b->plan->web ? sw_web_centre(b->plan->web, x, k) : sw_vec_at(x, k);
}

/* Arc length of node or ring k from the wire's start [m]. */
static inline double sw_axis_arc(const sw_body *b, size_t k) {
  const sw_web *web = b->plan->web;
  return web ? web->s[web->first[k]] - web->s[0] : b->plan->s[k] - b->plan->s[0];
}

/* Length of edge or slice e at rest [m]. */
static inline double sw_axis_rest(const sw_body *b, size_t e) {
  return b->plan->web ? sw_axis_arc(b, e + 1) - sw_axis_arc(b, e) : b->plan->rest[e];
}

#endif
