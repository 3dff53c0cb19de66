/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the places of a wire's smooth curve near edges and corners. The curve must stay at least
 * the wire's radius away from each edge and corner. So each counts, and none comes and goes when
 * the wire tilts. If a curve passes one on the wrong side, it cuts into the obstacle. Then the
 * places are the ways out of straight pieces that touch the curve, moved to the curve's own
 * feet. */
#include <math.h>

#include "contact/round.h"

/* A curve is searched by its chord if it is nearer to it than this share of the radius [-]. */
static const double STRAIGHT = 0.02;
/* Straight pieces are longer by this share of an edge at both ends, so that no place between two of
 * them is missed [-]. */
static const double OVERLAP = 0.08;
static const double QUARTER = 0.25;
/* A normal may lean inward by this share of the angle between the faces at an edge [-]. */
static const double LEAN = 0.3;
/* A foot belongs to a segment up to this far beyond its ends [-]. */
static const double BESIDE = 0.02;

/* Two places are the same if their points on the obstacle are nearer than this share of the radius
 * [-]. */
static const double SAME_POINT = 0.01;

static sw_place *same(sw_places *list, const sw_candidate *k, const sw_place *place) {
  const double near = SAME_POINT * k->radius;
  for (size_t i = 0; i < list->count; i++)
    if (list->place[i].sharp &&
        sw_norm2(sw_sub(list->place[i].near.point, place->near.point)) < near * near &&
        sw_dot(list->place[i].near.normal, place->near.normal) > 0)
      return &list->place[i];
  return NULL;
}

/* Adds a place to the list. Close to a corner its edges touch at the same place; the nearest of
 * these is taken, independent of the order. A full list keeps the nearest places. Returns 1 if the
 * place is new. */
static int take(sw_places *list, const sw_candidate *k, const sw_place *place) {
  sw_place *known = same(list, k, place);
  const int is_new = !known;
  if (is_new && list->count < SW_PLACES_MOST) {
    list->place[list->count++] = *place;
    return 1;
  }
  for (size_t i = 0; is_new && i < list->count; i++)
    if (!known || list->place[i].near.gap > known->near.gap) known = &list->place[i];
  if (place->near.gap < known->near.gap) *known = *place;
  return is_new;
}

/* A place found along a line is searched again along the curve's tangent if the two directions
 * differ by more than this, because the tilt decides which of two near edges touches [-]. */
static const double TURNED = 0.01;

static void along_tangent(const sw_piece *c, const sw_shape *shape, const sw_candidate *k,
                          double reach, double u, double back, double ahead, sw_places *list,
                          int again);

/* Adds the places of a straight piece from u[0] to u[1]. */
static void along_piece(const sw_piece *c, const sw_shape *shape, const sw_candidate *k,
                        double reach, const sw_vec end[2], const double u[2], sw_places *list,
                        int again) {
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
    if (!sw_contact_follow(c, &place)) continue;
    if (!(place.near.gap < reach) || !take(list, k, &place)) continue;
    const int turned = sw_norm2(sw_cross(place.along, d)) > TURNED * TURNED * sw_norm2(d);
    if (turned && again)
      along_tangent(c, shape, k, reach, place.near.at, QUARTER, QUARTER, list, 0);
  }
}

/* Adds the places along the tangent at u, by `back` and `ahead` to both sides. */
static void along_tangent(const sw_piece *c, const sw_shape *shape, const sw_candidate *k,
                          double reach, double u, double back, double ahead, sw_places *list,
                          int again) {
  sw_vec along;
  const sw_vec x = sw_contact_curve(c, u, &along);
  const sw_vec end[2] = {sw_madd(x, along, -back), sw_madd(x, along, ahead)};
  const double from[2] = {u - back, u + ahead};
  along_piece(c, shape, k, reach, end, from, list, again);
}

static void of_segment(const sw_piece *c, const sw_shape *shape, const sw_candidate *k,
                       double reach, sw_places *list) {
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
  if (!c->ends) along_tangent(c, shape, k, reach, 1.0, out, out, list, 1);
}

typedef struct search {
  const sw_contact *c;
  const sw_piece *piece;
  const sw_shape *shape;
  const sw_candidate *k;
  double reach;
  sw_places *list;
  int doubt; /* 1: the curve may pass an edge or corner on the wrong side */
} search;

/* Finds the chord's nearest place to a line, or to a point if `along` is zero. 0: the curve is too
 * far away. */
static int begin_at(const search *q, const sw_ridge *r, double *u) {
  const sw_vec *p = q->piece->p, d = sw_sub(p[2], p[1]), w = sw_sub(p[1], r->from);
  const sw_vec across = sw_madd(d, r->along, -sw_dot(r->along, d));
  const double size2 = sw_norm2(across), most = q->reach + q->piece->bulge;
  *u = size2 > 0 ? fmin(fmax(-sw_dot(across, w) / size2, 0.0), 1.0) : 0.5;
  const sw_vec off = sw_madd(w, d, *u);
  return sw_norm2(sw_madd(off, r->along, -sw_dot(r->along, off))) < most * most;
}

/* 1 if the candidate touched this edge or corner in the last iterate or step. */
static int is_known(const search *q, int feature) {
  const sw_contact *c = q->c;
  for (size_t i = q->k->last; i < q->k->last_end; i++)
    if (c->last[i].sharp && c->last[i].feature == feature) return 1;
  for (size_t i = q->k->memory; c->memory && i < q->k->memory_end; i++)
    if (c->memory[i].feature == feature) return 1;
  return 0;
}

static void try_ridge(void *user, const sw_ridge *r) {
  search *q = user;
  sw_place place = {.near = {.point = r->from, .normal = {0, 0, 0}, .feature = r->feature},
                    .sharp = r->sharp,
                    .known = is_known(q, r->feature),
                    .edge = r->along};
  sw_closest *near = &place.near;
  if (!begin_at(q, r, &near->at) || !sw_contact_follow(q->piece, &place)) return;
  if (near->at < -BESIDE || near->at > 1.0 + BESIDE || !(fabs(near->gap) < q->reach)) return;
  const double t = sw_dot(r->along, sw_sub(near->point, r->from));
  if (t < 0 || t > r->length) return;
  if (near->gap < 0) near->normal = sw_neg(near->normal), near->gap = -near->gap;
  if (!sw_shape_points_out(q->shape, r, near->normal, LEAN))
    q->doubt = 1;
  else
    take(q->list, q->k, &place);
}

/* Sorts the nearest first: of several places that are one touch, the first is used. */
static void put_in_order(sw_places *list) {
  for (size_t i = 1; i < list->count; i++) {
    const sw_place place = list->place[i];
    size_t at = i;
    for (; at > 0 && list->place[at - 1].near.gap > place.near.gap; at--)
      list->place[at] = list->place[at - 1];
    list->place[at] = place;
  }
}

void sw_contact_places(const sw_contact *c, const sw_candidate *k, const sw_piece *piece,
                       double reach, sw_places *list) {
  const sw_shape *shape = c->obstacles[k->obstacle].shape;
  search q = {c, piece, shape, k, reach, list, 0};
  list->count = 0;
  if (k->round) {
    sw_contact_round_places(piece, reach, list);
    return;
  }
  sw_shape_ridges(shape, piece->p[1], piece->p[2], reach + piece->bulge, try_ridge, &q);
  if (q.doubt) of_segment(piece, shape, k, reach, list);
  put_in_order(list);
}
