/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keeps one place of a wire exactly on a line or a curve (system/rail.h). The place slides along it
 * without friction or with Coulomb friction, and the wire turns freely there. The curve may be
 * moved like any hold. An open curve has ends that stop the place without rebound. */
#include <math.h>

#include "base/alloc.h"
#include "link/hold.h"

static const sw_param rows[] = {
    {"s", SW_PARAM_NUMBER, "m", 0, 0, HUGE_VAL, 0, NULL, offsetof(sw_hold_args, s),
     "arc length of the place of the wire that slides"},
    {"direction", SW_PARAM_VECTOR, "-", NAN, -HUGE_VAL, HUGE_VAL, 0, NULL,
     offsetof(sw_hold_args, line),
     "direction of a straight rail through the present place of the wire"},
    {"from", SW_PARAM_NUMBER, "m", -HUGE_VAL, -HUGE_VAL, 0, 0, NULL, offsetof(sw_hold_args, from),
     "start of a straight rail, measured along its direction from the present place (default: "
     "none)"},
    {"to", SW_PARAM_NUMBER, "m", HUGE_VAL, 0, HUGE_VAL, 0, NULL, offsetof(sw_hold_args, to),
     "end of a straight rail, measured in the same way (default: none)"},
    {"path", SW_PARAM_OTHER, "m", 0, 0, 0, 0, NULL, 0,
     "list of points {x, y, z} of a curved rail, a smooth curve through all of them; the wire must "
     "be on it"},
    {"closed", SW_PARAM_BOOLEAN, "-", 0, 0, 1, 0, NULL, offsetof(sw_hold_args, closed),
     "true: the path closes from its last point to the first; false: the rail ends at both ends"},
    {"friction", SW_PARAM_NUMBER, "-", 0, 0, 100, SW_PARAM_CHANGES, NULL,
     offsetof(sw_hold_args, friction), "Coulomb coefficient along the rail"},
    SW_NAME_ROW(sw_hold_args),
};

/* Largest distance between wire and curve when the slider is made, over the mean edge length [-].
 * The wire is moved onto the curve at once, which strains the edges there by this share squared. */
static const double LARGEST_GAP = 0.02;

/* Interpolates node values (n x 3), x or v, at arc length s. */
static sw_vec value_at(const sw_mesh *m, const double *nodes, double s) {
  size_t i = 0;
  while (i + 2 < m->n && m->s[i + 1] <= s) i++;
  return sw_lerp(sw_vec_at(nodes, i), sw_vec_at(nodes, i + 1),
                 (s - m->s[i]) / (m->s[i + 1] - m->s[i]));
}

static sw_status check(const sw_link_wire *w, sw_hold_args *a, sw_error *err) {
  const int straight = isfinite(a->line.x) && sw_norm(a->line) > 0;
  sw_curve *curve = NULL;
  sw_rail_point near;
  if (straight && a->points)
    return sw_fail(err, SW_EINVAL, "slider: give either direction or path, not both");
  if (!straight && !a->points)
    return sw_fail(err, SW_EINVAL, "slider: give a direction that is not 0, or a path");
  if (straight && a->closed)
    return sw_fail(err, SW_EINVAL,
                   "slider: closed goes with path; a straight rail has no end to join");
  if (straight) return SW_OK;
  if (isfinite(a->from) || isfinite(a->to))
    return sw_fail(err, SW_EINVAL,
                   "slider: from and to go with direction; a path has its own ends");
  const sw_status status = sw_curve_spline(a->points, a->count, a->closed, &curve);
  if (status == SW_EINVAL)
    return sw_fail(
        err, status,
        "slider: path has %zu points; it must have at least 3, each away from the one before",
        a->count);
  SW_TRY(status);
  const sw_mesh *m = w->mesh;
  const double edge = (m->s[m->n - 1] - m->s[0]) / (double)(m->n - 1);
  const sw_vec at = value_at(m, m->x, a->s);
  sw_curve_at(curve, sw_curve_nearest(curve, at), &near);
  sw_curve_release(curve);
  if (sw_dist(near.x, at) <= LARGEST_GAP * edge) return SW_OK;
  return sw_fail(err, SW_EINVAL,
                 "slider: wire '%s' is %.4g m away from the path at s = %.6g m; it must be on the "
                 "path, within %.2g m",
                 w->name, sw_dist(near.x, at), a->s - m->s[0], LARGEST_GAP * edge);
}

/* Makes the curve in the hold's frame: world axes, origin at the wire's place. */
static sw_status make_curve(const sw_hold *h, sw_curve **out) {
  const sw_hold_args *a = &h->args;
  if (!a->points) return sw_curve_line(a->line, out);
  double *points SW_LOCAL = sw_alloc(3 * a->count, sizeof *points);
  if (!points) return SW_ENOMEM;
  for (size_t i = 0; i < a->count; i++)
    sw_store(points + 3 * i, sw_sub(sw_vec_at(a->points, i), h->drive.pose.p));
  return sw_curve_spline(points, a->count, a->closed, out);
}

/* 1 if the place is at an end and moves beyond it. */
static int stops(const sw_slider *x) {
  return (x->p <= x->from && x->v < 0) || (x->p >= x->to && x->v > 0);
}

static sw_status begin(sw_hold *h, const sw_link_wire *w) {
  sw_slider *x = &h->slider;
  sw_rail_point here;
  SW_TRY(make_curve(h, &x->curve));
  const double end = sw_curve_end(x->curve);
  x->from = isfinite(end) ? 0.0 : h->args.points ? -HUGE_VAL : h->args.from;
  x->to = isfinite(end) ? end : h->args.points ? HUGE_VAL : h->args.to;
  x->friction = h->args.friction;
  x->p = sw_curve_nearest(x->curve, sw_v(0, 0, 0));
  sw_curve_at(x->curve, x->p, &here);
  x->v = sw_dot(here.along, value_at(w->mesh, w->mesh->v, h->args.s));
  if (stops(x)) x->v = 0;
  return SW_OK;
}

static void clear(sw_hold *h) { sw_curve_release(h->slider.curve); }

static void rail(const sw_hold *h, sw_rail *out) {
  const sw_slider *x = &h->slider;
  *out = (sw_rail){.curve = x->curve,
                   .at = sw_curve_at,
                   .from = x->from,
                   .to = x->to,
                   .friction = x->friction,
                   .left = HUGE_VAL,
                   .p = x->p,
                   .v = x->v,
                   .a = x->a,
                   .rubs = x->rubs};
}

static void take(sw_hold *h, const sw_link_wire *w) {
  const sw_system *s = w->system;
  const size_t at = sw_rail_freedom(s, h->rail);
  h->slider.p = s->x[at], h->slider.v = s->v[at], h->slider.a = s->a[at];
}

static int follow(sw_hold *h, const sw_link_wire *w) {
  sw_system *s = w->system;
  const size_t at = sw_rail_freedom(s, h->rail);
  take(h, w);
  h->slider.force = s->rails[h->rail].force, h->slider.rubs = s->rails[h->rail].rubs;
  if (!stops(&h->slider)) return 0;
  s->v[at] = s->a[at] = h->slider.v = h->slider.a = 0;
  sw_rails_place(s, s->x, s->v, NULL, NULL);
  return 1;
}

static void get(const sw_hold *h, sw_hold_args *a) {
  const sw_slider *x = &h->slider;
  sw_rail_point at;
  sw_curve_at(x->curve, x->p, &at);
  a->line = at.along, a->from = x->from, a->to = x->to, a->friction = x->friction;
}

static void set(sw_hold *h, const sw_hold_args *a) { h->slider.friction = a->friction; }

static void tape(sw_tape *t, sw_hold *h) {
  sw_slider *x = &h->slider;
  SW_TAPE_STRUCT(t, sw_slider, 72);
  sw_tape_curve(t, &x->curve);
  sw_tape_double(t, &x->from), sw_tape_double(t, &x->to), sw_tape_double(t, &x->friction);
  sw_tape_double(t, &x->p), sw_tape_double(t, &x->v), sw_tape_double(t, &x->a);
  sw_tape_double(t, &x->force), sw_tape_double(t, &x->rubs);
  sw_tape_expect(t, x->curve && x->from <= x->to && x->friction >= 0 && x->friction <= 100,
                 "a rail");
  sw_tape_expect(t, isfinite(x->p + x->v + x->a), "a rail");
}

static const char *const outputs[] = {"place", "speed", "force", NULL};

/* Along the rail: place, speed, force of friction and ends on the wire [m], [m/s], [N]. */
static void read(const sw_hold *h, double time SW_UNUSED, double *out) {
  out[0] = h->slider.p, out[1] = h->slider.v, out[2] = h->slider.force;
}

static const sw_hold_acts acts = {.outputs = outputs,
                                  .read = read,
                                  .lines = 1,
                                  .check = check,
                                  .begin = begin,
                                  .clear = clear,
                                  .follow = follow,
                                  .undo = take,
                                  .rail = rail,
                                  .get = get,
                                  .set = set,
                                  .tape = tape};

const sw_link_class sw_link_slider = {
    .name = "slider",
    .summary = "keeps a place of the wire on a line or a curve, along which that place slides",
    .params = SW_PARAMS("slider", rows),
    .hold = &acts,
};
