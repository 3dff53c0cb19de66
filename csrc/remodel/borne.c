/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A string's bending force pulls along its edges by EI curvature^2, that of a rod does not
 * (force/flex.c). So at the same axial force their springs are not stretched alike, and a wire that
 * changes from one to the other gets edges of other lengths. Shifting nodes along the wire would
 * leave sharp bends beside clamps; so all of the wire is shifted as its bends ask for
 * (body/bends.h). */
#include "remodel/borne.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "body/bends.h"
#include "body/build.h"
#include "body/join.h"
#include "link/hold.h"
#include "scene/wire.h"
#include "system/axial.h"
#include "system/system.h"

/* Lists stretches (2 x count, to be freed) of the wire that its living holds and joints keep [m].
 */
static sw_status list_held(const sw_scene *s, size_t wire, double **out, size_t *count) {
  const size_t joins = sw_scene_join_places(s, wire, NULL);
  size_t n = 0;
  *count = 0;
  double *held = *out = sw_alloc(2 * (sw_scene_living_holds(s) + joins) + 1, sizeof *held);
  if (!held) return SW_ENOMEM;
  double *joined =
      held + 2 * sw_scene_living_holds(s) + joins; /* read before they are written over */
  sw_scene_join_places(s, wire, joined);
  SW_EACH(hold, h, s)
    if (h->alive && h->wire == wire) held[n++] = h->s1, held[n++] = h->s2;
  for (size_t k = 0; k < joins; k++) {
    const double at = joined[k];
    held[n++] = at, held[n++] = at;
  }
  *count = n / 2;
  return SW_OK;
}

sw_status sw_line_carry(const sw_scene *s, size_t wire, sw_mesh *to) {
  const sw_mesh *from = &sw_scene_wire_in((sw_scene *)s, wire)->mesh;
  const double near = 1e-9 * (from->s[from->n - 1] - from->s[0]);
  size_t count = 0;
  sw_mesh fresh = {0};
  double *held SW_LOCAL = NULL;
  SW_TRY(list_held(s, wire, &held, &count));
  for (size_t i = 0; i < to->n; i++)
    for (size_t k = 0; k < 2 * count; k++)
      if (fabs(to->s[i] - held[k]) <= near) to->s[i] = held[k];
  SW_TRY(sw_mesh_resample(from, to->s, to->n, held, count, &fresh));
  fresh.spacing = to->spacing;
  sw_mesh_free(to);
  *to = fresh;
  return SW_OK;
}

/* --- borne forces ---------------------------------------------------------------------- */

sw_status sw_borne_read(sw_scene *s, size_t wire, sw_borne *out) {
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[wire];
  const sw_plan *p = b->plan;
  *out = (sw_borne){.force = NULL};
  if (!b->bears || !system->borne || p->web) return SW_OK;
  out->at.s = sw_alloc(p->nodes, sizeof *out->at.s);
  out->force = sw_alloc(p->edges, sizeof *out->force);
  if (!out->at.s || !out->force) return sw_borne_free(out), SW_ENOMEM;
  sw_system_begin_borne(system);
  memcpy(out->force, system->borne + b->first_edge, p->edges * sizeof *out->force);
  memcpy(out->at.s, p->s, p->nodes * sizeof *out->at.s);
  out->at.n = p->nodes;
  return SW_OK;
}

void sw_borne_free(sw_borne *b) { SW_FREE_ALL(b->at.s, b->force); }

/* Adds the old edges' forces of system/borne.h to the forces of the wire's edges. */
static sw_status add_old(sw_scene *s, size_t wire, const sw_borne *old, double *force) {
  const sw_mesh *m = &sw_scene_wire_in(s, wire)->mesh;
  size_t count = 0;
  double *held SW_LOCAL = NULL;
  if (!old->at.n) return SW_OK;
  SW_TRY(list_held(s, wire, &held, &count));
  for (size_t e = 0; e + 1 < m->n; e++)
    force[e] += sw_mesh_edge_value(&old->at, old->force, sw_mesh_middle(m, e), held, count);
  return SW_OK;
}

/* Gives the wire's edges the lengths that their springs ask for. Its bends stay. */
static sw_status give_lengths(sw_scene *s, size_t wire, const sw_wire_bends *bends) {
  sw_mesh *m = &sw_scene_wire_in(s, wire)->mesh, same = {0};
  int done;
  SW_TRY(sw_scene_give_bends(s, wire, bends, m->s, m->n, NULL, &done));
  SW_TRY(sw_mesh_copy(m, &same));
  /* along the wire, where it is straight or no shape was found */
  const sw_status status = sw_line_carry(s, wire, &same);
  if (status != SW_OK) {
    sw_mesh_free(&same);
    return status;
  }
  sw_mesh_free(m);
  *m = same;
  return SW_OK;
}

/* --- sharing ---------------------------------------------------------------------------- */

/* What is borne is linear in the strains of edges that keep their directions: any strain finds the
 * slopes [-]. */
static const double PROBE = 1e-3;

/* A line's edges: the whole axial force, the part of system/borne.h [N], and the slope of the
 * latter over the springs' force of the edge before, its own and the edge after (3 x edges) [-];
 * room (edges). */
typedef struct share {
  size_t edges;
  double *whole, *borne, *slope, *room;
} share;

static sw_status new_share(size_t edges, share *out) {
  double *p = sw_alloc(6 * edges, sizeof *p);
  if (!p) return SW_ENOMEM;
  *out = (share){edges, p, p + edges, p + 2 * edges, p + 5 * edges};
  return SW_OK;
}

/* Finds the slopes of every third edge, in the built scene. x: its nodes. */
static void probe(sw_system *s, const sw_body *b, const double *x, size_t first, share *out) {
  double *moved = s->x + 3 * b->first_node;
  const double *now = s->borne + b->first_edge;
  sw_vec shift = sw_v(0, 0, 0);
  for (size_t e = 0; e < out->edges; e++) {
    const sw_vec way = sw_sub(sw_vec_at(x, e + 1), sw_vec_at(x, e));
    if (e % 3 == first) /* longer by PROBE times its unstressed length */
      shift = sw_add(shift, sw_scale(sw_unit_or(way, sw_v(0, 0, 0)), PROBE * b->plan->rest[e]));
    sw_store(moved + 3 * e + 3, sw_add(sw_vec_at(x, e + 1), shift));
  }
  sw_system_begin_borne(s);
  for (size_t e = 0; e < out->edges; e++)
    for (size_t k = 0; k < 3; k++) /* edge e + k - 1 */
      if ((e + k + 2) % 3 == first)
        out->slope[3 * e + k] = (now[e] - out->borne[e]) / (PROBE * b->plan->beam.EA);
}

/* Reads the axial forces of the built scene's edges, and the slopes. SW_ENOMEM. */
static sw_status read_share(sw_scene *s, size_t wire, share *out) {
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[wire];
  const size_t size = 3 * b->plan->nodes * sizeof(double);
  memset(out->borne, 0, 4 * out->edges * sizeof *out->borne); /* and the slopes */
  if (!b->bears || !system->borne) return SW_OK;
  double *x SW_LOCAL = sw_alloc(3 * b->plan->nodes, sizeof *x);
  if (!x) return SW_ENOMEM;
  memcpy(x, system->x + 3 * b->first_node, size);
  sw_system_begin_borne(system);
  memcpy(out->borne, system->borne + b->first_edge, out->edges * sizeof *out->borne);
  for (size_t k = 0; k < 3; k++) probe(system, b, x, k, out);
  memcpy(system->x + 3 * b->first_node, x, size);
  sw_system_begin_borne(system);
  return SW_OK;
}

/* Changes the springs' forces T so that they and the forces of system/borne.h then are the
 * whole. */
static void solve(const share *h, double *T) {
  double *upper = h->room, *rest = h->borne;
  for (size_t e = 0; e < h->edges; e++) { /* Gauss; the matrix is 1 + slope */
    const double *k = h->slope + 3 * e;
    const double lower = e ? k[0] : 0, above = e ? upper[e - 1] : 0;
    const double diagonal = 1.0 + k[1] - lower * above;
    upper[e] = k[2] / diagonal;
    rest[e] = (h->whole[e] - T[e] - rest[e] - (e ? lower * rest[e - 1] : 0)) / diagonal;
  }
  for (size_t e = h->edges; e-- > 0;) {
    if (e + 1 < h->edges) rest[e] -= upper[e] * rest[e + 1];
    T[e] += rest[e];
  }
}

enum {
  TURNS = 3
}; /* edges turn as they get other lengths, which changes the forces of system/borne.h a little */

static sw_status share_out(sw_scene *s, size_t wire, const sw_borne *old, share *h,
                           sw_wire_bends *bends, sw_error *err) {
  sw_mesh *m = &sw_scene_wire_in(s, wire)->mesh;
  for (int k = 0; k < TURNS; k++) {
    SW_TRY(read_share(s, wire, h));
    SW_TRY(sw_scene_unbuild(s));
    if (k == 0) {
      SW_TRY(sw_scene_read_bends(s, wire, bends));
      memcpy(h->whole, m->tension, h->edges * sizeof *h->whole);
      SW_TRY(add_old(s, wire, old, h->whole));
    }
    solve(h, m->tension);
    SW_TRY(give_lengths(s, wire, bends));
    SW_TRY(sw_scene_build(s, err));
  }
  return SW_OK;
}

sw_status sw_borne_exchange(sw_scene *s, size_t wire, const sw_borne *old, sw_error *err) {
  const sw_body *b = &sw_scene_system(s)->bodies[wire];
  if (b->plan->web || (!old->at.n && !b->bears)) return SW_OK;
  share h = {0};
  sw_wire_bends bends = {0};
  sw_status status = new_share(b->plan->edges, &h);
  if (status == SW_OK) status = share_out(s, wire, old, &h, &bends, err);
  sw_free(h.whole);
  sw_wire_bends_free(&bends);
  return status == SW_ENOMEM ? sw_fail(err, status, "remodel: out of memory") : status;
}
