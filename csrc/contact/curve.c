/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where the smooth curve of a wire is near edges and corners. Found with straight pieces that touch
 * the curve, places are then moved to the curve's own foot: the same whichever piece found it. */
#include <math.h>

#include "contact/touch.h"

/* A wire that stands off its chords by less than this share of its radius is found by the chords
 * [-]. */
static const double STRAIGHT = 0.02;
/* Pieces go on beyond their ends by this share of an edge, so that none is missed between two [-].
 */
static const double OVERLAP = 0.08;
static const double QUARTER = 0.25;
/* Lines closer to parallel than this have no foot [-]: squared sine. */
static const double PARALLEL = 0.01;
enum { MOST_TURNS = 4 };                 /* of the search for the foot [-] */
static const double SHARP_ENOUGH = 1e-6; /* of an edge [-] */

/* Four nodes in a row in an obstacle's coordinates; u counts edges from the second. */
typedef struct piece {
  sw_vec p[4];      /* [m] */
  int starts, ends; /* 1: the wire does so at p[1] or p[2] */
  double bulge;     /* the curve stands off the nodes by so much, at most [m] */
} piece;

static void between(sw_vec a, sw_vec b, double u, sw_vec *x, sw_vec *along) {
  *x = sw_lerp(a, b, u), *along = sw_sub(b, a);
}

static void around(const sw_vec *p, double v, sw_vec *x, sw_vec *along) {
  const double a = 0.5 * (1.0 - v) * (1.0 - v), e = 0.5 * v * v;
  *x = sw_madd(sw_madd(sw_scale(p[1], 1.0 - a - e), p[0], a), p[2], e);
  *along = sw_madd(sw_scale(sw_sub(p[1], p[0]), 1.0 - v), sw_sub(p[2], p[1]), v);
}

static void at_curve(const piece *c, double u, sw_vec *x, sw_vec *along) {
  if (u < 0.5 ? c->starts : c->ends)
    between(c->p[1], c->p[2], u, x, along);
  else if (u < 0.5)
    around(c->p, u + 0.5, x, along);
  else
    around(c->p + 1, u - 0.5, x, along);
}

/* Number j of the four, in the world. */
static sw_vec node_at(const sw_contact *c, const sw_body *b, size_t i, size_t j, const double *x) {
  const size_t n = b->plan->nodes, at = i + j < 1 ? 0 : i + j - 1 < n ? i + j - 1 : n - 1;
  const size_t node = b->first_node + at;
  return sw_contact_where(c, x, node, node, 0);
}

static double off_middle(sw_vec a, sw_vec b, sw_vec c) {
  return sw_norm2(sw_add(sw_sub(a, b), sw_sub(c, b)));
}

/* A candidate's piece. 0: it is further off than reach. */
static int piece_of(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                    const sw_pose *pose, const double *x, double reach, piece *out) {
  const sw_body *b = &s->bodies[k->body];
  const size_t i = k->node - b->first_node;
  sw_vec world[4];
  for (size_t j = 0; j < 4; j++) world[j] = node_at(c, b, i, j, x);
  out->starts = i == 0, out->ends = i + 2 >= b->plan->nodes;
  const double one = out->starts ? 0 : off_middle(world[0], world[1], world[2]);
  const double two = out->ends ? 0 : off_middle(world[1], world[2], world[3]);
  out->bulge = sqrt(fmax(one, two)) / 8.0;
  for (size_t j = 1; j < 3; j++) out->p[j] = sw_pose_local(*pose, world[j]);
  /* it is also looked at before its first node */
  const double before = k->segment ? QUARTER * sw_dist(world[0], world[1]) : 0.0;
  if (!sw_shape_meets(c->obstacles[k->obstacle].shape, out->p[1], out->p[k->segment ? 2 : 1],
                      reach + out->bulge + before))
    return 0;
  for (size_t j = 0; j < 4; j += 3) out->p[j] = sw_pose_local(*pose, world[j]);
  return 1;
}

/* Move a place to the curve's foot over its edge or corner. 0: it has none nearby. */
static int find_foot(const piece *c, sw_place *place, double low, double high) {
  double u = place->near.at;
  const sw_vec q = place->near.point, e = place->edge;
  sw_vec x, along, w;
  double length, back = 0;
  for (int turn = 0;; turn++) {
    at_curve(c, u, &x, &along);
    length = sw_norm(along);
    if (!(length > 0)) return 0;
    along = sw_scale(along, 1.0 / length);
    w = sw_sub(x, q);
    const double b = sw_dot(along, e), det = 1.0 - b * b;
    if (det < PARALLEL) return 0;
    const double ahead = (b * sw_dot(e, w) - sw_dot(along, w)) / det;
    back = sw_dot(e, w) + b * ahead;
    if (turn == MOST_TURNS || fabs(ahead) < SHARP_ENOUGH * length) break;
    const double next = fmin(fmax(u + ahead / length, low), high);
    if (next == u) break;
    u = next;
  }
  const sw_vec across = place->sharp == SW_SHARP_EDGE ? sw_cross(along, e) : w;
  const sw_vec outward = place->near.normal;
  sw_vec n = sw_unit_or(sw_madd(across, along, -sw_dot(across, along)), outward);
  if (place->sharp == SW_SHARP_CORNER && sw_norm2(w) < SHARP_ENOUGH * length * length)
    n = sw_unit_or(sw_madd(outward, along, -sw_dot(outward, along)), outward);
  if (sw_dot(n, outward) < 0) n = sw_neg(n);
  place->along = along;
  place->near.at = u;
  place->near.normal = n;
  place->near.gap = sw_dot(n, w);
  place->near.point = sw_madd(q, e, back);
  return 1;
}

/* A place known before is this one when the obstacle's are nearer than this share of the radius
 * [-]. */
static const double SAME_POINT = 0.01;

static int is_new(const sw_places *list, const sw_candidate *k, const sw_place *place) {
  const double near = SAME_POINT * k->radius;
  for (size_t i = 0; i < list->count; i++)
    if (list->place[i].sharp &&
        sw_norm2(sw_sub(list->place[i].near.point, place->near.point)) < near * near &&
        sw_dot(list->place[i].near.normal, place->near.normal) > 0)
      return 0;
  return 1;
}

static void take(sw_places *list, const sw_place *place) {
  if (list->count < SW_PLACES_MOST) list->place[list->count++] = *place;
}

/* A place found along a line that turns from the curve's tangent there by more than this is looked
 * for again, along the tangent: which of two edges near each other touch is a matter of its tilt
 * [-]. */
static const double TURNED = 0.01;

static void along_tangent(const piece *c, const sw_shape *shape, const sw_candidate *k,
                          double reach, double u, double back, double ahead, sw_places *list,
                          int again);

/* Places of a straight piece from u[0] to u[1]. */
static void along_piece(const piece *c, const sw_shape *shape, const sw_candidate *k, double reach,
                        const sw_vec end[2], const double u[2], sw_places *list, int again) {
  sw_closest near[SW_CLOSEST_MAX];
  const sw_vec d = sw_sub(end[1], end[0]);
  const int n = sw_shape_segment(shape, end[0], end[1], reach + c->bulge, near);
  for (int i = 0; i < n; i++) {
    sw_place place = {.near = near[i], .edge = {0, 0, 0}};
    place.sharp = sw_shape_sharp(shape, near[i].feature, &place.edge);
    if (place.sharp == SW_SHARP_NOT) {
      place.sharp = SW_SHARP_EDGE;
      place.edge = sw_unit_or(sw_cross(near[i].normal, d), sw_v(0, 0, 0));
    }
    place.near.at = u[0] + near[i].at * (u[1] - u[0]);
    if (!find_foot(c, &place, c->starts ? 0.0 : -0.5, c->ends ? 1.0 : 1.5)) continue;
    if (!(place.near.gap < reach) || !is_new(list, k, &place)) continue;
    const int turned = sw_norm2(sw_cross(place.along, d)) > TURNED * TURNED * sw_norm2(d);
    take(list, &place);
    if (turned && again)
      along_tangent(c, shape, k, reach, place.near.at, QUARTER, QUARTER, list, 0);
  }
}

/* Along the tangent at u, so far to both sides. */
static void along_tangent(const piece *c, const sw_shape *shape, const sw_candidate *k,
                          double reach, double u, double back, double ahead, sw_places *list,
                          int again) {
  sw_vec x, along;
  at_curve(c, u, &x, &along);
  const sw_vec end[2] = {sw_madd(x, along, -back), sw_madd(x, along, ahead)};
  const double from[2] = {u - back, u + ahead};
  along_piece(c, shape, k, reach, end, from, list, again);
}

static void of_segment(const piece *c, const sw_shape *shape, const sw_candidate *k, double reach,
                       sw_places *list) {
  const double out = QUARTER + OVERLAP;
  const double back = c->starts ? 0.5 : out, ahead = c->ends ? 0.5 : out;
  if (c->bulge < STRAIGHT * k->radius) {
    const double u[2] = {c->starts ? 0.0 : -OVERLAP, c->ends ? 1.0 : 1.0 + OVERLAP};
    const sw_vec end[2] = {sw_lerp(c->p[1], c->p[2], u[0]), sw_lerp(c->p[1], c->p[2], u[1])};
    along_piece(c, shape, k, reach, end, u, list, 1);
    return;
  }
  along_tangent(c, shape, k, reach, 0.5, back, ahead, list, 1);
  if (!c->starts) along_tangent(c, shape, k, reach, 0.0, out, out, list, 1);
  if (!c->ends && k->last_one) along_tangent(c, shape, k, reach, 1.0, out, out, list, 1);
}

/* A node's place: on faces, at edges that it lies along, and at the wire's ends anywhere. Edges
 * across the wire are met by segments. */
static void of_node(const piece *p, const sw_system *s, const sw_shape *shape,
                    const sw_candidate *k, double reach, sw_places *list) {
  const size_t i = k->node - s->bodies[k->body].first_node;
  const int end = i == 0 || i + 1 == s->bodies[k->body].plan->nodes;
  sw_place place = {.edge = {0, 0, 0}};
  if (!sw_shape_point(shape, p->p[1], reach, &place.near)) return;
  place.near.at = 0;
  if (!end && sw_shape_sharp(shape, place.near.feature, &place.edge) != SW_SHARP_NOT) {
    const sw_vec along = sw_sub(p->p[2], p->p[0]);
    const double b = sw_dot(along, place.edge);
    if (sw_norm2(along) - b * b > PARALLEL * sw_norm2(along)) return;
  }
  take(list, &place);
}

/* How much the tension keeps an edge from bending, and the most that a touch leans [-]. */
static const double TAUT = 0.27, MOST_LEAN = 0.1;
/* What bends between nodes follows the force after so many of its own times [-]. */
static const double SLOWLY = 4.0;

double sw_contact_lean(const sw_system *s, const sw_candidate *k, double at, double force) {
  const sw_body *b = &s->bodies[k->body];
  const sw_plan *p = b->plan;
  const double place = (double)(k->node - b->first_node) + at;
  if (!(place > 0.5) || !(place < (double)p->edges - 0.5) || !(p->beam.EI > 0)) return 0;
  const size_t i = (size_t)(place + 0.5), e = b->first_edge + i;
  const double v = place + 0.5 - (double)i, h = 0.5 * (p->rest[i - 1] + p->rest[i]);
  const double T = fmax(0.0, 0.5 * (s->tension[e - 1] + s->tension[e])), h2 = h * h / p->beam.EI;
  const double lean = 0.25 * force * h2 * v * (1.0 - v) * (1.0 - 2.0 * v) / (1.0 + TAUT * T * h2);
  return fmin(fmax(lean, -MOST_LEAN), MOST_LEAN);
}

double sw_contact_steady_force(const sw_system *s, const sw_touch *t, double h) {
  const sw_plan *p = s->bodies[t->body].plan;
  const double N = t->press.normal_force;
  const size_t i = t->node - s->bodies[t->body].first_node;
  const double edge = p->rest[i < p->edges ? i : i - 1];
  const double slow = SLOWLY * edge * edge * sqrt(p->beam.mass / p->beam.EI);
  if (N <= t->steady || !(h > 0)) return N;
  return t->steady + (N - t->steady) * h / (h + slow);
}

sw_mean sw_contact_spot(const sw_system *s, const sw_candidate *k, double at) {
  if (!k->smooth || !k->segment) return sw_mean_chord(k->node, k->other, k->segment ? at : 0.0);
  const sw_body *b = &s->bodies[k->body];
  return sw_mean_curve(b->first_node, b->first_node + b->plan->nodes - 1,
                       (double)(k->node - b->first_node) + at);
}

void sw_contact_places(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                       const sw_contact_at *at, const double *x, double reach, sw_places *list) {
  const sw_shape *shape = c->obstacles[k->obstacle].shape;
  piece p;
  list->count = 0;
  if (!piece_of(c, s, k, &at[k->obstacle].pose, x, reach, &p)) return;
  if (k->segment)
    of_segment(&p, shape, k, reach, list);
  else
    of_node(&p, s, shape, k, reach, list);
}

int sw_contact_follow(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                      const double *x, sw_place *place) {
  piece p;
  if (!piece_of(c, s, k, &c->now[k->obstacle].pose, x, HUGE_VAL, &p)) return 0;
  return find_foot(&p, place, p.starts ? 0.0 : -0.5, p.ends ? 1.0 : 1.5);
}
