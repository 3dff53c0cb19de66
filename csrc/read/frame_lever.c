/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How much a wire's tension depends on the lever of friction along it. Friction f per length acts
 * at the surface, a radius r from the axis: its couple f r is a shear force, which changes the
 * tension where the wire is curved, by f r kappa per length (contact/surface.c). Rods that do not
 * roll leave it out. */
#include "read/frames.h"

/* Tensions below this share of the largest one count as this share: there a change matters no more
 * [-]. */
static const double LEAST = 0.1;

/* The change in one frame: along the wire, changes multiply [-]. */
static double lever_in(const float *x, const float *v, size_t count, double radius) {
  double sum = 0, largest = 0;
  for (size_t i = 0; i < count; i++)
    largest = fmax(largest, fabs((double)v[SW_FRAME_VALUES * i + SW_FRAME_TENSION]));
  for (size_t i = 0; i < count && largest > 0; i++, v += SW_FRAME_VALUES) {
    const size_t from = i > 0 ? i - 1 : i, to = i + 1 < count ? i + 1 : i;
    const sw_vec chord = sw_sub(sw_vec_of(x + 3 * to), sw_vec_of(x + 3 * from));
    const sw_vec along = sw_unit_or(chord, sw_v(0, 0, 0));
    const double friction = fabs(sw_dot(sw_vec_of(v + SW_FRAME_FORCE), along));
    const double tension = fmax(fabs((double)v[SW_FRAME_TENSION]), LEAST * largest);
    sum += friction * radius * (double)v[SW_FRAME_CURVATURE] / tension;
  }
  return -expm1(-sum);
}

double sw_scene_frames_lever(const sw_scene *s, double start, size_t w) {
  double most = 0;
  for (size_t f = 0; f < sw_scene_frames(s); f++) {
    size_t count, values;
    if (sw_scene_frame_time(s, f) < start) continue;
    const float *x = sw_scene_frame_wire(s, f, w, &count);
    const float *v = sw_scene_frame_values(s, f, w, &values);
    if (!x || !v || values != count) continue;
    most = fmax(most, lever_in(x, v, count, sw_scene_frame_radius(s, w)));
  }
  return most;
}
