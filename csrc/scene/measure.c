/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Read-outs of wires and of the whole scene. */
#include <math.h>
#include <string.h>

#include "scene/body.h"
#include "scene/kept_frames.h"
#include "scene/line.h"
#include "scene/observe.h"
#include "scene/spin.h"
#include "scene/touching.h"
#include "scene/world.h"
#include "state/clamp.h"
#include "system/join.h"

sw_status sw_scene_wire_length(sw_scene *s, sw_handle h, double *length, sw_error *err) {
  const sw_scene_wire *w = sw_scene_find_wire(s, h, err);
  if (!w) return SW_EDEAD;
  *length = w->mesh.s[w->mesh.n - 1] - w->mesh.s[0];
  return SW_OK;
}

sw_status sw_scene_wire_nodes(sw_scene *s, sw_handle h, size_t *nodes, sw_error *err) {
  const sw_scene_wire *w = sw_scene_find_wire(s, h, err);
  if (!w) return SW_EDEAD;
  *nodes = w->mesh.n;
  return SW_OK;
}

sw_status sw_scene_wire_particles(sw_scene *s, sw_handle h, size_t *particles, sw_error *err) {
  const sw_scene_wire *w = sw_scene_find_body(s, h, err);
  if (!w) return SW_EDEAD;
  *particles = sw_body_state_of(w).points;
  return SW_OK;
}

sw_status sw_scene_wire_particle_copy(sw_scene *s, sw_handle h, double *positions, double *arc,
                                      sw_error *err) {
  sw_scene_wire *w;
  SW_TRY(sw_scene_open_body(s, h, &w, err));
  const sw_body *b = &s->system.bodies[h.slot];
  const size_t n = b->plan->nodes;
  memcpy(positions, s->system.x + 3 * b->first_node, 3 * n * sizeof(double));
  for (size_t i = 0; i < n; i++) arc[i] = b->plan->s[i] - b->plan->s[0];
  return SW_OK;
}

sw_status sw_scene_wire_beam(sw_scene *s, sw_handle h, sw_beam *out, sw_error *err) {
  const sw_scene_wire *w = sw_scene_find_wire(s, h, err);
  if (!w) return SW_EDEAD;
  *out = w->beam;
  return SW_OK;
}

/* The clamp hinge at a node that looks along edge, or NULL. */
static const sw_clamp_hinge *clamp_at(const sw_plan *p, size_t node, size_t edge) {
  for (size_t c = 0; c < p->clamp_count; c++)
    if (p->clamps[c].node == node && p->clamps[c].edge == edge) return &p->clamps[c];
  return NULL;
}

static sw_vec director(const sw_system *s, const sw_clamp_hinge *h) {
  return sw_load(s->directors_now + 3 * (2 * (size_t)h->hold + (h->side > 0 ? 1 : 0)));
}

static sw_vec tangent_of(const sw_field *f, size_t e) {
  return sw_v(f->tangent[0][e], f->tangent[1][e], f->tangent[2][e]);
}

static double angle_between(sw_vec a, sw_vec b) {
  return 2.0 * asin(fmin(1.0, 0.5 * sw_dist(a, b)));
}

/* The clamp hinge at a node, whichever edge it looks along, or NULL. */
static const sw_clamp_hinge *face_at(const sw_plan *p, size_t node) {
  for (size_t c = 0; c < p->clamp_count; c++)
    if (p->clamps[c].node == node) return &p->clamps[c];
  return NULL;
}

/* Tangent and curvature at a node as seen from one of its edges. */
static void node_state(const sw_system *s, const sw_body *b, size_t node, size_t edge,
                       sw_vec *tangent, double *curvature) {
  const sw_plan *p = b->plan;
  const sw_field *f = &b->field;
  const sw_clamp_hinge *c = clamp_at(p, node, edge);
  const sw_vec own = tangent_of(f, edge);
  *curvature = 0.0;
  *tangent = own;
  if (c) {
    *tangent = director(s, c);
    *curvature = sw_clamp_curvature(c, s->directors_now, s->normals_now, own);
  } else if (p->held[edge] != SW_FREE && p->held[edge + 1] != SW_FREE &&
             (c = face_at(p, node)) != NULL) { /* from inside a grip, at its face */
    *tangent = director(s, c);
  } else if (node > 0 && node + 1 < p->nodes) {
    const sw_vec t1 = tangent_of(f, node - 1), t2 = tangent_of(f, node);
    const double l1 = p->rest[node - 1], l2 = p->rest[node];
    *tangent = sw_unit_or(sw_add(sw_scale(t1, l2), sw_scale(t2, l1)), own);
    if (p->hinge[node] > 0) *curvature = angle_between(t1, t2) / p->hinge[node];
  } else if (p->edges > 1) { /* free or pinned end: no moment, so no further bend */
    const size_t inner = node == 0 ? 1 : p->edges - 2;
    const sw_vec t2 = tangent_of(f, inner);
    const double share = 0.25 * 2.0 * p->rest[edge] / (p->rest[edge] + p->rest[inner]);
    *tangent = sw_unit_or(sw_madd(own, sw_sub(own, t2), share), own);
  }
}

/* What edges have at a place, linear between their middles. */
static double between_middles(const sw_plan *p, const double *T, double at) {
  double fraction;
  const size_t e = sw_plan_locate(p, at, &fraction);
  if (p->edges == 1) return T[0];
  size_t k = fraction < 0.5 ? (e > 0 ? e - 1 : 0) : e;
  if (k + 1 >= p->edges) k = p->edges - 2;
  const double m0 = 0.5 * (p->s[k] + p->s[k + 1]), m1 = 0.5 * (p->s[k + 1] + p->s[k + 2]);
  return T[k] + (T[k + 1] - T[k]) * (at - m0) / (m1 - m0);
}

/* Rate at which a wire that rolls turns about its axis, linear between edge middles. */
static double spin_at(const sw_system *s, const sw_body *b, double at) {
  if (!b->roll_block) return 0.0;
  const double *rate = s->v + 3 * s->nodes + b->first_roll;
  return between_middles(b->plan, rate, at);
}

/* Torque of hinge number k, of the plan's list with clamps after nodes. */
static double hinge_torque(const sw_body *b, size_t number, double length) {
  const double off = b->field.hinge_twist[number] - b->plan->rest_twist[number];
  return length > 0 ? b->plan->beam.GJ / length * off : 0.0;
}

/* The torque at a node of a wire with frames as seen from one of its edges. */
static double node_torque(const sw_body *b, size_t node, size_t edge) {
  const sw_clamp_hinge *c = clamp_at(b->plan, node, edge);
  if (!c) return hinge_torque(b, node, b->plan->hinge[node]);
  return hinge_torque(b, b->plan->nodes + (size_t)(c - b->plan->clamps), c->length);
}

/* Bend beyond that at rest, at a node as seen from one of its edges. */
static double node_flexure(const sw_system *s, const sw_body *b, size_t node, size_t edge) {
  const sw_clamp_hinge *c = clamp_at(b->plan, node, edge);
  return sw_scene_flexure(s, b, c ? b->plan->nodes + (size_t)(c - b->plan->clamps) : node);
}

/* Torque of the span that holds arc length at; 0 outside of spans. */
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
  sw_vec t0, t1;
  double k0, k1, f;
  const size_t e = sw_plan_locate(b->plan, at, &f);
  const double *x = s->system.x + 3 * (b->first_node + e);
  const double *v = s->system.v + 3 * (b->first_node + e);
  node_state(&s->system, b, e, e, &t0, &k0);
  node_state(&s->system, b, e + 1, e, &t1, &k1);
  /* cubic through both ends with their tangents; the chord keeps its length */
  const double l = b->field.length[e], h00 = (1 + 2 * f) * (1 - f) * (1 - f);
  const double h10 = f * (1 - f) * (1 - f), h01 = f * f * (3 - 2 * f), h11 = f * f * (f - 1);
  out->position = sw_add(sw_add(sw_scale(sw_load(x), h00), sw_scale(t0, l * h10)),
                         sw_add(sw_scale(sw_load(x + 3), h01), sw_scale(t1, l * h11)));
  out->velocity = sw_lerp(sw_load(v), sw_load(v + 3), f);
  out->tangent = sw_unit_or(sw_lerp(t0, t1, f), t0);
  out->curvature = k0 + f * (k1 - k0);
  out->elastic = between_middles(b->plan, s->system.tension + b->first_edge, at);
  out->tension = between_middles(b->plan, sw_system_pull(&s->system, b), at);
  out->spin = spin_at(&s->system, b, at);
  if (b->spin_block) {
    k0 = node_flexure(&s->system, b, e, e);
    k1 = node_flexure(&s->system, b, e + 1, e);
  }
  const double bent = (k0 + f * (k1 - k0)) * w->beam.radius;
  out->strain = out->elastic / w->beam.EA + bent;
  out->least_strain = out->elastic / w->beam.EA - bent;
  out->twist_moment = sw_scene_torque(&s->system, b, at);
}

sw_status sw_scene_wire_at(sw_scene *s, sw_handle h, double place, sw_point_state *out,
                           sw_error *err) {
  sw_scene_wire *w;
  SW_TRY(sw_scene_open_wire(s, h, &w, err));
  SW_TRY(sw_scene_check_place(w, place, err));
  sw_body_class_of(w)->at(s, w, &s->system.bodies[h.slot], place + w->mesh.s[0], out);
  return SW_OK;
}

sw_status sw_scene_wire_copy(sw_scene *s, sw_handle h, double *positions, double *arc,
                             double *velocities, sw_error *err) {
  sw_scene_wire *w;
  SW_TRY(sw_scene_open_wire(s, h, &w, err));
  const sw_body *b = &s->system.bodies[h.slot];
  const sw_body_class *body = sw_body_class_of(w);
  const size_t at = 3 * b->first_node;
  if (positions) body->middles(b->plan, s->system.x + at, positions);
  if (velocities) body->middles(b->plan, s->system.v + at, velocities);
  for (size_t i = 0; arc && i < w->mesh.n; i++) arc[i] = body->arc(w, b->plan, i);
  return SW_OK;
}

static const double LIGHT = 299792458.0; /* speed of light in vacuum [m/s] */

sw_status sw_scene_check_speed(const sw_scene *s, const sw_scene_wire *w, double speed,
                               sw_error *err) {
  if (speed <= LIGHT) return SW_OK;
  return sw_fail(err, SW_EINVAL,
                 "'%s' of scene '%s': set_velocity: a speed of %.6g m/s; at most %.9g m/s, that of "
                 "light",
                 w->name, s->name, speed, LIGHT);
}

sw_status sw_scene_wire_set_velocity(sw_scene *s, sw_handle h, sw_vec v, sw_vec omega, sw_vec about,
                                     sw_error *err) {
  sw_scene_wire *w;
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_scene_open_body(s, h, &w, err));
  const sw_body *b = &s->system.bodies[h.slot];
  for (size_t i = 0; i < b->plan->nodes; i++) {
    const sw_vec arm = sw_sub(sw_vec_at(s->system.x, b->first_node + i), about);
    SW_TRY(sw_scene_check_speed(s, w, sw_norm(sw_add(v, sw_cross(omega, arm))), err));
  }
  for (size_t i = 0; i < b->plan->nodes; i++) {
    const size_t k = 3 * (b->first_node + i);
    if (b->plan->held[i] != SW_FREE) continue;
    const sw_vec arm = sw_sub(sw_load(s->system.x + k), about);
    sw_store(s->system.v + k, sw_add(v, sw_cross(omega, arm)));
  }
  sw_system_rate_from_velocity(&s->system, h.slot);
  sw_system_forget_turning(&s->system);
  for (size_t e = 0; b->roll_block && e < b->plan->edges; e++)
    s->system.v[3 * s->system.nodes + b->first_roll + e] = sw_dot(omega, tangent_of(&b->field, e));
  sw_course_jump(&s->course);
  return SW_OK;
}

/* Places on the mesh become distances from where the wire starts now. */
static void measure_from_start(sw_wire_extremes *e, double start) {
  e->curvature.s -= start;
  e->tension.s -= start;
  e->raw.s -= start;
  e->strain.s -= start;
  e->ovalisation.s -= start;
  e->torsion.s -= start;
  e->folding.s -= start;
}

sw_status sw_scene_wire_extremes(sw_scene *s, sw_handle h, sw_wire_extremes *now,
                                 sw_wire_extremes *run, sw_error *err) {
  sw_scene_wire *w;
  SW_TRY(sw_scene_open_wire(s, h, &w, err));
  sw_scene_wire_now(s, h.slot, now);
  *run = w->extremes;
  sw_scene_keep_extremes(run, now);
  sw_scene_run_tension(s, h.slot, now, run);
  measure_from_start(now, w->mesh.s[0]);
  measure_from_start(run, w->mesh.s[0]);
  return SW_OK;
}

static void add_energy(sw_energy *out, const char *kind, double value) {
  for (size_t i = 0; i < out->count; i++)
    if (strcmp(out->kind[i], kind) == 0) {
      out->value[i] += value;
      return;
    }
  out->kind[out->count] = kind;
  out->value[out->count++] = value;
}

/* Explicit methods have lumped masses. */
static int lumped(const sw_scene *s) {
  return s->course.has_stepper && !(s->course.method->flags & SW_INTEGRATOR_IMPLICIT);
}

/* Of the forces on one body. */
static void add_terms(sw_scene *s, size_t body, sw_energy *out) {
  sw_system_show(&s->system, body);
  for (size_t k = 0; k < s->system.bodies[body].term_count; k++) {
    const sw_term *term = &s->system.bodies[body].terms[k];
    double other;
    const double energy = sw_system_term_energy(&s->system, body, k, &other);
    add_energy(out, term->cls->stores ? term->cls->stores : term->cls->name, energy - other);
    if (other != 0) add_energy(out, term->cls->corrects ? term->cls->corrects : "bend", other);
  }
}

static void collect_energy(sw_scene *s, sw_energy *out) {
  out->count = 0;
  add_energy(out, "kinetic", sw_system_kinetic(&s->system, lumped(s)));
  for (size_t b = 0; b < s->system.body_count; b++) add_terms(s, b, out);
  out->dissipated = sw_system_dissipated(&s->system, &out->has_dissipated);
  if (sw_scene_has_contact(s)) add_energy(out, "contact", sw_scene_contact_energy(s));
  if (s->crowd) add_energy(out, "repel", sw_crowd_energy(s->crowd, &s->system));
  if (s->system.joins) add_energy(out, "join", sw_joins_energy(&s->system));
}

sw_status sw_scene_energy(sw_scene *s, sw_energy *out, sw_error *err) {
  SW_TRY(sw_scene_readable(s, err));
  SW_TRY(sw_scene_still(s, err));
  SW_TRY(sw_scene_build(s, err));
  SW_TRY(sw_system_place_holds(&s->system, s->time, NULL, NULL, NULL, err));
  collect_energy(s, out);
  return SW_OK;
}

sw_status sw_scene_body_energy(sw_scene *s, sw_handle h, sw_energy *out, sw_error *err) {
  sw_scene_wire *w;
  SW_TRY(sw_scene_still(s, err));
  SW_TRY(sw_scene_open_body(s, h, &w, err));
  *out = (sw_energy){0};
  add_energy(out, "kinetic", sw_body_kinetic(&s->system, h.slot, lumped(s)));
  add_terms(s, h.slot, out);
  for (size_t k = 0; k < s->system.bodies[h.slot].term_count; k++) {
    const double *history = s->system.bodies[h.slot].terms[k].history;
    if (history) out->dissipated += history[0], out->has_dissipated = 1;
  }
  return SW_OK;
}

sw_status sw_scene_penetration(sw_scene *s, double *now, sw_extreme *deepest, sw_error *err) {
  SW_TRY(sw_scene_readable(s, err));
  *now = s->built ? sw_scene_deepest(s, NULL) : 0.0;
  *deepest = s->deepest;
  return SW_OK;
}

/* --- frames ------------------------------------------------------------------ */

void sw_scene_frame_energies(sw_scene *s, double out[SW_FRAME_ENERGIES]) {
  sw_energy e;
  collect_energy(s, &e);
  memset(out, 0, SW_FRAME_ENERGIES * sizeof *out);
  for (size_t i = 0; i < e.count; i++) {
    const int kind = strcmp(e.kind[i], "kinetic") == 0   ? 0
                     : strcmp(e.kind[i], "gravity") == 0 ? 2
                                                         : 1;
    out[kind] += e.value[i];
  }
}
