/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Adds, changes, reads and removes obstacles. */
#include <math.h>
#include <string.h>

#include "body/build.h"
#include "body/obstacle_log.h"
#include "edit/edit.h"
#include "edit/links.h"
#include "scene/course.h"
#include "scene/drive.h"
#include "scene/driven.h"
#include "scene/lookup.h"
#include "scene/obstacle.h"
#include "scene/parts.h"

static const sw_param obstacle_rows[] = {
    SW_NAME_ROW(sw_obstacle_args),
    {"at", SW_PARAM_VECTOR, "m", 0, -HUGE_VAL, HUGE_VAL, SW_PARAM_CHANGES, NULL,
     offsetof(sw_obstacle_args, at), "place of the shape's origin"},
    {"rotation", SW_PARAM_ROTATION, "rad", 0, 0, 0, SW_PARAM_CHANGES, NULL,
     offsetof(sw_obstacle_args, rotation),
     "rotation of the shape: { axis = {x, y, z}, angle = } or quaternion {w, x, y, z}"},
    {"friction", SW_PARAM_NUMBER, "-", 0.3, 0, 100, SW_PARAM_CHANGES, NULL,
     offsetof(sw_obstacle_args, friction), "Coulomb friction coefficient"},
    {"kinetic_friction", SW_PARAM_NUMBER, "-", NAN, 0, 100, SW_PARAM_CHANGES, NULL,
     offsetof(sw_obstacle_args, kinetic), "friction coefficient while sliding (default: friction)"},
    {"restitution", SW_PARAM_NUMBER, "-", 0, 0, 1, SW_PARAM_CHANGES, NULL,
     offsetof(sw_obstacle_args, restitution), "share of the approach speed kept in an impact"},
};
const sw_params sw_obstacle_params = SW_PARAMS("obstacle", obstacle_rows);

sw_status sw_scene_add_obstacle(sw_scene *s, sw_shape *shape, const sw_obstacle_args *args,
                                sw_handle *out, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_scene_unbuild(s));
  sw_scene_obstacle o = {.alive = 1,
                         .shape = shape,
                         .drive = {.pose = {args->at, args->rotation}},
                         .friction = args->friction,
                         .kinetic = isnan(args->kinetic) ? args->friction : args->kinetic,
                         .restitution = args->restitution};
  sw_scene_give_name(o.name, args->name, sw_shape_kind(shape), sw_scene_obstacle_slots(s));
  sw_obstacle_log_begin(s, &o);
  SW_TRY(sw_scene_add(s, SW_OF_OBSTACLE, &o, out));
  sw_scene_let_out(s);
  sw_shape_retain(shape);
  return SW_OK;
}

sw_status sw_scene_remove_obstacle(sw_scene *s, sw_handle obstacle, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  SW_FIND(sw_scene_obstacle, o, sw_scene_find_obstacle(s, obstacle, err));
  SW_TRY(sw_scene_unbuild(s));
  if (sw_obstacle_log_fill(s, o) != SW_OK) return sw_fail(err, SW_ENOMEM, "out of memory");
  o->alive = 0;
  return SW_OK;
}

sw_status sw_scene_obstacle_shape(sw_scene *s, sw_handle obstacle, sw_shape **out, sw_error *err) {
  const sw_scene_obstacle *o = sw_scene_any_obstacle(s, obstacle, err);
  if (!o) return SW_EDEAD; /* earlier frames show obstacles that were removed */
  *out = o->shape;
  return SW_OK;
}

sw_status sw_scene_obstacle_args(sw_scene *s, sw_handle obstacle, sw_obstacle_args *out,
                                 sw_error *err) {
  sw_pose pose;
  SW_FIND(const sw_scene_obstacle, o, sw_scene_find_obstacle(s, obstacle, err));
  SW_TRY(sw_scene_object_pose(s, SW_OF_OBSTACLE, obstacle, &pose, err));
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
  SW_FIND(sw_scene_obstacle, o, sw_scene_find_obstacle(s, obstacle, err));
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_scene_unbuild(s));
  o->friction = args->friction, o->kinetic = args->kinetic, o->restitution = args->restitution;
  sw_course_jump(sw_scene_course(s));
  return SW_OK;
}

sw_status sw_scene_obstacle_force(sw_scene *s, sw_handle obstacle, sw_vec about, sw_vec *force,
                                  sw_vec *moment, sw_error *err) {
  if (!sw_scene_find_obstacle(s, obstacle, err)) return SW_EDEAD;
  SW_TRY(sw_scene_readable(s, err));
  sw_obstacle_mean(sw_scene_obstacle_in(s, obstacle.slot), about, force, moment);
  return SW_OK;
}

void sw_scene_clear_obstacle(sw_scene_obstacle *o) {
  sw_shape_release(o->shape);
  sw_drive_free(&o->drive);
  sw_log_free(&o->log);
}
