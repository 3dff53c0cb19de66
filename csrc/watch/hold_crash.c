/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports holds that are driven into obstacles. A held piece of wire follows its hold, so nothing
 * stops it; it is checked in every step and on the way from the step before. Also reports holds
 * that push or pull harder than any wire bears. */
#include <math.h>

#include "body/build.h"
#include "link/hold.h"
#include "scene/drive.h"
#include "scene/events.h"
#include "scene/lookup.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "watch/observe.h"
#include "watch/series.h"

/* Depth in an obstacle that a held place may gain after it was grasped, over the distance from the
 * place to the wire's surface [-]. Contact itself lets wires in by far less. */
static const double ALLOWED = 0.25;
static const double NOTICED = 1e-5; /* smallest gain that counts [m] */

/* Largest motion of a place between two checks, over the same distance; number of checks per step
 * [-]. */
static const double STRIDE = 0.5;
enum { MOST_LOOKS = 32 };

static double skin_of(const sw_scene *s, const sw_hold *h) {
  return sw_plan_skin(sw_scene_system(s)->bodies[h->wire].plan, h->particle ? h->particle[0] : 0);
}

/* Returns how far the wire's surface is from the places, as obstacles feel it (contact/sunk.c) [m].
 */
static double surface_of(const sw_scene *s, const sw_hold *h) {
  const sw_web *web = sw_scene_system(s)->bodies[h->wire].plan->web;
  const int ring =
      web && web->rings && h->particle && sw_web_is_ring(web, sw_web_ring_of(web, h->particle[0]));
  return skin_of(s, h) - (ring ? web->proud : 0.0);
}

static double reach_of(const sw_hold *h) {
  double far = 0;
  for (size_t i = 0; i < h->count; i++) far = fmax(far, sw_norm(sw_vec_at(h->local, i)));
  return far;
}

/* Returns the depth of the held places, and of the wire between them, in a shape; pose: of the hold
 * in the shape's axes [m]. */
static double depth_at(const sw_hold *h, const sw_shape *shape, sw_pose pose, double skin) {
  double depth = 0;
  sw_vec before = sw_v(0, 0, 0);
  for (size_t i = 0; i < h->count; i++) {
    const sw_vec at = sw_pose_point(pose, sw_vec_at(h->local, i));
    sw_closest near[SW_CLOSEST_MAX];
    if (sw_shape_point(shape, at, skin, near)) depth = fmax(depth, skin - near[0].gap);
    const int n = i && !h->particle ? sw_shape_segment(shape, before, at, skin, near) : 0;
    for (int k = 0; k < n; k++) depth = fmax(depth, skin - near[k].gap);
    before = at;
  }
  return depth;
}

/* 1 if a place is farther than this from the bounds along one of their axes. */
static int is_off(const sw_bounds *b, sw_vec p, double far) {
  return p.x < b->min.x - far || p.x > b->max.x + far || p.y < b->min.y - far ||
         p.y > b->max.y + far || p.z < b->min.z - far || p.z > b->max.z + far;
}

/* Returns the largest depth on the way from one pose to another, both in the shape's axes [m]. */
static double depth_on_way(const sw_hold *h, const sw_shape *shape, sw_pose from, sw_pose to,
                           double skin) {
  const sw_bounds b = sw_shape_bounds(shape);
  const sw_vec turn = sw_quat_log(sw_quat_mul(to.q, sw_quat_conj(from.q)));
  const double reach = reach_of(h), way = sw_dist(from.p, to.p) + sw_norm(turn) * reach;
  const double size = 0.5 * sw_dist(b.min, b.max);
  if (is_off(&b, to.p, reach + skin + way)) return 0;
  const int looks =
      isfinite(size) ? (int)fmin(MOST_LOOKS, 1.0 + way / fmax(STRIDE * skin, NOTICED)) : 1;
  double depth = 0;
  for (int k = 1; k <= looks; k++) {
    const double share = (double)k / looks;
    const sw_pose at = {sw_lerp(from.p, to.p, share),
                        sw_quat_unit(sw_quat_mul(sw_quat_exp(sw_scale(turn, share)), from.q))};
    depth = fmax(depth, depth_at(h, shape, k < looks ? at : to, skin));
  }
  return depth;
}

/* Finds the obstacle that the hold is deepest in. */
static sw_status find_crash(sw_scene *s, const sw_hold *h, sw_crash *out, sw_error *err) {
  const double skin = surface_of(s, h),
               before = h->watch.looking ? h->watch.looked : sw_scene_time(s);
  sw_motion_state to, from, there, was;
  *out = (sw_crash){.time = sw_scene_time(s)};
  SW_TRY(sw_drive_eval(s, &h->drive, sw_scene_time(s), &to, err));
  SW_TRY(sw_drive_eval(s, &h->drive, before, &from, err));
  for (size_t i = 0; i < sw_scene_obstacle_slots(s); i++) {
    const sw_scene_obstacle *o = sw_scene_obstacle_in(s, i);
    if (!o->alive || o->off || (o->drive.tool && o->drive.tool == h->drive.tool)) continue;
    SW_TRY(sw_drive_eval(s, &o->drive, sw_scene_time(s), &there, err));
    SW_TRY(sw_drive_eval(s, &o->drive, before, &was, err));
    const double depth = depth_on_way(h, o->shape, sw_pose_from(was.pose, from.pose),
                                      sw_pose_from(there.pose, to.pose), skin);
    if (depth > out->depth) out->depth = depth, out->obstacle = i;
  }
  return SW_OK;
}

/* Force over section that no wire bears: that of the strongest steel [Pa]. EA is a limit, too: it
 * would double the wire's length. */
static const double STRONGEST = 4e9;

static void watch_force(sw_scene *s, const sw_hold *h, double arc) {
  const sw_beam *b = &sw_scene_wire_in(s, h->wire)->beam;
  const double force = sw_norm(h->force);
  const double most = fmin(b->EA, STRONGEST * M_PI * b->radius * b->radius);
  if (!(most > 0) || force <= most) return;
  sw_scene_tell(
      s, "overload", h->name, arc, force,
      "%s '%s' loads wire '%s' with %.4g N; no wire of this radius and EA bears more than %.3g N",
      h->cls->name, h->name, sw_scene_wire_in(s, h->wire)->name, force, most);
}

sw_status sw_hold_look_out(sw_scene *s, sw_hold *h, sw_error *err) {
  sw_crash now;
  const double arc = 0.5 * (h->s1 + h->s2) - sw_scene_wire_in(s, h->wire)->mesh.s[0];
  watch_force(s, h, arc);
  if (!sw_scene_obstacle_slots(s) || h->cls->hold->rail)
    return SW_OK; /* a rail may lead anywhere */
  SW_TRY(find_crash(s, h, &now, err));
  if (!h->watch.looking) h->watch.given = now.depth;
  h->watch.looking = 1, h->watch.looked = sw_scene_time(s);
  const double most = h->watch.given + fmax(ALLOWED * skin_of(s, h), NOTICED);
  const int crashing = now.depth > most;
  if (crashing && !h->watch.crashing) h->watch.crash = now; /* a new one */
  h->watch.crashing = crashing;
  if (!crashing) { /* it may press from the start on */
    if (!sw_hold_watch_press(s, h, now.obstacle, now.depth) && !(now.depth > NOTICED))
      SW_TRY(sw_hold_watch_tilt(s, h, NOTICED, err));
    return SW_OK;
  }
  sw_scene_tell(s, "crash", h->name, arc, now.depth,
                "%s '%s' pushes wire '%s' %.3g mm deep into '%s'; holds follow their "
                "motion, whatever the force",
                h->cls->name, h->name, sw_scene_wire_in(s, h->wire)->name, 1e3 * now.depth,
                sw_scene_obstacle_in(s, now.obstacle)->name);
  return SW_OK;
}

sw_status sw_scene_watch_holds(sw_scene *s, sw_handle wire, sw_error *err) {
  SW_TRY(sw_scene_ready(s, err));
  if (!sw_scene_find_wire(s, wire, err)) return SW_EDEAD;
  SW_TRY(sw_scene_build(s, err));
  SW_EACH(hold, h, s)
    if (h->alive && h->wire == wire.slot && !h->watch.looking) SW_TRY(sw_hold_look_out(s, h, err));
  return SW_OK;
}

int sw_hold_crashed(const sw_scene *s, double since) {
  SW_EACH(hold, h, s)
    if (h->alive && h->watch.crashing && h->watch.crash.time > since) return 1;
  return 0;
}

sw_status sw_scene_hold_crash(const sw_scene *s, sw_handle hold, double *time, double *depth,
                              const char **obstacle, sw_error *err) {
  SW_FIND(const sw_hold, h, sw_scene_find_hold(s, hold, err));
  const sw_crash *c = &h->watch.crash;
  *time = c->depth > 0 ? c->time : (double)NAN;
  *depth = c->depth;
  *obstacle = c->depth > 0 ? sw_scene_obstacle_in(s, c->obstacle)->name : "";
  return SW_OK;
}
