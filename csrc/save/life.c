/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Creates and frees scenes. */
#include "save/life.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "body/build.h"
#include "body/history.h"
#include "body/touching.h"
#include "edit/edit.h"
#include "grip/jaws.h"
#include "mutual/through.h"
#include "read/kept_frames.h"
#include "save/save.h"
#include "scene/forces.h"
#include "scene/gripper.h"
#include "scene/scene.h"
#include "scene/world.h"
#include "watch/observe.h"
#include "watch/zone.h"

static const sw_param scene_rows[] = {
    {"name", SW_PARAM_TEXT, "-", 0, 0, 0, 0, NULL, offsetof(sw_scene_args, name),
     "name used in messages and files"},
    {"gravity", SW_PARAM_VECTOR, "m/s2", NAN, -HUGE_VAL, HUGE_VAL, 0, NULL,
     offsetof(sw_scene_args, gravity), "acceleration of gravity (default {0, 0, -9.81})"},
};
const sw_params sw_scene_params = SW_PARAMS("scene", scene_rows);

static const double STANDARD_GRAVITY = 9.81; /* [m/s2] */

sw_status sw_scene_new(const sw_scene_args *args, sw_scene **out, sw_error *err) {
  sw_scene *s = sw_alloc(1, sizeof *s);
  if (!s) return sw_fail(err, SW_ENOMEM, "scene: out of memory");
  memcpy(s->name, args->name[0] ? args->name : "scene", args->name[0] ? sizeof s->name : 6);
  s->gravity = isnan(args->gravity.x) ? sw_v(0, 0, -STANDARD_GRAVITY) : args->gravity;
  s->course.window = SW_WINDOW;
  s->frames.stride = 1, s->frames.memory = SW_FRAME_MEMORY;
  *out = s;
  return SW_OK;
}

void sw_scene_free(sw_scene *s) {
  if (!s) return;
  SW_EACH(wire, w, s) sw_scene_clear_body(w);
  SW_EACH(force, f, s) sw_scene_clear_force(f);
  SW_EACH(hold, h, s) sw_hold_clear(h);
  SW_EACH(obstacle, o, s) sw_scene_clear_obstacle(o);
  SW_EACH(tool, t, s) sw_scene_clear_tool(t);
  for (size_t i = 0; i < s->zones.count; i++) sw_scene_clear_zone(&s->zones.list[i]);
  sw_scene_orphan_snapshots(s);
  sw_stepper_free(&s->course.stepper);
  sw_contact_free(s->contact);
  sw_log_free(&s->contact_steps);
  sw_mutual_free(s->pairs);
  sw_mutual_free(s->grains);
  sw_crowd_free(s->crowd);
  sw_through_free(s->through);
  sw_scene_drop_rules(s, 0);
  sw_free(s->rules.list);
  sw_system_free(&s->system);
  sw_scene_forget_contact(s);
  sw_scene_forget_histories(s);
  sw_frames_free(&s->frames);
  sw_events_clear(&s->events);
  sw_watches_clear(&s->watches);
  sw_ledger_free(&s->books);
  for (int unlike; s->review;) sw_scene_end_review(s, &unlike, NULL);
  SW_FREE_ALL(s->hold_slot, s->hold_loads, s->wires, s->gone, s->holds, s->obstacles, s->tools,
              s->forces, s->zones.list, s->joins, s);
}

sw_status sw_scene_set_gravity(sw_scene *s, sw_vec gravity, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  s->gravity = gravity;
  sw_course_jump(&s->course);
  return SW_OK;
}
