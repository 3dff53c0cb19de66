/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Other meshes for the wires of a scene. A wire that has not moved yet is drawn anew with the other
 * mesh; otherwise its state is carried over. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "body/bends.h"
#include "body/body.h"
#include "body/build.h"
#include "body/hold.h"
#include "body/join.h"
#include "body/other_edges.h"
#include "edit/edit.h"
#include "link/hold.h"
#include "scene/drive.h"
#include "scene/lookup.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "state/mesh.h"

static const double SAME_PLACE = 1e-9; /* of the wire's length [-] */

/* --- as drawn ---------------------------------------------------------------------- */

typedef struct kept_hold {
  size_t slot;
  sw_hold shape;
} kept_hold;

/* Finds the wire's living holds, with copies of where they hold. */
static sw_status keep_holds(const sw_scene *s, size_t wire, kept_hold **out, size_t *count) {
  *count = 0;
  *out = sw_alloc(sw_scene_living_holds(s), sizeof **out);
  if (!*out) return SW_ENOMEM;
  for (size_t k = 0; k < sw_scene_hold_slots(s); k++) {
    if (!sw_scene_hold_in(s, k)->alive || sw_scene_hold_in(s, k)->wire != wire) continue;
    SW_TRY(sw_scene_copy_shape(sw_scene_hold_in(s, k), &(*out)[*count].shape));
    (*out)[(*count)++].slot = k;
  }
  return SW_OK;
}

/* Lets each hold grasp the new mesh, in the order in which the holds were made. */
static sw_status retake_holds(sw_scene *s, const kept_hold *kept, size_t count) {
  for (size_t k = 0; k < count; k++) sw_scene_hold_in(s, kept[k].slot)->alive = 0;
  for (size_t k = 0; k < count; k++)
    SW_TRY(sw_scene_retake_hold(s, sw_scene_hold_in(s, kept[k].slot)));
  return SW_OK;
}

static void put_back(sw_scene *s, kept_hold *kept, size_t count) {
  for (size_t k = 0; k < count; k++) {
    sw_hold *h = sw_scene_hold_in(s, kept[k].slot);
    sw_hold *old = &kept[k].shape;
    double *arrays[2] = {h->s, h->local};
    h->alive = 1;
    h->shape = old->shape, h->s1 = old->s1, h->s2 = old->s2, h->count = old->count;
    memcpy(h->director, old->director, sizeof h->director);
    memcpy(h->frame, old->frame, sizeof h->frame);
    h->s = old->s, h->local = old->local;
    old->s = arrays[0], old->local = arrays[1];
  }
}

static sw_status redraw(sw_scene *s, size_t wire, size_t segments, sw_error *err) {
  sw_scene_wire *w = sw_scene_wire_in(s, wire);
  const sw_mesh before = w->mesh;
  const size_t drawn = w->drawing.segments;
  kept_hold *kept;
  size_t count;
  sw_mesh fresh = {0};
  sw_status status = keep_holds(s, wire, &kept, &count);
  if (status == SW_OK) status = sw_scene_draw(w, segments, &fresh, err);
  if (status == SW_OK) {
    w->mesh = fresh;
    status = retake_holds(s, kept, count);
    if (status == SW_OK) status = sw_scene_retake_joins(s, wire);
    if (status != SW_OK) {
      sw_mesh_free(&w->mesh);
      w->mesh = before;
      put_back(s, kept, count);
    } else {
      const double ratio = fresh.scale / before.scale;
      for (size_t k = 0; k < w->twisted_count; k++)
        w->twisted[k].s1 *= ratio, w->twisted[k].s2 *= ratio;
      sw_mesh old = before;
      sw_mesh_free(&old);
    }
  }
  if (status != SW_OK) w->drawing.segments = drawn;
  for (size_t k = 0; kept && k < count; k++) sw_hold_clear(&kept[k].shape);
  sw_free(kept);
  return status;
}

/* --- as it is now ------------------------------------------------------------------- */

/* Makes an even mesh of the wire's length with the places its holds need: arc lengths only. Its
 * nodes are old ones where possible. */
static sw_status new_places(const sw_scene *s, size_t wire, size_t segments, sw_mesh *out) {
  const sw_mesh *old = &sw_scene_wire_in(s, wire)->mesh;
  const double length = old->s[old->n - 1], ends[6] = {0, 0, 0, length, 0, 0};
  SW_TRY(sw_mesh_along(out, ends, 2, segments));
  out->EA = 1;
  for (size_t i = 1; i <= segments; i++) {
    double at = i == segments ? length : length * ((double)i / (double)segments);
    const size_t k = sw_mesh_node(old, at);
    if (fabs(old->s[k] - at) <= SAME_PLACE * length) at = old->s[k];
    if (k > 0 && fabs(old->s[k - 1] - at) <= SAME_PLACE * length) at = old->s[k - 1];
    out->s[i] = at;
  }
  return sw_scene_make_places(s, wire, out);
}

/* Between the places that a hold has grasped its wire is straight, wherever nodes were since. */
static sw_status put_held(sw_scene *s, size_t wire, sw_mesh *m, sw_error *err) {
  SW_EACH(hold, h, s) {
    sw_motion_state now;
    if (!h->alive || h->wire != wire || !h->local || sw_hold_passes(h) || h->cls->hold->rail)
      continue; /* of these the wire may be elsewhere than they have grasped it */
    SW_TRY(sw_drive_eval(s, &h->drive, sw_scene_time(s), &now, err));
    sw_line_put_held(h, now.pose, m);
  }
  return SW_OK;
}

static sw_status carry_over(sw_scene *s, size_t wire, size_t segments, sw_error *err) {
  sw_scene_wire *w = sw_scene_wire_in(s, wire);
  sw_mesh places = {0}, fresh = {0};
  size_t count = 0;
  double *held SW_LOCAL = sw_alloc(2 * sw_scene_living_holds(s), sizeof *held);
  if (!held) return SW_ENOMEM;
  SW_EACH(hold, h, s) {
    if (!h->alive || h->wire != wire) continue;
    held[2 * count] = h->s1;
    held[2 * count++ + 1] = h->s2;
  }
  sw_wire_bends bends = {0};
  sw_status status = w->beam.EI > 0 ? sw_scene_read_bends(s, wire, &bends) : SW_OK;
  if (status == SW_OK) status = new_places(s, wire, segments, &places);
  if (status == SW_OK) status = sw_mesh_resample(&w->mesh, places.s, places.n, held, count, &fresh);
  if (status == SW_OK) {
    sw_mesh old = w->mesh;
    w->mesh = fresh;
    w->mesh.spacing = places.spacing;
    status = put_held(s, wire, &w->mesh, err);
    if (status == SW_OK && bends.loads.list) status = sw_scene_give_all_bends(s, wire, &bends);
    sw_scene_correct_twist(s, wire, &old);
    sw_mesh_free(&old);
  }
  sw_wire_bends_free(&bends);
  sw_mesh_free(&places);
  return status;
}

/* 1 if the wire lies as drawn, with the whole drawn length. */
static int is_drawn(const sw_scene_wire *w) {
  const double drawn = w->drawing.length * w->mesh.scale;
  return w->mesh.drawn && fabs(w->mesh.s[w->mesh.n - 1] - drawn) <= SAME_PLACE * drawn;
}

/* SW_EINVAL for wires that cannot be meshed anew: feeding makes and removes nodes at places that
 * another mesh would not have; a mesh of particles is fixed when it is made. */
static sw_status check_fed(const sw_scene *s, sw_error *err) {
  SW_EACH(wire, wire, s) SW_TRY(sw_scene_check_line(wire, "another number of segments", err));
  SW_EACH(hold, h, s)
    if (h->alive && sw_hold_passes(h))
      return sw_fail(
          err, SW_EINVAL,
          "wire '%s' is fed by '%s': its segments cannot be changed, so there are no error "
          "bars and no model = 'auto'; choose the model, run with dt (or a tolerance "
          "in m), and compare with another number of segments",
          sw_scene_wire_in(s, h->wire)->name, h->name);
  for (size_t w = 0; w < sw_scene_wire_slots(s); w++)
    if (sw_scene_wire_in(s, w)->mesh.s[0] != 0)
      return sw_fail(err, SW_EINVAL, "wire '%s' has been fed: its segments cannot be changed",
                     sw_scene_wire_in(s, w)->name);
  return SW_OK;
}

sw_status sw_scene_remesh(sw_scene *s, const size_t *segments, size_t count, sw_error *err) {
  SW_TRY(sw_scene_ready(s, err));
  if (count != sw_scene_wire_slots(s))
    return sw_fail(err, SW_EINVAL,
                   "scene '%s': segments must have one number per wire, %zu in all, got %zu",
                   sw_scene_name(s), sw_scene_wire_slots(s), count);
  for (size_t w = 0; w < count; w++)
    if (segments[w] < 2 || segments[w] > 10000000)
      return sw_fail(err, SW_EINVAL,
                     "wire '%s': segments = %zu is not allowed; it must be from 2 to 10000000",
                     sw_scene_wire_in(s, w)->name, segments[w]);
  SW_TRY(check_fed(s, err));
  SW_TRY(sw_scene_unbuild(s));
  sw_scene_number_stops(s); /* they are not known after a restore */
  for (size_t w = 0; w < count; w++) {
    const sw_status status = is_drawn(sw_scene_wire_in(s, w)) ? redraw(s, w, segments[w], err)
                                                              : carry_over(s, w, segments[w], err);
    if (status == SW_ENOMEM)
      return sw_fail(err, status, "scene '%s': out of memory", sw_scene_name(s));
    if (status != SW_OK) return status;
  }
  sw_scene_measure_joins(s);
  return SW_OK;
}

/* Largest twist that may be lost when a wire that has moved gets frames [rad]. */
static const double LEAST_TWIST = 1e-3;

/* Lets a wire that has moved roll. It keeps its frames, or, where nothing twists it, gets frames
 * carried along the wire. */
static sw_status add_rolling(sw_scene *s, size_t wire, sw_error *err) {
  sw_scene_wire *w = sw_scene_wire_in(s, wire);
  sw_mesh *m = &w->mesh;
  for (size_t k = 0; k < w->twisted_count; k++)
    if (!(fabs(w->twisted[k].twist) <= LEAST_TWIST))
      return sw_fail(err, SW_EINVAL, "redraw: wire '%s' has moved and is twisted by %.3g rad",
                     w->name, w->twisted[k].twist);
  const int framed = w->mesh.rest != NULL;
  const sw_vec along = sw_unit_or(sw_sub(sw_load(m->x + 3), sw_load(m->x)), sw_v(1, 0, 0));
  if (!framed) SW_TRY(sw_mesh_add_frames(m, sw_perpendicular(along), 1, 0.0));
  w->beam.rolls = w->beam.framed = 1;
  sw_scene_forget_mesh(s, wire);
  if (!framed) sw_scene_frame_holds(s, wire);
  return SW_OK;
}

static sw_status change_beam(sw_scene *s, size_t wire, const sw_redrawing *as, sw_error *err) {
  sw_scene_wire *w = sw_scene_wire_in(s, wire);
  size_t segments;
  const int rolls = as->rolls && !w->beam.rolls, drawn = is_drawn(w);
  if (!drawn && (w->beam.rolls != as->rolls || as->EA != 1) && (!rolls || as->EA != 1))
    return sw_fail(err, SW_EINVAL, "redraw: wire '%s' has moved since it was drawn", w->name);
  w->beam.EA *= as->EA, w->beam.EI *= as->EI, w->beam.GJ *= as->GJ, w->beam.E *= as->EA;
  for (int k = 0; k < 2; k++) w->beam.EI_axis[k] *= as->EI;
  w->drawing.rolls = as->rolls;
  if (!drawn) return rolls ? add_rolling(s, wire, err) : SW_OK;
  w->beam.framed = w->beam.EI_axis[0] != w->beam.EI_axis[1] || w->drawing.rest == SW_REST_PATH;
  SW_TRY(sw_scene_wire_segments(s, (sw_handle){.slot = (uint32_t)wire, .generation = w->generation},
                                &segments, err));
  return redraw(s, wire, segments, err);
}

sw_status sw_scene_redraw(sw_scene *s, sw_handle h, const sw_redrawing *as, sw_error *err) {
  SW_TRY(sw_scene_ready(s, err));
  if (!sw_scene_find_wire(s, h, err)) return SW_EDEAD;
  sw_scene_wire *w = sw_scene_wire_in(s, h.slot);
  if (strcmp(w->cls->name, "rod") != 0)
    return sw_fail(err, SW_EINVAL, "redraw: wire '%s' is a %s, not a rod", w->name, w->cls->name);
  SW_TRY(check_fed(s, err));
  SW_TRY(sw_scene_unbuild(s));
  const sw_beam beam = w->beam;
  const int rolled = w->drawing.rolls;
  const sw_status status = change_beam(s, h.slot, as, err);
  if (status == SW_OK) return status;
  w->beam = beam, w->drawing.rolls = rolled;
  return status == SW_ENOMEM ? sw_fail(err, status, "scene '%s': out of memory", sw_scene_name(s))
                             : status;
}

sw_status sw_scene_wire_segments(sw_scene *s, sw_handle h, size_t *segments, sw_error *err) {
  SW_FIND(const sw_scene_wire, w, sw_scene_find_wire(s, h, err));
  *segments = (size_t)fmax(1.0, round((w->mesh.s[w->mesh.n - 1] - w->mesh.s[0]) / w->mesh.spacing));
  return SW_OK;
}
