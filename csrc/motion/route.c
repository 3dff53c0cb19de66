/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Turns a plan's way-points into a route: the implied start of a displacement, all orientations,
 * and the legs' lengths and turns. */
#include "base/alloc.h"
#include "motion/law.h"

/* Smaller distances are the same place; smaller angles are no turn. */
static const double same_place = 1e-9; /* [m] */
static const double same_angle = 1e-9; /* [rad] */

void sw_route_free(sw_route *route) {
  SW_FREE_ALL(route->p, route->q, route->t, route->legs);
  route->p = NULL, route->q = NULL, route->t = NULL, route->legs = NULL;
}

static sw_status allocate(sw_route *route) {
  return SW_ALLOC_ALL(SW_ROOM(route->p, route->count), SW_ROOM(route->q, route->count),
                      SW_ROOM(route->t, route->count), SW_ROOM(route->legs, route->count));
}

/* 1 if a displacement needs an extra way-point before its first. */
static int starts_elsewhere(const sw_motion_plan *plan) {
  if (!plan->relative) return 0;
  if (plan->count == 0) return 1;
  const sw_waypoint *first = &plan->points[0];
  if (sw_norm(first->p) > same_place) return 1;
  if (first->facing == SW_FACING_GIVEN) return sw_norm(sw_quat_log(first->q)) > same_angle;
  return first->facing == SW_FACING_TURNED && sw_norm(first->turn) > 0;
}

/* Returns the turn from the previous way-point to this one, in world axes [rad]. */
static sw_vec turn_to(const sw_waypoint *point, sw_quat before) {
  if (point->facing == SW_FACING_TURNED) return point->turn;
  if (point->facing == SW_FACING_KEPT) return sw_v(0, 0, 0);
  return sw_quat_log(sw_quat_mul(sw_quat_unit(point->q), sw_quat_conj(before)));
}

static sw_status check_point(const sw_route *route, size_t i, const sw_waypoint *point,
                             sw_error *err) {
  if (!sw_finite(point->p))
    return sw_fail(err, SW_EINVAL, "%s: way-point %zu has no finite position [m]", route->name,
                   i + 1);
  if (!isnan(point->t) && !isfinite(point->t))
    return sw_fail(err, SW_EINVAL, "%s: way-point %zu: t = %g s must be finite", route->name, i + 1,
                   point->t);
  const sw_quat *q = &point->q;
  if ((point->facing == SW_FACING_GIVEN && !isfinite(q->w + q->x + q->y + q->z)) ||
      (point->facing == SW_FACING_TURNED && !sw_finite(point->turn)))
    return sw_fail(err, SW_EINVAL, "%s: way-point %zu has no finite orientation", route->name,
                   i + 1);
  return SW_OK;
}

static sw_status fill(const sw_motion_plan *plan, sw_route *route, size_t implied, sw_error *err) {
  route->q[0] = sw_quat_identity();
  if (implied) route->t[0] = plan->count && !isnan(plan->points[0].t) ? 0 : NAN;
  for (size_t k = 0; k < plan->count; k++) {
    const size_t i = k + implied;
    const sw_waypoint *point = &plan->points[k];
    SW_TRY(check_point(route, k, point, err));
    route->p[i] = point->p;
    route->t[i] = point->t;
    const sw_quat before = i ? route->q[i - 1] : sw_quat_identity();
    const sw_vec w = turn_to(point, before);
    route->q[i] = point->facing == SW_FACING_GIVEN ? sw_quat_unit(point->q)
                                                   : sw_quat_mul(sw_quat_exp(w), before);
    if (i) route->legs[i - 1].w = sw_unrotate(before, w);
  }
  if (implied + plan->count < route->count) { /* turning on the spot */
    route->p[1] = route->p[0], route->q[1] = route->q[0], route->t[1] = route->t[0];
  }
  return SW_OK;
}

static sw_status check_times(sw_route *route, size_t implied, sw_error *err) {
  size_t given = 0, missing = 0;
  for (size_t i = 0; i < route->count; i++)
    if (isnan(route->t[i]))
      missing = i + 1;
    else
      given = i + 1;
  if (given && missing)
    return sw_fail(err, SW_EINVAL,
                   "%s: way-point %zu has a time and way-point %zu has none; give a time to every "
                   "way-point or to none",
                   route->name, given - implied, missing - implied);
  route->timed = given > 0;
  for (size_t i = 1; route->timed && i < route->count; i++)
    if (!(route->t[i] > route->t[i - 1])) {
      if (implied && i == 1)
        return sw_fail(
            err, SW_EINVAL,
            "%s: way-point 1 is not at displacement 0, so its time (%g s) must be above 0 s",
            route->name, route->t[1]);
      return sw_fail(err, SW_EINVAL,
                     "%s: times must increase, but way-point %zu has t = %.9g s after %.9g s",
                     route->name, i + 1 - implied, route->t[i], route->t[i - 1]);
    }
  return SW_OK;
}

static void measure(sw_route *route) {
  for (size_t k = 0; k + 1 < route->count; k++) {
    sw_leg *leg = &route->legs[k];
    leg->length = sw_dist(route->p[k], route->p[k + 1]);
    leg->angle = sw_norm(leg->w);
    if (leg->length < same_place) leg->length = 0;
    if (leg->angle < same_angle) leg->angle = 0, leg->w = sw_v(0, 0, 0);
    route->length += leg->length;
    route->angle += leg->angle;
  }
}

/* Divides a turn of the whole path among the legs: by length; if all lengths are 0, by time;
 * without times, evenly. */
static sw_status spread(sw_route *route, sw_vec turn, sw_error *err) {
  const size_t legs = route->count - 1;
  if (route->angle > 0)
    return sw_fail(err, SW_EINVAL,
                   "%s: turn cannot be combined with orientations of the way-points", route->name);
  const double time = route->timed ? route->t[legs] - route->t[0] : 0;
  const sw_vec body = sw_unrotate(route->q[0], turn);
  route->angle = 0;
  for (size_t k = 0; k < legs; k++) {
    sw_leg *leg = &route->legs[k];
    double part = 1.0 / (double)legs;
    if (route->length > 0)
      part = leg->length / route->length;
    else if (route->timed)
      part = (route->t[k + 1] - route->t[k]) / time;
    leg->w = sw_scale(body, part);
    leg->angle = sw_norm(leg->w);
    route->angle += leg->angle;
    route->q[k + 1] = sw_quat_mul(route->q[k], sw_quat_exp(leg->w));
  }
  return SW_OK;
}

sw_status sw_route_build(const sw_motion_plan *plan, sw_route *route, sw_error *err) {
  const size_t implied = (size_t)starts_elsewhere(plan);
  const int turns = sw_norm(plan->turn) > 0;
  route->count = plan->count + implied;
  if (route->count == 1 && turns) route->count = 2;
  if (route->count < 2)
    return sw_fail(err, SW_EINVAL,
                   "%s: a path needs at least 2 way-points, got %zu (give points = {{x,y,z}, ...}, "
                   "or turn to turn in place)",
                   route->name, plan->count);
  SW_TRY(allocate(route));
  SW_TRY(fill(plan, route, implied, err));
  SW_TRY(check_times(route, implied, err));
  measure(route);
  if (turns) SW_TRY(spread(route, plan->turn, err));
  for (size_t k = 0; k + 1 < route->count && !route->timed; k++)
    if (route->legs[k].length == 0 && route->legs[k].angle == 0)
      return sw_fail(err, SW_EINVAL,
                     "%s: way-point %zu (%g, %g, %g) m repeats the one before it; remove it, or "
                     "give times to stay there for a while",
                     route->name, k + 2 - implied, route->p[k].x, route->p[k].y, route->p[k].z);
  return SW_OK;
}
