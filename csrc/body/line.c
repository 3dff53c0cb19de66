/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies that are lines: the nodes of a wire are those of its mesh. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "body/bends.h"
#include "body/body.h"
#include "body/hold.h"
#include "body/join.h"
#include "body/spin.h"
#include "link/hold.h"
#include "state/hinge.h"
#include "state/mesh.h"

static int is_on(const sw_hold *h, size_t wire) { return h->alive && h->wire == wire; }

/* Writes the arc lengths that holds and joins need as nodes; returns their number. */
static size_t kept_places(const sw_scene *s, size_t wire, double *out) {
  size_t n = 0;
  SW_EACH(hold, h, s) {
    if (is_on(h, wire)) out[n++] = h->s1, out[n++] = h->s2;
  }
  return n + sw_scene_join_places(s, wire, out + n);
}

/* Returns room for these and two more, to be freed; NULL: out of memory. */
static double *new_places(const sw_scene *s, size_t wire) {
  return sw_alloc(2 * sw_scene_living_holds(s) + sw_scene_join_places(s, wire, NULL) + 2,
                  sizeof(double));
}

/* --- place ---------------------------------------------------------------------- */

static sw_body_state state(const sw_scene_wire *w) {
  const sw_mesh *m = &w->mesh;
  return (sw_body_state){m->n, m->x, m->v, m->a, m->tension, m->rate};
}

/* Returns the place of arc length s in the hold's frame. */
static sw_vec local_of(const sw_hold *h, double s) {
  size_t i = 0;
  while (i + 2 < h->count && h->s[i + 1] <= s) i++;
  if (h->count == 1) return sw_load(h->local);
  const double f = (s - h->s[i]) / (h->s[i + 1] - h->s[i]);
  return sw_lerp(sw_vec_at(h->local, i), sw_vec_at(h->local, i + 1), f);
}

void sw_line_put_held(const sw_hold *h, sw_pose pose, sw_mesh *m) {
  for (size_t i = sw_mesh_node(m, h->s1); i < m->n && m->s[i] <= h->s2; i++)
    sw_store(m->x + 3 * i, sw_pose_point(pose, local_of(h, m->s[i])));
  if (!h->formed) sw_mesh_strain_as_held(m, h->s1, h->s2);
}

/* Sets the unstressed lengths of edges that a hold has formed to their lengths in the hold. */
static void form(const sw_scene *s, size_t w, sw_plan *plan) {
  SW_EACH(hold, h, s) {
    if (!is_on(h, w) || !h->formed) continue;
    for (size_t e = sw_plan_first(plan, h->s1); e < plan->edges && plan->s[e + 1] <= h->s2; e++)
      plan->rest[e] = sw_dist(local_of(h, plan->s[e]), local_of(h, plan->s[e + 1]));
  }
}

/* Gives the plan the arcs that its wire was drawn along. SW_ENOMEM. */
static sw_status add_arcs(const sw_scene_wire *w, sw_plan *plan) {
  const sw_drawing *d = &w->drawing;
  const double length = d->length * w->mesh.scale; /* as drawn; wire may have been fed since [m] */
  if (d->count < 3 || d->segments < 2 || !(length > 0)) return SW_OK;
  double *shares = sw_alloc(plan->edges, sizeof *shares);
  int any;
  if (!shares) return SW_ENOMEM;
  const sw_status status =
      sw_mesh_arcs(d->points, d->count, d->segments, plan->s, plan->nodes, length, shares, &any);
  if (status == SW_OK && any)
    plan->drawn_arc = shares;
  else
    sw_free(shares);
  return status;
}

static sw_status plan(const sw_scene *s, size_t w, const sw_hold_place *places, size_t count,
                      sw_plan **out) {
  const sw_scene_wire *wire = sw_scene_wire_in(s, w);
  SW_TRY(sw_plan_new(&wire->beam, wire->mesh.s, wire->mesh.n, places, count, out));
  form(s, w, *out);
  if (add_arcs(wire, *out) == SW_OK) return SW_OK;
  sw_plan_release(*out);
  *out = NULL;
  return SW_ENOMEM;
}

static sw_status take(sw_scene *scene, size_t w) {
  const sw_system *s = sw_scene_system(scene);
  const sw_body *b = &s->bodies[w];
  sw_mesh *m = &sw_scene_wire_in(scene, w)->mesh;
  m->drawn = m->drawn && memcmp(m->x, s->x + 3 * b->first_node, 3 * m->n * sizeof *m->x) == 0 &&
             memcmp(m->v, s->v + 3 * b->first_node, 3 * m->n * sizeof *m->v) == 0;
  memcpy(m->x, s->x + 3 * b->first_node, 3 * m->n * sizeof *m->x);
  memcpy(m->v, s->v + 3 * b->first_node, 3 * m->n * sizeof *m->v);
  memcpy(m->a, s->a + 3 * b->first_node, 3 * m->n * sizeof *m->a);
  memcpy(m->tension, s->tension + b->first_edge, (m->n - 1) * sizeof *m->tension);
  if (b->axial_time > 0)
    memcpy(m->rate, s->strain_rate + b->first_edge, (m->n - 1) * sizeof *m->rate);
  else
    memset(m->rate, 0, m->n * sizeof *m->rate);
  if (b->spin_block) sw_scene_frame_out(scene, w);
  return SW_OK;
}

/* --- hold ----------------------------------------------------------------------- */

static void widen(const sw_mesh *m, double *s1, double *s2) { (void)m, (void)s1, (void)s2; }

/* Fewest edges between two holds. With four the bending stiffness between two clamps is 2 to 5 %
 * low, with three 5 to 10 %, and one edge would be rigid. No more than needed, because a bent
 * wire's energy grows when edges are halved. */
enum { LEAST_EDGES = 4 };

/* Finds the wire between hold h and another one; 0: none, or a third one holds it in between. */
static int gap_between(const sw_scene *s, const sw_hold *h, const sw_hold *o, double *low,
                       double *high) {
  if (!is_on(o, h->wire) || o == h) return 0;
  *low = o->s2 < h->s1 ? o->s2 : h->s2, *high = o->s2 < h->s1 ? h->s1 : o->s1;
  if (!(*low < *high)) return 0;
  SW_EACH(hold, third, s)
    if (is_on(third, h->wire) && *low < third->s1 && third->s2 < *high) return 0;
  return 1;
}

static int is_short(const sw_mesh *m, double low, double high) {
  return sw_mesh_node(m, high) - sw_mesh_node(m, low) < LEAST_EDGES;
}

/* Makes enough edges between h and the holds beside it. */
static sw_status refine_gaps(const sw_scene *s, const sw_hold *h, sw_mesh *m) {
  double *keep SW_LOCAL = new_places(s, h->wire);
  if (!keep) return SW_ENOMEM;
  const size_t count = kept_places(s, h->wire, keep);
  SW_EACH(hold, o, s) {
    double low, high;
    if (!gap_between(s, h, o, &low, &high)) continue;
    for (size_t before = 0; is_short(m, low, high) && before < m->n;) { /* or nothing is halved */
      before = m->n;
      SW_TRY(sw_mesh_halve(m, low, high, keep, count));
    }
  }
  return SW_OK;
}

/* Returns the distance of arc length s from the nearest node [m]. */
static double off_nodes(const sw_mesh *m, double s) {
  const size_t i = sw_mesh_node(m, s);
  return i > 0 ? fmin(fabs(m->s[i] - s), s - m->s[i - 1]) : fabs(m->s[i] - s);
}

/* 1 if the hold clamps the wire, so that the hinges beside it count. A feed's wire goes on moving,
 * and a frozen grip's places are given. */
static int leans(const sw_hold *h) {
  return h->cls->hold->direction && !sw_hold_passes(h) && !h->formed;
}

/* Leans a hold's nodes by way (sw_mesh_lean). Nodes that it has grasped stay in its grasp. */
static sw_status lean(sw_scene *s, sw_hold *h, int way) {
  sw_mesh *m = &sw_scene_wire_in(s, h->wire)->mesh;
  if (!leans(h)) return SW_OK;
  double *keep SW_LOCAL = new_places(s, h->wire);
  if (!keep) return SW_ENOMEM;
  const size_t count = kept_places(s, h->wire, keep);
  const size_t first = sw_mesh_node(m, h->s1), last = sw_mesh_node(m, h->s2);
  const sw_vec from = sw_vec_at(m->x, first);
  SW_TRY(sw_mesh_lean(m, first, last, way, keep, count));
  const sw_vec by = sw_unrotate(h->turn, sw_sub(sw_vec_at(m->x, first), from));
  if (!h->local || !(sw_norm(by) > 0)) return SW_OK;
  for (size_t i = 0; i < h->count; i++) sw_accumulate(h->local + 3 * i, by);
  h->shape = sw_scene_number(s); /* kept states have the one before */
  return SW_OK;
}

/* Finds places for the hold's ends. */
static sw_status place_ends(sw_scene *s, sw_hold *h, const double ends[2], double width) {
  sw_mesh *m = &sw_scene_wire_in(s, h->wire)->mesh;
  double placed[2], *keep SW_LOCAL = new_places(s, h->wire);
  if (!keep) return SW_ENOMEM;
  size_t n = kept_places(s, h->wire, keep);
  /* the end nearer to a node takes it first, whichever end arc length counts from */
  const int order = off_nodes(m, ends[1]) < off_nodes(m, ends[0]);
  SW_TRY(sw_mesh_place(m, ends[order], keep, n, &placed[order]));
  placed[!order] = placed[order];
  if (width > 0) {
    keep[n++] = placed[order];
    SW_TRY(sw_mesh_place(m, ends[!order], keep, n, &placed[!order]));
  }
  h->s1 = placed[0], h->s2 = placed[1];
  return SW_OK;
}

/* 1 if the user gives the direction that the hold holds. */
static int is_given(const sw_hold_args *a) {
  return isfinite(a->direction.x) && sw_norm(a->direction) > 0;
}

/* 1 if the wire keeps its bends as the hold comes or goes. */
static int keeps_bends(const sw_scene *s, const sw_hold *h) {
  const sw_scene_wire *w = sw_scene_wire_in(s, h->wire);
  return w->beam.EI > 0 && !w->mesh.drawn && !sw_hold_passes(h) && !h->formed;
}

/* Makes nodes for a new hold where the wire is. */
static sw_status make_nodes(sw_scene *s, sw_hold *h, const sw_hold_args *a, const double ends[2]) {
  SW_TRY(place_ends(s, h, ends, a->width));
  return refine_gaps(s, h, &sw_scene_wire_in(s, h->wire)->mesh);
}

/* Makes nodes for a hold that comes new to the wire, with the bends that the wire has. */
static sw_status place_on_bends(sw_scene *s, sw_hold *h, const sw_hold_args *a,
                                const double ends[2], int *done) {
  sw_wire_bends bends;
  sw_status status = sw_scene_read_bends(s, h->wire, &bends);
  if (status == SW_OK) status = make_nodes(s, h, a, ends);
  const double places[2] = {h->s1, h->s2};
  if (status == SW_OK) status = sw_scene_give_bends(s, h->wire, &bends, places, 2, h, done);
  sw_wire_bends_free(&bends);
  return status;
}

static sw_status place(sw_scene *s, sw_hold *h, const sw_hold_args *a, int fresh) {
  const sw_mesh *m = &sw_scene_wire_in(s, h->wire)->mesh;
  int done = 0;
  double ends[2];
  sw_body_interval(m, a, &ends[0], &ends[1]);
  if (!fresh) return place_ends(s, h, ends, a->width);
  if (is_given(a) || !keeps_bends(s, h))
    SW_TRY(make_nodes(s, h, a, ends));
  else
    SW_TRY(place_on_bends(s, h, a, ends, &done));
  return done ? SW_OK : lean(s, h, 1);
}

/* The hold lets go: the wire keeps its bends. */
static sw_status let_go(sw_scene *s, sw_hold *h) {
  sw_wire_bends bends;
  const double places[2] = {h->s1, h->s2};
  int done = 0;
  h->alive = keeps_bends(s, h);
  if (!h->alive) return lean(s, h, -1);
  sw_status status = sw_scene_read_bends(s, h->wire, &bends);
  h->alive = 0;
  if (status == SW_OK) status = sw_scene_give_bends(s, h->wire, &bends, places, 2, NULL, &done);
  sw_wire_bends_free(&bends);
  return status == SW_OK && !done ? lean(s, h, -1) : status;
}

/* Finds the held places in the hold's frame. Its origin is the point at s, its axes are the world's
 * now. By rounding, s may be beyond the wire's end: 0.2 m drawn with 10 edges are 0.2 m - 3e-17 m.
 */
static sw_status grasp(const sw_scene_wire *w, sw_hold *h, const sw_hold_args *a) {
  const sw_mesh *m = &w->mesh;
  const size_t first = sw_mesh_node(m, h->s1), last = sw_mesh_node(m, h->s2);
  const double at = fmax(m->s[first], fmin(a->s, m->s[last]));
  h->count = last - first + 1;
  SW_TRY(SW_ALLOC_ALL(SW_ROOM(h->s, h->count), SW_ROOM(h->local, 3 * h->count)));
  sw_vec origin = sw_vec_at(m->x, first);
  for (size_t i = first; i < last; i++)
    if (m->s[i + 1] >= at && m->s[i] <= at)
      origin = sw_lerp(sw_vec_at(m->x, i), sw_vec_at(m->x, i + 1),
                       (at - m->s[i]) / (m->s[i + 1] - m->s[i]));
  for (size_t i = first; i <= last; i++) {
    h->s[i - first] = m->s[i];
    sw_store(h->local + 3 * (i - first), sw_sub(sw_vec_at(m->x, i), origin));
  }
  h->drive.pose = (sw_pose){origin, sw_quat_identity()};
  h->last_pose = h->drive.pose;
  h->turn = h->drive.pose.q;
  return SW_OK;
}

/* Makes s a node of the mesh, of exactly this arc length. */
static sw_status place_exactly(sw_mesh *m, double s, const double *keep, size_t count) {
  double placed;
  SW_TRY(sw_mesh_place(m, s, keep, count, &placed));
  m->s[sw_mesh_node(m, placed)] = s;
  return SW_OK;
}

/* Makes enough edges between all holds of the wire. */
static sw_status refine_all(const sw_scene *s, size_t wire, sw_mesh *m) {
  for (size_t k = 0; k < sw_scene_hold_slots(s); k++)
    if (is_on(sw_scene_hold_in(s, k), wire)) SW_TRY(refine_gaps(s, sw_scene_hold_in(s, k), m));
  return SW_OK;
}

sw_status sw_line_refine(sw_scene *s, size_t wire) {
  return refine_all(s, wire, &sw_scene_wire_in(s, wire)->mesh);
}

sw_status sw_scene_make_places(const sw_scene *s, size_t wire, sw_mesh *m) {
  double *keep SW_LOCAL = new_places(s, wire);
  if (!keep) return SW_ENOMEM;
  const size_t n = kept_places(s, wire, keep);
  for (size_t k = 0; k < n; k++) SW_TRY(place_exactly(m, keep[k], keep, n));
  return refine_all(s, wire, m);
}

static void add_held(const sw_body *b, const sw_hold *h, sw_held_node node, sw_system *s) {
  for (size_t i = sw_plan_first(b->plan, h->s1); i < b->plan->nodes && b->plan->s[i] <= h->s2;
       i++) {
    node.node = b->first_node + i, node.local = local_of(h, b->plan->s[i]);
    s->held[s->held_count++] = node;
  }
}

static sw_status check_holds(const sw_scene *s, size_t wire, sw_error *err) {
  for (size_t k = 0; k < sw_scene_hold_slots(s); k++) {
    const sw_hold *h = sw_scene_hold_in(s, k);
    for (size_t i = 0; is_on(h, wire) && i < k; i++) {
      const sw_hold *o = sw_scene_hold_in(s, i);
      if (is_on(o, wire) && o->s1 <= h->s2 && h->s1 <= o->s2)
        return sw_scene_held_twice(s, o, h, err);
    }
  }
  return SW_OK;
}

/* --- carry over ----------------------------------------------------------------- */

/* A node is the same if its arc length is; one that was moved for a clamp starts anew. A segment is
 * the same if both its ends are. */
static void carry_over(const sw_body *b, const double *s, size_t count, size_t *new_node,
                       size_t *new_edge) {
  size_t i = 0;
  for (size_t k = 0; k < count; k++) {
    while (i < b->plan->nodes && b->plan->s[i] < s[k]) i++;
    if (i == b->plan->nodes || b->plan->s[i] != s[k]) continue;
    new_node[k] = b->first_node + i;
    if (k > 0 && new_node[k - 1] != SIZE_MAX && new_node[k - 1] + 1 == new_node[k])
      new_edge[k - 1] = new_node[k - 1];
  }
}

/* --- read ----------------------------------------------------------------------- */

static void middles(const sw_plan *p, const double *values, double *out) {
  memcpy(out, values, 3 * p->nodes * sizeof *out);
}

static double arc(const sw_scene_wire *w SW_UNUSED, const sw_plan *p, size_t node) {
  return sw_plan_place(p, node);
}

/* Apart: an edge between two holds, a quarter of this long, must differ from zero. */
const sw_body_class sw_body_line = {.held = "node",
                                    .apart = 1e-6,
                                    .state = state,
                                    .plan = plan,
                                    .take = take,
                                    .widen = widen,
                                    .place = place,
                                    .let_go = let_go,
                                    .grasp = grasp,
                                    .add_held = add_held,
                                    .check_holds = check_holds,
                                    .carry_over = carry_over,
                                    .at = sw_line_at,
                                    .middles = middles,
                                    .arc = arc};
