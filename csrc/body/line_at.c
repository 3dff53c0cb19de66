/* SPDX-License-Identifier: GPL-3.0-or-later */
/* State at a place on a line: between its nodes, and beside its holds and joints. */
#include <math.h>

#include "body/body.h"
#include "body/side.h"
#include "body/spin.h"
#include "scene/course.h"
#include "scene/parts.h"
#include "scene/values.h"
#include "scene/wire.h"
#include "state/clamp.h"
#include "system/axial.h"
#include "system/system.h"

/* Returns the clamp hinge at a node on this edge, or NULL. */
static const sw_clamp_hinge *clamp_at(const sw_plan *p, size_t node, size_t edge) {
  for (size_t c = 0; c < p->clamp_count; c++)
    if (p->clamps[c].node == node && p->clamps[c].edge == edge) return &p->clamps[c];
  return NULL;
}

static sw_vec director(const sw_system *s, const sw_clamp_hinge *h) {
  return sw_load(s->directors_now + 3 * (2 * (size_t)h->hold + (h->side > 0 ? 1 : 0)));
}

static double angle_between(sw_vec a, sw_vec b) {
  return 2.0 * asin(fmin(1.0, 0.5 * sw_dist(a, b)));
}

/* Returns a clamp hinge at a node, on any edge, or NULL. */
static const sw_clamp_hinge *face_at(const sw_plan *p, size_t node) {
  for (size_t c = 0; c < p->clamp_count; c++)
    if (p->clamps[c].node == node) return &p->clamps[c];
  return NULL;
}

/* Finds tangent and curvature at a node as seen from one of its edges. */
static void node_state(const sw_system *s, const sw_body *b, size_t node, size_t edge,
                       sw_vec *tangent, double *curvature) {
  const sw_plan *p = b->plan;
  const sw_field *f = &b->field;
  const sw_clamp_hinge *c;
  const sw_vec own = sw_field_tangent(f, edge);
  sw_bent_side side;
  const int bent = sw_scene_side_at(s, b, node, edge, &side);
  *curvature = 0.0;
  *tangent = own;
  if (bent) *curvature = sw_scene_side_curvature(s, b, &side);
  if (bent && side.clamp) {
    *tangent = director(s, side.clamp);
  } else if (p->held[edge] != SW_FREE && p->held[edge + 1] != SW_FREE &&
             (c = face_at(p, node)) != NULL) { /* inside a grip, at its face */
    *tangent = director(s, c);
  } else if (node > 0 && node + 1 < p->nodes) {
    const sw_vec t1 = sw_field_tangent(f, node - 1), t2 = sw_field_tangent(f, node);
    const double l1 = p->rest[node - 1], l2 = p->rest[node];
    *tangent = sw_unit_or(sw_add(sw_scale(t1, l2), sw_scale(t2, l1)), own);
    if (p->hinge[node] > 0 && !bent) *curvature = angle_between(t1, t2) / p->hinge[node];
  } else if (bent) { /* the middle of the edge has its direction */
    const sw_vec half = sw_scale(sw_scene_side_bend(s, b, &side), 0.5 * p->rest[edge]);
    *tangent = sw_unit_or(sw_madd(own, half, -side.side), own);
  } else if (p->edges > 1) { /* free or pinned end: no moment, so the bend does not change
                                further */
    const size_t inner = node == 0 ? 1 : p->edges - 2;
    const sw_vec t2 = sw_field_tangent(f, inner);
    const double share = 0.25 * 2.0 * p->rest[edge] / (p->rest[edge] + p->rest[inner]);
    *tangent = sw_unit_or(sw_madd(own, sw_sub(own, t2), share), own);
  }
}

double sw_line_between_middles(const sw_plan *p, const double *T, double at) {
  double fraction;
  const size_t e = sw_plan_locate(p, at, &fraction);
  if (p->edges == 1) return T[0];
  size_t k = fraction < 0.5 ? (e > 0 ? e - 1 : 0) : e;
  if (k + 1 >= p->edges) k = p->edges - 2;
  const double m0 = 0.5 * (p->s[k] + p->s[k + 1]), m1 = 0.5 * (p->s[k + 1] + p->s[k + 2]);
  return T[k] + (T[k + 1] - T[k]) * (at - m0) / (m1 - m0);
}

/* Returns the rate at which a rolling wire turns about its axis, linear between edge middles. */
static double spin_at(const sw_system *s, const sw_body *b, double at) {
  if (!b->roll_block) return 0.0;
  const double *rate = s->v + 3 * s->nodes + b->first_roll;
  return sw_line_between_middles(b->plan, rate, at);
}

/* Returns the torque of hinge `number` in the plan's list, with clamps after nodes. */
static double hinge_torque(const sw_body *b, size_t number, double length) {
  const double off = b->field.hinge_twist[number] - b->plan->rest_twist[number];
  return length > 0 ? b->plan->beam.GJ / length * off : 0.0;
}

/* Returns the torque at a node of a wire with frames, as seen from one of its edges. */
static double node_torque(const sw_body *b, size_t node, size_t edge) {
  const sw_clamp_hinge *c = clamp_at(b->plan, node, edge);
  if (!c) return hinge_torque(b, node, b->plan->hinge[node]);
  return hinge_torque(b, b->plan->nodes + (size_t)(c - b->plan->clamps), c->length);
}

/* Returns the bend beyond that at rest at a node, as seen from one of its edges. */
static double node_flexure(const sw_system *s, const sw_body *b, size_t node, size_t edge) {
  sw_bent_side side;
  if (sw_scene_side_at(s, b, node, edge, &side)) return sw_scene_side_flexure(s, b, &side);
  return sw_scene_flexure(s, b, node);
}

/* With frames from the hinges beside the place; else from the span that contains it, 0 outside
 * spans. */
double sw_scene_torque(const sw_system *s, const sw_body *b, double at) {
  if (b->spin_block) {
    double f;
    const size_t e = sw_plan_locate(b->plan, at, &f);
    return (1 - f) * node_torque(b, e, e) + f * node_torque(b, e + 1, e);
  }
  for (size_t k = 0; b->has_twist && k < b->plan->span_count; k++) {
    const sw_span *span = &b->plan->spans[k];
    if (at >= b->plan->s[span->first] && at <= b->plan->s[span->last + 1])
      return sw_span_torque(b->plan, span, b->plan->beam.GJ, s->twist[b->first_span + k]);
  }
  return 0.0;
}

void sw_line_at(const sw_scene *s, const sw_scene_wire *w, const sw_body *b, double at,
                sw_point_state *out) {
  sw_system *system = sw_scene_system(s);
  sw_vec t0, t1;
  double k0, k1, f;
  const size_t e = sw_plan_locate(b->plan, at, &f);
  const double *x = system->x + 3 * (b->first_node + e);
  const double *v = system->v + 3 * (b->first_node + e);
  node_state(system, b, e, e, &t0, &k0);
  node_state(system, b, e + 1, e, &t1, &k1);
  /* cubic through both ends with their tangents; the chord keeps its length */
  const double l = b->field.length[e], h00 = (1 + 2 * f) * (1 - f) * (1 - f);
  const double h10 = f * (1 - f) * (1 - f), h01 = f * f * (3 - 2 * f), h11 = f * f * (f - 1);
  out->position = sw_add(sw_add(sw_scale(sw_load(x), h00), sw_scale(t0, l * h10)),
                         sw_add(sw_scale(sw_load(x + 3), h01), sw_scale(t1, l * h11)));
  out->chord = sw_lerp(sw_load(x), sw_load(x + 3), f);
  out->velocity = sw_lerp(sw_load(v), sw_load(v + 3), f);
  out->tangent = sw_unit_or(sw_lerp(t0, t1, f), t0);
  out->curvature = k0 + f * (k1 - k0);
  out->elastic = sw_line_between_middles(b->plan, system->tension + b->first_edge, at);
  out->tension = sw_line_between_middles(b->plan, sw_system_pull(system, b), at);
  out->spin = spin_at(system, b, at);
  out->across = sw_v(0, 0, 0);
  if (b->spin_block) {
    const double *const *n = b->field.normals;
    out->across = sw_v(n[0][e], n[1][e], n[2][e]);
    k0 = node_flexure(system, b, e, e);
    k1 = node_flexure(system, b, e + 1, e);
  }
  const double axial = sw_line_between_middles(b->plan, sw_system_elastic(system, b), at);
  const double bent = (k0 + f * (k1 - k0)) * w->beam.radius;
  out->strain = axial / w->beam.EA + bent;
  out->least_strain = axial / w->beam.EA - bent;
  out->twist_moment = sw_scene_torque(system, b, at);
}
