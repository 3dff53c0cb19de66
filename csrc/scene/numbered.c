/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies by number and handle, those that have left too. */
#include <stdint.h>

#include "base/halving.h"
#include "scene/lookup.h"
#include "scene/scene.h"
#include "scene/wire.h"
#include "scene/world.h"

const sw_scene_wire *sw_scene_numbered(const sw_scene *s, size_t number, const sw_gone **gone) {
  size_t i; /* slots are in the order of their numbers */
  *gone = NULL;
  SW_FIRST_NOT(s->wires[i].number < number, i, 0, s->wire_count);
  if (i < s->wire_count && s->wires[i].number == number) return &s->wires[i];
  for (size_t k = 0; k < s->gone_count; k++)
    if (s->gone[k].number == number) *gone = &s->gone[k];
  return NULL;
}

sw_handle sw_scene_body_now(const sw_scene *s, sw_handle h) {
  if (h.slot < s->wire_count && s->wires[h.slot].generation == h.generation) return h;
  for (size_t k = 0; k < s->wire_count; k++)
    if (s->wires[k].generation == h.generation) return (sw_handle){(uint32_t)k, h.generation};
  return (sw_handle){UINT32_MAX, h.generation};
}

size_t sw_scene_body_number(const sw_scene *s, sw_handle h) {
  const sw_handle now = sw_scene_body_now(s, h);
  if (now.slot < s->wire_count) return s->wires[now.slot].number;
  for (size_t k = 0; k < s->gone_count; k++)
    if (s->gone[k].generation == h.generation) return s->gone[k].number;
  return SIZE_MAX;
}

const char *sw_scene_gone_name(const sw_scene *s, sw_handle h, double *time) {
  for (size_t k = 0; k < s->gone_count; k++)
    if (s->gone[k].generation == h.generation) {
      *time = s->gone[k].time;
      return s->gone[k].name;
    }
  return NULL;
}
