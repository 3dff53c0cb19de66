/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "contact/depth.h"

#include <math.h>

double sw_contact_deepest(const sw_contact *c, const sw_touch *t) {
  const sw_candidate *k = &c->candidates[t->candidate];
  const int line = k->squeezing > 0, pad = c->obstacles[t->obstacle].grips > 0;
  if (!line || pad || c->regime == SW_CONTACT_STATIC) return SW_DEEPEST;
  return fmin(SW_DEEPEST, SW_SHALLOW * k->radius);
}

double sw_contact_depth_before(const sw_contact *c, const sw_system *s, const sw_touch *t) {
  const sw_vec from = sw_pose_local(c->start[t->obstacle].pose, sw_mean_place(c, s->x, &t->spot));
  const sw_vec way = sw_rotate(c->now[t->obstacle].pose.q, sw_sub(t->seen, from));
  return t->forgiven - t->press.gap + sw_dot(t->press.normal, way);
}

void sw_contact_forgive(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                        const sw_kept *last, const double *y, sw_touch *t) {
  const sw_web *web = s->bodies[k->body].plan->web;
  const int slowly = (web && web->per_ring) || c->fresh;
  if (c->regime == SW_CONTACT_EXPLICIT || t->press.gap >= 0) return; /* force follows depth */
  const double always = sw_contact_imposed(c, s, k, t, y);
  const double depth = sw_contact_depth_before(c, s, t) - always;
  t->forgiven = always;
  if (c->regime != SW_CONTACT_IMPLICIT) return;
  const double h = slowly ? c->stage_time - c->time : c->h;
  sw_kept kept = last ? *last : (sw_kept){0};
  if (!t->squeezed) kept.left = 0;
  const sw_left left = sw_press_leave(depth, last ? &kept : NULL, h, slowly);
  t->forgiven += left.forgiven, t->left = left.left;
  t->let_out = left.let_out;
}

int sw_contact_is_squeezed(const sw_contact *c, const sw_candidate *k, const sw_kept *last,
                           const sw_touch *t) {
  if (!last || !(k->squeezing > 0)) return 0;
  return last->normal_force >= k->squeezing || last->left > 0 ||
         last->depth > sw_contact_deepest(c, t);
}
