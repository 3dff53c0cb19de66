/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bends beside clamps and rigid joints.
 *
 * A joint's hub turns an arm, the wire's edge at an end or both edges of a node in mid-wire, by
 * forces on the arm's nodes. At an end the wire has the hub's moment M, so the curvature M/EI. In
 * mid-wire the bend jumps by M/EI. The hinge of the node has the mean of both sides: with edges h
 * and k before and after, M h/(h + k) EI is missing before it and M k/(h + k) EI is too much after
 * it, as the forces of the arm bend the edges along h and k. */
#include "body/side.h"

#include <math.h>

#include "body/spin.h"
#include "state/clamp.h"
#include "system/part.h"

/* --- list ------------------------------------------------------------------------- */

static int is_mine(const sw_body *b, uint32_t node) {
  return node >= b->first_node && node < b->first_node + b->plan->nodes;
}

static const sw_clamp_hinge *clamp_at(const sw_plan *p, size_t node, size_t edge) {
  for (size_t c = 0; c < p->clamp_count; c++)
    if (p->clamps[c].node == node && p->clamps[c].edge == edge) return &p->clamps[c];
  return NULL;
}

/* 1 if an arm at a system's node comes before arm a of hub k. */
static int is_before(const struct sw_joins *all, uint32_t node, size_t k, size_t a) {
  for (size_t i = 0; i <= k; i++)
    for (size_t j = 0; j < (i < k ? all->hubs[i].count : a); j++)
      if (all->hubs[i].arms[j].node == node) return 1;
  return 0;
}

static int is_joined(const sw_system *s, const sw_body *b, size_t node) {
  const struct sw_joins *all = s->joins;
  if (!all) return 0;
  return is_before(all, (uint32_t)(b->first_node + node), all->hub_count, 0);
}

/* Returns the moment of all joints on the node, about any point [N m]. */
static sw_vec moment_at(const sw_system *s, const sw_body *b, size_t node) {
  const struct sw_joins *all = s->joins;
  sw_vec sum = sw_v(0, 0, 0);
  for (size_t k = 0; k < all->hub_count; k++)
    for (size_t a = 0; a < all->hubs[k].count; a++) {
      sw_vec bending, twisting;
      if (all->hubs[k].arms[a].node != b->first_node + node) continue;
      sw_join_hub_moment(s, &all->hubs[k], a, s->x, &bending, &twisting);
      sum = sw_add(sum, bending);
    }
  return sum;
}

/* Side number n of the joints: two for each of SW_HUB_ARMS of each hub. */
enum { OF_HUB = 2 * SW_HUB_ARMS };

static int touches(const sw_join_hub *h, const sw_body *b) {
  for (size_t a = 0; a < h->count; a++)
    if (is_mine(b, h->arms[a].node)) return 1;
  return 0;
}

static int joint_side(const sw_system *s, const sw_body *b, size_t n, sw_bent_side *out) {
  const struct sw_joins *all = s->joins;
  const size_t k = n / OF_HUB, a = n / 2 % SW_HUB_ARMS;
  const int side = n % 2 ? 1 : -1;
  const sw_join_hub *h = &all->hubs[k];
  if (a >= h->count || !is_mine(b, h->arms[a].node)) return 0;
  const size_t node = h->arms[a].node - b->first_node;
  if (side > 0 ? node + 1 == b->plan->nodes : node == 0) return 0;
  const size_t edge = side > 0 ? node : node - 1;
  if (clamp_at(b->plan, node, edge) || is_before(all, h->arms[a].node, k, a)) return 0;
  /* the side before this one of the same node has the same moment */
  const int known = side > 0 && out->joined && out->node == node && out->side < 0;
  const sw_vec moment = known ? out->moment : moment_at(s, b, node);
  *out = (sw_bent_side){node, edge, side, NULL, 1, moment};
  return 1;
}

int sw_scene_next_side(const sw_system *s, const sw_body *b, size_t *next, sw_bent_side *out) {
  const sw_plan *p = b->plan;
  const size_t clamps = p->clamp_count;
  if (!*next) *out = (sw_bent_side){0};
  if (*next < clamps) {
    const sw_clamp_hinge *c = &p->clamps[(*next)++];
    *out = (sw_bent_side){c->node, c->edge, c->side, c, is_joined(s, b, c->node), sw_v(0, 0, 0)};
    if (out->joined) out->moment = moment_at(s, b, c->node);
    return 1;
  }
  const size_t end = clamps + (s->joins && !p->web ? OF_HUB * s->joins->hub_count : 0);
  while (*next < end) {
    const size_t n = *next - clamps;
    const int none = n % OF_HUB == 0 && !touches(&s->joins->hubs[n / OF_HUB], b);
    *next += none ? OF_HUB : 1;
    if (!none && joint_side(s, b, n, out)) return 1;
  }
  return 0;
}

int sw_scene_side_at(const sw_system *s, const sw_body *b, size_t node, size_t edge,
                     sw_bent_side *out) {
  const sw_clamp_hinge *c = clamp_at(b->plan, node, edge);
  *out = (sw_bent_side){node, edge, edge == node ? 1 : -1, c, is_joined(s, b, node), sw_v(0, 0, 0)};
  if (out->joined) out->moment = moment_at(s, b, node);
  return c || out->joined;
}

/* --- bends ------------------------------------------------------------------------ */

static int is_inner(const sw_plan *p, size_t node) { return node > 0 && node + 1 < p->nodes; }

/* Returns the share of a node's joint moment that adds to the bend of this side: all at an end. */
static double share_of(const sw_plan *p, const sw_bent_side *o) {
  if (!is_inner(p, o->node)) return 1;
  return p->rest[o->edge] / (p->rest[o->node - 1] + p->rest[o->node]);
}

/* Returns EI times the bend from the joint, towards the centre [N m]. */
static sw_vec of_joint(const sw_body *b, const sw_bent_side *o) {
  const sw_vec t = sw_field_tangent(&b->field, o->edge);
  return sw_scale(sw_cross(o->moment, t), -o->side * share_of(b->plan, o));
}

static sw_vec across(sw_vec change, sw_vec t, double size) {
  const sw_vec way = sw_madd(change, t, -sw_dot(change, t));
  return sw_scale(sw_unit_or(way, sw_v(0, 0, 0)), size);
}

/* Returns the bend of the clamp, or else of the node's own hinge. */
static sw_vec of_hinge(const sw_system *s, const sw_body *b, const sw_bent_side *o) {
  const sw_plan *p = b->plan;
  const sw_vec t = sw_field_tangent(&b->field, o->edge);
  if (o->clamp) {
    const sw_vec d = sw_vec_at(s->directors_now, sw_clamp_place(o->clamp));
    return across(sw_scale(sw_sub(t, d), o->side), t, sw_scene_clamp_curvature(s, b, o->clamp));
  }
  if (!is_inner(p, o->node) || !(p->hinge[o->node] > 0)) return sw_v(0, 0, 0);
  const sw_vec change =
      sw_sub(sw_field_tangent(&b->field, o->node), sw_field_tangent(&b->field, o->node - 1));
  const double angle = 2.0 * asin(fmin(1.0, 0.5 * sw_norm(change)));
  return across(change, t, angle / p->hinge[o->node]);
}

/* Finds the bend at rest of a wire with frames, along the normal and across it. At an end it is
 * that of the next node, as the joint takes the end as it is at rest. */
static void at_rest(const sw_plan *p, const sw_bent_side *o, double out[2]) {
  size_t number = o->clamp ? p->nodes + (size_t)(o->clamp - p->clamps) : o->node;
  if (!o->clamp && !is_inner(p, o->node)) number = o->side > 0 ? o->node + 1 : o->node - 1;
  const double length = o->clamp ? 0.5 * p->rest[o->edge] : p->hinge[number];
  for (int k = 0; k < 2; k++)
    out[k] = length > 0 ? p->rest_bend[2 * number + (size_t)k] / length : 0;
}

/* Finds the bend beyond that at rest of a wire with frames. */
static void flexure(const sw_system *s, const sw_body *b, const sw_bent_side *o, double out[2]) {
  const sw_plan *p = b->plan;
  const sw_field *f = &b->field;
  const size_t number = o->clamp ? p->nodes + (size_t)(o->clamp - p->clamps) : o->node;
  out[0] = out[1] = 0;
  const double length = sw_scene_hinge_bend(s, b, number, out);
  const sw_vec t = sw_field_tangent(f, o->edge), bend = of_joint(b, o);
  const sw_vec one = sw_v(f->normals[0][o->edge], f->normals[1][o->edge], f->normals[2][o->edge]);
  const sw_vec axes[2] = {one, sw_cross(t, one)};
  for (size_t k = 0; k < 2; k++) {
    out[k] = length > 0 ? (out[k] - p->rest_bend[2 * number + k]) / length : 0;
    out[k] += sw_dot(bend, axes[k]) / p->beam.EI_axis[k];
  }
}

double sw_scene_side_flexure(const sw_system *s, const sw_body *b, const sw_bent_side *o) {
  double bend[2];
  if (!o->joined)
    return sw_scene_flexure(s, b, b->plan->nodes + (size_t)(o->clamp - b->plan->clamps));
  flexure(s, b, o, bend);
  return hypot(bend[0], bend[1]);
}

sw_vec sw_scene_side_bend(const sw_system *s, const sw_body *b, const sw_bent_side *o) {
  const sw_field *f = &b->field;
  if (!o->joined) return of_hinge(s, b, o);
  if (!b->spin_block) return sw_madd(of_hinge(s, b, o), of_joint(b, o), 1.0 / b->plan->beam.EI);
  double bend[2], rest[2];
  flexure(s, b, o, bend);
  at_rest(b->plan, o, rest);
  const sw_vec one = sw_v(f->normals[0][o->edge], f->normals[1][o->edge], f->normals[2][o->edge]);
  const sw_vec two = sw_cross(sw_field_tangent(f, o->edge), one);
  return sw_madd(sw_scale(one, bend[0] + rest[0]), two, bend[1] + rest[1]);
}

double sw_scene_side_curvature(const sw_system *s, const sw_body *b, const sw_bent_side *o) {
  return o->joined ? sw_norm(sw_scene_side_bend(s, b, o))
                   : sw_scene_clamp_curvature(s, b, o->clamp);
}
