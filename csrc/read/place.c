/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Read-outs of a wire at a place, and the list of all read-outs. */
#include "read/reading.h"
#include "read/readout.h"
#include "scene/lookup.h"
#include "scene/parts.h"
#include "scene/values.h"
#include "scene/wire.h"

const sw_readout *const *sw_readout_all(void) {
#define ONE(name) &sw_readout_##name,
  static const sw_readout *const all[] = {SW_READOUTS(ONE) NULL};
#undef ONE
  return all;
}

static sw_status curvature(sw_scene *s, sw_handle h, double place, double *out, sw_error *err) {
  sw_point_state p;
  SW_TRY(sw_scene_wire_at(s, h, place, &p, err));
  *out = p.curvature;
  return SW_OK;
}

static sw_status tension(sw_scene *s, sw_handle h, double place, double *out, sw_error *err) {
  sw_point_state p;
  SW_TRY(sw_scene_wire_at(s, h, place, &p, err));
  *out = p.tension;
  return SW_OK;
}

/* Returns why there is no twist moment, or NULL. Strings bear none, nor do lines between the meshed
 * parts of a wire. */
static const char *without_twist(const sw_scene *s, const sw_scene_wire *w, sw_handle h,
                                 double place) {
  const sw_plan *p = sw_scene_system(s)->bodies[h.slot].plan;
  sw_recipe recipe;
  double f;
  w->cls->recipe(&w->beam, &recipe);
  if (!p->web) return recipe.twist ? NULL : "the wire is a string, which has none";
  const size_t r = sw_plan_locate(p, place + w->mesh.s[0], &f);
  if (sw_web_is_ring(p->web, r) || sw_web_is_ring(p->web, r + 1)) return NULL;
  return "there the wire is a line of particles, which has none";
}

static sw_status twist_moment(sw_scene *s, sw_handle h, double place, double *out, sw_error *err) {
  sw_point_state p;
  SW_TRY(sw_scene_wire_at(s, h, place, &p, err));
  const sw_scene_wire *w = sw_scene_find_wire(s, h, err);
  const char *why = without_twist(s, w, h, place);
  *out = p.twist_moment;
  if (!why) return SW_OK;
  return sw_fail(err, SW_EINVAL,
                 "wire '%s': twist_moment at s = %.6g m is not known: %s; it is for "
                 "rods and meshes",
                 w->name, place, why);
}

static sw_status spin(sw_scene *s, sw_handle h, double place, double *out, sw_error *err) {
  sw_point_state p;
  SW_FIND(const sw_scene_wire, w, sw_scene_find_wire(s, h, err));
  if (!w->beam.rolls)
    return sw_fail(err, SW_EINVAL, "wire '%s': spin needs a wire made with rolls = true", w->name);
  SW_TRY(sw_scene_wire_at(s, h, place, &p, err));
  *out = p.spin;
  return SW_OK;
}

const sw_readout sw_readout_curvature = {"curvature", "1/m", "curvature of the wire at s", 1,
                                         curvature};
const sw_readout sw_readout_tension = {"tension", "N", "axial force at s, above 0 for tension", 1,
                                       tension};
const sw_readout sw_readout_twist_moment = {
    "twist_moment", "N m", "moment about the wire's own axis at s", 1, twist_moment};
const sw_readout sw_readout_spin = {
    "spin", "rad/s", "angular velocity about the wire's own axis at s, of wires that roll", 1,
    spin};
