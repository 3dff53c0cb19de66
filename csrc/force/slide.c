/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of a composite that slide on each other along the wire, with Coulomb friction. Each element
 * is two facing edges, one of each part, from one ring to the next (state/slide.h): r is the offset
 * between their middles, t the unit vector along them, u = r.t, d = r - u t, n = d/|d|.
 *
 * Across: E = 1/2 k (|d| - d0)^2 in both directions, because the shell encloses the cores: where
 * they part on one side they press on the other. Along: a spring K (u - p) that slips, |K (u - p)|
 * <= L = friction (grip + |k (|d| - d0)|). L uses the pressure of the last accepted state, so L is
 * constant within a step and lags one step behind. Backward Euler from the remembered p_o (radial
 * return; Simo and Hughes 1998), with xi = K (u - p_o) and o = max(0, |xi| - L), is p = p_o +
 * sign(xi) o/K, the minimum over p of
 *   1/2 K (u - p)^2 + L |p - p_o| = xi^2/(2 K) - o^2/(2 K).
 * Around the wire only the springs across resist, where they are inclined to each other.
 *
 * With e the sum of the edges and l its length, the derivatives with respect to r and e are
 *   u_r = t, u_e = d/l; |d|_r = n, |d|_e = -u n/l; with Q = I - t t' - n n',
 *   u_re = (I - t t')/l, u_ee = -(t d' + d t' + u (I - t t'))/l^2,
 *   |d|_rr = Q/|d|, |d|_re = -t n'/l - u Q/(l |d|),
 *   |d|_ee = (-|d| n n' + u (t n' + n t') + u^2 Q/|d|)/l^2.
 * Both depend only on differences of positions and are invariant under rotation, so forces and
 * moments sum to zero. Edges stay paired: valid while the distance slid is short against the wire's
 * radius of curvature. */
#include "state/slide.h"

#include <math.h>
#include <string.h>

#include "force/force.h"

/* An excess over the limit below this share of it is rounding and counts as no slip: solves start
 * on the elastic side [-]. */
static const double ON_LIMIT = 1e-10;

typedef struct pair {
  sw_slide_place at;
  double press;         /* k (|d| - d0) [N] */
  double stick;         /* stiffness along; 0: nothing resists [N/m] */
  double limit;         /* limit of the force along [N] */
  double before, after; /* slip [m] */
  double xi, over;      /* [N] */
} pair;

/* Measures pair number. history: this pair's slip and pressure [m, N]. */
static void measure(const sw_web *w, size_t number, const double *x, const double *history,
                    pair *p) {
  const sw_web_slide *s = &w->slide[number];
  const double *at[SW_SLIDE_NODES];
  for (int i = 0; i < SW_SLIDE_NODES; i++) at[i] = x + 3 * (size_t)s->node[i];
  p->at = sw_slide_measure(at);
  p->press = s->press * (p->at.apart - s->apart);
  p->stick = w->friction > 0 ? s->stick : 0;
  p->limit = w->friction * (s->grip + fabs(history[1]));
  p->before = p->after = history[0];
  p->xi = p->stick * (p->at.u - s->along - p->before);
  p->over = fabs(p->xi) - p->limit;
  if (!(p->over > ON_LIMIT * p->limit)) p->over = 0;
  if (p->over > 0) p->after += copysign(p->over / p->stick, p->xi);
}

/* Returns the force along the wire [N]. */
static double along(const pair *p) { return p->over > 0 ? copysign(p->limit, p->xi) : p->xi; }

static void add_force(const sw_web_slide *s, const pair *p, double *force) {
  const double F = along(p), N = p->press, l = p->at.l;
  for (int k = 0; k < 3; k++) {
    const double t = p->at.t[k], n = p->at.n[k];
    const double by_offset = F * t + N * n, by_edge = (F * p->at.apart - N * p->at.u) * n / l;
    for (int i = 0; i < SW_SLIDE_NODES; i++)
      force[3 * (size_t)s->node[i] + (size_t)k] -=
          sw_slide_offset[i] * by_offset + sw_slide_edge[i] * by_edge;
  }
}

/* Second derivatives by r r, r e and e e, without the stiffness k of the spring across. */
static void derive(const pair *p, int cautious, double H[3][9]) {
  const double *t = p->at.t, *n = p->at.n, l = p->at.l, u = p->at.u, d = p->at.apart;
  /* A slipping pair's cautious stiffness is the secant to the slip limit: an upper bound from which
   * iterations converge downwards. */
  const double slack = cautious ? p->limit / fabs(p->xi) : 0.0;
  const double K = p->over > 0 ? slack * p->stick : p->stick;
  /* The terms of the forces themselves make the matrix indefinite; cautious iterations omit
   * them. */
  const double F = cautious ? 0.0 : along(p), N = cautious ? 0.0 : p->press;
  const double k = p->at.apart > 0 ? N / d : 0.0;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      const double P = (i == j) - t[i] * t[j], nn = n[i] * n[j], Q = P - nn;
      const double both = t[i] * n[j] + n[i] * t[j];
      H[0][3 * i + j] = K * t[i] * t[j] + k * Q;
      H[1][3 * i + j] = (K * d * t[i] * n[j] + F * P - N * t[i] * n[j] - k * u * Q) / l;
      H[2][3 * i + j] =
          (K * d * d * nn - F * (d * both + u * P) - N * d * nn + N * u * both + k * u * u * Q) /
          (l * l);
    }
}

static void add_stiffness(const sw_web_slide *s, const pair *p, size_t number, sw_field *f) {
  const size_t *slot = f->slide_slot + SW_FIELD_SLIDE_PAIRS * number;
  const double *n = p->at.n, c = p->at.u / p->at.l;
  double H[3][9], B[9];
  derive(p, f->cautious, H);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      const double nn = s->press * n[i] * n[j];
      H[0][3 * i + j] += nn, H[1][3 * i + j] -= c * nn, H[2][3 * i + j] += c * c * nn;
    }
  for (int a = 0; a < SW_SLIDE_NODES; a++)
    for (int b = 0; b <= a; b++) {
      const double ra = sw_slide_offset[a], ea = sw_slide_edge[a];
      const double rb = sw_slide_offset[b], eb = sw_slide_edge[b];
      for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
          B[3 * i + j] = ra * rb * H[0][3 * i + j] + ra * eb * H[1][3 * i + j] +
                         ea * rb * H[1][3 * j + i] + ea * eb * H[2][3 * i + j];
      if (a != b) {
        sw_field_add_block(f, s->node[a], s->node[b], *slot++, B, 3);
        continue;
      }
      double *own = f->blocks + f->own_slot[s->node[a]];
      for (size_t i = 0; i < 3; i++)
        for (size_t j = 0; j < 3; j++) own[i * f->block_stride + j] += B[3 * i + j];
    }
}

static sw_status eval(const void *args SW_UNUSED, sw_field *f, sw_error *err SW_UNUSED) {
  const sw_web *w = f->plan->web;
  for (size_t i = 0; i < w->slides; i++) {
    pair p;
    measure(w, i, f->x, f->history + 1 + 2 * i, &p);
    if (f->want & SW_WANT_FORCE) add_force(&w->slide[i], &p, f->force);
    if (f->want & SW_WANT_STIFFNESS) add_stiffness(&w->slide[i], &p, i, f);
    if (!(f->want & SW_WANT_ENERGY)) continue;
    f->energy += 0.5 * p.press * p.press / w->slide[i].press;
    if (p.stick > 0) f->energy += 0.5 * (p.xi * p.xi - p.over * p.over) / p.stick;
  }
  return SW_OK;
}

static int applies(const sw_plan *plan) { return plan->web && plan->web->slides > 0; }

static size_t state_size(const sw_plan *plan) { return 1 + 2 * plan->web->slides; }

static void commit(const void *args SW_UNUSED, const sw_field *f, double *history) {
  const sw_web *w = f->plan->web;
  for (size_t i = 0; i < w->slides; i++) {
    double *own = history + 1 + 2 * i;
    pair p;
    measure(w, i, f->x, own, &p);
    history[0] += p.limit * fabs(p.after - p.before);
    own[0] = p.after, own[1] = p.press;
  }
}

/* Copies the history for the same mesh. Another mesh starts without slip and keeps the dissipated
 * work. */
static void inherit(const sw_plan *old, const double *from, const sw_field *f, double *history) {
  if (old->web == f->plan->web)
    memcpy(history, from, state_size(f->plan) * sizeof *history);
  else
    history[0] = from[0];
}

static double stable_dt(const void *args SW_UNUSED, const sw_plan *plan) {
  return plan->web->slide_rate2 > 0 ? 2.0 / sqrt(plan->web->slide_rate2) : HUGE_VAL;
}

const sw_force_class sw_force_slide = {
    .name = "slide",
    .summary = "contact of the parts of a composite, which slide along the wire with friction",
    .loses = "friction",
    .flags = SW_FORCE_INNER | SW_FORCE_ANY_BODY,
    .params = {"force slide", NULL, 0},
    .eval = eval,
    .stable_dt = stable_dt,
    .applies = applies,
    .state_size = state_size,
    .commit = commit,
    .inherit = inherit,
};
