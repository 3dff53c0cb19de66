/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The turn of a hub. */
#include "solve/rotation.h"
#include "system/join.h"

sw_quat sw_join_hub_turn(const sw_join_hub *h, const double *x) {
  double B[9] = {0};
  for (size_t a = 0; a < h->count; a++) {
    const sw_vec edge = sw_sub(sw_vec_at(x, h->arms[a].to), sw_vec_at(x, h->arms[a].from));
    double p[3], d[3];
    sw_store(p, sw_scale(edge, h->arms[a].k / sw_norm(edge)));
    sw_store(d, h->arms[a].rest);
    for (int i = 0; i < 9; i++) B[i] += p[i / 3] * d[i % 3];
  }
  return sw_rotation_fit(B);
}
