/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Springs that yield: the rest length changes when a spring is strained beyond its yield strain in
 * either direction. A spring of stiffness k and rest length l0, elongated by d, has the force k (d
 * - p) with p its plastic elongation. With linear kinematic hardening (Prager), |k (d - p) - h k p|
 * <= k l0 yield. Beyond that, further elongation meets the stiffness k h/(1 + h): 0 without
 * hardening.
 *
 * Backward Euler from the remembered p_o (radial return; Simo and Hughes 1998) has a closed form.
 * With K = (1 + h) k, xi = k d - K p_o and o = max(0, |xi| - k l0 yield): p = p_o + sign(xi) o/K,
 * the minimum over p of
 *   1/2 k (d - p)^2 + 1/2 h k p^2 + k l0 yield |p - p_o|.
 * The spring itself (spring.c) gives 1/2 k d^2; this force adds the difference
 *   W = - k d p_o + 1/2 K p_o^2 - o^2/(2 K),
 * so a spring that never yielded costs only the check of its length. The stiffness is W's second
 * derivative, the consistent tangent. A body's web does not change, so inherit copies histories. */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "force/force.h"

typedef struct yield_args {
  double yield;     /* NAN: the yield of the web's links [-] */
  double hardening; /* [-] */
} yield_args;

static const sw_param rows[] = {
    {"yield", SW_PARAM_NUMBER, "-", NAN, 0, 1, SW_PARAM_REQUIRED | SW_PARAM_ABOVE_MIN, NULL,
     offsetof(yield_args, yield), "strain of a spring beyond which it stays longer or shorter"},
    {"hardening", SW_PARAM_NUMBER, "-", 0, 0, 1e6, 0, NULL, offsetof(yield_args, hardening),
     "yield force gained per plastic elongation, as a share of the spring's stiffness; lost in the "
     "other direction"},
};

/* An excess over the limit below this share of it is rounding and counts as no yield: solves start
 * on the elastic side [-]. */
static const double ON_LIMIT = 1e-10;
static const double CAUTIOUS_SHARE = 0.5; /* share of the softening in cautious stiffness [-] */

typedef struct spring {
  double k, harden, limit; /* [N/m], [N/m], [N] */
  double l, longer;        /* length, elongation [m] */
  double t[3];             /* unit vector along the spring [-] */
  double before, after;    /* plastic elongation [m] */
  double xi, over;         /* [N] */
} spring;

/* Measures spring e; 0: it cannot yield. */
static int measure(const yield_args *a, const sw_web *w, size_t e, const double *x,
                   const double *history, spring *s) {
  const sw_web_link *link = &w->link[e];
  const int own = isnan(a->yield);
  if (own && !w->yield) return 0;
  const double yield = own ? w->yield[e] : a->yield;
  if (isnan(yield)) return 0;
  const double *from = x + 3 * (size_t)link->a, *to = x + 3 * (size_t)link->b;
  double l2 = 0;
  for (int k = 0; k < 3; k++) s->t[k] = to[k] - from[k], l2 += s->t[k] * s->t[k];
  s->l = sqrt(l2);
  for (int k = 0; k < 3; k++) s->t[k] = s->l > 0 ? s->t[k] / s->l : 0.0;
  s->k = link->k, s->harden = (own ? w->hardening[e] : a->hardening) * link->k;
  s->limit = link->k * link->rest * yield;
  s->longer = s->l - link->rest;
  s->before = s->after = history[1 + e];
  s->xi = s->k * s->longer - (s->k + s->harden) * s->before;
  s->over = fabs(s->xi) - s->limit;
  if (!(s->over > ON_LIMIT * s->limit)) s->over = 0;
  s->after += copysign(s->over / (s->k + s->harden), s->xi);
  return 1;
}

static void add_stiffness(const sw_web_link *link, const spring *s, size_t e, sw_field *f) {
  const double flow = s->over > 0 ? s->k * s->k / (s->k + s->harden) : 0.0;
  const double axial = -flow * (f->cautious ? CAUTIOUS_SHARE : 1.0);
  const double geometric = -s->k * s->after / s->l, rest = axial - geometric;
  const double K[6] = {rest * s->t[0] * s->t[0] + geometric,
                       rest * s->t[0] * s->t[1],
                       rest * s->t[0] * s->t[2],
                       rest * s->t[1] * s->t[1] + geometric,
                       rest * s->t[1] * s->t[2],
                       rest * s->t[2] * s->t[2] + geometric};
  sw_field_add_pair(f, link->a, link->b, f->link_slot[e], K);
}

static sw_status eval(const void *args, sw_field *f, sw_error *err SW_UNUSED) {
  const sw_web *w = f->plan->web;
  for (size_t e = 0; e < w->links; e++) {
    spring s;
    if (!measure(args, w, e, f->x, f->history, &s)) continue;
    if (s.after == 0 && s.before == 0) continue;
    const sw_web_link *link = &w->link[e];
    const double T = -s.k * s.after, K = s.k + s.harden;
    for (size_t k = 0; k < 3 && f->want & SW_WANT_FORCE; k++) {
      f->force[3 * (size_t)link->a + k] += T * s.t[k];
      f->force[3 * (size_t)link->b + k] -= T * s.t[k];
    }
    if ((f->want & SW_WANT_STIFFNESS) && s.l > 0) add_stiffness(link, &s, e, f);
    if (!(f->want & SW_WANT_ENERGY)) continue;
    const double elastic = s.before * s.k * (0.5 * s.before - s.longer);
    f->bending += elastic;
    f->energy += elastic + 0.5 * s.harden * s.before * s.before - 0.5 * s.over * s.over / K;
  }
  return SW_OK;
}

static size_t state_size(const sw_plan *plan) { return 1 + plan->web->links; }

static void commit(const void *args, const sw_field *f, double *history) {
  for (size_t e = 0; e < f->plan->web->links; e++) {
    spring s;
    if (!measure(args, f->plan->web, e, f->x, history, &s)) continue;
    history[0] += s.limit * fabs(s.after - s.before);
    history[1 + e] = s.after;
  }
}

static void inherit(const sw_plan *old SW_UNUSED, const double *from, const sw_field *f,
                    double *history) {
  memcpy(history, from, state_size(f->plan) * sizeof *history);
}

const sw_force_class sw_force_plastic_springs = {
    .name = "plastic_springs",
    .summary = "springs of a mesh stay longer or shorter beyond a yield strain, with hardening",
    .corrects = "stretch",
    .flags = SW_FORCE_ANY_BODY | SW_FORCE_OF_WEB,
    .params = SW_PARAMS("force plastic_springs", rows),
    .eval = eval,
    .state_size = state_size,
    .commit = commit,
    .inherit = inherit,
};
