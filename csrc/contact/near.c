/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the places of a candidate near its obstacle: of its node, samples, chord, or smooth
 * curve. */
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
    if (list->count && k->smooth && sw_contact_is_segments(c, s, k, at, x, &list->place[0].near))
      list->count = 0;
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
}
