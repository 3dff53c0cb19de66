/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "contact/trough.h"

#include <math.h>

#include "contact/touch.h"

/* Largest depth over the shift that made it. It is 1 where a wall is right beside the wire [-]. */
static const double STEEPEST = 0.99;

/* Hollow within half the shift over that within the shift: 1 in a bore, less on the flat facets of
 * its mesh, 0 on a floor with a wall farther away, to which the wire may go [-]. */
static const double EVEN = 0.25;

/* A place of a wire's axis on an obstacle. */
typedef struct spot {
  const sw_contact *contact;
  size_t obstacle;
  sw_vec place, across; /* across: along the surface, unit vector [m], [-] */
  double radius;        /* of the wire [m] */
} spot;

/* How deep the wire is in the obstacle after a shift to one side [m]. */
static double depth_after(const spot *w, double shift) {
  const sw_vec p = sw_madd(w->place, w->across, shift);
  const sw_vec local = sw_pose_local(w->contact->now[w->obstacle].pose, p);
  const sw_shape *shape = w->contact->obstacles[w->obstacle].shape;
  sw_closest near;
  return sw_shape_point(shape, local, w->radius, &near) ? w->radius - near.gap : 0.0;
}

/* 1/(R - r), as if the obstacle were a bore: its axis is ((R - r)^2 + d^2)^0.5 away after a shift
 * d. The mean over both sides leaves out a slope. */
static double hollow_within(const spot *w, double d) {
  const double mean = 0.5 * (depth_after(w, d) + depth_after(w, -d));
  const double deep = fmin(mean, STEEPEST * d);
  return deep > 0 ? 2.0 * deep / (d * d - deep * deep) : 0.0;
}

/* A wire that is shifted by at most its radius keeps its axis out of the obstacle. */
double sw_contact_trough(const sw_contact *c, const sw_system *s, const sw_body *b, size_t k,
                         double aside) {
  sw_contact_push push;
  if (b->plan->web || !sw_contact_push_at(c, s, k, &push)) return 0;
  const size_t i = push.node - b->first_node, last = b->plan->nodes - 1;
  const size_t e = b->first_node + (i < last ? i : last - 1);
  const sw_vec along = sw_sub(sw_vec_at(s->x, e + 1), sw_vec_at(s->x, e));
  const double r = b->plan->beam.radius, d = fmin(aside, r);
  const spot w = {c, sw_contact_index(c, push.obstacle), sw_madd(push.point, push.normal, r),
                  sw_unit_or(sw_cross(push.normal, along), sw_v(0, 0, 0)), r};
  const double half = d > 0 ? hollow_within(&w, 0.5 * d) : 0.0;
  if (!(half > 0)) return 0; /* most obstacles */
  const double whole = hollow_within(&w, d);
  return half > EVEN * whole ? whole : 0.0;
}
