/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A spring of limited force from one place of a wire to a point, like a hand that holds only so
 * hard. With d the distance, F the limit and d0 = F / k:
 *   E = 1/2 k d^2 up to d0, F (d - d0 / 2) beyond: the force is k d, then F, towards the point.
 * It has no mass and no damping, and does not fix the wire's direction. */
#include <math.h>
#include <stddef.h>

#include "force/axis.h"
#include "force/force.h"

typedef struct pull_args {
  double s;         /* [m] */
  sw_vec to;        /* [m] */
  double force;     /* limit [N] */
  double stiffness; /* [N/m] */
} pull_args;

static const sw_param rows[] = {
    {"s", SW_PARAM_NUMBER, "m", NAN, 0, HUGE_VAL, SW_PARAM_REQUIRED, NULL, offsetof(pull_args, s),
     "arc length of the pulled place"},
    {"to", SW_PARAM_VECTOR, "m", 0, -HUGE_VAL, HUGE_VAL, SW_PARAM_REQUIRED | SW_PARAM_CHANGES, NULL,
     offsetof(pull_args, to), "the point to which it is pulled"},
    {"force", SW_PARAM_NUMBER, "N", NAN, 0, HUGE_VAL,
     SW_PARAM_REQUIRED | SW_PARAM_ABOVE_MIN | SW_PARAM_CHANGES, NULL, offsetof(pull_args, force),
     "largest force"},
    {"stiffness", SW_PARAM_NUMBER, "N/m", NAN, 0, HUGE_VAL,
     SW_PARAM_REQUIRED | SW_PARAM_ABOVE_MIN | SW_PARAM_CHANGES, NULL,
     offsetof(pull_args, stiffness), "stiffness of the spring, below the largest force"},
};

typedef struct pulled {
  size_t i;        /* the place is between places i and i + 1 of the wire */
  double part[2];  /* shares of the two places [-] */
  sw_vec n;        /* unit vector from the point to the place, 0 if they coincide [-] */
  double distance; /* [m] */
  double size;     /* force [N] */
} pulled;

static pulled pulled_of(const pull_args *a, const sw_field *f) {
  pulled p = {0};
  double fraction;
  p.i = sw_plan_locate(f->plan, a->s, &fraction);
  p.part[0] = 1.0 - fraction, p.part[1] = fraction;
  const sw_vec at = sw_lerp(sw_axis_at(f, p.i), sw_axis_at(f, p.i + 1), fraction);
  p.distance = sw_dist(at, a->to);
  p.n = sw_unit_or(sw_sub(at, a->to), sw_v(0, 0, 0));
  p.size = fmin(a->stiffness * p.distance, a->force);
  return p;
}

/* Stiffness times w: k I below the limit, F / d (I - n n') beyond. */
static void stiffness_of(const pull_args *a, const pulled *p, double w, double K[9]) {
  const int limited = p->size >= a->force;
  const double across = w * (limited ? p->size / p->distance : a->stiffness);
  const double n[3] = {p->n.x, p->n.y, p->n.z};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      K[3 * i + j] = (i == j ? across : 0.0) - (limited ? across * n[i] * n[j] : 0.0);
}

enum { NEXT = 6 };

static sw_status eval(const void *args, sw_field *f, sw_error *err SW_UNUSED) {
  const pull_args *a = args;
  double K[9];
  const pulled p = pulled_of(a, f);
  const int stiff = (f->want & SW_WANT_STIFFNESS) != 0, web = f->plan->web != NULL;
  for (size_t end = 0; end < 2; end++) {
    stiffness_of(a, &p, p.part[end] * (web ? 1.0 : p.part[end]), K);
    sw_axis_put(f, p.i + end, sw_scale(p.n, -p.size * p.part[end]), stiff ? K : NULL);
  }
  stiffness_of(a, &p, p.part[0] * p.part[1], K);
  for (size_t k = 0; stiff && !web && k < 9; k++) f->rows[SW_FIELD_ROW * p.i + NEXT + k] += K[k];
  if (f->want & SW_WANT_ENERGY)
    f->energy += p.size * p.distance - 0.5 * p.size * p.size / a->stiffness;
  return SW_OK;
}

static const char *const outputs[] = {"distance", "tension", NULL};

static void read(const void *args, const sw_field *f, const double *history SW_UNUSED,
                 double *out) {
  const pulled p = pulled_of(args, f);
  out[0] = p.distance, out[1] = p.size;
}

static double stable_dt(const void *args, const sw_plan *plan) {
  return sw_axis_stable_dt(plan, ((const pull_args *)args)->stiffness);
}

const sw_force_class sw_force_pull = {
    .name = "pull",
    .summary = "a spring of limited force from one place to a point, like a hand",
    .flags = SW_FORCE_AT_PLACE | SW_FORCE_ANY_BODY | SW_FORCE_ANY_SHAPE,
    .params = SW_PARAMS("force pull", rows),
    .eval = eval,
    .stable_dt = stable_dt,
    .outputs = outputs,
    .read = read,
};
