/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds whether a touch stays at its place of the iterate. Its equations have a fixed place and
 * normal; a shift may change both, except on a flat surface. This check is much cheaper than
 * another iterate. */
#include <math.h>

#include "contact/curve.h"
#include "touch/same.h"

/* A touch has stayed if its normal turned by at most TURNED, and its place moved by at most the
 * share MOVED of its segment [-]. */
static const double TURNED = 0.01, MOVED = 0.01;
/* The change of its gap must also change its force by less than OFF of the force plus LITTLE of the
 * scene's forces [-]. */
static const double OFF = 0.01, LITTLE = 1e-3;

/* A wire that moves further than this may touch other things; share of the radius [-]. */
static const double FAR = 0.5;

/* Finds the nearest place on the smooth curve now; 0: none. */
static int find_on_curve(const sw_contact *c, const sw_system *s, const sw_touch *t,
                         const double *y, sw_place *out) {
  const sw_candidate *k = &c->candidates[t->candidate];
  sw_piece piece;
  *out = sw_contact_place_of(c, t);
  if (!sw_contact_piece(c, s, k, c->now, y, 2.0 * k->radius, &piece)) return 0;
  if (t->sharp != SW_SHARP_ROUND) return sw_contact_follow(&piece, out);
  sw_places list;
  double nearest = SW_SAME_TOUCH;
  sw_contact_places(c, k, &piece, 2.0 * k->radius, &list);
  for (size_t i = 0; i < list.count; i++) {
    const double away = fabs(list.place[i].near.at - t->at);
    if (away < nearest) *out = list.place[i], nearest = away;
  }
  return nearest < SW_SAME_TOUCH;
}

/* Cosine below which a place is on another flank of a groove [-]. */
static const double SAME_SIDE = 0.7;

static double other_flank(const sw_closest *near, sw_vec way) {
  return sw_dot(near->normal, way) < SAME_SIDE ? SW_SAME_TOUCH : 0.0;
}

/* Finds the nearest place on the wire now; 0: none. */
static int find(const sw_contact *c, const sw_system *s, const sw_touch *t, const double *y,
                sw_place *place) {
  const sw_candidate *k = &c->candidates[t->candidate];
  if (t->sharp) return find_on_curve(c, s, t, y, place);
  sw_closest *out = &place->near;
  const sw_shape *shape = c->obstacles[t->obstacle].shape;
  const sw_pose *pose = &c->now[t->obstacle].pose;
  const sw_vec a = sw_pose_local(*pose, sw_contact_where(c, y, t->node, t->node, 0));
  const sw_vec b = sw_pose_local(*pose, sw_contact_where(c, y, t->other, t->other, 0));
  const double reach = 2.0 * k->radius;
  sw_closest near[SW_CLOSEST_MAX];
  const int n = t->segment && !k->samples ? sw_shape_segment(shape, a, b, reach, near) : 0;
  const sw_vec way = sw_unrotate(pose->q, t->press.normal);
  double nearest = SW_SAME_TOUCH;
  for (int i = 0; i < n; i++) {
    const double away = fabs(near[i].at - t->at) + other_flank(&near[i], way);
    if (away < nearest) *out = near[i], nearest = away;
  }
  if (nearest < SW_SAME_TOUCH) return 1;
  out->at = t->at; /* a sample, a node, or a place that was kept because it pushes */
  return sw_shape_point_like(shape, t->segment ? sw_lerp(a, b, t->at) : a, reach, way, out);
}

int sw_contact_stays(const sw_contact *c, const sw_system *s, const sw_touch *t, const double *y,
                     double shift, double scale) {
  const sw_candidate *k = &c->candidates[t->candidate];
  const sw_press *p = &t->press;
  sw_place place = {.sharp = SW_SHARP_NOT};
  if (!(shift < FAR * k->radius)) return 0;
  if (t->feature == SW_BEHIND_BARRIER) return 1;
  if (!find(c, s, t, y, &place)) return !p->active;
  const sw_closest near = place.near;
  if (near.gap < 0) return 0; /* inside the obstacle the side must be found again */
  const sw_vec normal = sw_contact_leaning(c, s, k, &place, t->steady);
  const double aslant = sw_contact_aslant(c, t->node, t->other, near.at, normal);
  const double gap = near.gap - k->skin + t->rise + aslant + t->forgiven;
  if (!p->active) return gap >= 0;
  const double stiff = t->sharp ? p->k * sw_place_share(&place) / t->share : p->k;
  return fabs(near.at - t->at) < MOVED &&
         fabs(stiff * gap - p->k * p->gap_after) <= OFF * p->normal_force + LITTLE * scale &&
         sw_norm2(sw_sub(normal, p->normal)) < TURNED * TURNED;
}
