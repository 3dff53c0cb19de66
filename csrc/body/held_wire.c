/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A line with its holds, before the scene is built: the turns at its nodes and clamps. */
#include "body/held_wire.h"

#include "body/chain.h"
#include "force/force.h"
#include "scene/forces.h"
#include "scene/lookup.h"
#include "scene/wire.h"
#include "state/hinge.h"

int sw_held_remembers(const sw_scene *s, size_t wire) {
  SW_EACH(force, f, s) {
    const int bends = f->cls->state_size && !(f->cls->flags & SW_FORCE_ANY_SHAPE);
    if (f->alive && bends && (f->wire < 0 || f->wire == (long)wire)) return 1;
  }
  return 0;
}

/* A wire whose kinetic energy is more than this share of its bending energy moves [-]. */
static const double MOVES = 0.1;

int sw_held_moves(const sw_scene *s, size_t wire, const sw_bends *b) {
  const sw_scene_wire *w = sw_scene_wire_in((sw_scene *)s, wire);
  const sw_mesh *m = &w->mesh;
  double kinetic = 0, bending = 0;
  for (size_t i = 0; i < m->n; i++)
    kinetic += 0.25 * w->beam.mass * sw_norm2(sw_vec_at(m->v, i)) *
               (m->s[i + 1 < m->n ? i + 1 : i] - m->s[i > 0 ? i - 1 : 0]);
  for (size_t k = 0; k + 1 < b->count; k++)
    bending += 0.5 * w->beam.EI * sw_norm2(b->list[k].vector) * (b->list[k + 1].s - b->list[k].s);
  return kinetic > MOVES * bending;
}

const sw_hold *sw_held_by(const sw_held_wire *v, double s) {
  for (size_t k = 0; k < v->count; k++)
    if (v->holds[k]->s1 <= s && s <= v->holds[k]->s2) return v->holds[k];
  return NULL;
}

const sw_clamp_hinge *sw_held_clamp(const sw_held_wire *v, size_t i, int side) {
  SW_ITEMS(const sw_clamp_hinge, h, v->plan->clamps, v->plan->clamp_count) {
    if (h->node == i && h->side == side) return h;
  }
  return NULL;
}

static sw_vec in_world(const sw_held_wire *v, const sw_hold *h, sw_vec held) {
  return h == v->fresh ? held : sw_rotate(h->turn, held); /* a fresh one has no pose yet */
}

sw_vec sw_held_director(const sw_held_wire *v, const sw_hold *h, int end) {
  return v->unloaded ? h->frame[end > 0].rest_tangent : in_world(v, h, h->director[end > 0]);
}

double sw_held_joint(const sw_held_wire *v, size_t i) {
  const sw_mesh *m = v->mesh;
  return v->unloaded ? 0.5 * (m->s[i + 1] - m->s[i - 1]) : v->plan->hinge[i];
}

double sw_held_clamp_joint(const sw_held_wire *v, const sw_clamp_hinge *h) {
  return v->unloaded ? 0.5 * v->plan->rest[h->edge] : h->length;
}

/* An edge or a held direction: its frames now and of the unloaded wire. */
typedef struct piece {
  sw_edge_frame now, rest;
} piece;

/* 1 if the present wire is compared with an unloaded one that may be bent. */
static int compares(const sw_held_wire *v) { return v->mesh->rest && !v->unloaded; }

static piece edge_of(const sw_held_wire *v, size_t e) {
  const sw_mesh *m = v->mesh;
  piece p = {.now.t = sw_edge_direction(v->nodes, e)};
  if (!compares(v)) return p;
  p.now.m1 = sw_vec_at(m->normal, e);
  p.rest = (sw_edge_frame){sw_edge_direction(m->rest, e), sw_vec_at(m->rest_normal, e)};
  return p;
}

static piece direction_of(const sw_held_wire *v, const sw_hold *h, int end) {
  const sw_mesh_frame *f = &h->frame[end > 0];
  piece p = {.now.t = sw_held_director(v, h, end)};
  if (!compares(v)) return p;
  p.now.m1 = in_world(v, h, f->normal);
  p.rest = (sw_edge_frame){f->rest_tangent, f->rest_normal};
  return p;
}

static sw_vec rest_turn(const sw_held_wire *v, const piece *a, const piece *b) {
  if (!compares(v)) return sw_v(0, 0, 0);
  const sw_vec turn = sw_chain_turn(a->rest.t, b->rest.t); /* across the first one */
  const double one = sw_dot(turn, a->rest.m1);
  const double two = sw_dot(turn, sw_cross(a->rest.t, a->rest.m1));
  return sw_madd(sw_scale(a->now.m1, one), sw_cross(a->now.t, a->now.m1), two);
}

static sw_vec flexure(const sw_held_wire *v, const piece *a, const piece *b) {
  return sw_sub(sw_chain_turn(a->now.t, b->now.t), rest_turn(v, a, b));
}

sw_vec sw_held_rest_turn(const sw_held_wire *v, size_t i) {
  const piece a = edge_of(v, i - 1), b = edge_of(v, i);
  return rest_turn(v, &a, &b);
}

sw_vec sw_held_flexure(const sw_held_wire *v, size_t i) {
  const piece a = edge_of(v, i - 1), b = edge_of(v, i);
  return flexure(v, &a, &b);
}

sw_vec sw_held_rest_turn_beside(const sw_held_wire *v, const sw_hold *h, size_t i, int side,
                                int end) {
  const piece held = direction_of(v, h, end), edge = edge_of(v, side > 0 ? i : i - 1);
  return side > 0 ? rest_turn(v, &held, &edge) : rest_turn(v, &edge, &held);
}

sw_vec sw_held_flexure_beside(const sw_held_wire *v, const sw_hold *h, size_t i, int side,
                              int end) {
  const piece held = direction_of(v, h, end), edge = edge_of(v, side > 0 ? i : i - 1);
  return side > 0 ? flexure(v, &held, &edge) : flexure(v, &edge, &held);
}
