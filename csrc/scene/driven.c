/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sets and reads poses and motions of holds, obstacles and grippers. */
#include "scene/driven.h"

#include "contact/contact.h"
#include "scene/course.h"
#include "scene/drive.h"
#include "scene/gripper.h"
#include "scene/lookup.h"
#include "scene/obstacle.h"

/* Returns the drive of a living object, and its name. */
static sw_drive *drive_of(const sw_scene *s, sw_kind kind, sw_handle of, const char **name,
                          sw_error *err) {
  if (kind == SW_OF_HOLD) {
    sw_hold *h = sw_scene_living_hold(s, of, err);
    return h ? *name = h->name, &h->drive : NULL;
  }
  if (kind == SW_OF_OBSTACLE) {
    sw_scene_obstacle *o = sw_scene_find_obstacle(s, of, err);
    return o ? *name = o->name, &o->drive : NULL;
  }
  sw_tool *t = sw_scene_find_tool(s, of, err);
  return t ? *name = t->name, &t->drive : NULL;
}

static void ask_again(sw_scene *s, sw_kind kind) {
  if (kind == SW_OF_OBSTACLE && sw_scene_contact(s)) sw_contact_ask_again(sw_scene_contact(s));
}

/* 1 if the object holds wires, whose speed then jumps. Pads of a tool alone push by their place,
 * not by their speed. */
static int holds_any(const sw_scene *s, sw_kind kind, sw_handle of) {
  int any = kind != SW_OF_TOOL;
  SW_EACH(hold, h, s) {
    any |= h->alive && h->drive.tool == 1 + of.slot;
  }
  return any;
}

sw_status sw_scene_object_follow(sw_scene *s, sw_kind kind, sw_handle of, sw_motion *motion,
                                 int relative, sw_error *err) {
  const char *name;
  SW_FIND(sw_drive, d, drive_of(s, kind, of, &name, err));
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_drive_follow(s, d, name, motion, relative, err));
  if (kind == SW_OF_OBSTACLE) sw_scene_note_driven(s, of.slot);
  if (holds_any(s, kind, of)) sw_course_set_off(sw_scene_course(s));
  ask_again(s, kind);
  return SW_OK;
}

sw_status sw_scene_object_put(sw_scene *s, sw_kind kind, sw_handle of, sw_pose pose,
                              sw_error *err) {
  const char *name;
  SW_FIND(sw_drive, d, drive_of(s, kind, of, &name, err));
  SW_TRY(sw_drive_put(s, d, name, pose, err));
  ask_again(s, kind);
  return SW_OK;
}

sw_status sw_scene_object_pose(sw_scene *s, sw_kind kind, sw_handle of, sw_pose *out,
                               sw_error *err) {
  const char *name;
  sw_motion_state now;
  const sw_hold *released = kind == SW_OF_HOLD ? sw_scene_find_hold(s, of, NULL) : NULL;
  if (released && !released->alive) return *out = released->last_pose, SW_OK;
  SW_FIND(const sw_drive, d, drive_of(s, kind, of, &name, err));
  SW_TRY(sw_drive_eval(s, d, sw_scene_time(s), &now, err));
  *out = now.pose;
  return SW_OK;
}
