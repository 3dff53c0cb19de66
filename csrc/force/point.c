/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A dead force at one arc length, of fixed direction and size, shared between the edge's two nodes
 * in proportion to its position. In a mesh of particles each of the two rings distributes its part
 * by mass, so that the force acts at the section's centre. */
#include <math.h>
#include <stddef.h>

#include "force/force.h"

typedef struct point_args {
  double s;     /* [m] */
  sw_vec force; /* [N] */
} point_args;

static const sw_param rows[] = {
    {"s", SW_PARAM_NUMBER, "m", NAN, 0, HUGE_VAL, SW_PARAM_REQUIRED, NULL, offsetof(point_args, s),
     "arc length where the force acts"},
    {"force", SW_PARAM_VECTOR, "N", 0, -HUGE_VAL, HUGE_VAL, SW_PARAM_REQUIRED | SW_PARAM_CHANGES,
     NULL, offsetof(point_args, force), "the force, fixed in world axes"},
};

static void on_ring(const sw_web *web, size_t ring, sw_vec force, sw_field *f) {
  double middle[3];
  if (f->want & SW_WANT_FORCE)
    for (size_t p = web->first[ring]; p < web->first[ring + 1]; p++) {
      const double share = sw_web_is_ring(web, ring) ? web->share[p - web->first[ring]] : 1.0;
      sw_accumulate(f->force + 3 * p, sw_scale(force, share));
    }
  if (!(f->want & SW_WANT_ENERGY)) return;
  sw_web_middle(web, f->x, ring, middle);
  f->energy -= sw_dot(force, sw_load(middle));
}

static sw_status eval(const void *args, sw_field *f, sw_error *err SW_UNUSED) {
  const point_args *a = args;
  double fraction;
  const size_t e = sw_plan_locate(f->plan, a->s, &fraction);
  if (f->plan->web) {
    on_ring(f->plan->web, e, sw_scale(a->force, 1.0 - fraction), f);
    on_ring(f->plan->web, e + 1, sw_scale(a->force, fraction), f);
    return SW_OK;
  }
  double *first = f->force + 3 * e;
  if (f->want & SW_WANT_FORCE) {
    sw_accumulate(first, sw_scale(a->force, 1.0 - fraction));
    sw_accumulate(first + 3, sw_scale(a->force, fraction));
  }
  if (f->want & SW_WANT_ENERGY)
    f->energy -=
        sw_dot(a->force, sw_lerp(sw_load(f->x + 3 * e), sw_load(f->x + 3 * e + 3), fraction));
  return SW_OK;
}

const sw_force_class sw_force_point = {
    .name = "point",
    .summary = "a force of fixed direction at one place of the wire",
    .flags = SW_FORCE_AT_PLACE | SW_FORCE_ANY_BODY | SW_FORCE_LOAD,
    .params = SW_PARAMS("force point", rows),
    .eval = eval,
};
