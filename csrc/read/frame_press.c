/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pressure on lines, from frames. */
#include "base/vec.h"
#include "read/frames.h"

static const double TWO_SIDED =
    0.5; /* share of a node's force that cancels if it is pressed from both sides [-] */

static int is_skipped(const sw_press_request *r, double s, double edge) {
  for (size_t k = 0; k < r->spans; k++)
    if (fabs(s - r->span[k][0]) <= r->span[k][1] + 1.5 * edge) return 1;
  return 0;
}

static double contact_at(const float *p, size_t n) {
  return (double)p[SW_FRAME_VALUES * n + SW_FRAME_CONTACT];
}

static double both_sides(const float *p, size_t n) {
  const float *f = p + SW_FRAME_VALUES * n + SW_FRAME_FORCE;
  return contact_at(p, n) - sw_norm(sw_v((double)f[0], (double)f[1], (double)f[2]));
}

int sw_scene_frame_press(const sw_scene *s, size_t frame, size_t w, const sw_press_request *r,
                         sw_press *out) {
  size_t count = 0;
  const float *x = sw_scene_frame_wire(s, frame, w, &count);
  const float *p = x ? sw_scene_frame_values(s, frame, w, &count) : NULL;
  *out = (sw_press){.count = count};
  if (!p || count < 2) return 0;
  const double edge = sw_dist(sw_v((double)x[0], (double)x[1], (double)x[2]),
                              sw_v((double)x[3], (double)x[4], (double)x[5]));
  if (!(edge > 0)) return 0;
  for (size_t n = 0; n < count; n++) {
    const double force = contact_at(p, n), both = both_sides(p, n);
    if (!(force > 0) || is_skipped(r, (double)n * edge, edge)) continue;
    out->load = fmax(out->load, force / edge);
    if (both > TWO_SIDED * force) out->squeeze = fmax(out->squeeze, both / edge);
  }
  if (!(out->load > 0)) return 0;
  out->first = count;
  for (size_t n = 0; n < count; n++) {
    if (contact_at(p, n) / edge < r->place * out->load) continue;
    if (is_skipped(r, (double)n * edge, edge)) continue;
    if (out->first == count) out->first = n;
    out->last = n;
  }
  return 1;
}
