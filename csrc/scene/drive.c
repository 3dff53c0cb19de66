/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Drives: they move a hold, an obstacle or a gripper. */
#include "scene/drive.h"

#include <math.h>
#include <string.h>

#include "link/hold.h"
#include "scene/course.h"
#include "scene/gripper.h"
#include "scene/parts.h"
#include "system/system.h"

void sw_drive_free(sw_drive *d) {
  sw_motion_release(d->motion);
  d->motion = NULL;
}

/* Evaluates a drive in a tool's frame, which itself is at rest or follows a motion. */
static sw_status carried(sw_scene *s, const sw_drive *d, double t, sw_motion_state *out,
                         sw_error *err) {
  const sw_tool *tool = sw_scene_tool_in(s, d->tool - 1);
  sw_motion_state f;
  SW_TRY(sw_drive_eval(s, &tool->drive, t, &f, err));
  const sw_quat q = f.pose.q;
  const sw_vec arm = sw_rotate(q, sw_madd(d->pose.p, d->opens, sw_jaw_at(&tool->jaw, t)));
  const sw_vec opening = sw_rotate(q, sw_scale(d->opens, tool->jaw.speed));
  const sw_vec turning = sw_cross(f.omega, arm);
  out->pose = (sw_pose){sw_add(f.pose.p, arm), sw_quat_mul(q, d->pose.q)};
  out->v = sw_add(f.v, sw_add(turning, opening));
  out->a = sw_add(sw_add(f.a, sw_cross(f.alpha, arm)),
                  sw_cross(f.omega, sw_madd(turning, opening, 2.0)));
  out->omega = f.omega;
  out->alpha = f.alpha;
  out->pivot = f.pose.p;
  return SW_OK;
}

sw_status sw_drive_eval(sw_scene *s, const sw_drive *d, double t, sw_motion_state *out,
                        sw_error *err) {
  if (d->tool) return carried(s, d, t, out, err);
  if (!d->motion) {
    memset(out, 0, sizeof *out);
    out->pose = d->pose;
    out->pivot = d->pose.p;
    return SW_OK;
  }
  sw_scene_enter(s, 1); /* a user's function may call anything: changes are refused meanwhile */
  const sw_status status = sw_motion_eval(d->motion, t - d->start, out, err);
  sw_scene_enter(s, -1);
  out->pivot = out->pose.p;
  return status;
}

/* --- inner stages ------------------------------------------------------------------ */

/* Motion as one turn and shift of all space: what turns about a common centre goes on together. Of
 * the point at the stage's start. */
typedef struct screw {
  sw_vec way, turn; /* [m], [rad]; or per time */
} screw;

/* Returns a + once turn x a + twice turn x (turn x a). */
static sw_vec bent(sw_vec a, sw_vec turn, double once, double twice) {
  const sw_vec across = sw_cross(turn, a);
  return sw_add(sw_madd(a, across, once), sw_scale(sw_cross(turn, across), twice));
}

/* Below this angle series are exact to 1e-14 [rad]. */
static const double SMALL_TURN = 0.05;

/* Where a pose is after a screw. */
static sw_pose go(sw_pose from, screw by) {
  const double t = sw_norm(by.turn), u = t * t;
  const double once = t < SMALL_TURN ? (1 - u / 12 * (1 - u / 30)) / 2 : (1 - cos(t)) / u;
  const double twice =
      t < SMALL_TURN ? (1 - u / 20 * (1 - u / 42 * (1 - u / 72))) / 6 : (1 - sin(t) / t) / u;
  return (sw_pose){sw_add(from.p, bent(by.way, by.turn, once, twice)),
                   sw_quat_unit(sw_quat_mul(sw_quat_exp(by.turn), from.q))};
}

/* Returns the screw between two poses, to fourth order of the turn. */
static screw between(sw_pose from, sw_pose to) {
  screw s = {.turn = sw_quat_log(sw_quat_mul(to.q, sw_quat_conj(from.q)))};
  s.way = bent(sw_sub(to.p, from.p), s.turn, -0.5, (1 + sw_norm2(s.turn) / 60) / 12);
  return s;
}

static screw mix(double a, screw x, double b, screw y) {
  return (screw){sw_madd(sw_scale(x.way, a), y.way, b), sw_madd(sw_scale(x.turn, a), y.turn, b)};
}

/* A turn counts like the way that it makes over this arm [m]. */
static const double ARM = 0.1;

static double size(screw s) { return sw_norm(s.way) + ARM * sw_norm(s.turn); }

static void screw_ahead(const sw_motion_state *from, sw_motion_state *at, double inner) {
  const sw_vec arm = sw_sub(at->pose.p, from->pose.p);
  const screw v0 = {from->v, from->omega};
  const screw v1 = {sw_sub(at->v, sw_cross(at->omega, arm)), at->omega};
  const screw next = mix(inner, v1, 0, v1), made = between(from->pose, at->pose);
  const double off = size(mix(1, made, -0.5 * inner, mix(1, v0, 1, v1)));
  if (sw_inner_goes_ahead(off, size(mix(1, next, -1, made)))) at->pose = go(from->pose, next);
}

/* A function's velocities are differences over times on both sides, and so over a jump at the
 * stage's start. These are derivatives at both ends of the cubic through four evenly spaced
 * values, less the first, times h. */
static void find_slopes(const sw_vec rest[3], double h, sw_vec *first, sw_vec *last) {
  const sw_vec a = rest[0], b = rest[1], c = rest[2];
  *first = sw_scale(sw_add(sw_madd(sw_scale(a, 18), b, -9), sw_scale(c, 2)), 0.5 / h);
  *last = sw_scale(sw_add(sw_madd(sw_scale(c, 11), b, -18), sw_scale(a, 9)), 0.5 / h);
}

/* Sets the velocities at both ends of a stage to those by its poses alone. */
static sw_status find_rates(sw_scene *s, const sw_drive *d, double t, double h,
                            sw_motion_state *from, sw_motion_state *at, sw_error *err) {
  sw_vec way[3], turn[3];
  for (int k = 0; k < 3; k++) {
    sw_motion_state m = *at;
    if (k < 2) SW_TRY(sw_drive_eval(s, d, t - h * (2 - k) / 3, &m, err));
    way[k] = sw_sub(m.pose.p, from->pose.p);
    turn[k] = sw_quat_log(sw_quat_mul(m.pose.q, sw_quat_conj(from->pose.q)));
  }
  find_slopes(way, h, &from->v, &at->v);
  if (sw_norm2(from->omega) + sw_norm2(at->omega) > 0)
    find_slopes(turn, h, &from->omega, &at->omega);
  return SW_OK;
}

static int is_function(const sw_scene *s, const sw_drive *d) {
  const sw_motion *m = d->tool ? sw_scene_tool_in(s, d->tool - 1)->drive.motion : d->motion;
  return m && sw_motion_is_function(m);
}

/* Moves the pose at the stage's end to the stage's length times the velocity there. Around a stop
 * it stays: a shift of nanometres would reverse friction. stays: 1 if holds keep to their paths,
 * and so does what turns: a drum would be ahead of a clamp on it, and stretch a cable in between.
 */
static void go_ahead(const sw_motion_state *from, sw_motion_state *at, double inner, int stays) {
  if (sw_norm2(from->omega) + sw_norm2(at->omega) > 0) {
    if (!stays) screw_ahead(from, at, inner);
    return;
  }
  const sw_vec next = sw_madd(from->pose.p, at->v, inner);
  const sw_vec way = sw_sub(at->pose.p, from->pose.p);
  const double off = sw_norm(sw_madd(way, sw_add(from->v, at->v), -0.5 * inner));
  if (sw_inner_goes_ahead(off, sw_dist(next, at->pose.p))) at->pose.p = next;
}

sw_status sw_drive_place(sw_scene *s, const sw_drive *d, double t, sw_motion_state *out,
                         sw_error *err) {
  const sw_system *system = sw_scene_system(s);
  const double inner = system->inner;
  sw_motion_state from, at;
  SW_TRY(sw_drive_eval(s, d, t, out, err));
  if (!(inner > 0) || !(d->motion || d->tool)) return SW_OK;
  SW_TRY(sw_drive_eval(s, d, t - inner, &from, err));
  at = *out;
  if (is_function(s, d)) SW_TRY(find_rates(s, d, t, inner, &from, &at, err));
  go_ahead(&from, &at, inner, system->stays);
  out->pose = at.pose;
  return SW_OK;
}

/* --- orders ------------------------------------------------------------------------ */

static sw_status check_free(sw_scene *s, const sw_drive *d, const char *object, sw_error *err) {
  if (!d->tool) return SW_OK;
  return sw_fail(err, SW_EINVAL, "'%s' moves with gripper '%s'; move the gripper", object,
                 sw_scene_tool_in(s, d->tool - 1)->name);
}

static const double LARGEST_JUMP = 1e-6; /* of position, taken as rounding [m] */
static const double LARGEST_TURN = 1e-6; /* of orientation, taken as rounding [rad] */

sw_status sw_drive_follow(sw_scene *s, sw_drive *d, const char *object, sw_motion *motion,
                          int relative, sw_error *err) {
  const double now = sw_scene_time(s);
  sw_motion_state here, first;
  SW_TRY(check_free(s, d, object, err));
  SW_TRY(sw_drive_eval(s, d, now, &here, err));
  sw_drive next = {.pose = here.pose, .start = now};
  if (motion && (relative || sw_motion_is_relative(motion))) {
    if (sw_motion_relative(motion, here.pose, &next.motion) != SW_OK)
      return sw_fail(err, SW_ENOMEM, "%s: out of memory", object);
  } else {
    next.motion = sw_motion_retain(motion);
  }
  const sw_status status = sw_drive_eval(s, &next, now, &first, err);
  const double jump = sw_dist(first.pose.p, here.pose.p);
  const double turn = sw_norm(sw_quat_log(sw_quat_mul(first.pose.q, sw_quat_conj(here.pose.q))));
  if (status != SW_OK || !(jump <= LARGEST_JUMP) || !(turn <= LARGEST_TURN)) {
    sw_drive_free(&next);
    if (status != SW_OK) return status;
    return sw_fail(err, SW_EINVAL,
                   "%s: the trajectory starts at (%g, %g, %g) m, %.4g m and %.3g rad away from the "
                   "present pose; start at that pose or give relative = true",
                   object, first.pose.p.x, first.pose.p.y, first.pose.p.z, jump, turn);
  }
  sw_drive_free(d);
  *d = next;
  return SW_OK;
}

sw_status sw_drive_put(sw_scene *s, sw_drive *d, const char *object, sw_pose pose, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(check_free(s, d, object, err));
  sw_drive_free(d);
  *d = (sw_drive){.pose = pose};
  sw_course_jump(sw_scene_course(s));
  return SW_OK;
}

/* Puts a drive on a tape. In a file a user's function that has ended becomes the pose where it
 * ended; one that still runs was refused before. */
void sw_tape_drive(sw_tape *t, sw_scene *s, sw_drive *x) {
  sw_drive now = *x;
  sw_motion_state at;
  SW_TAPE_STRUCT(t, sw_drive, 104);
  if (!sw_tape_reads(t) && !t->home && x->motion && sw_motion_is_function(x->motion)) {
    const sw_status status = sw_drive_eval(s, x, sw_scene_time(s), &at, t->err);
    if (status != SW_OK) sw_tape_fail(t, status);
    now = (sw_drive){.pose = at.pose};
  }
  sw_tape_pose(t, &now.pose);
  sw_tape_double(t, &now.start);
  sw_tape_size(t, &now.tool), sw_tape_vec(t, &now.opens);
  sw_tape_motion(t, &now.motion);
  if (!sw_tape_reads(t)) return;
  *x = now;
  const double q = x->pose.q.w + x->pose.q.x + x->pose.q.y + x->pose.q.z;
  sw_tape_expect(t, sw_finite(x->pose.p) && isfinite(q) && isfinite(x->start), "a place");
  sw_tape_expect(t, sw_finite(x->opens), "a place");
}

int sw_drive_stands(const sw_drive *d, double t) {
  return !d->tool && (!d->motion || sw_motion_end(d->motion) <= t - d->start);
}
