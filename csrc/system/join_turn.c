/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The turn of a hub and the directors of its arms. */
#include "solve/rotation.h"
#include "system/join.h"

static int is_known(const sw_join_hub *h, const double *x, int now) {
  for (size_t a = 0; a < h->count; a++) {
    const sw_vec edge = sw_join_edge(&h->arms[a], x), known = h->edge[now][a];
    if (edge.x != known.x || edge.y != known.y || edge.z != known.z) return 0;
  }
  return h->link_count && !h->line;
}

/* Fitting takes long, and the same places come again. */
sw_quat sw_join_hub_turn(const sw_join_hub *h, const double *x) {
  double B[9] = {0};
  if (is_known(h, x, 1)) return h->now;
  if (is_known(h, x, 0)) return h->before;
  for (size_t a = 0; a < h->count; a++) {
    const sw_vec edge = sw_join_edge(&h->arms[a], x);
    double p[3], d[3];
    sw_store(p, sw_scale(edge, h->arms[a].k / sw_norm(edge)));
    sw_store(d, h->arms[a].rest);
    for (int i = 0; i < 9; i++) B[i] += p[i / 3] * d[i % 3];
  }
  return sw_rotation_fit(B);
}

sw_vec sw_join_hub_mean(const sw_join_hub *h, const double *x) {
  sw_vec sum = sw_v(0, 0, 0);
  for (size_t a = 0; a < h->count; a++) {
    const sw_vec edge = sw_join_edge(&h->arms[a], x);
    sum = sw_madd(sum, edge, h->arms[a].k * h->arms[a].along / sw_norm(edge));
  }
  return sw_unit_or(sum, h->arms[0].rest);
}

sw_vec sw_join_director(const sw_join_hub *h, const struct sw_join_arm *arm, sw_quat turn,
                        const double *x) {
  return h->line ? sw_scale(sw_join_hub_mean(h, x), arm->along) : sw_rotate(turn, arm->rest);
}

const struct sw_join_arm *sw_join_arm_at(const sw_system *s, const sw_clamp_hinge *stop,
                                         const sw_join_hub **hub) {
  const sw_join_place *at = &s->joins->places[(size_t)stop->hold - s->hold_count];
  *hub = &s->joins->hubs[at->hub];
  return &(*hub)->arms[at->arm];
}
