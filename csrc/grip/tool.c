/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tools: their frames, pads and holds, and the state of the wires that they hold. */
#include "grip/tool.h"

#include <math.h>

#include "base/alloc.h"
#include "body/build.h"
#include "body/hold.h"
#include "body/obstacle_log.h"
#include "grip/frozen.h"
#include "grip/held.h"
#include "grip/jaws.h"
#include "link/hold.h"
#include "scene/course.h"
#include "scene/drive.h"
#include "scene/driven.h"
#include "scene/gripper.h"
#include "scene/lookup.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "scene/values.h"
#include "system/system.h"

void sw_scene_clear_tool(sw_tool *t) {
  sw_drive_free(&t->drive);
  sw_frozen_release(t->frozen);
  sw_log_free(&t->log);
  sw_free(t->room);
}

static const double SLIP = 1e-4; /* default slip that is an event [m] */
static const double LIMIT = 0.9; /* default margin at which a frozen grip is lost [-] */

sw_status sw_scene_add_tool(sw_scene *s, const sw_tool_args *args, sw_handle *out, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  sw_tool t = {.alive = 1,
               .drive = {.pose = {args->at, args->rotation}},
               .jaw = {.opening = args->opening, .since = sw_scene_time(s), .force = HUGE_VAL},
               .tolerance = SLIP,
               .limit = LIMIT,
               .now = {.centre = args->at, .q = args->rotation}};
  t.now.slip_time = t.now.slip_place = t.now.lost_time = NAN;
  sw_scene_give_name(t.name, args->name, "gripper", sw_scene_tool_slots(s));
  if (sw_scene_add(s, SW_OF_TOOL, &t, out) == SW_OK) return SW_OK;
  return sw_fail(err, SW_ENOMEM, "gripper: out of memory");
}

/* Turns a world pose into a pose in the tool's present frame. */
static sw_status local_pose(sw_scene *s, const sw_tool *t, sw_pose world, sw_pose *out,
                            sw_error *err) {
  sw_motion_state now;
  SW_TRY(sw_drive_eval(s, &t->drive, sw_scene_time(s), &now, err));
  const sw_quat back = sw_quat_conj(now.pose.q);
  *out = (sw_pose){sw_rotate(back, sw_sub(world.p, now.pose.p)), sw_quat_mul(back, world.q)};
  return SW_OK;
}

sw_status sw_scene_tool_pad(sw_scene *s, sw_handle tool, sw_handle obstacle, int finger,
                            sw_vec opens, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  sw_tool *t = sw_scene_find_tool(s, tool, err);
  sw_scene_obstacle *o = t ? sw_scene_find_obstacle(s, obstacle, err) : NULL;
  sw_motion_state now;
  sw_pose pose;
  if (!o) return SW_EDEAD;
  if (t->pads == SW_TOOL_PADS)
    return sw_fail(err, SW_EINVAL, "gripper '%s': its pads have more than %d parts", t->name,
                   SW_TOOL_PADS);
  SW_TRY(sw_drive_eval(s, &o->drive, sw_scene_time(s), &now, err));
  SW_TRY(local_pose(s, t, now.pose, &pose, err));
  sw_drive_free(&o->drive);
  pose.p = sw_madd(pose.p, opens, -sw_jaw_at(&t->jaw, sw_scene_time(s)));
  o->drive = (sw_drive){.pose = pose, .tool = 1 + tool.slot, .opens = opens};
  t->pad[t->pads++] = (sw_tool_pad){obstacle.slot, finger};
  if (finger >= t->fingers) t->fingers = finger + 1;
  return SW_OK;
}

sw_status sw_scene_tool_hold(sw_scene *s, sw_handle tool, sw_handle hold, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  const sw_tool *t = sw_scene_find_tool(s, tool, err);
  sw_hold *h = t ? sw_scene_living_hold(s, hold, err) : NULL;
  sw_motion_state now;
  sw_pose pose;
  if (!h) return SW_EDEAD;
  SW_TRY(sw_drive_eval(s, &h->drive, sw_scene_time(s), &now, err));
  SW_TRY(local_pose(s, t, now.pose, &pose, err));
  sw_drive_free(&h->drive);
  h->drive = (sw_drive){.pose = pose, .tool = 1 + tool.slot};
  sw_course_jump(sw_scene_course(s));
  return SW_OK;
}

sw_status sw_scene_tool_take(sw_scene *s, sw_handle tool, sw_handle hold, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  sw_tool *t = sw_scene_find_tool(s, tool, err);
  sw_hold *h = t ? sw_scene_living_hold(s, hold, err) : NULL;
  if (!h) return SW_EDEAD;
  if (h->drive.tool)
    return sw_fail(err, SW_EINVAL, "gripper '%s': '%s' already moves with a gripper", t->name,
                   h->name);
  sw_drive_free(&t->drive);
  t->drive = h->drive;
  h->drive = (sw_drive){.pose = {.q = {1, 0, 0, 0}}, .tool = 1 + tool.slot};
  return SW_OK;
}

sw_status sw_scene_tool_pads_on(sw_scene *s, sw_handle tool, int on, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  SW_FIND(const sw_tool, t, sw_scene_find_tool(s, tool, err));
  SW_TRY(sw_scene_unbuild(s));
  for (size_t k = 0; k < t->pads; k++) sw_scene_obstacle_in(s, t->pad[k].obstacle)->off = !on;
  return SW_OK;
}

sw_status sw_scene_tool_jaws(sw_scene *s, sw_handle tool, const sw_jaw_args *args, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  SW_FIND(sw_tool, t, sw_scene_find_tool(s, tool, err));
  sw_jaw *j = &t->jaw;
  if (j->force != args->force) SW_TRY(sw_scene_unbuild(s)); /* contact gets the new force */
  j->mode = args->mode;
  j->goal = args->opening, j->most = args->speed, j->force = args->force;
  j->speed = 0, j->since = sw_scene_time(s);
  j->status = args->mode == SW_JAW_STILL ? SW_JAW_RESTS : SW_JAW_MOVES;
  return SW_OK;
}

sw_status sw_scene_tool_watch(sw_scene *s, sw_handle tool, double tolerance, int stops,
                              sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  SW_FIND(sw_tool, t, sw_scene_find_tool(s, tool, err));
  t->tolerance = tolerance, t->stops = stops;
  t->now.slipped = t->now.turned = sw_v(0, 0, 0);
  t->now.slip = 0;
  t->now.slip_time = t->now.slip_place = NAN;
  return SW_OK;
}

/* --- held wires ------------------------------------------------------------------- */

double sw_tool_squeeze(sw_scene *s, const sw_tool *t, double time) {
  sw_contact *contact = sw_scene_contact(s);
  double sum = 0;
  sw_motion_state at;
  sw_error ignored; /* no error: the trial has evaluated this drive */
  if (!contact || !t->fingers || sw_drive_eval(s, &t->drive, time, &at, &ignored) != SW_OK)
    return 0;
  for (size_t k = 0; k < t->pads; k++) {
    const sw_drive *d = &sw_scene_obstacle_in(s, t->pad[k].obstacle)->drive;
    sw_vec force, moment;
    sw_contact_force(contact, (int)t->pad[k].obstacle, sw_v(0, 0, 0), &force, &moment);
    sum += t->pad[k].finger < 0
               ? 0.0
               : sw_dot(sw_unrotate(at.pose.q, force), sw_unit_or(d->opens, sw_v(0, 0, 0)));
  }
  return sum / t->fingers;
}

/* The force that pad k feels, and its moment about a point. Where the scene was changed and nothing
 * has been stepped since, there are no touches: then that at the end of the last step. */
static void on_pad(const sw_scene *s, const sw_tool *t, size_t k, sw_vec about, sw_vec *force,
                   sw_vec *moment) {
  const sw_contact *contact = sw_scene_contact(s);
  const size_t slot = t->pad[k].obstacle;
  const sw_scene_obstacle *o = sw_scene_obstacle_in(s, slot);
  sw_motion_state at;
  sw_error ignored; /* no error: the last step has evaluated this drive */
  *force = *moment = sw_v(0, 0, 0);
  if (contact && sw_contact_touches(contact) > 0) {
    sw_contact_force(contact, (int)slot, about, force, moment);
    return;
  }
  if (o->off || !sw_scene_was_pressed(s, slot) ||
      sw_drive_eval((sw_scene *)s, &o->drive, sw_scene_time(s), &at, &ignored) != SW_OK)
    return;
  *force = o->past.end.force;
  *moment = sw_add(o->past.end.moment, sw_cross(sw_sub(at.pivot, about), *force));
}

/* Adds the force of the pads (of one finger, or -1: of all) on wires, and its moment about a
 * point. */
static void pads_force(const sw_scene *s, const sw_tool *t, int finger, sw_vec about, sw_vec *force,
                       sw_vec *moment) {
  for (size_t k = 0; k < t->pads; k++) {
    sw_vec f, m;
    if (finger >= 0 && t->pad[k].finger != finger) continue;
    on_pad(s, t, k, about, &f, &m);
    *force = sw_sub(*force, f);
    *moment = sw_sub(*moment, m);
  }
}

/* Adds the mean of the same over the last step, impacts included. */
static void pads_mean(const sw_scene *s, const sw_tool *t, sw_vec about, sw_vec *force,
                      sw_vec *moment) {
  for (size_t k = 0; k < t->pads; k++) {
    sw_vec f, m;
    sw_obstacle_mean(sw_scene_obstacle_in(s, t->pad[k].obstacle), about, &f, &m);
    *force = sw_sub(*force, f);
    *moment = sw_sub(*moment, m);
  }
}

/* Adds the force of the tool's holds. mean: NULL; or the means of steps with a jerk are used, and
 * *mean becomes 1 if there was one. */
static sw_status holds_force(sw_scene *s, size_t slot, sw_vec about, sw_vec *force, sw_vec *moment,
                             int *mean, sw_error *err) {
  SW_EACH(hold, h, s) {
    sw_motion_state at;
    if (!h->alive || h->drive.tool != 1 + slot) continue;
    SW_TRY(sw_drive_eval(s, &h->drive, sw_scene_time(s), &at, err));
    sw_vec F = h->force, M = h->moment;
    if (mean) *mean |= sw_hold_jerked(s, h, &F, &M);
    *force = sw_add(*force, F);
    *moment = sw_add(*moment, sw_add(M, sw_cross(sw_sub(at.pose.p, about), F)));
  }
  return SW_OK;
}

sw_status sw_scene_tool_force(sw_scene *s, sw_handle tool, const sw_vec *about, sw_vec *force,
                              sw_vec *moment, sw_error *err) {
  sw_pose pose;
  SW_TRY(sw_scene_readable(s, err));
  SW_TRY(sw_scene_object_pose(s, SW_OF_TOOL, tool, &pose, err));
  const sw_vec point = about ? *about : pose.p;
  *force = *moment = sw_v(0, 0, 0);
  pads_force(s, sw_scene_tool_in(s, tool.slot), -1, point, force, moment);
  return holds_force(s, tool.slot, point, force, moment, NULL, err);
}

sw_status sw_scene_tool_finger(sw_scene *s, sw_handle tool, int finger, const sw_vec *about,
                               sw_vec *force, sw_vec *moment, sw_error *err) {
  sw_pose pose;
  SW_TRY(sw_scene_readable(s, err));
  SW_TRY(sw_scene_object_pose(s, SW_OF_TOOL, tool, &pose, err));
  const sw_tool *t = sw_scene_tool_in(s, tool.slot);
  if (finger < 0 || finger >= t->fingers)
    return sw_fail(err, SW_EINVAL, "gripper '%s': there is no finger %d; it has %d", t->name,
                   finger + 1, t->fingers);
  *force = *moment = sw_v(0, 0, 0);
  pads_force(s, t, finger, about ? *about : pose.p, force, moment);
  return SW_OK;
}

/* Returns the load on the frozen grip over the load that its pads could bear. */
static double hold_frozen(const sw_scene *s, sw_tool *t, sw_vec force, sw_vec moment) {
  sw_tool_state *now = &t->now;
  now->margin =
      sw_frozen_margin(t->frozen, sw_unrotate(now->q, force), sw_unrotate(now->q, moment));
  if (isnan(now->lost_time) && now->margin > t->limit) now->lost_time = sw_scene_time(s);
  return now->margin;
}

/* Sets the margin. NAN: there is no wire, the wire only leans on one finger, or the jaws move.
 * Friction is then always used up, under almost no force. */
static sw_status hold_now(sw_scene *s, sw_tool *t, double *margin, sw_error *err) {
  sw_held sum;
  sw_tool_state *now = &t->now;
  const int held = now->normal > 0;
  *margin = NAN;
  SW_TRY(sw_held_look(s, t, &sum, &now->slipped, &now->turned, &now->slip, err));
  const int between = (sum.press & (sum.press - 1)) != 0 || (sum.press && t->fingers == 1);
  now->opening = t->jaw.opening, now->status = t->jaw.status, now->squeeze = t->jaw.now;
  now->normal = sum.normal, now->most = sum.most, now->margin = sum.margin;
  now->sliding = sum.normal > 0 ? sum.sliding / sum.normal : 0;
  if (held && !(sum.normal > 0)) now->lost_time = sw_scene_time(s);
  if (!(sum.normal > 0)) return SW_OK;
  now->lost_time = NAN;
  now->place = sum.place;
  if (isnan(now->slip_time) && now->slip > t->tolerance)
    now->slip_time = sw_scene_time(s), now->slip_place = now->place;
  if (between && now->status != SW_JAW_MOVES) *margin = now->margin;
  return SW_OK;
}

static int holds_any(const sw_scene *s, size_t slot) {
  SW_EACH(hold, h, s)
    if (h->alive && h->drive.tool == 1 + slot) return 1;
  return 0;
}

sw_status sw_tool_observe(sw_scene *s, sw_error *err) {
  for (size_t k = 0; k < sw_scene_tool_slots(s); k++) {
    sw_tool *t = sw_scene_tool_in(s, k);
    sw_motion_state at;
    double row[SW_LOG_TOOL_SIZE];
    if (!t->alive) continue;
    SW_TRY(sw_drive_eval(s, &t->drive, sw_scene_time(s), &at, err));
    t->now.centre = at.pose.p;
    t->now.q = at.pose.q;
    sw_vec force = sw_v(0, 0, 0), moment = force;
    pads_mean(s, t, at.pose.p, &force, &moment);
    int mean = 0;
    SW_TRY(holds_force(s, k, at.pose.p, &force, &moment, &mean, err));
    double margin;
    if (t->frozen)
      margin = hold_frozen(s, t, force, moment);
    else
      SW_TRY(hold_now(s, t, &margin, err));
    t->way = t->swing = sw_v(0, 0, 0), t->searched = 0;
    SW_TRY(sw_tool_look_out(s, k, err));
    row[SW_LOG_TIME] = sw_scene_time(s);
    sw_store(row + SW_LOG_FORCE, force);
    sw_store(row + SW_LOG_MOMENT, moment);
    sw_store(row + SW_LOG_POINT, at.pose.p);
    row[SW_LOG_OPENING] = t->now.opening, row[SW_LOG_SQUEEZE] = t->now.squeeze;
    row[SW_LOG_MARGIN] = margin, row[SW_LOG_SLIP] = t->now.slip;
    row[SW_LOG_SPAN] = holds_any(s, k) ? sw_hold_span(s, mean) : sw_scene_course(s)->span;
    if (sw_log_add(&t->log, row, SW_LOG_TOOL_SIZE) != SW_OK)
      return sw_fail(err, SW_ENOMEM, "out of memory for the series of '%s'", t->name);
  }
  return SW_OK;
}

sw_status sw_scene_tool_touches(sw_scene *s, sw_handle tool, size_t *count, sw_error *err) {
  sw_contact *contact = sw_scene_contact(s);
  SW_TRY(sw_scene_readable(s, err));
  if (!sw_scene_find_tool(s, tool, err)) return SW_EDEAD;
  *count = contact ? sw_contact_touches(contact) : 0;
  return SW_OK;
}

int sw_scene_tool_touch(const sw_scene *s, sw_handle tool, size_t number, sw_tool_touch *out) {
  sw_system *system = sw_scene_system(s);
  const sw_tool *t = sw_scene_tool_in(s, tool.slot);
  sw_contact_push push;
  if (!sw_contact_push_at(sw_scene_contact(s), system, number, &push)) return 0;
  for (size_t k = 0; k < t->pads; k++) {
    if (t->pad[k].obstacle != (size_t)push.obstacle) continue;
    const sw_vec arm = sw_sub(push.point, t->now.centre);
    const size_t wire = sw_system_body_of(system, push.node);
    *out = (sw_tool_touch){.finger = t->pad[k].finger,
                           .at = sw_unrotate(t->now.q, arm),
                           .acts = sw_unrotate(t->now.q, sw_sub(push.acts, t->now.centre)),
                           .force = sw_unrotate(t->now.q, push.force),
                           .normal = push.normal_force,
                           .s = push.place,
                           .slid = push.slid,
                           .wire = sw_scene_wire_in(s, wire)->number,
                           .name = sw_scene_wire_in(s, wire)->name};
    return 1;
  }
  return 0;
}

int sw_tool_slipped(const sw_scene *s, double since) {
  SW_EACH(tool, t, s)
    if (t->alive && ((t->stops && t->now.slip_time > since) ||
                     ((t->stops || t->frozen) && t->now.lost_time > since) ||
                     (t->crashing && t->crash.time > since)))
      return 1;
  return 0;
}

sw_status sw_scene_tool_limit(sw_scene *s, sw_handle tool, double margin, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  SW_FIND(sw_tool, t, sw_scene_find_tool(s, tool, err));
  t->limit = margin;
  t->now.lost_time = NAN;
  return SW_OK;
}

sw_status sw_scene_tool_state(sw_scene *s, sw_handle tool, sw_tool_state *out, sw_error *err) {
  SW_TRY(sw_scene_readable(s, err));
  SW_FIND(const sw_tool, t, sw_scene_find_tool(s, tool, err));
  *out = t->now;
  out->frozen = t->frozen != NULL;
  const int any = t->crash.depth > 0;
  out->crash_time = any ? t->crash.time : (double)NAN;
  out->crash_depth = t->crash.depth;
  out->crash_part = any ? sw_scene_obstacle_in(s, t->crash.part)->name : "";
  out->crash_obstacle = any ? sw_scene_obstacle_in(s, t->crash.obstacle)->name : "";
  out->opening = sw_jaw_at(&t->jaw, sw_scene_time(s));
  out->status = t->jaw.status;
  return SW_OK;
}
