/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sharpness of a wire's largest curvature against its edges, and the curvature between nodes. */
#include <math.h>

#include "body/side.h"
#include "contact/contact.h"
#include "link/hold.h"
#include "read/extremes.h"
#include "scene/course.h"
#include "scene/parts.h"

/* Curvatures at a node and at two nodes on either side, over that at the node, along the axis about
 * which the wire bends there. At a clamp the nodes on its wire's side are 3 and 4 [-]. */
enum { AROUND = 5, HERE = 2 };

/* Shares of `uneven`: errors of smooth bends, kinks and clamped ends besides those from the
 * curvatures beside them; the factors cover the scatter of the latter. From 500 bends against 8
 * times as many edges (spec/check/bend_calm_spec) [-]. */
static const double SMOOTH = 1.4, SMOOTH_MORE = 0.02, SMOOTH_LESS = 0.03;
static const double KINK = 0.9, KINK_LESS = 0.15;
static const double HELD = 1.4, HELD_LESS = 0.04, PUSHED = 0.6;
/* A bend is smooth if the second differences beside it are more than this share of its own [-]. */
static const double EVEN = 0.4;
/* A wire may lie on a round obstacle along a way if TWICE the error told makes it as sharp. If it
 * is sharper, it lies there, or a little off it [-]. */
static const double TWICE = 2, AROUND_LESS = 0.02;
/* The hinge of a clamp or a joint has this share of an edge: a taut wire's bend within it is too
 * wide, as watch/edges.c tells within 8 %; 0.1 and 0.05 were measured for other loads [-]. */
static const double CLAMPED = 5.0 / 12, JOINED = 0.5, TAUT = 1.1, LOADED = 0.1, SAGGING = 0.05;
/* A mesh's bends are those of its slices. Up to NEAR radii from a hold the section is held in shape
 * and the bend has not its full size: radii of tubes, radial and cubic meshes of three cables were
 * up to 1.21 times too wide, besides the way to the hold; AT_HOLD leaves some room. With slices of
 * half the default length elements were up to 0.11 sharper than a beam [-]. */
static const double NEAR = 2, AT_HOLD = 0.25, AT_HOLD_LESS = 0.12;

/* Returns the curvature at node i along the axis about which the wire bends there. Beyond the
 * wire's ends and at nodes without a hinge it is that of a clamp or joint there, along `along`, or
 * zero. */
static sw_vec curvature_at(const sw_system *s, const sw_body *b, long i, sw_vec along) {
  const sw_plan *p = b->plan;
  const sw_field *f = &b->field;
  if (i > 0 && i + 1 < (long)p->nodes && p->hinge[i] > 0) {
    const sw_vec before = sw_field_tangent(f, (size_t)i - 1);
    const sw_vec axis = sw_cross(before, sw_field_tangent(f, (size_t)i));
    const double angle = sw_angle_of_chord(sw_scene_hinge_chord(f, (size_t)i));
    return sw_scale(sw_unit_or(axis, sw_v(0, 0, 0)), angle / p->hinge[i]);
  }
  double most = 0;
  sw_bent_side side;
  for (size_t next = 0; sw_scene_next_side(s, b, &next, &side);)
    if ((long)side.node == i) most = fmax(most, sw_scene_side_curvature(s, b, &side));
  return sw_scale(sw_unit_or(along, sw_v(0, 0, 0)), most);
}

static double uneven_at(const sw_system *s, const sw_body *b, long i) {
  const sw_vec here = curvature_at(s, b, i, sw_v(0, 0, 0));
  const sw_vec before = curvature_at(s, b, i - 1, here), after = curvature_at(s, b, i + 1, here);
  return sw_norm(sw_madd(sw_add(before, after), here, -2.0));
}

static double uneven_beside(const sw_system *s, const sw_body *b, const sw_bent_side *h) {
  const long way = h->side, i = (long)h->node;
  const sw_vec next = curvature_at(s, b, i + way, sw_v(0, 0, 0));
  const sw_vec here = sw_scale(sw_unit_or(next, sw_v(0, 0, 0)), sw_scene_side_curvature(s, b, h));
  const sw_vec third = curvature_at(s, b, i + 2 * way, next);
  return sw_norm(sw_madd(sw_add(here, third), next, -2.0));
}

/* Returns the part of a second difference from the accelerations of nodes up to two from i: an
 * edge's mass times the acceleration across the wire, over EI/h^2 [1/m]. */
static double swings_at(const sw_scene *s, const sw_body *b, long i) {
  const sw_plan *p = b->plan;
  const sw_course *course = sw_scene_course(s);
  if (!course->has_stepper || !(course->span > 0) || !(p->beam.EI > 0)) return 0;
  double most = 0;
  for (long k = i - 2; k <= i + 2; k++) {
    if (k < 1 || k + 1 >= (long)p->nodes) continue;
    const sw_vec a = sw_vec_at(course->stepper.a + 3 * b->first_node, (size_t)k);
    const sw_vec before = sw_field_tangent(&b->field, (size_t)k - 1);
    const sw_vec along =
        sw_unit_or(sw_add(before, sw_field_tangent(&b->field, (size_t)k)), sw_v(0, 0, 0));
    const double across = sw_norm(sw_madd(a, along, -sw_dot(a, along)));
    most = fmax(most, across * p->beam.mass * p->hinge[k] * p->hinge[k] / p->beam.EI);
  }
  return most;
}

/* Fills in the curvatures around node i over its own, which is `value`. */
static void around(const sw_system *s, const sw_body *b, long i, double value, double c[AROUND]) {
  const sw_vec here = curvature_at(s, b, i, sw_v(0, 0, 0));
  const sw_vec axis = sw_unit_or(here, sw_v(0, 0, 0));
  for (int k = 0; k < AROUND; k++)
    c[k] = sw_dot(curvature_at(s, b, i + k - HERE, axis), axis) / value;
}

/* Returns how high two lines meet, or two exponentials if `steep`, of which one goes through places
 * -2 and -1 and the other through 1 and 2; within one place from 0 [-]. */
static double meeting(const double c[AROUND], int steep) {
  double y[AROUND];
  for (int k = 0; k < AROUND; k++) y[k] = steep ? log(c[k]) : c[k];
  const double left = y[1] - y[0], right = y[3] - y[4];
  if (!(left + right > 0)) return 1;
  const double x = fmax(-1.0, fmin(1.0, (y[3] + right - y[1] - left) / (left + right)));
  const double high = fmin(y[1] + left * (x + 1), y[3] + right * (1 - x));
  return steep ? exp(high) : high;
}

/* A bend between holds: smooth, with its top on a parabola through three nodes, less the loss by a
 * hinge's mean over its edges (1/24 of the second difference). Or at one place, a touch, where two
 * flanks meet. */
static void between_holds(const double c[AROUND], double uneven, sw_sharpness *out) {
  double second[AROUND] = {0}, least = HUGE_VAL;
  for (int k = 1; k + 1 < AROUND; k++) second[k] = 2 * c[k] - c[k - 1] - c[k + 1];
  for (int k = 0; k < AROUND; k++) least = fmin(least, c[k]);
  const double own = second[HERE], tilt = c[3] - c[1];
  const double top = own > 0 ? fmin(tilt * tilt / (8 * own) + own / 24, uneven / 4) : uneven / 4;
  if (fmin(second[1], second[3]) > EVEN * own && own > 0) {
    out->more = SMOOTH * top + SMOOTH_MORE * uneven, out->less = SMOOTH_LESS * uneven;
    return;
  }
  const double line = meeting(c, 0), steep = least > 0 ? meeting(c, 1) : line;
  out->more = fmax(KINK * (fmax(line, steep) - 1), SMOOTH * top);
  out->less = KINK_LESS * uneven;
}

/* A bend at a clamp or joint under the axial force T: the share of an edge that its hinge has. */
static void at_side(const sw_plan *p, double T, const sw_bent_side *side, double uneven,
                    sw_sharpness *out) {
  const double h = p->rest[side->edge], part = side->clamp ? CLAMPED : JOINED;
  const double load = p->beam.EI > 0 ? T * h * h / p->beam.EI : 0;
  const double taut = hypot(1.0, part * sqrt(fmax(0.0, load))) - 1;
  const double slack = LOADED * fmin(fabs(load), uneven) + SAGGING * uneven;
  out->more = HELD * slack * (1 + 0.5 * uneven) + TAUT * taut;
  out->less = uneven * fmax(HELD_LESS, -PUSHED * load);
}

/* A bend on a round obstacle, whose bend of the axis is out->round: it may be as sharp as that if
 * its nodes do not exclude it, and is not sharper. */
static void on_round(sw_sharpness *out) {
  const double left = out->round - 1;
  if (left > 0 && TWICE * out->more > left) out->more = fmax(out->more, left);
  if (left < 0) out->less = fmax(out->less, 1 - out->round / (1 + AROUND_LESS));
}

sw_sharpness sw_scene_sharpness(const sw_scene *s, const sw_body *b, size_t node,
                                const sw_bent_side *side, double value) {
  const sw_system *system = sw_scene_system(s);
  const long i = (long)(side ? side->node : node);
  sw_sharpness out = {0};
  if (!(value > 0)) return out;
  out.uneven = (side ? uneven_beside(system, b, side) : uneven_at(system, b, i)) / value;
  out.swings = swings_at(s, b, i) / value;
  if (side) {
    at_side(b->plan, sw_system_elastic(system, b)[side->edge], side, out.uneven, &out);
    return out;
  }
  double c[AROUND];
  around(system, b, i, value, c);
  between_holds(c, out.uneven, &out);
  const double round = sw_contact_round_beside(sw_scene_contact(s), system, b->first_node + node);
  if (round > 0) out.round = 1 / ((round + b->plan->beam.radius) * value), on_round(&out);
  return out;
}

/* The bend of a beam under a tension T grows as exp(x sqrt(T/EI)) on a way x to its hold. */
sw_sharpness sw_scene_mesh_sharpness(const sw_scene *s, size_t wire, const sw_wire_extremes *now) {
  const sw_beam *beam = &sw_scene_system(s)->bodies[wire].plan->beam;
  sw_sharpness out = {0};
  double way = HUGE_VAL;
  SW_EACH(hold, h, s) {
    if (!h->alive || h->wire != wire) continue;
    way = fmin(way, fmax(0.0, fmax(h->s1 - now->curvature.s, now->curvature.s - h->s2)));
  }
  if (!(way < NEAR * beam->radius) || !(beam->EI > 0)) return out;
  const double grows = exp(way * sqrt(fmax(0.0, now->tension.value) / beam->EI));
  out.uneven = AT_HOLD, out.more = grows * (1 + AT_HOLD) - 1, out.less = AT_HOLD_LESS;
  return out;
}
