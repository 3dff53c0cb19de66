/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Work of holds, feeds and moving obstacles over a step: force times path, and moment times angle.
 * For holds and obstacles it is computed from their impulse on the wire in the step, if the method
 * gives it, because stages may be off at the step's ends. Otherwise by the trapezoid rule from the
 * ends. */
#include <math.h>

#include "base/alloc.h"
#include "body/hold.h"
#include "link/hold.h"
#include "scene/course.h"
#include "scene/drive.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "step/energy.h"
#include "system/system.h"

/* Work over a step, and the largest work with the force at either end alone. */
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

/* Returns the work of force and moment from the noted pose to the present one. The moment is about
 * the pose's place. */
static bounds work_of(const sw_worker *from, const sw_pose *to, sw_vec force, sw_vec moment,
                      int changed) {
  const sw_vec way = sw_sub(to->p, from->pose.p);
  const sw_vec turn = sw_quat_log(sw_quat_mul(to->q, sw_quat_conj(from->pose.q)));
  return work_between(sw_dot(from->force, way) + sw_dot(from->moment, turn),
                      sw_dot(force, way) + sw_dot(moment, turn), changed);
}

/* Replaces the mean by that of the impulses in a step of size h. In a calm step it is also the
 * smallest bound: axial forces swing from step to step, and those at the ends are not those within
 * the step. At a strike the bound of the ends stays: the impulse is far above their forces, but
 * does no work along the path. */
static bounds by_impulse(bounds b, const sw_worker *from, const sw_pose *to, sw_vec force,
                         sw_vec moment, double h, int calm) {
  b.mean = work_of(from, to, sw_scale(force, 1.0 / h), sw_scale(moment, 1.0 / h), 1).mean;
  if (calm) b.most = fmax(b.most, b.mean);
  return b;
}

/* Returns the energy per length of wire in hold k, which lies there straight, though it may be
 * curved and twisted without load [N]. */
static double strained(sw_scene *s, size_t k) {
  const sw_body *b = &sw_scene_system(s)->bodies[sw_scene_held_by(s, k)->wire];
  const sw_plan *p = b->plan;
  double sum = 0;
  for (size_t c = 0; p->rest_bend && c < p->clamp_count; c++) {
    if (p->clamps[c].hold != (int)k) continue;
    const double *bend = p->rest_bend + 2 * (p->nodes + c), half = 0.5 * p->rest[p->clamps[c].edge];
    const double twist = p->rest_twist[p->nodes + c] / half;
    for (int i = 0; i < 2; i++) sum += 0.5 * p->beam.EI_axis[i] * bend[i] * bend[i] / (half * half);
    sum += 0.5 * p->beam.GJ * twist * twist;
  }
  return sum;
}

/* Returns the energy of wire that a feed has let in from a spool: kinetic energy and height. Wire
 * fed at mid-wire comes from the other side and brings none. */
static double brought(sw_scene *s, size_t k, double length) {
  const sw_hold *h = sw_scene_held_by(s, k);
  const sw_scene_wire *wire = sw_scene_wire_in(s, h->wire);
  if (h->node > 0 && h->node + 1 < wire->mesh.n) return 0;
  const sw_hold_state *at = &sw_scene_system(s)->hold_states[k];
  const double mass = wire->beam.mass * length;
  const double height = -mass * sw_dot(sw_scene_gravity(s), at->pose.p);
  sw_scene_books(s)->step.let_in += height;
  return 0.5 * mass * sw_norm2(at->v) + height + strained(s, k) * length;
}

/* Returns the drive's mean force in a step of size h, from the hold's impulse. The share of the
 * guide walls hardly changes in a step; in a turning guide the direction is that at mid-step. */
static double mean_drive(sw_scene *s, size_t k, const sw_hold_way *now, double h) {
  sw_system *system = sw_scene_system(s);
  const sw_hold_sums *sums = &sw_scene_held_by(s, k)->sums;
  const sw_pose *to = &system->hold_states[k].pose;
  const sw_quat back = sw_quat_mul(sw_scene_books(s)->holds[k].pose.q, sw_quat_conj(to->q));
  const sw_vec before = sw_rotate(back, now->direction);
  sw_vec force, moment;
  sw_system_reaction(system, (int)k, to->p, &force, &moment);
  const double walls = sw_dot(force, now->direction) - now->stage;
  const sw_vec middle = sw_unit_or(sw_add(before, now->direction), now->direction);
  const double axial = sw_dot(sums->force[sums->last], middle) / h;
  const sw_body *b = &system->bodies[sw_scene_held_by(s, k)->wire];
  return axial - 0.5 * axial * axial / (axial > 0 ? b->EA_push : b->EA) - walls;
}

/* 1 if a drive slips at its limit in the step: the wire's speed and the impulse jump then. A drive
 * that pushes with a force moves with that force. */
static int slips_off(const sw_hold *h, const sw_hold_way *now, const sw_worker *from) {
  return now->slipped != from->slipped && !isfinite(h->feed.slip.push);
}

static double work_of_feed(sw_scene *s, size_t k, double t1, int changed) {
  const sw_hold *hold = sw_scene_held_by(s, k);
  const double h = t1 - sw_scene_time(s);
  const sw_worker *from = &sw_scene_books(s)->holds[k];
  const sw_hold_way now = sw_hold_way_of(s, hold, t1, sw_scene_system(s)->x);
  const double length = now.way - from->fed, more = brought(s, k, length);
  bounds b = work_between(from->drive * length, now.stage * length, changed);
  if (hold->sums.known && h > 0 && !slips_off(hold, &now, from)) {
    b.mean = mean_drive(s, k, &now, h) * length;
  }
  sw_step_energy *step = &sw_scene_books(s)->step;
  step->slipping += fabs(0.5 * (from->drive + now.stage) * (now.slipped - from->slipped));
  step->feeds += b.mean + more;
  return b.most + more;
}

double sw_ledger_effort(const sw_step_energy *step) {
  return fabs(step->holds) + fabs(step->obstacles) + fabs(step->feeds - step->let_in) +
         fabs(step->forces) + step->slipping;
}

/* Adds the friction loss on a rail. */
static void rub_on_rail(sw_scene *s, size_t k) {
  sw_books *b = sw_scene_books(s);
  sw_system *system = sw_scene_system(s);
  const size_t number = sw_scene_held_by(s, k)->rail;
  const sw_rail *rail = &system->rails[number];
  const sw_worker *from = &b->holds[k];
  const double way = system->x[sw_rail_freedom(system, number)] - from->fed;
  if (rail->friction > 0) b->step.friction += fmax(0.0, -0.5 * (from->drive + rail->rubs) * way);
}

static sw_vec held_place(sw_scene *s, size_t k) {
  const sw_hold *h = sw_scene_held_by(s, k);
  const sw_system *system = sw_scene_system(s);
  return sw_vec_at(system->x, system->bodies[h->wire].first_node + h->node);
}

/* Impacts that take a smaller share of the kinetic energy are not a blow, for example of an edge
 * that slides onto a peg [-]. */
static const double NO_BLOW = 1e-3;

/* 1 if nothing strikes in the step. changed: the force at its start is not known, which counts as
 * calm. */
static int calm(sw_scene *s, int changed) {
  const sw_books *b = sw_scene_books(s);
  return changed ||
         (!sw_scene_course(s)->stepper.plastic && fabs(b->step.impact) <= NO_BLOW * b->now.kinetic);
}

static bounds work_of_hold(sw_scene *s, size_t k, double h, int changed) {
  sw_system *system = sw_scene_system(s);
  const sw_pose *to = &system->hold_states[k].pose;
  const sw_worker *from = &sw_scene_books(s)->holds[k];
  const sw_hold_sums *sums = &sw_scene_held_by(s, k)->sums;
  sw_vec force, moment;
  sw_system_reaction(system, (int)k, to->p, &force, &moment);
  /* the load of a stage within the step is already its mean */
  bounds b = work_of(from, to, force, moment, changed || system->loads_kept);
  if (!sums->known || !(h > 0)) return b;
  sw_vec gained = sums->moment[sums->last];
  if (sw_scene_held_by(s, k)->cls->hold->rail) /* a rail is booked about the wire's place */
    gained = sw_add(gained, sw_cross(sw_sub(held_place(s, k), to->p), sums->force[sums->last]));
  return by_impulse(b, from, to, sums->force[sums->last], gained, h, calm(s, changed));
}

static double work_of_holds(sw_scene *s, double t1, int changed) {
  sw_system *system = sw_scene_system(s);
  double most = 0;
  for (size_t k = 0; k < system->hold_count; k++) {
    const sw_pose *to = &system->hold_states[k].pose;
    if (sw_hold_passes(sw_scene_held_by(s, k))) most += work_of_feed(s, k, t1, changed);
    if (sw_scene_held_by(s, k)->cls->hold->rail) rub_on_rail(s, k);
    if (same_pose(&sw_scene_books(s)->holds[k].pose, to)) continue;
    const bounds b = work_of_hold(s, k, t1 - sw_scene_time(s), changed);
    sw_scene_books(s)->step.holds += b.mean;
    most += b.most;
  }
  return most;
}

/* Moves a moment from the world's origin to a place. */
static sw_vec about(sw_vec moment, sw_vec force, sw_vec place) {
  return sw_sub(moment, sw_cross(place, force));
}

static bounds work_of_obstacle(sw_scene *s, size_t k, const sw_worker *from, const sw_pose *to,
                               double h, int changed) {
  const sw_contact *contact = sw_scene_contact(s);
  sw_vec force, moment;
  sw_contact_force(contact, (int)k, to->p, &force, &moment);
  const bounds b = work_of(from, to, sw_neg(force), sw_neg(moment), changed);
  if (!(h > 0)) return b;
  sw_contact_gained(contact, (int)k, &force, &moment);
  return by_impulse(b, from, to, sw_neg(force), sw_neg(moment), h, calm(s, changed));
}

static double work_of_obstacles(sw_scene *s, double h, int changed) {
  sw_contact *contact = sw_scene_contact(s);
  double most = 0;
  if (!contact || !(sw_contact_shift(contact, 1.0) > 0)) return 0;
  size_t count;
  const int *movers = sw_contact_movers(contact, &count);
  for (size_t i = 0; i < count; i++) {
    const size_t k = (size_t)sw_contact_id(contact, (size_t)movers[i]);
    sw_worker from = sw_scene_books(s)->obstacles[k];
    sw_pose to;
    if (!sw_scene_obstacle_in(s, k)->alive || !sw_contact_poses(contact, (int)k, &from.pose, &to))
      continue;
    if (same_pose(&from.pose, &to)) continue;
    from.moment = about(from.moment, from.force, from.pose.p);
    const bounds b = work_of_obstacle(s, k, &from, &to, h, changed);
    sw_scene_books(s)->step.obstacles += b.mean;
    most += b.most;
  }
  return most;
}

double sw_ledger_work(sw_scene *s, double t1, int changed) {
  return work_of_holds(s, t1, changed) + work_of_obstacles(s, t1 - sw_scene_time(s), changed);
}

static sw_status make_room(sw_scene *s) {
  sw_system *system = sw_scene_system(s);
  sw_books *b = sw_scene_books(s);
  if (b->hold_room < system->hold_count) {
    sw_free(b->holds);
    b->hold_room = 0;
    b->holds = sw_alloc(system->hold_count, sizeof *b->holds);
    if (!b->holds) return SW_ENOMEM;
    b->hold_room = system->hold_count;
  }
  if (b->obstacle_room >= sw_scene_obstacle_slots(s)) return SW_OK;
  sw_free(b->obstacles);
  b->obstacle_room = 0;
  b->obstacles = sw_alloc(sw_scene_obstacle_slots(s), sizeof *b->obstacles);
  if (!b->obstacles) return SW_ENOMEM;
  b->obstacle_room = sw_scene_obstacle_slots(s);
  return SW_OK;
}

/* Notes an obstacle's force and moment; an obstacle that never moves does no work. */
static void note_obstacle(sw_scene *s, size_t k) {
  sw_worker *w = &sw_scene_books(s)->obstacles[k];
  *w = (sw_worker){0};
  if (!sw_scene_obstacle_in(s, k)->alive || !sw_drive_moves(&sw_scene_obstacle_in(s, k)->drive))
    return;
  sw_contact_force(sw_scene_contact(s), (int)k, sw_v(0, 0, 0), &w->force, &w->moment);
  w->force = sw_neg(w->force), w->moment = sw_neg(w->moment);
}

/* Returns a rail's moment about the pose; it is stored about the place on the rail. */
static sw_vec moment_of_rail(const sw_rail *rail, const sw_pose *pose, sw_vec force) {
  sw_rail_point on;
  rail->at(rail->curve, rail->p, &on);
  return sw_cross(sw_rotate(pose->q, on.x), force);
}

static void note_hold(sw_scene *s, size_t k, int logged) {
  sw_system *system = sw_scene_system(s);
  const sw_hold *h = sw_scene_held_by(s, k);
  sw_worker *w = &sw_scene_books(s)->holds[k];
  *w = (sw_worker){system->hold_states[k].pose, h->end_force, h->end_moment, 0, 0, 0};
  if (!logged) sw_system_reaction(system, (int)k, w->pose.p, &w->force, &w->moment);
  if (h->cls->hold->rail) {
    sw_rail rail;
    h->cls->hold->rail(h, &rail);
    w->fed = rail.p, w->drive = rail.rubs;
    if (logged) w->moment = moment_of_rail(&rail, &w->pose, w->force);
  }
  if (!sw_hold_passes(h)) return;
  const sw_hold_way now = sw_hold_way_of(s, h, sw_scene_time(s), logged ? NULL : system->x);
  w->fed = now.way, w->drive = now.stage, w->slipped = now.slipped;
}

sw_status sw_ledger_note_workers(sw_scene *s, int logged) {
  sw_contact *contact = sw_scene_contact(s);
  SW_TRY(make_room(s));
  for (size_t k = 0; k < sw_scene_system(s)->hold_count; k++) note_hold(s, k, logged);
  size_t count = 0;
  const int *movers = contact ? sw_contact_movers(contact, &count) : NULL;
  for (size_t i = 0; i < count; i++)
    note_obstacle(s, (size_t)sw_contact_id(contact, (size_t)movers[i]));
  return SW_OK;
}
