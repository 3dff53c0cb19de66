/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Springs and hubs of joins in the equations, and their energy. */
#include <string.h>

#include "state/tie.h"
#include "system/join_twist.h"

static sw_vec apart_at(const sw_join_spring *p, const double *x) {
  return sw_sub(sw_vec_at(x, p->i), sw_vec_at(x, p->j));
}

static sw_vec force_at(const sw_join_spring *p, sw_vec apart) {
  if (!p->tie) return sw_scale(sw_sub(apart, p->offset), -p->k);
  const double d = sw_norm(apart);
  return d > p->slack ? sw_scale(apart, -sw_tie_pull(p->k, p->slack, d) / d) : sw_v(0, 0, 0);
}

sw_vec sw_join_spring_force(const sw_join_spring *p, const double *x) {
  return force_at(p, apart_at(p, x));
}

/* Stiffness for the nodes' difference, times a sign. */
static void spring_stiffness(const sw_join_spring *p, const double *x, double sign, double out[9]) {
  const sw_vec apart = apart_at(p, x);
  memset(out, 0, 9 * sizeof *out);
  if (!p->tie)
    out[0] = out[4] = out[8] = sign * p->k;
  else if (sw_norm(apart) > p->slack)
    sw_tie_stiffness(p->k, p->slack, apart, sign, out);
}

sw_vec sw_join_tie_expected(const sw_join_spring *p, const double *x, const double *update) {
  const sw_vec more = apart_at(p, update), before = sw_sub(apart_at(p, x), more);
  const double d = sw_norm(before);
  if (!(d > p->slack)) return sw_v(0, 0, 0);
  const sw_vec n = sw_scale(before, 1.0 / d);
  const double across = p->k * (1.0 - p->slack / d);
  const double along = (p->k - across) * sw_dot(n, more);
  return sw_sub(force_at(p, before), sw_madd(sw_scale(more, across), n, along));
}

static sw_status eval_spring(sw_system *s, const sw_join_spring *p, const double *y) {
  double own[9], other[9];
  spring_stiffness(p, y, 1.0, own);
  spring_stiffness(p, y, -1.0, other);
  const sw_vec f = sw_join_spring_force(p, y);
  sw_join_add_force(s, p->i, f);
  sw_join_add_force(s, p->j, sw_neg(f));
  SW_TRY(sw_join_add_block(s, p->i, p->i, own));
  SW_TRY(sw_join_add_block(s, p->j, p->j, own));
  return sw_join_add_block(s, p->i, p->j, other);
}

static sw_status eval_hub(sw_system *s, const sw_join_hub *h, const double *y) {
  sw_hub_arm arms[SW_HUB_ARMS];
  double C[9];
  SW_TRY(sw_hub_eval(s, h, y, arms, C));
  sw_join_twist_eval(s, h, arms, C);
  return SW_OK;
}

/* --- all together ----------------------------------------------------------------- */

/* 1 if the node's body waits. Joined bodies all wait, or none does. */
static int waits(const sw_system *s, uint32_t node) {
  return s->waiting && s->bodies[sw_system_body_of(s, node)].waits;
}

sw_status sw_joins_eval(sw_system *s, const double *y) {
  const struct sw_joins *all = s->joins;
  for (size_t k = 0; all && k < all->spring_count; k++)
    if (!waits(s, all->springs[k].i)) SW_TRY(eval_spring(s, &all->springs[k], y));
  for (size_t k = 0; all && k < all->hub_count; k++)
    if (!waits(s, all->hubs[k].arms[0].from)) SW_TRY(eval_hub(s, &all->hubs[k], y));
  return SW_OK;
}

/* Returns the energy of the arms that are nodes from .. to - 1 of the system, at the state. */
static double hub_energy(const sw_system *s, const sw_join_hub *h, size_t from, size_t to) {
  sw_hub_arm arms[SW_HUB_ARMS];
  double sum = 0;
  sw_hub_measure(h, s->x, arms);
  const sw_vec give = sw_join_hub_give(s, h, arms);
  for (size_t a = 0; a < h->count; a++) { /* |p - r|^2/2 = 1 - p.r, without cancellation */
    const sw_vec r = sw_add(arms[a].r, sw_cross(give, arms[a].r));
    if (h->arms[a].node >= from && h->arms[a].node < to)
      sum += 0.5 * h->arms[a].k * sw_norm2(sw_sub(arms[a].p, r));
  }
  return sum;
}

double sw_joins_energy(const sw_system *s) {
  const struct sw_joins *all = s->joins;
  double sum = 0;
  for (size_t k = 0; all && k < all->spring_count; k++)
    if (all->springs[k].k > 0)
      sum += 0.5 * sw_norm2(sw_join_spring_force(&all->springs[k], s->x)) / all->springs[k].k;
  return sum + sw_joins_bend_energy(s, 0, SIZE_MAX);
}

double sw_joins_bend_energy(const sw_system *s, size_t from, size_t to) {
  const struct sw_joins *all = s->joins;
  double sum = 0;
  for (size_t k = 0; all && k < all->hub_count; k++) sum += hub_energy(s, &all->hubs[k], from, to);
  return sum;
}
