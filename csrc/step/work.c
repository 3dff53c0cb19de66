/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Work of holds, feeds and moving obstacles over a step: force times way and moment times turn, by
 * the trapezoid between the step's ends. */
#include <math.h>

#include "base/alloc.h"
#include "body/hold.h"
#include "link/hold.h"
#include "scene/drive.h"
#include "scene/obstacle.h"
#include "scene/wire.h"
#include "scene/world.h"
#include "step/energy.h"

/* A work over a step and its bounds: by the forces at either end alone. */
typedef struct bounds {
  double mean, most; /* [J] */
} bounds;

static bounds work_between(double before, double after, int changed) {
  if (changed) before = after;
  return (bounds){0.5 * (before + after), fmax(before, after)};
}

static int same_pose(const sw_pose *a, const sw_pose *b) {
  return sw_dist(a->p, b->p) == 0 && a->q.w == b->q.w && a->q.x == b->q.x && a->q.y == b->q.y &&
         a->q.z == b->q.z;
}

/* Of force and moment about the pose's place, from the pose noted to the one now. */
static bounds work_of(const sw_worker *from, const sw_pose *to, sw_vec force, sw_vec moment,
                      int changed) {
  const sw_vec way = sw_sub(to->p, from->pose.p);
  const sw_vec turn = sw_quat_log(sw_quat_mul(to->q, sw_quat_conj(from->pose.q)));
  return work_between(sw_dot(from->force, way) + sw_dot(from->moment, turn),
                      sw_dot(force, way) + sw_dot(moment, turn), changed);
}

/* Energy of the wire that a feed has let in: its speed and its height. */
static double brought(const sw_scene *s, size_t k, double length) {
  const sw_beam *beam = &s->wires[s->holds[s->hold_slot[k]].wire].beam;
  const sw_hold_state *at = &s->system.hold_states[k];
  return beam->mass * length * (0.5 * sw_norm2(at->v) - sw_dot(s->gravity, at->pose.p));
}

static double work_of_feed(sw_scene *s, size_t k, double t1, int changed) {
  const sw_hold *h = &s->holds[s->hold_slot[k]];
  const sw_worker *from = &s->books.holds[k];
  const sw_hold_way now = sw_hold_way_of(s, h, t1, s->system.x);
  const double length = now.way - from->fed;
  const bounds b = work_between(from->drive * length, now.force * length, changed);
  s->books.step.feeds += b.mean + brought(s, k, length);
  return b.most + brought(s, k, length);
}

/* What friction on a rail takes. */
static void rub_on_rail(sw_scene *s, size_t k) {
  const sw_slider *x = &s->holds[s->hold_slot[k]].slider;
  const sw_worker *from = &s->books.holds[k];
  const double way = s->system.x[sw_rail_freedom(&s->system, x->rail)] - from->fed;
  const double now = s->system.rails[x->rail].rubs;
  if (x->friction > 0) s->books.step.friction += fmax(0.0, -0.5 * (from->drive + now) * way);
}

static double work_of_holds(sw_scene *s, double t1, int changed) {
  double most = 0;
  for (size_t k = 0; k < s->system.hold_count; k++) {
    const sw_pose *to = &s->system.hold_states[k].pose;
    if (sw_hold_passes(&s->holds[s->hold_slot[k]])) most += work_of_feed(s, k, t1, changed);
    if (s->holds[s->hold_slot[k]].cls->hold->rail) rub_on_rail(s, k);
    if (same_pose(&s->books.holds[k].pose, to)) continue;
    sw_vec force, moment;
    sw_system_reaction(&s->system, (int)k, to->p, &force, &moment);
    const bounds b = work_of(&s->books.holds[k], to, force, moment, changed);
    s->books.step.holds += b.mean;
    most += b.most;
  }
  return most;
}

/* A moment about the world's origin, about a place. */
static sw_vec about(sw_vec moment, sw_vec force, sw_vec place) {
  return sw_sub(moment, sw_cross(place, force));
}

static double work_of_obstacles(sw_scene *s, int changed) {
  double most = 0;
  if (!s->contact || !sw_contact_moves(s->contact)) return 0;
  size_t count;
  const int *movers = sw_contact_movers(s->contact, &count);
  for (size_t i = 0; i < count; i++) {
    const size_t k = (size_t)sw_contact_id(s->contact, (size_t)movers[i]);
    sw_worker from = s->books.obstacles[k];
    sw_vec force, moment;
    sw_pose to;
    if (!s->obstacles[k].alive || !sw_contact_poses(s->contact, (int)k, &from.pose, &to)) continue;
    if (same_pose(&from.pose, &to)) continue;
    sw_contact_force(s->contact, (int)k, to.p, &force, &moment);
    from.moment = about(from.moment, from.force, from.pose.p);
    const bounds b = work_of(&from, &to, sw_neg(force), sw_neg(moment), changed);
    s->books.step.obstacles += b.mean;
    most += b.most;
  }
  return most;
}

double sw_ledger_work(sw_scene *s, double t1, int changed) {
  return work_of_holds(s, t1, changed) + work_of_obstacles(s, changed);
}

static sw_status make_room(sw_scene *s) {
  sw_books *b = &s->books;
  if (b->hold_room < s->system.hold_count) {
    sw_free(b->holds);
    b->hold_room = 0;
    b->holds = sw_alloc(s->system.hold_count, sizeof *b->holds);
    if (!b->holds) return SW_ENOMEM;
    b->hold_room = s->system.hold_count;
  }
  if (b->obstacle_room >= s->obstacle_count) return SW_OK;
  sw_free(b->obstacles);
  b->obstacle_room = 0;
  b->obstacles = sw_alloc(s->obstacle_count, sizeof *b->obstacles);
  if (!b->obstacles) return SW_ENOMEM;
  b->obstacle_room = s->obstacle_count;
  return SW_OK;
}

/* What never moves does no work. */
static void note_obstacle(sw_scene *s, size_t k) {
  sw_worker *w = &s->books.obstacles[k];
  *w = (sw_worker){0};
  if (!s->obstacles[k].alive || !sw_drive_moves(&s->obstacles[k].drive)) return;
  sw_contact_force(s->contact, (int)k, sw_v(0, 0, 0), &w->force, &w->moment);
  w->force = sw_neg(w->force), w->moment = sw_neg(w->moment);
}

static void note_hold(sw_scene *s, size_t k, int logged) {
  const sw_hold *h = &s->holds[s->hold_slot[k]];
  sw_worker *w = &s->books.holds[k];
  *w = (sw_worker){s->system.hold_states[k].pose, h->force, h->moment, 0, 0};
  if (!logged) sw_system_reaction(&s->system, (int)k, w->pose.p, &w->force, &w->moment);
  if (h->cls->hold->rail) w->fed = h->slider.p, w->drive = h->slider.rubs;
  if (!sw_hold_passes(h)) return;
  const sw_hold_way now = sw_hold_way_of(s, h, s->time, logged ? NULL : s->system.x);
  w->fed = now.way;
  w->drive = logged ? h->feed.drive : now.force;
}

sw_status sw_ledger_note_workers(sw_scene *s, int logged) {
  SW_TRY(make_room(s));
  for (size_t k = 0; k < s->system.hold_count; k++) note_hold(s, k, logged);
  size_t count = 0;
  const int *movers = s->contact ? sw_contact_movers(s->contact, &count) : NULL;
  for (size_t i = 0; i < count; i++)
    note_obstacle(s, (size_t)sw_contact_id(s->contact, (size_t)movers[i]));
  return SW_OK;
}
