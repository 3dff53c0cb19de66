/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the places of a candidate near its obstacle: of its node, samples, chord, or smooth
 * curve. */
#include <math.h>

#include "contact/pads.h"
#include "contact/round.h"

/* Appends the place after the last one; `near` is already filled. wire: the wire's position. */
static void take(sw_places *list, sw_vec wire) {
  sw_place *place = &list->place[list->count++];
  place->sharp = SW_SHARP_NOT;
  place->edge = sw_v(0, 0, 0), place->wire = wire, place->faint = 0;
}

/* Adds the obstacle's nearest place to a point of the candidate's segment, or to its particle;
 * `at`: place on the segment. */
static void near_point(const sw_contact *c, const sw_candidate *k, sw_vec wire, double at,
                       double reach, sw_places *list) {
  sw_closest *near = &list->place[list->count].near;
  const int rims = !k->segment && sw_pad_has_rims(c, k->obstacle);
  if (!(rims ? sw_pad_point(c, k, wire, reach, near)
             : sw_shape_point(c->obstacles[k->obstacle].shape, wire, reach, near)))
    return;
  near->at = at;
  take(list, wire);
}

/* In a shallow hollow a point passes from face to face by moving sideways by about its gap times
 * the angle between them. Each face then bears its share, from all to none, so that no force jumps
 * as a foot leaves its face. Both faces of a hollow bear in full from twice this angle on [rad]. */
static const double SHALLOW = 0.06;

/* Returns the share of a place beside another one: the distance of its foot from where both faces
 * meet, over that at which the other face takes over. */
static double share_beside(const sw_closest *own, const sw_closest *other) {
  const double cosine = fmin(sw_dot(own->normal, other->normal), 1.0);
  const double half = sqrt((1.0 - cosine) / fmax(1.0 + cosine, 1e-12)); /* tan(angle/2) */
  const double sine = sqrt(fmax(1.0 - cosine * cosine, 1e-24));
  const double foot = (other->gap - own->gap * cosine) / sine;
  return foot / (2.0 * own->gap * fmin(half, 0.5 * SHALLOW));
}

/* Adds the further near places of a line's node in a hollow of the obstacle, as on the other flank
 * of a groove. */
static void near_beside(const sw_contact *c, const sw_system *s, const sw_candidate *k, sw_vec wire,
                        double reach, sw_places *list) {
  sw_closest more[SW_CLOSEST_MAX];
  if (!list->count || s->bodies[k->body].plan->web) return;
  const sw_shape *shape = c->obstacles[k->obstacle].shape;
  const int n = sw_shape_beside(shape, wire, reach, &list->place[0].near, more);
  for (int i = 0; i < n; i++) {
    list->place[list->count].near = more[i];
    take(list, wire);
  }
  for (size_t i = 0; n > 0 && i < list->count; i++)
    for (size_t j = 0; j < list->count; j++) {
      const double share = j == i ? 1.0 : share_beside(&list->place[i].near, &list->place[j].near);
      list->place[i].faint = fmax(list->place[i].faint, 1.0 - share);
    }
}

/* Edges with normals that differ by less are one edge to a wire across them: 1 minus the cosine of
 * 0.08 degrees [-]. */
static const double ONE_WAY = 1e-6;
/* Two edges meet if their lines pass each other within this share of the wire's radius [-]. */
static const double MEET = 1e-4;

/* 1 if two places across the wire are on edges that meet in one point. */
static int meet(const sw_shape *shape, const sw_closest *one, const sw_closest *two, double near) {
  sw_vec a, b;
  if (sw_shape_sharp(shape, one->feature, &a) != SW_SHARP_EDGE) return 0;
  if (sw_shape_sharp(shape, two->feature, &b) != SW_SHARP_EDGE) return 0;
  const sw_vec across = sw_cross(a, b);
  const double off = sw_dot(across, sw_sub(two->point, one->point));
  return fabs(off) <= near * sw_norm(across);
}

/* Lets two edges that meet in a shallow hollow across the wire share the wire between them, as the
 * faces of a hollow share a node: seen along the wire they are lines. Else the force of an edge
 * jumped from none to all where the wire comes over its end, and a wire drawn along the hollow had
 * no equilibrium there (spec/contact/hollow_edges_spec). */
static void share_hollows(const sw_shape *shape, double radius, sw_places *list) {
  for (size_t i = 0; i < list->count; i++)
    for (size_t j = 0; j < list->count; j++) {
      const sw_closest *own = &list->place[i].near, *other = &list->place[j].near;
      if (i == j || !(own->gap > 0 && other->gap > 0)) continue;
      const double cosine = sw_dot(own->normal, other->normal);
      if (!(cosine > 0 && cosine < 1.0 - ONE_WAY) || !meet(shape, own, other, MEET * radius))
        continue;
      const double share = share_beside(own, other);
      if (share >= 0) list->place[i].faint = fmax(list->place[i].faint, 1.0 - share);
    }
}

/* Leaves the places on edges across the wire to its segments. */
static void leave_to_segments(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                              const sw_contact_at *at, const double *x, sw_places *list) {
  size_t kept = 0;
  for (size_t i = 0; i < list->count; i++)
    if (!sw_contact_is_segments(c, s, k, at, x, &list->place[i].near))
      list->place[kept++] = list->place[i];
  list->count = kept;
}

void sw_contact_near(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                     const sw_contact_at *at, const double *x, double reach, sw_places *list) {
  const sw_shape *shape = c->obstacles[k->obstacle].shape;
  sw_piece piece;
  sw_closest near[SW_CLOSEST_MAX];
  list->count = 0;
  if (k->smooth && k->segment && sw_contact_piece(c, s, k, at, x, reach, &piece))
    sw_contact_places(c, k, &piece, reach, list);
  if (k->smooth && k->segment && !k->round) return;
  const sw_pose *pose = &at[k->obstacle].pose;
  const sw_vec a = sw_pose_local(*pose, sw_contact_where(c, x, k->node, k->node, 0));
  if (!k->segment) {
    near_point(c, k, a, 0, reach, list);
    near_beside(c, s, k, a, reach, list);
    if (k->smooth) leave_to_segments(c, s, k, at, x, list);
    return;
  }
  const sw_vec b = sw_pose_local(*pose, sw_contact_where(c, x, k->other, k->other, 0));
  for (int i = 0; i < k->samples; i++)
    near_point(c, k, sw_lerp(a, b, sw_sample_at(k, i)), sw_sample_at(k, i), reach, list);
  const int n = k->samples ? 0 : sw_shape_segment(shape, a, b, reach, near);
  for (int i = 0; i < n; i++) {
    if (k->round && sw_contact_is_rounds(c, k, a, b, near[i].at)) continue;
    list->place[list->count].near = near[i];
    take(list, sw_lerp(a, b, near[i].at));
  }
  if (n > 1) share_hollows(shape, k->radius, list);
}
