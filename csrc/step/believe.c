/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks whether a trial of a step is believable. A diverged trial is refused here, and never
 * becomes the scene's state. */
#include "step/believe.h"

#include <math.h>
#include <string.h>

#include "base/simd.h"
#include "force/solid.h"
#include "read/reading.h"
#include "scene/course.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"

static const double LARGEST_STRAIN = 10.0; /* beyond it a run has diverged [-] */

/* An edge squeezed below this share of its length is beyond Hooke's law; a smaller step may avoid
 * that [-]. */
static const double LEAST_SHARE = 0.3;

enum { LANES = 8 }; /* partial sums, for vector instructions [-] */

/* Returns the sum of squares. It is finite only if each value and its square are. */
SW_HOT
static double sum_of_squares(size_t n, const double *x) {
  double lane[LANES] = {0}, sum = 0;
  size_t i = 0;
  for (; i + LANES <= n; i += LANES)
    for (size_t k = 0; k < LANES; k++) lane[k] += x[i + k] * x[i + k];
  for (; i < n; i++) sum += x[i] * x[i];
  for (size_t k = 0; k < LANES; k++) sum += lane[k];
  return sum;
}

static sw_status fail_at(const sw_scene *s, size_t b, size_t node, const char *what,
                         sw_error *err) {
  const sw_body *body = &sw_scene_system(s)->bodies[b];
  const char *name = sw_scene_wire_in(s, b)->name;
  if (sw_scene_is_loose(sw_scene_wire_in(s, b)))
    return sw_fail(err, SW_EDIVERGED, "%s of particle %zu of '%s' is not a finite number", what,
                   node + 1, name);
  return sw_fail(err, SW_EDIVERGED, "%s of wire '%s' near s = %.4g m is not a finite number", what,
                 name, body->plan->s[node] - body->plan->s[0]);
}

/* Reports the first node whose place or velocity is not finite. */
static sw_status find_infinite(const sw_scene *s, const double *x, const char *what,
                               sw_error *err) {
  sw_system *system = sw_scene_system(s);
  for (size_t b = 0; b < system->body_count; b++) {
    const sw_body *body = &system->bodies[b];
    for (size_t i = 0; i < body->plan->nodes; i++)
      if (!isfinite(sw_norm2(sw_vec_at(x, body->first_node + i))))
        return fail_at(s, b, i, what, err);
  }
  return sw_fail(err, SW_EDIVERGED, "%s of a wire about its axis is not a finite number", what);
}

static sw_status check_finite(const sw_scene *s, const double *values, const char *what,
                              sw_error *err) {
  if (isfinite(sum_of_squares(sw_scene_system(s)->freedoms, values))) return SW_OK;
  return find_infinite(s, values, what, err);
}

/* 1 if all bodies consist of edges only. Then the check of edges also finds places that are not
 * finite, because such edges have no finite length. */
static int has_edges_alone(const sw_scene *s) {
  sw_system *system = sw_scene_system(s);
  for (size_t b = 0; b < system->body_count; b++)
    if (system->bodies[b].plan->web || system->bodies[b].roll_block) return 0;
  return 1;
}

static sw_status torn(const sw_scene *s, size_t wire, uint32_t a, uint32_t b, sw_error *err) {
  const sw_web *web = sw_scene_system(s)->bodies[wire].plan->web;
  if (!web->per_ring)
    return sw_fail(err, SW_EDIVERGED, "'%s' is torn apart between particles %u and %u",
                   sw_scene_wire_in(s, wire)->name, a + 1, b + 1);
  return sw_fail(err, SW_EDIVERGED, "wire '%s' is torn apart near s = %.4g m",
                 sw_scene_wire_in(s, wire)->name, web->s[a]);
}

/* Largest allowed distance of two corners of an element, over its largest side times the largest
 * stretch [-]. */
static const double LARGEST_DIAGONAL = 3.0;

/* 1 if the element's mean strain is beyond belief, or the distance of two corners, which the mean
 * does not show. */
static int is_torn(const sw_solid *shape, const sw_web_solid *e, const double *x) {
  const double most = 1.0 + LARGEST_STRAIN, count = (double)e->count;
  const sw_vec origin = sw_vec_at(x, e->node[0]);
  double side2 = 0, far2 = 0;
  for (int k = 0; k < 3; k++) { /* columns of the mean deformation gradient */
    sw_vec column = {0};
    double sum = 0;
    for (uint32_t i = 0; i < e->count; i++) {
      const double row = shape->rows[k][i];
      column = sw_add(column, sw_scale(sw_sub(sw_vec_at(x, e->node[i]), origin), row));
      sum += row * row;
    }
    if (!(sw_norm2(column) <= most * most)) return 1;
    side2 = fmax(side2, 4.0 / (count * sum)); /* a box's rows are 2/count over its side */
  }
  for (uint32_t i = 1; i < e->count; i++)
    far2 = fmax(far2, sw_norm2(sw_sub(sw_vec_at(x, e->node[i]), origin)));
  return !(far2 <= LARGEST_DIAGONAL * LARGEST_DIAGONAL * most * most * side2);
}

/* Checks links and elements for tearing. Squeezed particles may come close to each other, which is
 * no error. */
static sw_status check_web(const sw_scene *s, size_t wire, const double *x, sw_error *err) {
  const sw_plan *plan = sw_scene_system(s)->bodies[wire].plan;
  const sw_web *web = plan->web;
  SW_ITEMS(const sw_web_link, link, web->link, web->links) {
    const double most = (1.0 + LARGEST_STRAIN) * link->rest;
    if (!(sw_dist(sw_vec_at(x, link->a), sw_vec_at(x, link->b)) <= most))
      return torn(s, wire, link->a, link->b, err);
  }
  for (size_t e = 0; web->shapes && e < web->solids; e++) {
    const sw_web_solid *solid = &web->solid[e];
    if (is_torn((const sw_solid *)web->shapes + sw_plan_shape(plan, solid), solid, x))
      return torn(s, wire, solid->node[0], solid->node[1], err);
  }
  return SW_OK;
}

/* Returns the number of edges that exceed a limit or have no finite length. */
SW_HOT
static long bad_edges(size_t m, const double *restrict rest, const double *restrict x) {
  const double most = (1.0 + LARGEST_STRAIN) * (1.0 + LARGEST_STRAIN);
  const double least = LEAST_SHARE * LEAST_SHARE;
  long bad = 0;
  for (size_t e = 0; e < m; e++) {
    const double dx = x[3 * e + 3] - x[3 * e], dy = x[3 * e + 4] - x[3 * e + 1];
    const double dz = x[3 * e + 5] - x[3 * e + 2], l2 = dx * dx + dy * dy + dz * dz;
    const double rest2 = rest[e] * rest[e];
    bad += !(l2 >= least * rest2) | !(l2 <= most * rest2);
  }
  return bad;
}

static sw_status check_edges(const sw_scene *s, size_t b, const double *x, sw_error *err) {
  const sw_plan *plan = sw_scene_system(s)->bodies[b].plan;
  if (!bad_edges(plan->edges, plan->rest, x)) return SW_OK;
  SW_TRY(check_finite(s, sw_scene_course(s)->stepper.trial_x, "the place", err));
  for (size_t e = 0; e < plan->edges; e++) {
    const double l2 = sw_norm2(sw_sub(sw_load(x + 3 * e + 3), sw_load(x + 3 * e)));
    const double most = (1.0 + LARGEST_STRAIN) * plan->rest[e];
    const double least = LEAST_SHARE * plan->rest[e];
    if (l2 < least * least)
      return sw_fail(err, SW_ENOCONV, "wire '%s' is crushed near s = %.4g m",
                     sw_scene_wire_in(s, b)->name, plan->s[e] - plan->s[0]);
    if (!(l2 <= most * most))
      return sw_fail(err, SW_EDIVERGED, "wire '%s' is torn apart near s = %.4g m",
                     sw_scene_wire_in(s, b)->name, plan->s[e] - plan->s[0]);
  }
  return SW_OK;
}

sw_status sw_scene_check_trial(const sw_scene *s, sw_error *err) {
  sw_course *course = sw_scene_course(s);
  sw_system *system = sw_scene_system(s);
  if (!has_edges_alone(s)) SW_TRY(check_finite(s, course->stepper.trial_x, "the place", err));
  SW_TRY(check_finite(s, course->stepper.trial_v, "the velocity", err));
  if (course->stepper.trial_a) /* the next step starts from these */
    SW_TRY(check_finite(s, course->stepper.trial_a, "the acceleration", err));
  for (size_t b = 0; b < system->body_count; b++) {
    const sw_body *body = &system->bodies[b];
    const double *x = course->stepper.trial_x + 3 * body->first_node;
    if (body->plan->web) SW_TRY(check_web(s, b, x, err));
    SW_TRY(check_edges(s, b, x, err));
  }
  return SW_OK;
}

void sw_scene_remark_contact(sw_scene *s) {
  const sw_event *e;
  if (!sw_scene_touches(s)) return;
  for (size_t k = 0; (e = sw_scene_event(s, k)) != NULL; k++)
    if (strcmp(e->kind, "integrator") == 0) return;
  sw_scene_tell(
      s, "integrator", sw_scene_course(s)->method->name, NAN, NAN,
      "integrator '%s' gains energy in contacts of wires; use integrator = 'tr-bdf2' for contact",
      sw_scene_course(s)->method->name);
}
