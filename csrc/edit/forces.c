/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces of a scene, and which forces go with which wires. */
#include "scene/forces.h"

#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "body/build.h"
#include "edit/edit.h"
#include "edit/forces.h"
#include "scene/course.h"
#include "scene/lookup.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "state/mesh.h"
#include "system/system.h"

/* SW_EINVAL when the force cannot act on the wire. */
static sw_status check_wire(const sw_force_class *cls, const sw_scene_wire *w, const void *args,
                            sw_error *err) {
  sw_recipe recipe;
  int by_angle = 0;
  w->cls->recipe(&w->beam, &recipe);
  if ((cls->flags & SW_FORCE_AT_PLACE) && sw_scene_is_loose(w))
    return sw_fail(err, SW_EINVAL,
                   "force %s: '%s' is an object of particles, which has no arc length s; for "
                   "particles use kind = 'push'",
                   cls->name, w->name);
  if ((cls->flags & SW_FORCE_OF_WEB) && !w->cls->mesh)
    return sw_fail(err, SW_EINVAL,
                   "force %s: wire '%s' is a %s; this force goes with objects of particles and "
                   "with models that are meshes",
                   cls->name, w->name, w->cls->name);
  const int any_body = (cls->flags & SW_FORCE_ANY_BODY) && !(cls->flags & SW_FORCE_OF_AXIS);
  if (w->cls->mesh && !any_body && sw_scene_is_loose(w))
    return sw_fail(err, SW_EINVAL,
                   "force %s: '%s' is an object of particles; this force goes with wires",
                   cls->name, w->name);
  if (w->cls->mesh && !(cls->flags & SW_FORCE_ANY_BODY))
    return sw_fail(
        err, SW_EINVAL,
        "force %s: wire '%s' is a %s, a mesh of particles; this force goes with model = 'rod' only",
        cls->name, w->name, w->cls->name);
  for (size_t k = 0; k < recipe.count; k++) by_angle |= strcmp(recipe.terms[k].force, "bend") == 0;
  if ((cls->flags & SW_FORCE_BY_ANGLE) && !by_angle)
    return sw_fail(
        err, SW_EINVAL,
        "force %s: wire '%s' is a %s; this force corrects the bending of model = 'rod' only",
        cls->name, w->name, w->cls->name);
  if (cls->commit && w->beam.framed && !(cls->flags & SW_FORCE_ANY_SHAPE))
    return sw_fail(err, SW_EINVAL,
                   "force %s: wire '%s' is curved at rest, has two values of EI or rolls; this "
                   "force does not support that",
                   cls->name, w->name);
  return cls->check ? cls->check(args, &w->beam, err) : SW_OK;
}

/* 1 if a force of the whole scene does not act on this body: it acts on centre lines, and the body
 * is an object of particles. */
static int passes_by(const sw_force_class *cls, const sw_scene_wire *w) {
  return (cls->flags & SW_FORCE_OF_AXIS) && sw_scene_is_loose(w);
}

sw_status sw_scene_check_rules(const sw_scene *s, size_t wire, const sw_scene_wire *as,
                               sw_error *err) {
  SW_EACH(force, f, s) {
    if (f->alive && (f->wire < 0 ? !passes_by(f->cls, as) : f->wire == (long)wire))
      SW_TRY(check_wire(f->cls, as, f->args, err));
  }
  return SW_OK;
}

static sw_status check_force(const sw_scene *s, const sw_force_class *cls, sw_handle wire,
                             const void *args, sw_error *err) {
  for (size_t w = 0; w < sw_scene_wire_slots(s); w++) {
    if (wire.generation ? w == wire.slot : !passes_by(cls, sw_scene_wire_in(s, w)))
      SW_TRY(check_wire(cls, sw_scene_wire_in(s, w), args, err));
  }
  return SW_OK;
}

void sw_scene_clear_force(sw_scene_force *f) { sw_free(f->particle); }

static sw_status check_some(const sw_force_class *cls, const sw_scene_wire *w,
                            const sw_force_some *some, sw_error *err) {
  if (!w) return sw_fail(err, SW_EINVAL, "force %s: on is required: the object", cls->name);
  if (!some->count)
    return sw_fail(err, SW_EINVAL, "force %s: the list of particles of '%s' is empty", cls->name,
                   w->name);
  for (size_t i = 0; i < some->count; i++)
    if (some->particle[i] >= w->strand.web->particles)
      return sw_fail(err, SW_EINVAL, "force %s: '%s' has no particle %lu; it has %zu, from 1 on",
                     cls->name, w->name, (unsigned long)some->particle[i] + 1,
                     w->strand.web->particles);
  return SW_OK;
}

/* Replaces the caller's list by one that the scene owns. SW_ENOMEM. */
static sw_status own_list(sw_scene_force *f) {
  sw_force_some some;
  memcpy(&some, f->args, sizeof some);
  f->particle = sw_alloc(some.count, sizeof *f->particle);
  if (!f->particle) return SW_ENOMEM;
  memcpy(f->particle, some.particle, some.count * sizeof *f->particle);
  some.particle = f->particle;
  memcpy(f->args, &some, sizeof some);
  return SW_OK;
}

/* Completes arguments that depend on where the wires lie, in a scene that is not built. */
static sw_status place_force(const sw_scene *s, const sw_scene_wire *w, const sw_force_class *cls,
                             void *args, sw_error *err) {
  if (!cls->place) return SW_OK;
  if (!w && sw_scene_wire_slots(s) == 1) w = sw_scene_wire_in(s, 0);
  if (!w) return cls->place(args, 0, NULL, NULL, err);
  const sw_web *web = w->strand.web;
  return web ? cls->place(args, web->particles, w->strand.x, web->s, err)
             : cls->place(args, w->mesh.n, w->mesh.x, w->mesh.s, err);
}

sw_status sw_scene_add_force(sw_scene *s, const sw_force_class *cls, sw_handle wire,
                             const void *args, size_t args_size, sw_handle *out, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  const sw_scene_wire *w = wire.generation ? sw_scene_find_body(s, wire, err) : NULL;
  if (wire.generation && !w) return SW_EDEAD;
  if (args_size > SW_FORCE_ARGS_MAX) return sw_fail(err, SW_ELIMIT, "force: too many arguments");
  if (cls->flags & SW_FORCE_AT_PLACE) {
    double at;
    memcpy(&at, args, sizeof at); /* the first member must be s */
    if (!w) return sw_fail(err, SW_EINVAL, "force %s: on is required: the wire", cls->name);
    const double length = w->mesh.s[w->mesh.n - 1] - w->mesh.s[0];
    if (at > length * (1 + 1e-12))
      return sw_fail(err, SW_EINVAL, "force %s: s = %g m is beyond the end of wire '%s' at %g m",
                     cls->name, at, w->name, length);
  }
  SW_TRY(check_force(s, cls, wire, args, err));
  if (cls->flags & SW_FORCE_ON_SOME) SW_TRY(check_some(cls, w, args, err));
  if (cls->place)
    SW_TRY(sw_scene_unbuild(s));
  else
    sw_scene_await_forces(s); /* many ties can be made in turn, each where its wire is now */
  sw_scene_force f = {.alive = 1,
                      .cls = cls,
                      .wire = wire.generation ? (long)wire.slot : -1,
                      .scale = w ? w->mesh.scale : 1.0};
  if (args_size) memcpy(f.args, args, args_size);
  SW_TRY(place_force(s, w, cls, f.args, err));
  if (cls->flags & SW_FORCE_ON_SOME) SW_TRY(own_list(&f));
  if (w && cls->flags & SW_FORCE_AT_PLACE) f.args[0] += w->mesh.s[0]; /* stays with the wire */
  const sw_status status = sw_scene_add(s, SW_OF_FORCE, &f, out);
  if (status != SW_OK) sw_scene_clear_force(&f);
  return status;
}

const sw_force_class *sw_scene_force_class(const sw_scene *s, sw_handle h) {
  const sw_scene_force *f = sw_scene_find_force(s, h, NULL);
  return f ? f->cls : NULL;
}

sw_status sw_scene_read_force(sw_scene *s, sw_handle force, sw_handle wire, double *out,
                              sw_error *err) {
  sw_system *system = sw_scene_system(s);
  SW_TRY(sw_scene_readable(s, err));
  SW_TRY(sw_scene_still(s, err)); /* inside a step the solver uses the fields */
  SW_FIND(const sw_scene_force, f, sw_scene_find_force(s, force, err));
  const sw_force_class *cls = f->cls;
  SW_FIND(const sw_scene_wire, w, sw_scene_find_body(s, wire, err));
  if (!cls->read) return sw_fail(err, SW_EINVAL, "force %s: there is nothing to read", cls->name);
  SW_TRY(sw_scene_build(s, err));
  sw_system_refresh(system);
  const sw_body *b = &system->bodies[wire.slot];
  for (size_t k = 0; k < b->term_count; k++)
    if (b->terms[k].id == (long)force.slot) {
      cls->read(b->terms[k].args, &b->field, b->terms[k].history, out);
      return SW_OK;
    }
  return sw_fail(err, SW_EINVAL, "force %s: it does not act on '%s'", cls->name, w->name);
}

sw_status sw_scene_name_force(sw_scene *s, sw_handle force, const char *name, sw_error *err) {
  SW_FIND(sw_scene_force, f, sw_scene_find_force(s, force, err));
  snprintf(f->name, SW_NAME_SIZE, "%s", name);
  return SW_OK;
}

/* Returns the place of the force from the wire's present start; its own place counts from the
 * wire's first start. */
static double place_of(const sw_scene *s, const sw_scene_force *f) {
  const sw_mesh *m = &sw_scene_wire_in(s, f->wire)->mesh;
  return f->args[0] * m->scale / f->scale - m->s[0];
}

sw_status sw_scene_force_args(const sw_scene *s, sw_handle force, void *args, sw_error *err) {
  if (!sw_scene_force_class(s, force))
    return sw_fail(err, SW_EDEAD, "this force is no longer in scene '%s'", sw_scene_name(s));
  const sw_scene_force *f = sw_scene_force_in(s, force.slot);
  memcpy(args, f->args, sizeof f->args);
  if (!(f->cls->flags & SW_FORCE_AT_PLACE) || f->wire < 0) return SW_OK;
  const double place = place_of(s, f);
  memcpy(args, &place, sizeof place);
  return SW_OK;
}

sw_status sw_scene_set_force(sw_scene *s, sw_handle force, const void *args, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  SW_FIND(sw_scene_force, f, sw_scene_find_force(s, force, err));
  const sw_handle wire =
      f->wire < 0 ? (sw_handle){0, 0}
                  : (sw_handle){(uint32_t)f->wire, sw_scene_wire_in(s, f->wire)->generation};
  if (!f->alive)
    return sw_fail(err, SW_EINVAL, "force %s: it was released; make another one", f->cls->name);
  SW_TRY(check_force(s, f->cls, wire, args, err));
  SW_TRY(sw_scene_unbuild(s));
  const double place = f->args[0];
  memcpy(f->args, args, sizeof f->args);
  if (f->cls->flags & SW_FORCE_AT_PLACE) f->args[0] = place;
  sw_course_jump(sw_scene_course(s));
  return SW_OK;
}

sw_status sw_scene_remove_force(sw_scene *s, sw_handle force, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  SW_FIND(sw_scene_force, f, sw_scene_find_force(s, force, err));
  if (!f->alive) return SW_OK;
  SW_TRY(sw_scene_unbuild(s));
  f->alive = 0;
  return SW_OK;
}
