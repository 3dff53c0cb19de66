/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Moves material frames between the meshes and the system. */
#include "body/spin.h"

#include <math.h>
#include <string.h>

#include "link/hold.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "state/clamp.h"
#include "state/hinge.h"
#include "state/mesh.h"

static sw_edge_frame edge_frame(const double *nodes, const double *normals, size_t e) {
  const sw_vec t = sw_unit_or(sw_sub(sw_vec_at(nodes, e + 1), sw_vec_at(nodes, e)), sw_v(1, 0, 0));
  return (sw_edge_frame){t, sw_vec_at(normals, e)};
}

/* Returns the scene's living hold of this number. */
static const sw_hold *hold_number(const sw_scene *s, int number) {
  SW_EACH(hold, h, s)
    if (h->alive && number-- == 0) return h;
  return NULL;
}

static void set_rest(sw_plan *p, size_t number, const sw_edge_frame *a, const sw_edge_frame *b) {
  p->rest_twist[number] = sw_hinge_twist(a, b, 0.0);
  sw_hinge_bend(a, b, p->rest_twist[number], p->rest_bend + 2 * number);
}

/* Sets the rest values of the hinges at nodes from .. to, and of all clamps. */
static void unloaded_between(const sw_scene *s, size_t wire, sw_plan *p, size_t from, size_t to) {
  const sw_mesh *m = &sw_scene_wire_in(s, wire)->mesh;
  for (size_t i = from; i <= to && i + 1 < p->nodes; i++) {
    const sw_edge_frame a = edge_frame(m->rest, m->rest_normal, i - 1);
    const sw_edge_frame b = edge_frame(m->rest, m->rest_normal, i);
    set_rest(p, i, &a, &b);
  }
  for (size_t c = 0; c < p->clamp_count; c++) {
    const int leaves = p->clamps[c].side > 0;
    const sw_mesh_frame *f = &hold_number(s, p->clamps[c].hold)->frame[leaves];
    const sw_edge_frame held = {f->rest_tangent, f->rest_normal};
    const sw_edge_frame edge = edge_frame(m->rest, m->rest_normal, p->clamps[c].edge);
    set_rest(p, p->nodes + c, leaves ? &held : &edge, leaves ? &edge : &held);
  }
}

sw_status sw_scene_unloaded(const sw_scene *s, size_t wire, sw_plan *p) {
  SW_TRY(sw_plan_add_rest(p));
  unloaded_between(s, wire, p, 1, p->nodes);
  return SW_OK;
}

void sw_scene_unloaded_near(const sw_scene *s, size_t wire, sw_plan *p, size_t node) {
  unloaded_between(s, wire, p, node > 1 ? node - 1 : 1, node + 1);
}

static sw_edge_frame present(const sw_field *f, size_t e) {
  return (sw_edge_frame){sw_field_tangent(f, e),
                         sw_v(f->normals[0][e], f->normals[1][e], f->normals[2][e])};
}

double sw_scene_hinge_bend(const sw_system *s, const sw_body *body, size_t number, double bend[2]) {
  const sw_plan *p = body->plan;
  const sw_field *f = &body->field;
  sw_edge_frame a, b;
  double length;
  if (number < p->nodes) {
    length = p->hinge[number];
    if (!(length > 0) || number == 0 || number + 1 == p->nodes) return 0;
    a = present(f, number - 1), b = present(f, number);
  } else {
    const sw_clamp_hinge *c = &p->clamps[number - p->nodes];
    const size_t at = 2 * (size_t)c->hold + (c->side > 0 ? 1 : 0);
    const sw_edge_frame held = {sw_vec_at(s->directors_now, at), sw_vec_at(s->normals_now, at)};
    length = c->length;
    a = c->side > 0 ? held : present(f, c->edge);
    b = c->side > 0 ? present(f, c->edge) : held;
  }
  sw_hinge_bend(&a, &b, f->hinge_twist[number], bend);
  return length;
}

double sw_scene_flexure(const sw_system *s, const sw_body *body, size_t number) {
  double bend[2] = {0, 0};
  const double length = sw_scene_hinge_bend(s, body, number, bend);
  const double *rest = body->plan->rest_bend + 2 * number;
  return length > 0 ? hypot(bend[0] - rest[0], bend[1] - rest[1]) / length : 0;
}

/* Of a wire that is curved when unloaded. A clamp's hinge has the length that gives the right
 * moment for a change of the bend. The unloaded bend is that between the tangent at the clamp and
 * an edge, over half of the edge. */
static double curved_at_clamp(const sw_system *s, const sw_body *body, size_t clamp) {
  const sw_plan *p = body->plan;
  const size_t number = p->nodes + clamp;
  double bend[2] = {0, 0};
  const double hinge = sw_scene_hinge_bend(s, body, number, bend);
  const double half = 0.5 * p->rest[p->clamps[clamp].edge];
  const double *rest = p->rest_bend + 2 * number;
  return hypot((bend[0] - rest[0]) / hinge + rest[0] / half,
               (bend[1] - rest[1]) / hinge + rest[1] / half);
}

double sw_scene_clamp_curvature(const sw_system *s, const sw_body *b, const sw_clamp_hinge *h) {
  const sw_plan *p = b->plan;
  const sw_vec t = sw_field_tangent(&b->field, h->edge);
  if (p->rest_bend && p->beam.curved && !(h->softer > 0))
    return curved_at_clamp(s, b, (size_t)(h - p->clamps));
  return sw_clamp_curvature(h, s->directors_now, s->normals_now, t);
}

static const double AS_DRAWN = 1e-9; /* rounding of normals and twists [-], [rad] */

void sw_scene_frame_out(sw_scene *s, size_t wire) {
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[wire];
  const sw_plan *p = b->plan;
  const double *state = system->frames + b->first_frame, *twist = state + 3 * p->edges;
  sw_mesh *m = &sw_scene_wire_in(s, wire)->mesh;
  for (size_t e = 0; e < p->edges; e++) {
    const sw_vec now = sw_v(state[e], state[p->edges + e], state[2 * p->edges + e]);
    if (sw_dist(now, sw_vec_at(m->normal, e)) > AS_DRAWN) m->drawn = 0;
    sw_store(m->normal + 3 * e, now);
  }
  memcpy(m->twist, twist, p->nodes * sizeof *twist);
  for (size_t i = 0; i < p->nodes; i++)
    if (p->held[i] != SW_FREE && !(p->hinge[i] > 0)) m->twist[i] = 0;
  for (size_t c = 0; c < p->clamp_count; c++) m->twist[p->clamps[c].node] += twist[p->nodes + c];
  for (size_t i = 0; i < p->nodes; i++)
    if (fabs(m->twist[i]) > AS_DRAWN) m->drawn = 0; /* a wire is drawn without twist */
  if (!b->roll_block) return;
  const size_t at = 3 * system->nodes + b->first_roll;
  memcpy(m->turn, system->x + at, p->edges * sizeof *m->turn);
  memcpy(m->spin, system->v + at, p->edges * sizeof *m->spin);
}

/* Returns a clamp hinge's twist from the mesh's twist of its node: half of it where both sides have
 * a hinge. */
static double twist_before(const sw_plan *p, const sw_mesh *m, size_t clamp) {
  int sides = 0;
  for (size_t c = 0; c < p->clamp_count; c++) sides += p->clamps[c].node == p->clamps[clamp].node;
  return m->twist[p->clamps[clamp].node] / sides;
}

void sw_scene_frame_in(sw_scene *s) {
  sw_system *system = sw_scene_system(s);
  for (size_t w = 0; w < sw_scene_wire_slots(s); w++) {
    const sw_body *b = &system->bodies[w];
    const sw_plan *p = b->plan;
    const sw_mesh *m = &sw_scene_wire_in(s, w)->mesh;
    if (!b->spin_block) continue;
    double *state = system->frames + b->first_frame, *twist = state + 3 * p->edges;
    for (size_t e = 0; e < p->edges; e++)
      for (size_t k = 0; k < 3; k++) state[k * p->edges + e] = m->normal[3 * e + k];
    memcpy(twist, m->twist, p->nodes * sizeof *twist);
    for (size_t c = 0; c < p->clamp_count; c++) twist[p->nodes + c] = twist_before(p, m, c);
    if (b->roll_block) {
      const size_t at = 3 * system->nodes + b->first_roll;
      memcpy(system->x + at, m->turn, p->edges * sizeof *m->turn);
      memcpy(system->v + at, m->spin, p->edges * sizeof *m->spin);
    }
    sw_system_measure_frames(system, w);
  }
}
