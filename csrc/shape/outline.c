/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Triangle surfaces for drawing: their lists, and bodies of revolution. */
#include "base/alloc.h"
#include "shape/shape_class.h"

sw_status sw_triangles_new(size_t vertices, size_t triangles, sw_triangles *out) {
  *out = (sw_triangles){sw_alloc(3 * vertices, sizeof *out->vertices),
                        sw_alloc(3 * triangles, sizeof *out->indices), vertices, triangles};
  if (out->vertices && out->indices) return SW_OK;
  sw_triangles_free(out);
  return SW_ENOMEM;
}

void sw_triangles_free(sw_triangles *triangles) {
  sw_free(triangles->vertices);
  sw_free(triangles->indices);
  *triangles = (sw_triangles){0};
}

sw_ring *sw_ring_arc(sw_ring *to, double radius, double z, double from, double end, int steps) {
  for (int i = 0; i <= steps; i++) {
    const double angle = from + (end - from) * i / steps;
    *to++ = (sw_ring){radius * cos(angle), z + radius * sin(angle)};
  }
  return to;
}

/* Order of the vertices: lower pole, rings from below, upper pole. */
sw_status sw_revolve(const sw_ring *rings, size_t count, double bottom, double top, int around,
                     sw_triangles *out) {
  const size_t n = (size_t)around, last = n * count + 1;
  SW_TRY(sw_triangles_new(last + 1, 2 * n * count, out));
  sw_store(out->vertices, sw_v(0, 0, bottom));
  sw_store(out->vertices + 3 * last, sw_v(0, 0, top));
  for (size_t i = 0; i < count; i++)
    for (size_t k = 0; k < n; k++) {
      const double angle = 4 * SW_HALF_PI * (double)k / around, r = rings[i].radius;
      sw_store(out->vertices + 3 * (1 + i * n + k),
               sw_v(r * cos(angle), r * sin(angle), rings[i].z));
    }
  int *to = out->indices;
  for (size_t k = 0; k < n; k++) {
    const size_t next = (k + 1) % n, high = 1 + (count - 1) * n;
    to = sw_triangle_put(to, 0, 1 + next, 1 + k);
    for (size_t i = 0; i + 1 < count; i++) {
      const size_t one = 1 + i * n, two = one + n;
      to = sw_triangle_put(to, one + k, one + next, two + next);
      to = sw_triangle_put(to, one + k, two + next, two + k);
    }
    to = sw_triangle_put(to, high + k, high + next, last);
  }
  return SW_OK;
}
