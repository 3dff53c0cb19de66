/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Turns a route into a path: where to rest, how wide to blend, how long each run takes. */
#include "base/alloc.h"
#include "base/each.h"
#include "motion/path.h"

static const double default_blend = 0.1; /* over the shorter leg [-] */
static const double any_speed = 1e12;    /* factor on a speed that removes its limit [-] */
static const double turns_back = -0.5;   /* cosine of 120 deg [-] */

static sw_status check(const sw_motion_law *law, const sw_motion_plan *plan, const sw_route *route,
                       sw_error *err) {
  const int rests = law->profile->rests;
  const int limited = !isnan(plan->acceleration) || !isnan(plan->angular_acceleration);
  if (!rests && limited)
    return sw_fail(
        err, SW_EINVAL,
        "%s: law 'linear' jumps to its speed, so an acceleration cannot be kept; use 'trapezoidal'",
        route->name);
  if (!rests && plan->stop > 0)
    return sw_fail(err, SW_EINVAL, "%s: law 'linear' never rests; use 'trapezoidal' to stop",
                   route->name);
  if (!rests) return SW_OK;
  if ((route->timed || plan->stop > 0) && plan->blend > 0)
    return sw_fail(err, SW_EINVAL,
                   "%s: blend = %g m has no use where law '%s' rests at every way-point",
                   route->name, plan->blend, law->name);
  if (route->timed && plan->stop == 0)
    return sw_fail(err, SW_EINVAL,
                   "%s: with a time for every way-point law '%s' rests at each; use 'spline' to "
                   "pass through",
                   route->name, law->name);
  return SW_OK;
}

static int reverses(const sw_leg *in, const sw_leg *out, const sw_vec p[3]) {
  sw_vec a = sw_sub(p[1], p[0]), b = sw_sub(p[2], p[1]);
  if (in->length == 0 && out->length == 0) a = in->w, b = out->w;
  return sw_dot(a, b) < turns_back * sw_norm(a) * sw_norm(b);
}

/* 1 if the path rests at the inner way-point i. */
static int rests_at(const sw_motion_law *law, const sw_motion_plan *plan, const sw_route *route,
                    size_t i) {
  if (!law->profile->rests) return 0;
  if (route->timed || plan->stop >= 0) return route->timed || plan->stop > 0;
  return isnan(plan->blend) && reverses(&route->legs[i - 1], &route->legs[i], &route->p[i - 1]);
}

static double half_width(const sw_motion_law *law, const sw_motion_plan *plan, const sw_leg *in,
                         const sw_leg *out) {
  if (isnan(plan->blend))
    return law->profile->rests ? default_blend * fmin(in->time, out->time) : 0;
  double half = 0.5 * fmin(in->time, out->time);
  if (plan->blend == 0) return 0;
  if (in->length > 0) half = fmin(half, plan->blend * in->time / in->length);
  if (out->length > 0) half = fmin(half, plan->blend * out->time / out->length);
  return half;
}

static void add_segments(const sw_motion_law *law, const sw_motion_plan *plan,
                         const sw_route *route, sw_path *path) {
  for (size_t k = 0; k + 1 < route->count; k++) {
    const sw_leg *leg = &route->legs[k];
    sw_segment *g = &path->segments[k];
    g->time = leg->time;
    g->p = route->p[k];
    g->q = route->q[k];
    g->d = sw_scale(sw_sub(route->p[k + 1], route->p[k]), 1 / leg->time);
    g->w = sw_scale(leg->w, 1 / leg->time);
    g->world = sw_rotate(g->q, g->w);
    g->turns = leg->angle > 0;
    if (k == 0 || rests_at(law, plan, route, k)) {
      path->runs[path->run_count++].first = k;
    } else {
      g->s = g[-1].s + g[-1].time;
      g->blend = half_width(law, plan, leg - 1, leg);
    }
    sw_run *run = &path->runs[path->run_count - 1];
    run->count++;
    run->span += leg->time;
  }
}

/* Returns the time of the whole path at `factor` times the speeds of the legs' times. */
static double total_time(const sw_motion_plan *plan, const sw_route *route, const sw_path *path,
                         double factor) {
  double sum = 0;
  SW_ITEMS(const sw_run, run, path->runs, path->run_count) {
    const double growth = sw_route_growth(plan, &route->legs[run->first], run->count);
    sum += path->profile->least_time(run->span / factor, growth / factor);
  }
  return sum;
}

/* Finds the factor on the legs' speeds at which the path takes the plan's duration. */
static sw_status factor_for(const sw_motion_plan *plan, const sw_route *route, const sw_path *path,
                            double *factor, sw_error *err) {
  double slow = total_time(plan, route, path, 1) / plan->duration, fast = slow;
  const double least = total_time(plan, route, path, any_speed * slow);
  while (total_time(plan, route, path, slow) < plan->duration) slow *= 0.5;
  if (least > plan->duration)
    return sw_fail(err, SW_EINVAL,
                   "%s: duration = %g s is too short for the acceleration; it takes at least %g s",
                   route->name, plan->duration, least);
  for (int i = 0; i < 60 && total_time(plan, route, path, fast) > plan->duration; i++) fast *= 2;
  for (int i = 0; i < 200 && fast > slow * (1 + 1e-15); i++) {
    const double middle = 0.5 * (slow + fast);
    if (total_time(plan, route, path, middle) > plan->duration)
      slow = middle;
    else
      fast = middle;
  }
  *factor = slow;
  return SW_OK;
}

static void change_speed(sw_route *route, sw_path *path, double factor) {
  for (size_t k = 0; k < path->segment_count; k++) {
    sw_segment *g = &path->segments[k];
    route->legs[k].time /= factor;
    g->time /= factor, g->s /= factor, g->blend /= factor;
    g->d = sw_scale(g->d, factor);
    g->w = sw_scale(g->w, factor), g->world = sw_scale(g->world, factor);
  }
  for (size_t r = 0; r < path->run_count; r++) path->runs[r].span /= factor;
}

static sw_status add_times(const sw_motion_plan *plan, const sw_route *route, sw_path *path,
                           sw_motion *motion, sw_error *err) {
  double t = 0;
  SW_ITEMS(sw_run, run, path->runs, path->run_count) {
    const double growth = sw_route_growth(plan, &route->legs[run->first], run->count);
    run->t = route->timed ? route->t[run->first] - route->t[0] : t;
    run->time = route->timed ? run->span : path->profile->least_time(run->span, growth);
    if (!path->profile->fit(run, growth))
      return sw_fail(err, SW_EINVAL,
                     "%s: %g s from way-point %zu to %zu is too short for the acceleration; it "
                     "takes at least %g s",
                     route->name, run->time, run->first + 1, run->first + run->count + 1,
                     path->profile->least_time(run->span / any_speed, growth / any_speed));
    t = run->t + run->time;
  }
  motion->duration = t;
  return SW_OK;
}

static double length_of(const sw_route *route, const sw_path *path) {
  double sum = route->length;
  for (size_t k = 1; k < path->segment_count; k++) {
    const sw_segment *g = &path->segments[k];
    if (g->blend > 0)
      sum += sw_path_corner_length(g - 1, g) - g->blend * (sw_norm(g[-1].d) + sw_norm(g->d));
  }
  return sum;
}

sw_status sw_path_plan(const sw_motion_law *law, const sw_motion_plan *plan, sw_route *route,
                       sw_motion *motion, sw_error *err) {
  SW_TRY(check(law, plan, route, err));
  sw_path *path = sw_alloc(1, sizeof *path);
  if (!path) return SW_ENOMEM;
  motion->body = path; /* freed with the motion */
  path->profile = law->profile;
  path->segment_count = route->count - 1;
  SW_TRY(SW_ALLOC_ALL(SW_ROOM(path->segments, path->segment_count),
                      SW_ROOM(path->runs, path->segment_count)));
  add_segments(law, plan, route, path);
  if (!isnan(plan->duration)) {
    double factor = 1;
    SW_TRY(factor_for(plan, route, path, &factor, err));
    change_speed(route, path, factor);
  }
  SW_TRY(add_times(plan, route, path, motion, err));
  if (!isnan(plan->duration)) motion->duration = plan->duration;
  motion->length = length_of(route, path);
  return SW_OK;
}
