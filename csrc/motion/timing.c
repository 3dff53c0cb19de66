/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds each leg's time at the highest speeds, and the limits of the acceleration. */
#include "base/each.h"
#include "motion/law.h"

static double most(double a, double b) { return a > b ? a : b; }

static sw_status untimed_leg(const sw_route *route, size_t k, double speed, sw_error *err) {
  const int straight = route->legs[k].length > 0;
  const double much = straight ? route->legs[k].length : route->legs[k].angle;
  return sw_fail(err, SW_EINVAL,
                 "%s: between way-points %zu and %zu there is only a %s of %.4g %s, and %s does "
                 "not give its duration: give %s, or a time for every way-point",
                 route->name, k + 1, k + 2, straight ? "move" : "turn", much,
                 straight ? "m" : "rad", isnan(speed) ? "angular_speed" : "speed or duration",
                 straight ? "speed [m/s]" : "angular_speed [rad/s]");
}

static sw_status by_speed(sw_route *route, double speed, double angular, sw_error *err) {
  for (size_t k = 0; k + 1 < route->count; k++) {
    sw_leg *leg = &route->legs[k];
    const double move = isnan(speed) ? 0 : leg->length / speed;
    const double turn = isnan(angular) ? 0 : leg->angle / angular;
    leg->time = most(move, turn);
    if (!(leg->time > 0) || (leg->length > 0 && isnan(speed) && leg->angle == 0))
      return untimed_leg(route, k, speed, err);
    if (!isfinite(leg->time))
      return sw_fail(err, SW_EINVAL, "%s: way-points %zu and %zu are too far apart", route->name,
                     k + 1, k + 2);
  }
  return SW_OK;
}

sw_status sw_route_time(const sw_motion_plan *plan, sw_route *route, sw_error *err) {
  const int speeds = !isnan(plan->speed) || !isnan(plan->angular_speed);
  const int lasts = !isnan(plan->duration);
  if (route->timed && (speeds || lasts))
    return sw_fail(err, SW_EINVAL,
                   "%s: the way-points have times; leave out speed, angular_speed and duration",
                   route->name);
  if (speeds && lasts)
    return sw_fail(err, SW_EINVAL, "%s: give duration = %g s or a speed, not both", route->name,
                   plan->duration);
  for (size_t k = 0; route->timed && k + 1 < route->count; k++)
    route->legs[k].time = route->t[k + 1] - route->t[k];
  if (route->timed) return SW_OK;
  if (speeds) return by_speed(route, plan->speed, plan->angular_speed, err);
  if (lasts) return by_speed(route, route->length > 0 ? 1 : NAN, route->length > 0 ? NAN : 1, err);
  return sw_fail(err, SW_EINVAL,
                 "%s: the speed is not given; give speed [m/s], duration [s] or a time for every "
                 "way-point [s]",
                 route->name);
}

double sw_route_growth(const sw_motion_plan *plan, const sw_leg *legs, size_t count) {
  double growth = INFINITY;
  SW_ITEMS(const sw_leg, leg, legs, count) {
    if (!isnan(plan->acceleration) && leg->length > 0)
      growth = fmin(growth, plan->acceleration * leg->time / leg->length);
    if (!isnan(plan->angular_acceleration) && leg->angle > 0)
      growth = fmin(growth, plan->angular_acceleration * leg->time / leg->angle);
  }
  return growth;
}
