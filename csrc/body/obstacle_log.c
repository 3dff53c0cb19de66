/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Series of the forces on obstacles. Where nothing touches there is nothing to write: rows without
 * a force are added when something does, or when the series is read. */
#include "body/obstacle_log.h"

#include "body/touching.h"
#include "scene/obstacle.h"
#include "scene/values.h"
#include "scene/world.h"

enum { TIME, SPAN, STEP }; /* a row of the scene's steps with contact */

static size_t steps_of(const sw_scene *s) { return s->contact_steps.count / STEP; }

void sw_obstacle_log_begin(const sw_scene *s, sw_scene_obstacle *o) { o->logged = steps_of(s); }

static sw_status add(sw_scene *s, sw_scene_obstacle *o, sw_vec force) {
  const double *step = s->contact_steps.rows + STEP * o->logged;
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
  const double step[STEP] = {[TIME] = s->time, [SPAN] = s->course.span};
  size_t count;
  if (!s->contact) return SW_OK;
  if (!sw_contact_informed(s->contact)) sw_scene_inform_contact(s);
  SW_TRY(sw_log_add(&s->contact_steps, step, STEP));
  const int *busy = sw_contact_busy(s->contact, &count);
  for (size_t i = 0; i < count; i++) {
    sw_scene_obstacle *o = &s->obstacles[sw_contact_id(s->contact, (size_t)busy[i])];
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
