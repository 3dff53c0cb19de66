/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies that are webs: meshes of particles ring by ring along a wire, and objects of particles. */
#include "state/web.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "body/body.h"
#include "body/section.h"
#include "link/hold.h"
#include "state/mesh.h"
#include "strand/ring.h"

/* --- place ---------------------------------------------------------------------- */

static sw_body_state state(const sw_scene_wire *w) {
  const sw_strand *p = &w->strand;
  return (sw_body_state){p->web->particles, p->x, p->v, p->a, p->axial, p->rate};
}

static sw_status plan(const sw_scene *s, size_t w, const sw_hold_place *places, size_t count,
                      sw_plan **out) {
  (void)places, (void)count; /* holds know their particles */
  sw_web *web = sw_scene_wire_in(s, w)->strand.web;
  int *held SW_LOCAL = sw_alloc(web->particles, sizeof *held);
  if (!held) return SW_ENOMEM;
  SW_EACH(hold, h, s) {
    if (!h->alive || h->wire != w) continue;
    for (size_t i = 0; i < h->count; i++) held[h->particle[i]] = SW_HELD;
  }
  return sw_plan_of_web(&sw_scene_wire_in(s, w)->beam, web, held, out);
}

static sw_status take(sw_scene *scene, size_t w) {
  const sw_system *s = sw_scene_system(scene);
  const sw_body *b = &s->bodies[w];
  sw_scene_wire *wire = sw_scene_wire_in(scene, w);
  sw_strand *p = &wire->strand;
  const size_t at = 3 * b->first_node, size = 3 * b->plan->nodes * sizeof(double);
  memcpy(p->x, s->x + at, size);
  memcpy(p->v, s->v + at, size);
  memcpy(p->a, s->a + at, size);
  memcpy(p->axial, s->tension + b->first_edge, p->web->links * sizeof(double));
  sw_free(p->rate);
  p->rate = b->axial_time > 0 ? sw_alloc(p->web->links, sizeof *p->rate) : NULL;
  if (p->rate)
    memcpy(p->rate, s->strain_rate + b->first_edge, p->web->links * sizeof(double));
  else if (b->axial_time > 0)
    return SW_ENOMEM;
  for (size_t r = 0; r < p->web->rings; r++) {
    sw_store(wire->mesh.x + 3 * r, sw_web_centre(p->web, p->x, r));
    sw_store(wire->mesh.v + 3 * r, sw_web_centre(p->web, p->v, r));
  }
  return SW_OK;
}

/* --- hold ----------------------------------------------------------------------- */

static sw_status place(sw_scene *s, sw_hold *h, const sw_hold_args *a, int fresh SW_UNUSED) {
  const sw_mesh *m = &sw_scene_wire_in(s, h->wire)->mesh;
  sw_body_interval(m, a, &h->s1, &h->s2);
  sw_strand_rings(m, &h->s1, &h->s2);
  return SW_OK;
}

/* 1 if a hold of this class holds the particle. */
static int holds(const sw_web *web, const sw_link_class *cls, size_t particle) {
  const size_t ring = sw_web_ring_of(web, particle);
  return cls->hold->direction || !sw_web_is_ring(web, ring) ||
         particle - web->first[ring] == web->axis;
}

/* Finds the held particles in the hold's frame. If a direction is given, the hold's pose is turned
 * to it; the wire is not yet. */
static sw_status grasp(const sw_scene_wire *w, sw_hold *h, const sw_hold_args *a) {
  const sw_web *web = w->strand.web;
  const sw_mesh *m = &w->mesh;
  const size_t first = sw_mesh_node(m, h->s1), last = sw_mesh_node(m, h->s2);
  const size_t room = web->first[last + 1] - web->first[first];
  SW_TRY(
      SW_ALLOC_ALL(SW_ROOM(h->s, room), SW_ROOM(h->local, 3 * room), SW_ROOM(h->particle, room)));
  size_t i = first < last ? first : first + 1 < m->n ? first : first - 1;
  while (i + 2 < m->n && m->s[i + 1] < a->s) i++;
  const double f = fmin(1.0, fmax(0.0, (a->s - m->s[i]) / (m->s[i + 1] - m->s[i])));
  const sw_vec origin = sw_lerp(sw_vec_at(m->x, i), sw_vec_at(m->x, i + 1), f);
  const sw_quat turn = sw_quat_between(sw_mesh_tangent_at(m, a->s), h->director[1]);
  for (size_t p = web->first[first]; p < web->first[last + 1]; p++) {
    if (!holds(web, h->cls, p)) continue;
    h->s[h->count] = web->s[p];
    h->particle[h->count] = (uint32_t)p;
    sw_store(h->local + 3 * h->count++, sw_sub(sw_vec_at(w->strand.x, p), origin));
  }
  h->drive.pose = (sw_pose){origin, turn};
  h->last_pose = h->drive.pose;
  h->turn = sw_quat_identity();
  return SW_OK;
}

static sw_status refine(const sw_scene *s SW_UNUSED, const sw_hold *h SW_UNUSED,
                        sw_mesh *m SW_UNUSED) {
  return SW_OK;
}

static void add_held(const sw_body *b, const sw_hold *h, sw_held_node node, sw_system *s) {
  for (size_t i = 0; i < h->count; i++) {
    node.node = b->first_node + h->particle[i], node.local = sw_vec_at(h->local, i);
    s->held[s->held_count++] = node;
  }
}

/* taken (particles): 1 + the slot of the hold that has the particle; 0 = none. */
static sw_status mark(const sw_scene *s, size_t k, size_t *taken, sw_error *err) {
  const sw_hold *h = sw_scene_hold_in(s, k);
  const size_t particles = sw_scene_wire_in(s, h->wire)->strand.web->particles;
  for (size_t i = 0; i < h->count; i++) {
    const size_t p = h->particle ? h->particle[i] : particles;
    if (p >= particles)
      return sw_fail(err, SW_EINVAL, "wire '%s': '%s' holds a particle that does not exist",
                     sw_scene_wire_in(s, h->wire)->name, h->name);
    if (taken[p]) return sw_scene_held_twice(s, sw_scene_hold_in(s, taken[p] - 1), h, err);
    taken[p] = k + 1;
  }
  return SW_OK;
}

static sw_status check_holds(const sw_scene *s, size_t wire, sw_error *err) {
  size_t *taken = NULL;
  sw_status status = SW_OK;
  for (size_t k = 0; k < sw_scene_hold_slots(s) && status == SW_OK; k++) {
    if (!sw_scene_hold_in(s, k)->alive || sw_scene_hold_in(s, k)->wire != wire) continue;
    if (!taken) taken = sw_alloc(sw_scene_wire_in(s, wire)->strand.web->particles, sizeof *taken);
    if (!taken) return sw_fail(err, SW_ENOMEM, "scene '%s': out of memory", sw_scene_name(s));
    status = mark(s, k, taken, err);
  }
  sw_free(taken);
  return status;
}

/* --- carry over ----------------------------------------------------------------- */

/* Particles stay as they are. */
static void carry_over(const sw_body *b, const double *s SW_UNUSED, size_t count, size_t *new_node,
                       size_t *new_edge) {
  for (size_t k = 0; k < count; k++) new_node[k] = new_edge[k] = b->first_node + k;
}

/* --- read ----------------------------------------------------------------------- */

static void middles(const sw_plan *p, const double *values, double *out) {
  for (size_t r = 0; r < p->web->rings; r++) sw_web_middle(p->web, values, r, out + 3 * r);
}

static double arc(const sw_scene_wire *w, const sw_plan *p SW_UNUSED, size_t ring) {
  return w->mesh.s[ring];
}

const sw_body_class sw_body_web = {.held = "particles",
                                   .apart = 0.0,
                                   .state = state,
                                   .plan = plan,
                                   .take = take,
                                   .widen = sw_strand_rings,
                                   .place = place,
                                   .grasp = grasp,
                                   .refine = refine,
                                   .add_held = add_held,
                                   .check_holds = check_holds,
                                   .carry_over = carry_over,
                                   .at = sw_strand_at,
                                   .middles = middles,
                                   .arc = arc};
