/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The smooth curve of a wire, its feet (nearest places) on edges and corners, and the normals of
 * touches there. */
#include <math.h>

#include "contact/round.h"
#include "touch/lean.h"

static const double QUARTER = 0.25;
/* There is no foot between directions closer to parallel than PARALLEL. Nodes touch edges up to the
 * angle NEARLY. The two limits overlap, because a node's tangent differs from the curve's; so no
 * place is missed. A known touch stays up to STILL: its push turns the wire, and with one limit it
 * would come and go from iterate to iterate. Squared sines [-]. */
static const double PARALLEL = 0.005, STILL = 0.00125, NEARLY = 0.02;
enum { MOST_TURNS = 6 };                 /* most iterations for the foot [-] */
static const double SHARP_ENOUGH = 1e-9; /* tolerance of the foot, share of an edge [-] */
static const double NO_LENGTH = 1e-6; /* squared share of an edge that counts as no distance [-] */

/* A position on the curve with its first and second derivatives by u [m]. */
typedef struct spot {
  sw_vec x, along, bend;
} spot;

static spot between(sw_vec a, sw_vec b, double u) {
  return (spot){sw_lerp(a, b, u), sw_sub(b, a), {0, 0, 0}};
}

static spot around(const sw_vec *p, double v) {
  const double a = 0.5 * (1.0 - v) * (1.0 - v), e = 0.5 * v * v;
  const sw_vec before = sw_sub(p[1], p[0]), after = sw_sub(p[2], p[1]);
  return (spot){sw_madd(sw_madd(sw_scale(p[1], 1.0 - a - e), p[0], a), p[2], e),
                sw_lerp(before, after, v), sw_sub(after, before)};
}

static spot at_curve(const sw_piece *c, double u) {
  if (u < 0.5 ? c->starts : c->ends) return between(c->p[1], c->p[2], u);
  return u < 0.5 ? around(c->p, u + 0.5) : around(c->p + 1, u - 0.5);
}

/* World position of node j of the four. */
static sw_vec node_at(const sw_contact *c, const sw_body *b, size_t i, size_t j, const double *x) {
  const size_t n = b->plan->nodes, at = i + j < 1 ? 0 : i + j - 1 < n ? i + j - 1 : n - 1;
  const size_t node = b->first_node + at;
  return sw_contact_where(c, x, node, node, 0);
}

static double off_middle(sw_vec a, sw_vec b, sw_vec c) {
  return sw_norm2(sw_add(sw_sub(a, b), sw_sub(c, b)));
}

int sw_contact_piece(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                     const sw_contact_at *at, const double *x, double reach, sw_piece *out) {
  const sw_body *b = &s->bodies[k->body];
  const sw_shape *shape = c->obstacles[k->obstacle].shape;
  const size_t i = k->node - b->first_node;
  for (size_t j = 0; j < 4; j++)
    out->p[j] = sw_pose_local(at[k->obstacle].pose, node_at(c, b, i, j, x));
  if (sw_shape_over_face(shape, out->p, 4)) return 0;
  out->shape = shape, out->firm = k->firm;
  for (int j = 0; j < 2; j++) out->firm_beside[j] = k->firm_beside[j];
  out->starts = i == 0, out->ends = i + 2 >= b->plan->nodes;
  const double one = out->starts ? 0 : off_middle(out->p[0], out->p[1], out->p[2]);
  const double two = out->ends ? 0 : off_middle(out->p[1], out->p[2], out->p[3]);
  out->bulge = sqrt(fmax(one, two)) / 8.0;
  /* the search extends beyond the first and last node */
  const double beyond = QUARTER * sw_dist(out->p[1], out->p[2]);
  return sw_shape_meets(shape, out->p[1], out->p[2], reach + out->bulge + beyond);
}

/* Moves a place to the curve's foot on its edge or corner. 0: no foot nearby. */
static int find_foot(const sw_piece *c, sw_place *place, double low, double high) {
  double u = place->near.at;
  const sw_vec q = place->near.point, e = place->edge;
  spot on;
  sw_vec w;
  for (int turn = 0;; turn++) {
    on = at_curve(c, u);
    w = sw_sub(on.x, q);
    const sw_vec off = sw_madd(w, e, -sw_dot(e, w));
    const double across2 = sw_norm2(sw_madd(on.along, e, -sw_dot(e, on.along)));
    if (!(across2 > (place->known ? STILL : PARALLEL) * sw_norm2(on.along))) return 0;
    const double rise = across2 + sw_dot(on.bend, off);
    const double ahead = -sw_dot(on.along, off) / (rise > 0 ? rise : across2);
    if (turn == MOST_TURNS || fabs(ahead) < SHARP_ENOUGH) break;
    const double next = fmin(fmax(u + ahead, low), high);
    if (next == u) return 0; /* the foot is beyond the piece */
    u = next;
  }
  const double length = sw_norm(on.along), back = sw_dot(e, w);
  const sw_vec along = sw_scale(on.along, 1.0 / length);
  const sw_vec across = place->sharp == SW_SHARP_EDGE ? sw_cross(along, e) : w;
  const sw_vec outward = place->near.normal;
  sw_vec n = sw_unit_or(sw_madd(across, along, -sw_dot(across, along)), outward);
  if (place->sharp == SW_SHARP_CORNER && sw_norm2(w) < NO_LENGTH * length * length)
    n = sw_unit_or(sw_madd(outward, along, -sw_dot(outward, along)), outward);
  if (sw_dot(n, outward) < 0) n = sw_neg(n);
  place->along = along;
  place->near.at = u;
  place->near.normal = n;
  place->near.gap = sw_dot(n, w);
  place->near.point = sw_madd(q, e, back);
  return 1;
}

int sw_contact_goes_across(sw_vec along, sw_vec edge) {
  const double share = sw_dot(along, edge);
  return sw_norm2(along) - share * share > NEARLY * sw_norm2(along);
}

/* Nodes touch faces, and edges along the wire; nodes at the wire's ends touch everything. */
int sw_contact_is_segments(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                           const sw_contact_at *at, const double *x, const sw_closest *near) {
  const sw_body *b = &s->bodies[k->body];
  const size_t i = k->node - b->first_node;
  sw_vec edge = {0, 0, 0};
  if (i == 0 || i + 1 == b->plan->nodes) return 0;
  if (k->round
          ? !sw_contact_over_round(c, k, near, &edge)
          : sw_shape_sharp(c->obstacles[k->obstacle].shape, near->feature, &edge) == SW_SHARP_NOT)
    return 0;
  const sw_vec world = sw_sub(node_at(c, b, i, 2, x), node_at(c, b, i, 0, x));
  const sw_vec along = sw_unrotate(at[k->obstacle].pose.q, world);
  return sw_contact_goes_across(along, edge);
}

double sw_contact_steady_force(const sw_system *s, const sw_touch *t, double h) {
  const sw_body *b = &s->bodies[t->body];
  return sw_lean_steady(b, t->node - b->first_node, t->steady, t->press.normal_force, h);
}

sw_mean sw_contact_spot(const sw_system *s, const sw_candidate *k, double at) {
  if (!k->smooth || !k->segment) return sw_mean_chord(k->node, k->other, k->segment ? at : 0.0);
  const sw_body *b = &s->bodies[k->body];
  return sw_mean_curve(b->first_node, b->first_node + b->plan->nodes - 1,
                       (double)(k->node - b->first_node) + at);
}

sw_vec sw_contact_curve(const sw_piece *piece, double u, sw_vec *along) {
  const spot on = at_curve(piece, u);
  *along = on.along;
  return on.x;
}

int sw_contact_follow(const sw_piece *piece, sw_place *place) {
  return find_foot(piece, place, piece->starts ? 0.0 : -0.5, piece->ends ? 1.0 : 1.5);
}

sw_place sw_contact_place_of(const sw_contact *c, const sw_touch *t) {
  const sw_quat back = sw_quat_conj(c->now[t->obstacle].pose.q);
  return (sw_place){.near = {.at = t->at,
                             .point = t->local,
                             .normal = sw_rotate(back, t->press.normal),
                             .feature = t->feature},
                    .sharp = t->sharp,
                    .known = 1,
                    .edge = t->edge};
}

sw_vec sw_contact_leaning(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                          const sw_place *place, double steady) {
  const sw_quat q = c->now[k->obstacle].pose.q;
  const sw_vec normal = sw_rotate(q, place->near.normal);
  if (!place->sharp || !(steady > 0)) return normal;
  const double lone = place->sharp == SW_SHARP_ROUND ? k->lone : 1.0;
  const sw_body *b = &s->bodies[k->body];
  const double along = (double)(k->node - b->first_node) + place->near.at;
  const double lean = lone * sw_lean_of(s, b, along, steady);
  return sw_unit_or(sw_madd(normal, sw_rotate(q, place->along), lean), normal);
}
