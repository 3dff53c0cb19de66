/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads frames, and checks their blocks. */
#include "read/kept_frames.h"

#include <math.h>

#include "scene/lists.h"
#include "scene/lookup.h"
#include "scene/parts.h"
#include "scene/wire.h"

enum { TOOL = SW_FRAME_TOOL, HOLD = SW_FRAME_HOLD };

static size_t before_wires(const sw_frame *f) {
  return TOOL * f->tools + HOLD * (f->obstacles + f->holds);
}

int sw_scene_frame_walk(const sw_frame *f, size_t room, size_t *size) {
  size_t at = before_wires(f);
  for (size_t w = 0; w < f->wires; w++) {
    double count[3]; /* nodes, values per node, points around each [-] */
    for (size_t k = 0; k < 3; k++) {
      if (at >= room) return 0;
      count[k] = f->data[at++];
      const double each = k == 0 ? 3 : k == 1 ? count[0] : SW_FRAME_SURFACE * count[0];
      if (!(count[k] >= 0) || count[k] != floor(count[k]) ||
          (k == 1 && count[k] > 0 && count[k] != SW_FRAME_VALUES) ||
          !(each * count[k] <= (double)(room - at)))
        return 0;
      at += (size_t)(each * count[k]);
    }
  }
  *size = at;
  return at <= room;
}

size_t sw_scene_frames(const sw_scene *s) { return sw_scene_frames_of(s)->count; }
double sw_scene_frame_time(const sw_scene *s, size_t frame) {
  return sw_scene_frames_of(s)->list[frame].time;
}
const double *sw_scene_frame_energy(const sw_scene *s, size_t frame) {
  return sw_scene_frames_of(s)->list[frame].energy;
}

const float *sw_scene_frame_body(const sw_scene *s, size_t frame, sw_frame_kind kind, size_t k,
                                 int *there) {
  const sw_frame *f = &sw_scene_frames_of(s)->list[frame];
  const size_t count[] = {f->obstacles, f->holds, f->tools};
  const float *p = f->data;
  if (k >= count[kind]) return NULL;
  for (int before = 0; before < (int)kind; before++) p += HOLD * count[before];
  p += (kind == SW_FRAME_TOOLS ? TOOL : HOLD) * k;
  *there = kind == SW_FRAME_TOOLS || p[SW_FRAME_BODY] > 0;
  return p;
}

size_t sw_scene_frame_wires(const sw_scene *s) { return sw_scene_bodies_made(s); }

double sw_scene_frame_radius(const sw_scene *s, size_t w) {
  const sw_gone *gone;
  const sw_scene_wire *wire = sw_scene_numbered(s, w, &gone);
  return wire ? wire->beam.radius : gone ? gone->radius : 0;
}

int sw_scene_frame_is_loose(const sw_scene *s, size_t w) {
  const sw_gone *gone;
  const sw_scene_wire *wire = sw_scene_numbered(s, w, &gone);
  return wire ? sw_scene_is_loose(wire) : gone && gone->loose;
}

const float *sw_scene_frame_wire(const sw_scene *s, size_t frame, size_t w, size_t *count) {
  const sw_frame *f = &sw_scene_frames_of(s)->list[frame];
  if (w >= f->wires) return NULL;
  const float *p = f->data + before_wires(f);
  for (size_t k = 0; k < w; k++) {
    const size_t nodes = (size_t)*p;
    p += 1 + 3 * nodes;
    p += 1 + nodes * (size_t)*p;
    p += 1 + SW_FRAME_SURFACE * nodes * (size_t)*p;
  }
  *count = (size_t)*p;
  return p + 1;
}

const float *sw_scene_frame_values(const sw_scene *s, size_t frame, size_t w, size_t *count) {
  const float *p = sw_scene_frame_wire(s, frame, w, count);
  if (!p) return NULL;
  p += 3 * *count;
  return *p > 0 ? p + 1 : NULL;
}

const float *sw_scene_frame_surface(const sw_scene *s, size_t frame, size_t w, size_t *count,
                                    size_t *around) {
  const float *p = sw_scene_frame_wire(s, frame, w, count);
  if (!p) return NULL;
  p += 3 * *count;
  p += 1 + *count * (size_t)*p;
  *around = (size_t)*p;
  *count *= *around;
  return *around ? p + 1 : NULL;
}
