/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds objects of a scene by their handles, gives their names, and checks whether the scene may be
 * changed or read now. */
#include "scene/lookup.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "base/halving.h"
#include "link/joint.h"
#include "scene/forces.h"
#include "scene/gripper.h"
#include "scene/obstacle.h"
#include "scene/scene.h"
#include "scene/wire.h"
#include "scene/world.h"

const char *sw_scene_name(const sw_scene *s) { return s->name; }
double sw_scene_time(const sw_scene *s) { return s->time; }
sw_vec sw_scene_gravity(const sw_scene *s) { return s->gravity; }
double sw_scene_window(const sw_scene *s) { return s->course.window; }

sw_status sw_scene_readable(const sw_scene *s, sw_error *err) {
  if (!s->diverged) return SW_OK;
  return sw_fail(err, SW_EDIVERGED,
                 "scene '%s': the last run diverged (%.300s); its state is not valid; restore a "
                 "snapshot or build the scene again",
                 s->name, s->why.text);
}

int sw_scene_busy(const sw_scene *s) { return s->running > 0 ? 1 : s->looking ? 2 : 0; }

sw_status sw_scene_still(const sw_scene *s, sw_error *err) {
  if (s->running)
    return sw_fail(err, SW_EBUSY,
                   "scene '%s' cannot be changed or measured from inside a step or a function of "
                   "time",
                   s->name);
  return SW_OK;
}

/* SW_EBUSY from inside a step, a user's function or an observer. */
static sw_status not_inside(const sw_scene *s, sw_error *err) {
  SW_TRY(sw_scene_still(s, err));
  if (s->looking)
    return sw_fail(err, SW_EBUSY,
                   "scene '%s' cannot be changed inside an observer's function; use "
                   "observer:change(function() ... end)",
                   s->name);
  return SW_OK;
}

sw_status sw_scene_editable(const sw_scene *s, sw_error *err) {
  SW_TRY(not_inside(s, err));
  return sw_scene_not_reviewed(s, err);
}

sw_status sw_scene_measurable(const sw_scene *s, sw_error *err) {
  SW_TRY(not_inside(s, err));
  return sw_scene_readable(s, err);
}

sw_status sw_scene_ready(const sw_scene *s, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  return sw_scene_readable(s, err);
}

sw_scene_wire *sw_scene_find_body(const sw_scene *s, sw_handle h, sw_error *err) {
  if (h.slot < s->wire_count && s->wires[h.slot].generation == h.generation)
    return &s->wires[h.slot];
  double time;
  const char *name = sw_scene_gone_name(s, h, &time);
  if (name)
    sw_fail(err, SW_EDEAD, "'%s' was taken away from scene '%s' at t = %.6g s", name, s->name,
            time);
  else
    sw_fail(err, SW_EDEAD, "this object is no longer in scene '%s'", s->name);
  return NULL;
}

sw_scene_wire *sw_scene_find_wire(const sw_scene *s, sw_handle h, sw_error *err) {
  sw_scene_wire *w = sw_scene_find_body(s, h, err);
  if (!w || !sw_scene_is_loose(w)) return w;
  sw_fail(err, SW_EINVAL, "'%s' is an object of particles, not a wire", w->name);
  return NULL;
}

/* Returns NULL and sets err: there is no such object. */
static void *missing(const sw_scene *s, const char *word, sw_error *err) {
  sw_fail(err, SW_EDEAD, "this %s is no longer in scene '%s'", word, s->name);
  return NULL;
}

/* Finds the object of a handle, released or not. */
#define FIND(type, name, list, count, word)                                            \
  type *sw_scene_##name(const sw_scene *s, sw_handle h, sw_error *err) {               \
    const int known = h.slot < s->count && s->list[h.slot].generation == h.generation; \
    return known ? &s->list[h.slot] : missing(s, word, err);                           \
  }
FIND(sw_hold, find_hold, holds, hold_count, "clamp")
FIND(sw_joint, find_join, joins, join_count, "join")
FIND(sw_scene_force, find_force, forces, force_count, "force")
FIND(sw_scene_obstacle, any_obstacle, obstacles, obstacle_count, "obstacle")
FIND(sw_tool, any_tool, tools, tool_count, "gripper")

sw_scene_obstacle *sw_scene_find_obstacle(const sw_scene *s, sw_handle h, sw_error *err) {
  sw_scene_obstacle *o = sw_scene_any_obstacle(s, h, err);
  return o && !o->alive ? missing(s, "obstacle", err) : o;
}

sw_tool *sw_scene_find_tool(const sw_scene *s, sw_handle h, sw_error *err) {
  sw_tool *o = sw_scene_any_tool(s, h, err);
  return o && !o->alive ? missing(s, "gripper", err) : o;
}

const char *sw_scene_wire_name(const sw_scene *s, sw_handle h) {
  const sw_scene_wire *w = sw_scene_find_body(s, h, NULL);
  return w ? w->name : NULL;
}

static sw_identity identity_of_body(const sw_scene *s, sw_handle h) {
  double time;
  const sw_scene_wire *w = sw_scene_find_body(s, h, NULL);
  if (w) return (sw_identity){w->name, w->cls->name, 1};
  return (sw_identity){.name = sw_scene_gone_name(s, h, &time)};
}

sw_identity sw_scene_identify(const sw_scene *s, sw_kind kind, sw_handle h) {
  const sw_hold *hold = kind == SW_OF_HOLD ? sw_scene_find_hold(s, h, NULL) : NULL;
  const sw_joint *join = kind == SW_OF_JOIN ? sw_scene_find_join(s, h, NULL) : NULL;
  const sw_tool *tool = kind == SW_OF_TOOL ? sw_scene_any_tool(s, h, NULL) : NULL;
  const sw_scene_force *force = kind == SW_OF_FORCE ? sw_scene_find_force(s, h, NULL) : NULL;
  const sw_scene_obstacle *obstacle =
      kind == SW_OF_OBSTACLE ? sw_scene_any_obstacle(s, h, NULL) : NULL;
  if (kind == SW_OF_BODY) return identity_of_body(s, h);
  if (hold) return (sw_identity){hold->name, hold->cls->name, hold->alive};
  if (join) return (sw_identity){join->name, join->cls->name, join->alive};
  if (tool) return (sw_identity){tool->name, "gripper", tool->alive};
  if (force) return (sw_identity){force->name, force->cls->name, force->alive};
  if (obstacle)
    return (sw_identity){obstacle->name, sw_shape_kind(obstacle->shape), obstacle->alive};
  return (sw_identity){NULL, NULL, 0};
}

/* Names an unnamed object "wire1", "box2", ... */
void sw_scene_give_name(char *out, const char *wanted, const char *kind, size_t number) {
  if (wanted[0])
    memcpy(out, wanted, SW_NAME_SIZE);
  else
    snprintf(out, SW_NAME_SIZE, "%s%zu", kind, number + 1);
}

sw_hold *sw_scene_living_hold(const sw_scene *s, sw_handle hold, sw_error *err) {
  sw_hold *h = sw_scene_find_hold(s, hold, err);
  if (h && !h->alive) {
    sw_fail(err, SW_EDEAD, "%s '%s' has been released", h->cls->name, h->name);
    return NULL;
  }
  return h;
}

sw_status sw_scene_check_line(const sw_scene_wire *w, const char *what, sw_error *err) {
  if (!w->cls->mesh) return SW_OK;
  if (sw_scene_is_loose(w))
    return sw_fail(err, SW_EINVAL, "%s: '%s' is an object of particles; this goes with wires only",
                   what, w->name);
  return sw_fail(err, SW_EINVAL,
                 "%s: wire '%s' is a %s, a mesh of particles; this goes with rods and strings only",
                 what, w->name, w->cls->name);
}

/* --- bodies, including those that have left ----------------------------------------------- */

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
