/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Read-outs of recorded wear. */
#include "watch/worn.h"

#include "record/wear.h"
#include "scene/lookup.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "watch/wear.h"

sw_status sw_scene_worn(const sw_scene *s, sw_handle h, size_t *places, sw_error *err) {
  SW_FIND(const sw_scene_wire, w, sw_scene_find_wire(s, h, err));
  *places = w->wear.count;
  return SW_OK;
}

sw_extreme sw_scene_worn_sidewall(const sw_scene *s, sw_handle h) {
  const sw_scene_wire *w = sw_scene_wire_in(s, h.slot);
  sw_extreme x = sw_wear_sidewall(s, &w->wear);
  x.s -= w->mesh.s[0];
  return x;
}

sw_worn sw_scene_worn_place(const sw_scene *s, sw_handle h, size_t k) {
  const sw_scene_wire *w = sw_scene_wire_in(s, h.slot);
  const sw_wear_place *x = &w->wear.places[k];
  return (sw_worn){.s = x->s - w->mesh.s[0], .rubbed = x->rubbed, .slid = x->slid, .side = x->side};
}

size_t sw_scene_worn_cycles(const sw_scene *s, sw_handle h, size_t k, int signal, sw_cycle *out) {
  const sw_wear *w = &sw_scene_wire_in(s, h.slot)->wear;
  return sw_cycles_read(&w->cycles[SW_WEAR_SIGNALS * k + (size_t)signal], out);
}

size_t sw_scene_worn_residue(const sw_scene *s, sw_handle h, size_t k, int signal, double *out) {
  const sw_wear *w = &sw_scene_wire_in(s, h.slot)->wear;
  return sw_cycles_residue(&w->cycles[SW_WEAR_SIGNALS * k + (size_t)signal], out);
}
