/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The frozen state between pads while a rigid grip replaces them: reference count, and tape. It
 * holds the particles with their springs' forces, in the tool's axes, and the friction between pads
 * and particles. */
#include "grip/frozen.h"

#include <math.h>

#include "base/alloc.h"
#include "contact/contact.h"
#include "grip/jaws.h"
#include "scene/gripper.h"
#include "scene/parts.h"
#include "scene/scene.h"
#include "state/state_tape.h"
#include "strand/ring.h"

void sw_frozen_release(sw_frozen *f) {
  if (!f || --f->references > 0) return;
  sw_mesh_free(&f->mesh);
  sw_strand_free(&f->strand);
  sw_region_free(&f->stations);
  SW_FREE_ALL(f->frame, f->rod, f->touch, f->memory, f);
}

/* --- on a tape ---------------------------------------------------------------------------- */

static void tape_handle(sw_tape *t, sw_handle *h) {
  SW_TAPE_STRUCT(t, sw_handle, 8);
  sw_tape_uint32(t, &h->slot), sw_tape_uint32(t, &h->generation);
}

static void tape_fields(sw_tape *t, sw_frozen *f) {
  SW_TAPE_STRUCT(t, sw_frozen, 552);
  SW_TAPE_STRUCT(t, sw_stations, 32);
  sw_tape_mark(t, "contact", sw_contact_layout());
  sw_tape_uint32(t, &f->wire.generation); /* the slot changes when other wires leave */
  tape_handle(t, &f->hold);
  SW_TAPE_CLASS(t, f->cls, sw_wire_find);
  sw_tape_mesh(t, &f->mesh, 1);
  sw_tape_strand(t, &f->strand, 1);
  sw_tape_pose(t, &f->pose), sw_tape_vec(t, &f->across);
  sw_tape_size(t, &f->first), sw_tape_size(t, &f->last);
  sw_tape_count(t, &f->stations.n, sizeof *f->stations.s);
  SW_TAPE_ARRAY(t, f->frame, 6 * f->stations.n), SW_TAPE_ARRAY(t, f->rod, 3 * f->stations.n);
  SW_TAPE_ARRAY(t, f->stations.s, f->stations.n), SW_TAPE_ARRAY(t, f->stations.ring, f->stations.n);
  sw_tape_double(t, &f->stations.spacing);
  sw_tape_count(t, &f->bytes, 1);
  sw_tape_array(t, &f->memory, f->bytes, 1);
  sw_tape_count(t, &f->touches, sizeof *f->touch);
  SW_TAPE_ARRAY(t, f->touch, f->touches);
  sw_tape_size(t, &f->node), sw_tape_size(t, &f->nodes);
  sw_tape_jaw(t, &f->jaw);
}

static void retain(void *frozen) {
  if (frozen) ((sw_frozen *)frozen)->references++;
}
static void release(void *frozen) { sw_frozen_release(frozen); }

void sw_tape_frozen(sw_tape *t, sw_frozen **frozen) {
  static const sw_sharing sharing = {retain, release};
  if (sw_tape_share(t, frozen, &sharing)) return;
  int there = !sw_tape_reads(t) && *frozen != NULL;
  sw_tape_int(t, &there);
  if (!there) return;
  if (!sw_tape_object(t, frozen, sizeof **frozen)) return;
  if (sw_tape_reads(t)) (*frozen)->references = 1;
  tape_fields(t, *frozen);
}

int sw_frozen_fits(const sw_frozen *f, const sw_scene *s) {
  const sw_web *web = f->strand.web;
  if (!f->cls || !f->cls->mesh || !web || !web->per_ring || !f->strand.calibrated || f->mesh.rest)
    return 0;
  if (sw_scene_body_now(s, f->wire).slot >= sw_scene_wire_slots(s)) return 0;
  if (f->mesh.n != web->rings || f->stations.n != web->rings) return 0;
  if (f->first > f->last || f->last >= web->rings || f->nodes != web->particles) return 0;
  for (size_t i = 0; i < f->stations.n; i++)
    if (!isfinite(f->stations.s[i]) || (i && !(f->stations.s[i - 1] < f->stations.s[i]))) return 0;
  SW_ITEMS(const sw_frozen_touch, t, f->touch, f->touches) {
    if (!sw_finite(t->at) || !sw_finite(t->normal) || !(t->force >= 0 && t->friction >= 0))
      return 0;
  }
  if (f->node > SIZE_MAX - f->nodes || web->around_count > SW_OUTLINE) return 0;
  return sw_contact_memory_fits(f->memory, f->bytes, SIZE_MAX, sw_scene_obstacle_slots(s));
}
