/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Series of the forces on obstacles. Rows are not written while nothing touches. The missing rows,
 * without a force, are added when something touches, or when the series is read. */
#include "body/obstacle_log.h"

#include "body/touching.h"
#include "scene/course.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "scene/values.h"

enum { TIME, SPAN, STEP }; /* a row of the scene's contact steps */

static size_t steps_of(const sw_scene *s) { return sw_scene_contact_steps(s)->count / STEP; }

void sw_obstacle_log_begin(const sw_scene *s, sw_scene_obstacle *o) { o->logged = steps_of(s); }

static sw_status add(sw_scene *s, sw_scene_obstacle *o, sw_vec force) {
  const double *step = sw_scene_contact_steps(s)->rows + STEP * o->logged;
  double row[SW_LOG_OBSTACLE_SIZE] = {step[TIME]};
  sw_store(row + 1, force);
  row[4] = step[SPAN];
  SW_TRY(sw_log_add(&o->log, row, SW_LOG_OBSTACLE_SIZE));
  o->logged++;
  return SW_OK;
}

static sw_status fill(sw_scene *s, sw_scene_obstacle *o, size_t end) {
  while (o->alive && o->logged < end) SW_TRY(add(s, o, sw_v(0, 0, 0)));
  return SW_OK;
}

sw_status sw_obstacle_log_fill(sw_scene *s, sw_scene_obstacle *o) {
  return fill(s, o, steps_of(s));
}

sw_status sw_obstacle_log_state(sw_scene *s) {
  sw_contact *contact = sw_scene_contact(s);
  const double step[STEP] = {[TIME] = sw_scene_time(s), [SPAN] = sw_scene_course(s)->span};
  size_t count;
  if (!contact) return SW_OK;
  if (!sw_contact_informed(contact)) sw_scene_inform_contact(s);
  SW_TRY(sw_log_add(sw_scene_contact_steps(s), step, STEP));
  const int *busy = sw_contact_busy(contact, &count);
  for (size_t i = 0; i < count; i++) {
    sw_scene_obstacle *o = sw_scene_obstacle_in(s, sw_contact_id(contact, (size_t)busy[i]));
    sw_vec force, moment;
    if (!o->alive) continue;
    SW_TRY(fill(s, o, steps_of(s) - 1));
    sw_obstacle_mean(o, sw_v(0, 0, 0), &force, &moment);
    SW_TRY(add(s, o, force));
  }
  return SW_OK;
}

void sw_obstacle_mean(const sw_scene_obstacle *o, sw_vec about, sw_vec *force, sw_vec *moment) {
  *force = *moment = sw_v(0, 0, 0);
  if (o->off) return;
  *force = o->past.mean.force;
  *moment = sw_sub(o->past.mean.moment, sw_cross(about, *force));
}
