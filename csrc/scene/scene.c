/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Life of a scene and of what is in it. */
#include "scene/scene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/log.h"
#include "base/tape.h"
#include "link/hold.h"
#include "scene/forces.h"
#include "scene/history.h"
#include "scene/hold.h"
#include "scene/jaws.h"
#include "scene/kept_frames.h"
#include "scene/line.h"
#include "scene/obstacle.h"
#include "scene/touching.h"
#include "scene/world.h"
#include "state/field.h"

static const sw_param scene_rows[] = {
    {"name", SW_PARAM_TEXT, "-", 0, 0, 0, 0, NULL, offsetof(sw_scene_args, name),
     "name used in messages and files"},
    {"gravity", SW_PARAM_VECTOR, "m/s2", NAN, -HUGE_VAL, HUGE_VAL, 0, NULL,
     offsetof(sw_scene_args, gravity), "gravity (default {0, 0, -9.81})"},
};
const sw_params sw_scene_params = SW_PARAMS("scene", scene_rows);

static const double STANDARD_GRAVITY = 9.81; /* [m/s2] */

sw_status sw_scene_new(const sw_scene_args *args, sw_scene **out, sw_error *err) {
  sw_scene *s = sw_alloc(1, sizeof *s);
  if (!s) return sw_fail(err, SW_ENOMEM, "scene: out of memory");
  memcpy(s->name, args->name[0] ? args->name : "scene", args->name[0] ? sizeof s->name : 6);
  s->gravity = isnan(args->gravity.x) ? sw_v(0, 0, -STANDARD_GRAVITY) : args->gravity;
  s->course.window = SW_WINDOW;
  s->frame_stride = 1, s->frame_memory = SW_FRAME_MEMORY;
  *out = s;
  return SW_OK;
}

double sw_scene_window(const sw_scene *s) { return s->course.window; }

void sw_scene_clear_obstacle(sw_scene_obstacle *o) {
  sw_shape_release(o->shape);
  sw_drive_free(&o->drive);
  sw_log_free(&o->log);
}

void sw_scene_free(sw_scene *s) {
  if (!s) return;
  for (size_t i = 0; i < s->wire_count; i++) sw_scene_clear_body(&s->wires[i]);
  for (size_t i = 0; i < s->force_count; i++) sw_scene_clear_force(&s->forces[i]);
  for (size_t i = 0; i < s->hold_count; i++) sw_hold_clear(&s->holds[i]);
  for (size_t i = 0; i < s->obstacle_count; i++) sw_scene_clear_obstacle(&s->obstacles[i]);
  for (size_t i = 0; i < s->tool_count; i++) sw_scene_clear_tool(&s->tools[i]);
  sw_scene_orphan_snapshots(s);
  sw_stepper_free(&s->course.stepper);
  sw_contact_free(s->contact);
  sw_log_free(&s->contact_steps);
  sw_pairs_free(s->pairs);
  sw_grains_free(s->grains);
  sw_crowd_free(s->crowd);
  sw_scene_drop_rules(s, 0);
  sw_free(s->rules);
  sw_system_free(&s->system);
  sw_scene_forget_contact(s);
  sw_scene_forget_histories(s);
  sw_scene_drop_frames(s);
  sw_free(s->frames);
  sw_events_clear(&s->events);
  sw_watches_clear(&s->watches);
  sw_ledger_free(&s->books);
  sw_free(s->hold_slot);
  sw_free(s->hold_loads);
  sw_free(s->wires);
  sw_free(s->holds);
  sw_free(s->obstacles);
  sw_free(s->tools);
  sw_free(s->forces);
  sw_free(s->joins);
  sw_free(s);
}

const char *sw_scene_name(const sw_scene *s) { return s->name; }
double sw_scene_time(const sw_scene *s) { return s->time; }
sw_vec sw_scene_gravity(const sw_scene *s) { return s->gravity; }
sw_status sw_scene_set_gravity(sw_scene *s, sw_vec gravity, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  s->gravity = gravity;
  sw_course_jump(&s->course);
  return SW_OK;
}

sw_status sw_scene_readable(const sw_scene *s, sw_error *err) {
  if (!s->diverged) return SW_OK;
  return sw_fail(err, SW_EDIVERGED,
                 "scene '%s': the last run diverged (%.300s); its numbers mean nothing, restore a "
                 "snapshot or build the scene anew",
                 s->name, s->why.text);
}

int sw_scene_busy(const sw_scene *s) { return s->running > 0 || s->looking; }

sw_status sw_scene_still(const sw_scene *s, sw_error *err) {
  if (s->running)
    return sw_fail(err, SW_EBUSY,
                   "scene '%s' cannot be changed or measured from inside a step or a function of "
                   "time",
                   s->name);
  return SW_OK;
}

sw_status sw_scene_editable(const sw_scene *s, sw_error *err) {
  SW_TRY(sw_scene_still(s, err));
  if (s->looking)
    return sw_fail(
        err, SW_EBUSY,
        "scene '%s' cannot be changed while an observer looks at it; hand the change in: "
        "observer:change(function() ... end)",
        s->name);
  return SW_OK;
}

sw_scene_wire *sw_scene_find_body(const sw_scene *s, sw_handle h, sw_error *err) {
  if (h.slot < s->wire_count && s->wires[h.slot].generation == h.generation)
    return &s->wires[h.slot];
  sw_fail(err, SW_EDEAD, "this object is not of scene '%s' any more", s->name);
  return NULL;
}

sw_scene_wire *sw_scene_find_wire(const sw_scene *s, sw_handle h, sw_error *err) {
  sw_scene_wire *w = sw_scene_find_body(s, h, err);
  if (!w || !sw_scene_is_loose(w)) return w;
  sw_fail(err, SW_EINVAL, "'%s' is an object of particles, not a wire", w->name);
  return NULL;
}

sw_hold *sw_scene_find_hold(const sw_scene *s, sw_handle h, sw_error *err) {
  if (h.slot < s->hold_count && s->holds[h.slot].generation == h.generation)
    return &s->holds[h.slot];
  sw_fail(err, SW_EDEAD, "this clamp is not of scene '%s' any more", s->name);
  return NULL;
}

sw_scene_obstacle *sw_scene_find_obstacle(const sw_scene *s, sw_handle h, sw_error *err) {
  if (h.slot < s->obstacle_count && s->obstacles[h.slot].generation == h.generation &&
      s->obstacles[h.slot].alive)
    return &s->obstacles[h.slot];
  sw_fail(err, SW_EDEAD, "this obstacle is not of scene '%s' any more", s->name);
  return NULL;
}

const char *sw_scene_wire_name(const sw_scene *s, sw_handle h) {
  const sw_scene_wire *w = sw_scene_find_body(s, h, NULL);
  return w ? w->name : NULL;
}

const char *sw_scene_hold_name(const sw_scene *s, sw_handle h, const char **kind, int *held) {
  const sw_hold *hold = sw_scene_find_hold(s, h, NULL);
  if (!hold) return NULL;
  *kind = hold->cls->name;
  *held = hold->alive;
  return hold->name;
}

const char *sw_scene_obstacle_name(const sw_scene *s, sw_handle h, const char **kind,
                                   int *present) {
  if (h.slot >= s->obstacle_count || s->obstacles[h.slot].generation != h.generation) return NULL;
  *kind = sw_shape_kind(s->obstacles[h.slot].shape);
  *present = s->obstacles[h.slot].alive;
  return s->obstacles[h.slot].name;
}

/* A name for an unnamed object: "wire1", "box2", ... */
void sw_scene_give_name(char *out, const char *wanted, const char *kind, size_t number) {
  if (wanted[0])
    memcpy(out, wanted, SW_NAME_SIZE);
  else
    snprintf(out, SW_NAME_SIZE, "%s%zu", kind, number + 1);
}

/* --- obstacles -------------------------------------------------------------- */

static const sw_param obstacle_rows[] = {
    {"name", SW_PARAM_TEXT, "-", 0, 0, 0, 0, NULL, offsetof(sw_obstacle_args, name),
     "name used in messages and series"},
    {"at", SW_PARAM_VECTOR, "m", 0, -HUGE_VAL, HUGE_VAL, SW_PARAM_CHANGES, NULL,
     offsetof(sw_obstacle_args, at), "place of the shape's origin"},
    {"rotation", SW_PARAM_ROTATION, "rad", 0, 0, 0, SW_PARAM_CHANGES, NULL,
     offsetof(sw_obstacle_args, rotation),
     "turn of the shape: { axis = {x, y, z}, angle = } or quaternion {w, x, y, z}"},
    {"friction", SW_PARAM_NUMBER, "-", 0.3, 0, 100, SW_PARAM_CHANGES, NULL,
     offsetof(sw_obstacle_args, friction), "Coulomb friction coefficient"},
    {"kinetic_friction", SW_PARAM_NUMBER, "-", NAN, 0, 100, SW_PARAM_CHANGES, NULL,
     offsetof(sw_obstacle_args, kinetic), "of what slides already (default: friction)"},
    {"restitution", SW_PARAM_NUMBER, "-", 0, 0, 1, SW_PARAM_CHANGES, NULL,
     offsetof(sw_obstacle_args, restitution), "share of the approach speed kept in an impact"},
};
const sw_params sw_obstacle_params = SW_PARAMS("obstacle", obstacle_rows);

sw_status sw_scene_add_obstacle(sw_scene *s, sw_shape *shape, const sw_obstacle_args *args,
                                sw_handle *out, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_scene_thaw(s));
  SW_TRY(sw_grow((void **)&s->obstacles, &s->obstacle_capacity, s->obstacle_count + 1,
                 sizeof *s->obstacles));
  sw_scene_obstacle *o = &s->obstacles[s->obstacle_count];
  *o = (sw_scene_obstacle){.generation = ++s->serial,
                           .alive = 1,
                           .drive = {.pose = {args->at, args->rotation}},
                           .friction = args->friction,
                           .kinetic = isnan(args->kinetic) ? args->friction : args->kinetic,
                           .restitution = args->restitution};
  sw_scene_give_name(o->name, args->name, sw_shape_kind(shape), s->obstacle_count);
  o->shape = sw_shape_retain(shape);
  sw_obstacle_log_begin(s, o);
  *out = (sw_handle){(uint32_t)s->obstacle_count++, s->serial};
  return SW_OK;
}

sw_status sw_scene_remove_obstacle(sw_scene *s, sw_handle obstacle, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  sw_scene_obstacle *o = sw_scene_find_obstacle(s, obstacle, err);
  if (!o) return SW_EDEAD;
  SW_TRY(sw_scene_thaw(s));
  if (sw_obstacle_log_fill(s, o) != SW_OK) return sw_fail(err, SW_ENOMEM, "out of memory");
  o->alive = 0;
  return SW_OK;
}

sw_status sw_scene_obstacle_follow(sw_scene *s, sw_handle obstacle, sw_motion *motion, int relative,
                                   sw_error *err) {
  sw_scene_obstacle *o = sw_scene_find_obstacle(s, obstacle, err);
  if (!o) return SW_EDEAD;
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_drive_follow(s, &o->drive, o->name, motion, relative, err));
  sw_course_jump(&s->course);
  if (s->contact) sw_contact_ask_again(s->contact);
  return SW_OK;
}

sw_status sw_scene_obstacle_pose(sw_scene *s, sw_handle obstacle, sw_pose *out, sw_error *err) {
  sw_motion_state now;
  const sw_scene_obstacle *o = sw_scene_find_obstacle(s, obstacle, err);
  if (!o) return SW_EDEAD;
  SW_TRY(sw_drive_eval(s, &o->drive, s->time, &now, err));
  *out = now.pose;
  return SW_OK;
}

sw_status sw_scene_obstacle_shape(sw_scene *s, sw_handle obstacle, sw_shape **out, sw_error *err) {
  const sw_scene_obstacle *o = sw_scene_find_obstacle(s, obstacle, err);
  if (!o) return SW_EDEAD;
  *out = o->shape;
  return SW_OK;
}

sw_status sw_scene_obstacle_set_pose(sw_scene *s, sw_handle obstacle, sw_pose pose, sw_error *err) {
  sw_scene_obstacle *o = sw_scene_find_obstacle(s, obstacle, err);
  if (!o) return SW_EDEAD;
  SW_TRY(sw_scene_editable(s, err));
  if (o->drive.tool)
    return sw_fail(err, SW_EINVAL, "obstacle '%s' goes with gripper '%s'; move that", o->name,
                   s->tools[o->drive.tool - 1].name);
  sw_drive_free(&o->drive);
  o->drive.pose = pose;
  sw_course_jump(&s->course);
  if (s->contact) sw_contact_ask_again(s->contact);
  return SW_OK;
}

sw_status sw_scene_obstacle_args(sw_scene *s, sw_handle obstacle, sw_obstacle_args *out,
                                 sw_error *err) {
  sw_pose pose;
  const sw_scene_obstacle *o = sw_scene_find_obstacle(s, obstacle, err);
  if (!o) return SW_EDEAD;
  SW_TRY(sw_scene_obstacle_pose(s, obstacle, &pose, err));
  *out = (sw_obstacle_args){.at = pose.p,
                            .rotation = pose.q,
                            .friction = o->friction,
                            .kinetic = o->kinetic,
                            .restitution = o->restitution};
  memcpy(out->name, o->name, sizeof out->name);
  return SW_OK;
}

sw_status sw_scene_obstacle_set_surface(sw_scene *s, sw_handle obstacle,
                                        const sw_obstacle_args *args, sw_error *err) {
  sw_scene_obstacle *o = sw_scene_find_obstacle(s, obstacle, err);
  if (!o) return SW_EDEAD;
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_scene_thaw(s));
  o->friction = args->friction, o->kinetic = args->kinetic, o->restitution = args->restitution;
  sw_course_jump(&s->course);
  return SW_OK;
}

void sw_obstacle_mean(const sw_scene_obstacle *o, sw_vec about, sw_vec *force, sw_vec *moment) {
  *force = *moment = sw_v(0, 0, 0);
  if (o->off) return;
  *force = o->past.mean.force;
  *moment = sw_sub(o->past.mean.moment, sw_cross(about, *force));
}

sw_status sw_scene_obstacle_force(sw_scene *s, sw_handle obstacle, sw_vec about, sw_vec *force,
                                  sw_vec *moment, sw_error *err) {
  if (!sw_scene_find_obstacle(s, obstacle, err)) return SW_EDEAD;
  SW_TRY(sw_scene_readable(s, err));
  sw_obstacle_mean(&s->obstacles[obstacle.slot], about, force, moment);
  return SW_OK;
}
