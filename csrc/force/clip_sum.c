/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrates the clip's potential along an edge: quadrature, forces, stiffness. */
#include "force/clip_sum.h"

#include <math.h>
#include <string.h>

enum { FINENESS = 16 };                /* places over the clip's width, at least [-] */
enum { NEXT = 6, ROW = SW_FIELD_ROW }; /* offset and size in a node's row of the field */

static const double STEEPEST = 1e6;   /* largest ratio of the lip forces and flanks [-] */
static const double STRONGEST = 1e12; /* largest lip force [N] */

/* A flank of length 0 would have no slope. */
sw_status sw_clip_check_lips(const sw_clip_args *a, const char *kind, sw_error *err) {
  const double larger = fmax(a->insertion, a->retention);
  const double smaller = fmin(a->insertion, a->retention);
  if (larger > STRONGEST || larger > STEEPEST * smaller)
    return sw_fail(err, SW_EINVAL,
                   "force %s: insertion = %g N and retention = %g N are not allowed; they must be "
                   "at most %g N, and one at most %g times the other",
                   kind, a->insertion, a->retention, STRONGEST, STEEPEST);
  return SW_OK;
}

sw_clip sw_clip_of(const sw_clip_args *a, const sw_beam *beam) {
  sw_clip c = {.at = a->at, .width = a->width, .friction = a->friction};
  c.direction = sw_unit_or(a->direction, sw_v(0, 0, 1));
  const sw_vec axis = sw_madd(a->axis, c.direction, -sw_dot(a->axis, c.direction));
  c.axis = sw_unit_or(axis, sw_perpendicular(c.direction));
  c.across = sw_cross(c.direction, c.axis);
  c.insertion = a->insertion, c.retention = a->retention;
  c.strongest = fmax(a->insertion, a->retention);
  c.law = sw_clip_law_of(beam->radius, a->radius, a->insertion, a->retention, a->way, a->stiffness,
                         a->strength);
  return c;
}

static void local_of(const sw_clip *c, sw_vec x, double out[3]) {
  const sw_vec d = sw_sub(x, c->at);
  out[0] = sw_dot(d, c->direction), out[1] = sw_dot(d, c->across), out[2] = sw_dot(d, c->axis);
}

sw_vec sw_clip_world(const sw_clip *c, const double g[3]) {
  return sw_madd(sw_madd(sw_scale(c->direction, g[0]), c->across, g[1]), c->axis, g[2]);
}

/* Items of a whole matrix in its upper half. */
static const int WHOLE[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};

/* Second derivatives of w U chi with respect to u, v, a; upper half. */
static void second(const sw_clip_point *p, const double chi[3], double w, double H[6]) {
  H[0] = w * chi[0] * p->uu, H[1] = w * chi[0] * p->uv, H[2] = w * chi[1] * p->u;
  H[3] = w * chi[0] * p->vv, H[4] = w * chi[1] * p->v, H[5] = w * chi[2] * p->energy;
}

/* Adds second derivatives at a place of an edge; part: shares of its ends; next: the coupling's
 * upper half [N/m]. */
static void add_stiffness(const sw_clip_point *p, const double part[2], const double chi[3],
                          double w, sw_clip_sum *out, double next[6]) {
  double H[6];
  second(p, chi, w, H);
  for (int k = 0; k < 6; k++) {
    out->own[0][k] += part[0] * part[0] * H[k];
    out->own[1][k] += part[1] * part[1] * H[k];
    next[k] += part[0] * part[1] * H[k];
  }
}

/* Adds a place of weight w to where the wire is in the clip. */
static void add_middle(const sw_clip *c, const double x[3], double w, double s, sw_clip_sum *out) {
  const double in = w * sw_clip_between(&c->law, x[1]);
  out->all[0] += w, out->all[1] += w * x[0], out->all[2] += w * x[1];
  out->share += in, out->u += in * x[0], out->v += in * x[1], out->s += in * s;
}

/* Adds one place at t along the edge, of weight w. */
static void add_place(const sw_clip *c, const double x[3], double t, const double chi[3], double w,
                      double s, int what, sw_clip_sum *out, double next[6]) {
  const double part[2] = {1.0 - t, t};
  if (what & SW_CLIP_WANT_MIDDLE) add_middle(c, x, w * chi[0], s, out);
  const sw_clip_point p = sw_clip_at(&c->law, x[0], x[1]);
  const double push = what & SW_CLIP_WANT_PUSH ? hypot(p.u, p.v) : 0.0;
  out->energy += w * chi[0] * p.energy;
  for (int end = 0; end < 2; end++) {
    out->g[end][0] += part[end] * w * chi[0] * p.u;
    out->g[end][1] += part[end] * w * chi[0] * p.v;
    out->g[end][2] += part[end] * w * chi[1] * p.energy;
    out->push[end] += part[end] * w * chi[0] * push;
  }
  if (what & SW_CLIP_WANT_STIFFNESS) add_stiffness(&p, part, chi, w, out, next);
}

/* Adds the derivatives of the weight, which changes with the edge's way along the axis. */
static void add_weight(const sw_clip_walk *w, int stiffness, sw_clip_sum *out) {
  const double sum = out->energy / w->weight; /* of U chi over the places [J] */
  double G[2][3];
  for (int end = 0; end < 2; end++)
    for (int k = 0; k < 3; k++) G[end][k] = w->slope / w->weight * out->g[end][k];
  out->g[0][2] -= w->slope * sum, out->g[1][2] += w->slope * sum;
  if (!stiffness) return;
  for (int end = 0; end < 2; end++) {
    const double way = end ? 1.0 : -1.0;
    out->own[end][2] += way * G[end][0], out->own[end][4] += way * G[end][1];
    out->own[end][5] += 2.0 * way * G[end][2] + w->curve * sum;
  }
  for (int k = 0; k < 3; k++) out->next[6 + k] -= G[1][k], out->next[3 * k + 2] += G[0][k];
  out->next[8] -= w->curve * sum;
}

/* Finds the first and last of n evenly spaced places between a and b that may lie in the window; 0:
 * none. */
static int range(double a, double b, double half, long n, long *first, long *last) {
  const double low = fmin(a, b), high = fmax(a, b);
  if (low >= half || high <= -half) return 0;
  double t0 = 0, t1 = 1;
  if (high - low > 1e-12 * half) {
    t0 = (-half - a) / (b - a), t1 = (half - a) / (b - a);
    if (t0 > t1) {
      const double swap = t0;
      t0 = t1, t1 = swap;
    }
    t0 = fmax(0.0, t0), t1 = fmin(1.0, t1);
  }
  *first = (long)floor(t0 * (double)n - 0.5), *last = (long)ceil(t1 * (double)n - 0.5);
  *first = *first < 0 ? 0 : *first, *last = *last > n - 1 ? n - 1 : *last;
  return 1;
}

/* Cosine of the steepest crossing that the clip's model covers, 45 degrees [-]. */
static const double STEEP = 0.70710678118654752;

/* Fills the length of an edge as the clip sees it, and its derivatives by `way`, the edge's way
 * along the axis: |way|, and a parabola that does not vanish for a wire that crosses more steeply.
 */
static void length_of(double way, double length, double out[3]) {
  const double least = STEEP * length;
  const int along = fabs(way) >= least;
  out[0] = along ? fabs(way) : 0.5 * (way * way / least + least);
  out[1] = along ? copysign(1.0, way) : way / least;
  out[2] = along ? 0.0 : 1.0 / least;
}

long sw_clip_find(const sw_clip *c, const sw_field *f, long from) {
  const long points = (long)sw_axis_points(f->plan);
  const double half = 0.5 * c->width, zero = sw_dot(c->axis, c->at);
  if (from + 1 >= points) return SW_CLIP_NO_EDGE;
  double last = sw_dot(c->axis, sw_axis_at(f, (size_t)from)) - zero;
  for (long e = from; e + 1 < points; e++) {
    const double next = sw_dot(c->axis, sw_axis_at(f, (size_t)e + 1)) - zero;
    if (!((last >= half && next >= half) || (last <= -half && next <= -half))) return e;
    last = next;
  }
  return SW_CLIP_NO_EDGE;
}

int sw_clip_begin(const sw_clip *c, const sw_field *f, size_t e, sw_clip_walk *w) {
  const sw_vec end[2] = {sw_axis_at(f, e), sw_axis_at(f, e + 1)};
  return sw_clip_begin_at(c, f->plan, e, end, w);
}

int sw_clip_begin_at(const sw_clip *c, const sw_plan *plan, size_t e, const sw_vec end[2],
                     sw_clip_walk *w) {
  const double most = 1e6;
  double seen[3];
  long first;
  local_of(c, end[0], w->a);
  local_of(c, end[1], w->b);
  w->half = 0.5 * c->width;
  w->s = sw_axis_s(plan, e);
  w->length = sw_axis_s(plan, e + 1) - w->s;
  w->count = (long)fmin(most, ceil(FINENESS * w->length / c->width));
  if (!range(w->a[2], w->b[2], w->half, w->count, &first, &w->last)) return 0;
  w->k = first;
  length_of(w->b[2] - w->a[2], w->length, seen);
  const double share = 1.0 / ((double)w->count * c->width);
  w->weight = share * seen[0], w->slope = share * seen[1], w->curve = share * seen[2];
  w->begun = 0;
  return 1;
}

void sw_clip_begin_window(sw_clip_walk *w) {
  const double part = (w->b[2] - w->a[2]) / (double)w->count; /* way from place to place [m] */
  const double first = w->a[2] + ((double)w->k + 0.5) * part;
  w->rate = M_PI / w->half, w->begun = 1;
  w->now[0] = cos(w->rate * first), w->now[1] = sin(w->rate * first);
  w->turn[0] = cos(w->rate * part), w->turn[1] = sin(w->rate * part);
}

int sw_clip_far(const sw_clip *c, const sw_clip_walk *w) {
  const sw_clip_law *l = &c->law;
  if (fmin(w->a[0], w->b[0]) >= l->out + l->in) return 1;
  if (l->caught) return 0;
  const double side = l->clearance + 0.5 * l->in + 2.0 * l->reach;
  return fmax(w->a[0], w->b[0]) <= -l->clearance - 2.0 * l->reach ||
         fmin(w->a[1], w->b[1]) >= side || fmax(w->a[1], w->b[1]) <= -side;
}

void sw_clip_sum_of(const sw_clip *c, sw_clip_walk *w, int what, sw_clip_sum *out) {
  double x[3], t, chi[3], next[6] = {0};
  memset(out, 0, sizeof *out);
  while (sw_clip_next(w, x, &t, chi))
    add_place(c, x, t, chi, w->weight, w->s + t * w->length, what, out, next);
  for (int k = 0; k < 9; k++) out->next[k] = next[WHOLE[k]];
  add_weight(w, what & SW_CLIP_WANT_STIFFNESS, out);
}

int sw_clip_edge(const sw_clip *c, const sw_field *f, size_t e, int what, sw_clip_sum *out) {
  sw_clip_walk w;
  if (!sw_clip_begin(c, f, e, &w)) return 0;
  sw_clip_sum_of(c, &w, what, out);
  return 1;
}

/* --- on the wire --------------------------------------------------------------------- */

/* Turns local second derivatives H into world axes: Q' H Q. */
static void turn(const sw_clip *c, const double H[9], double out[9]) {
  const double q[9] = {c->direction.x, c->direction.y, c->direction.z, c->across.x, c->across.y,
                       c->across.z,    c->axis.x,      c->axis.y,      c->axis.z};
  double half[9]; /* H Q */
  for (int k = 0; k < 3; k++)
    for (int j = 0; j < 3; j++)
      half[3 * k + j] = H[3 * k] * q[j] + H[3 * k + 1] * q[3 + j] + H[3 * k + 2] * q[6 + j];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      out[3 * i + j] = q[i] * half[j] + q[3 + i] * half[3 + j] + q[6 + i] * half[6 + j];
}

/* The same of one end's own derivatives. lump: NULL; or of the coupling, whose symmetric part is
 * added. */
static void turn_own(const sw_clip *c, const double own[6], const double *lump, double out[9]) {
  double H[9];
  for (int k = 0; k < 9; k++) {
    const int other = 3 * (k % 3) + k / 3;
    H[k] = own[WHOLE[k]] + (lump ? 0.5 * (lump[k] + lump[other]) : 0.0);
  }
  turn(c, H, out);
}

void sw_clip_on_edge(const sw_clip *c, sw_field *f, size_t e, const sw_clip_sum *sum) {
  const int stiffness = (f->want & SW_WANT_STIFFNESS) != 0, mesh = f->plan->web != NULL;
  double K[9];
  for (size_t end = 0; end < 2; end++) {
    if (stiffness) turn_own(c, sum->own[end], mesh ? sum->next : NULL, K);
    sw_axis_put(f, e + end, sw_neg(sw_clip_world(c, sum->g[end])), stiffness ? K : NULL);
  }
  if (!stiffness || mesh) return;
  turn(c, sum->next, K);
  for (int k = 0; k < 9; k++) f->rows[ROW * e + NEXT + (size_t)k] += K[k];
}

/* The weights' part: of a node's two edges, each couples a move along the axis with one across by
 * the lips' force over the width, and moves along it by the window's. chi is at most 2. */
double sw_clip_stiffness(const sw_clip *c, double slip) {
  const double turn_rate = 2.0 * M_PI / c->width;
  const double weights = 8.0 * (c->strongest + turn_rate * c->law.top) / c->width;
  return sw_clip_stiffest(&c->law) + turn_rate * turn_rate * c->law.top + weights +
         c->friction * c->strongest / slip;
}
