/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Creates motions by law, evaluates them, and makes views of other motions. */
#include "motion/motion.h"

#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/param.h"
#include "motion/law.h"

static const sw_motion_law *const laws[] = {
#define X(name) &sw_motion_law_##name,
#include "motion/list.def"
#undef X
};

enum { LAWS = sizeof laws / sizeof laws[0] };

const char *sw_motion_law_at(size_t i) {
  for (size_t k = 0; k < LAWS; k++)
    if (laws[k]->plan && i-- == 0) return laws[k]->name;
  return NULL;
}

static const sw_motion_law *find_law(const char *name) {
  for (size_t k = 0; k < LAWS; k++)
    if (laws[k]->plan && strcmp(laws[k]->name, name) == 0) return laws[k];
  return NULL;
}

static sw_status unknown_law(const char *object, const char *name, sw_error *err) {
  const char *names[LAWS];
  size_t count = 0;
  while (sw_motion_law_at(count)) names[count] = sw_motion_law_at(count), count++;
  const char *near = sw_nearest_name(name, names, sizeof names[0], count);
  if (near)
    return sw_fail(err, SW_EINVAL, "%s: there is no law '%s'; did you mean '%s'?", object, name,
                   near);
  char known[256] = "";
  for (size_t i = 0, used = 0; i < count && used < sizeof known; i++)
    used += (size_t)snprintf(known + used, sizeof known - used, "%s%s", i ? " " : "", names[i]);
  return sw_fail(err, SW_EINVAL, "%s: there is no law '%s'; known are: %s", object, name, known);
}

sw_motion_plan sw_motion_plan_empty(void) {
  return (sw_motion_plan){.speed = NAN,
                          .angular_speed = NAN,
                          .acceleration = NAN,
                          .angular_acceleration = NAN,
                          .duration = NAN,
                          .blend = NAN,
                          .stop = -1};
}

static sw_status check_number(const char *name, const char *what, double value, const char *unit,
                              int zero, sw_error *err) {
  if (isnan(value) || (isfinite(value) && (value > 0 || (zero && value == 0)))) return SW_OK;
  return sw_fail(err, SW_EINVAL, "%s: %s = %g %s is not allowed; it must be %s 0 %s", name, what,
                 value, unit, zero ? "at least" : "above", unit);
}

static sw_status check_plan(const sw_motion_plan *plan, const char *name, sw_error *err) {
  SW_TRY(check_number(name, "speed", plan->speed, "m/s", 0, err));
  SW_TRY(check_number(name, "angular_speed", plan->angular_speed, "rad/s", 0, err));
  SW_TRY(check_number(name, "acceleration", plan->acceleration, "m/s2", 0, err));
  SW_TRY(check_number(name, "angular_acceleration", plan->angular_acceleration, "rad/s2", 0, err));
  SW_TRY(check_number(name, "duration", plan->duration, "s", 0, err));
  SW_TRY(check_number(name, "blend", plan->blend, "m", 1, err));
  if (!isfinite(plan->start))
    return sw_fail(err, SW_EINVAL, "%s: start = %g s must be a finite number", name, plan->start);
  if (!sw_finite(plan->turn)) return sw_fail(err, SW_EINVAL, "%s: turn must be finite [rad]", name);
  if (plan->about && !sw_finite(plan->centre))
    return sw_fail(err, SW_EINVAL, "%s: about must be a finite place [m]", name);
  if (plan->about && !plan->relative)
    return sw_fail(err, SW_EINVAL,
                   "%s: about needs way-points that are displacements, of the centre: set relative "
                   "= true, or leave them out",
                   name);
  return SW_OK;
}

static sw_status plan_motion(const sw_motion_plan *plan, sw_route *route, sw_motion *motion,
                             sw_error *err) {
  SW_TRY(check_plan(plan, route->name, err));
  SW_TRY(sw_route_build(plan, route, err));
  const char *name = plan->law;
  if (!name) name = route->timed && route->count > 2 ? "spline" : "minimum-jerk";
  const sw_motion_law *law = find_law(name);
  if (!law) return unknown_law(route->name, name, err);
  motion->law = law;
  SW_TRY(sw_route_time(plan, route, err));
  motion->start = plan->start + (route->timed ? route->t[0] : 0);
  motion->relative = plan->relative;
  motion->about = plan->about, motion->centre = plan->centre;
  if (plan->about && !(route->angle > 0))
    return sw_fail(err, SW_EINVAL, "%s: about needs a turn, or way-points with rotations",
                   route->name);
  motion->count = route->count;
  return law->plan(law, plan, route, motion, err);
}

static void forget(sw_motion_given *given) {
  if (given) sw_free(given->points);
  sw_free(given);
}

static sw_status remember(const sw_motion_plan *plan, sw_motion *motion) {
  sw_motion_given *given = sw_alloc(1, sizeof *given);
  if (!given) return SW_ENOMEM;
  motion->given = given;
  given->plan = *plan;
  given->points = sw_alloc(plan->count, sizeof *given->points);
  if (!given->points) return SW_ENOMEM;
  if (plan->count) memcpy(given->points, plan->points, plan->count * sizeof *plan->points);
  snprintf(given->name, sizeof given->name, "%s", plan->name ? plan->name : "");
  given->plan.name = given->name[0] ? given->name : NULL;
  given->plan.law = motion->law->name;
  given->plan.points = given->points;
  return SW_OK;
}

sw_status sw_motion_create(const sw_motion_plan *plan, sw_motion **out, sw_error *err) {
  sw_route route = {.name = plan->name ? plan->name : "trajectory"};
  *out = NULL;
  sw_motion *motion = sw_alloc(1, sizeof *motion);
  if (!motion) return sw_fail(err, SW_ENOMEM, "%s: out of memory", route.name);
  motion->references = 1;
  sw_status status = plan_motion(plan, &route, motion, err);
  if (status == SW_OK) status = remember(plan, motion);
  sw_route_free(&route);
  if (status == SW_OK)
    *out = motion;
  else
    sw_motion_release(motion);
  if (status == SW_ENOMEM) return sw_fail(err, status, "%s: out of memory", route.name);
  return status;
}

/* --- views ------------------------------------------------------------------ */

sw_motion *sw_motion_view(sw_motion *motion) {
  sw_motion *seen = sw_alloc(1, sizeof *seen);
  if (!seen) return NULL;
  *seen = *motion;
  seen->references = 1;
  if (motion->inner) { /* view the motion behind the other view */
    seen->inner = sw_motion_retain(motion->inner);
  } else {
    seen->inner = sw_motion_retain(motion);
    seen->base = sw_pose_identity();
  }
  seen->body = NULL;
  seen->given = NULL;
  return seen;
}

sw_status sw_motion_relative(sw_motion *motion, sw_pose base, sw_motion **out) {
  *out = sw_motion_view(motion);
  if (!*out) return SW_ENOMEM;
  (*out)->base.p = sw_add(base.p, (*out)->base.p);
  (*out)->base.q = sw_quat_mul((*out)->base.q, base.q);
  (*out)->relative = 0;
  return SW_OK;
}

sw_status sw_motion_shifted(sw_motion *motion, double delay, sw_motion **out) {
  *out = sw_motion_view(motion);
  if (!*out) return SW_ENOMEM;
  (*out)->start += delay;
  return SW_OK;
}

/* --- reading ---------------------------------------------------------------- */

/* What is at `at` before the motion goes round its centre: an arm that turns, carried along. */
static void go_about(const sw_motion *motion, sw_vec at, sw_motion_state *out) {
  const sw_vec rest = sw_sub(at, motion->centre), arm = sw_rotate(out->pose.q, rest);
  const sw_vec v = sw_cross(out->omega, arm);
  out->pose.p = sw_add(out->pose.p, sw_sub(arm, rest));
  out->v = sw_add(out->v, v);
  out->a = sw_add(out->a, sw_add(sw_cross(out->alpha, arm), sw_cross(out->omega, v)));
}

sw_status sw_motion_eval(const sw_motion *motion, double t, sw_motion_state *out, sw_error *err) {
  if (isnan(t)) return sw_fail(err, SW_EINVAL, "trajectory: the time is not a number");
  if (t == HUGE_VAL && motion->duration == HUGE_VAL)
    return sw_fail(err, SW_EINVAL, "trajectory: this motion has no end");
  const int early = t < motion->start, late = t >= sw_motion_end(motion);
  const double since = early ? 0 : t - motion->start;
  const sw_motion *law = motion->inner ? motion->inner : motion;
  SW_TRY(law->law->eval(law, late || since > law->duration ? law->duration : since, out, err));
  if (motion->about) go_about(motion, motion->inner ? motion->base.p : sw_v(0, 0, 0), out);
  if (early || late) out->v = out->a = out->omega = out->alpha = sw_v(0, 0, 0);
  if (motion->inner) {
    out->pose.p = sw_add(motion->base.p, out->pose.p);
    out->pose.q = sw_quat_mul(out->pose.q, motion->base.q);
  }
  return SW_OK;
}

double sw_motion_start(const sw_motion *motion) { return motion->start; }
double sw_motion_duration(const sw_motion *motion) { return motion->duration; }
double sw_motion_end(const sw_motion *motion) { return motion->start + motion->duration; }
double sw_motion_length(const sw_motion *motion) { return motion->length; }
size_t sw_motion_count(const sw_motion *motion) { return motion->count; }
const char *sw_motion_law_name(const sw_motion *motion) { return motion->law->name; }
int sw_motion_is_relative(const sw_motion *motion) { return motion->relative; }

sw_motion *sw_motion_retain(sw_motion *motion) {
  if (motion) motion->references++;
  return motion;
}

void sw_motion_release(sw_motion *motion) {
  if (!motion || --motion->references > 0) return;
  if (motion->inner)
    sw_motion_release(motion->inner);
  else if (motion->body)
    motion->law->destroy(motion->body);
  forget(motion->given);
  sw_free(motion);
}
