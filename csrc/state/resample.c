/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gives a wire other nodes. A smooth curve through the old nodes gives the new ones. These are then
 * shifted as little as possible so that every edge has the strain of the wire there. (A curve is
 * longer than the wire's chords; without the shift the wire would start stretched, and ring.) */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "state/hinge.h"
#include "state/mesh.h"

enum { MOST_SHIFTS = 40 };
static const double SAME_CHORD = 1e-14; /* relative error at which chords are right [-] */
/* Added to each edge's compliance against shifts, which is 1 per free node [-]. A wire stretched
 * straight between two holds has no room to shift: this keeps its equations regular, and its error
 * stays. */
static const double STIFFENING = 1e-7;

typedef struct resample {
  const sw_mesh *old;
  sw_mesh *out;
  const double *held; /* (held_count x 2) from, to [m] */
  size_t held_count;
  double *diagonal, *next, *rhs, *want; /* (edges) of the equations for the shift */
  double *strain;                       /* (edges) of the unloaded wire or of the wire [-] */
  double *turned, *known; /* (old edges) twist from the first edge on [rad]; of the unloaded wire,
                             chord over length - 1 [-] */
} resample;

static int is_held(const resample *p, double from, double to) {
  for (size_t k = 0; k < p->held_count; k++)
    if (p->held[2 * k] <= from && to <= p->held[2 * k + 1]) return 1;
  return 0;
}

/* 1 if a held stretch begins or ends here. Tension and curvature may jump there. */
static int is_break(const resample *p, double s) {
  for (size_t k = 0; k < 2 * p->held_count; k++)
    if (p->held[k] == s) return 1;
  return 0;
}

static sw_vec slope_between(const sw_mesh *m, const double *values, size_t a, size_t b) {
  const sw_vec d = sw_sub(sw_vec_at(values, b), sw_vec_at(values, a));
  return sw_scale(d, 1.0 / (m->s[b] - m->s[a]));
}

/* Returns the derivative of a node quantity at node i, for the edge between i and j: from the
 * parabola through both and the node before i, or after j where i is an end or break. */
static sw_vec slope_at(const resample *p, const double *values, size_t i, size_t j) {
  const sw_mesh *m = p->old;
  const int up = j > i;
  const sw_vec own = slope_between(m, values, i, j);
  const double l1 = fabs(m->s[j] - m->s[i]);
  const int ends = i == 0 || i + 1 == m->n || is_break(p, m->s[i]);
  if (!ends) {
    const size_t k = up ? i - 1 : i + 1;
    const double l2 = fabs(m->s[i] - m->s[k]);
    const sw_vec other = slope_between(m, values, k, i);
    return sw_scale(sw_add(sw_scale(own, l2), sw_scale(other, l1)), 1.0 / (l1 + l2));
  }
  if (j == 0 || j + 1 == m->n || is_break(p, m->s[j])) return own;
  const size_t k = up ? j + 1 : j - 1;
  const double l2 = fabs(m->s[k] - m->s[j]);
  return sw_madd(own, sw_sub(own, slope_between(m, values, j, k)), l1 / (l1 + l2));
}

/* Returns the old edge that contains arc length s. */
static size_t edge_at(const sw_mesh *m, double s) {
  const size_t i = sw_mesh_node(m, s);
  if (i == 0) return 0;
  return m->s[i] == s && i + 1 < m->n ? i : i - 1;
}

/* Returns a node quantity at arc length s: cubic between nodes, linear where held. */
static sw_vec curve_at(const resample *p, const double *values, double s) {
  const sw_mesh *m = p->old;
  const size_t e = edge_at(m, s);
  const double l = m->s[e + 1] - m->s[e], u = (s - m->s[e]) / l, w = 1 - u;
  const sw_vec a = sw_vec_at(values, e), b = sw_vec_at(values, e + 1);
  if (s == m->s[e]) return a;
  if (s == m->s[e + 1]) return b;
  if (is_held(p, m->s[e], m->s[e + 1])) return sw_lerp(a, b, u);
  const sw_vec da = slope_at(p, values, e, e + 1), db = slope_at(p, values, e + 1, e);
  const sw_vec ends = sw_add(sw_scale(a, w * w * (1 + 2 * u)), sw_scale(b, u * u * (1 + 2 * w)));
  return sw_add(ends, sw_scale(sw_sub(sw_scale(da, w), sw_scale(db, u)), l * u * w));
}

/* Returns an edge quantity at arc length s: linear between the middles of old edges, extrapolated
 * beside ends and breaks. */
static double edge_value_at(const resample *p, const double *values, double s) {
  const sw_mesh *m = p->old;
  const size_t e = edge_at(m, s);
  const int before = e > 0 && !is_break(p, m->s[e]);
  const int after = e + 2 < m->n && !is_break(p, m->s[e + 1]);
  if (!before && !after) return values[e];
  const size_t other = (s < sw_mesh_middle(m, e) ? before : !after) ? e - 1 : e + 1;
  const double share =
      (s - sw_mesh_middle(m, e)) / (sw_mesh_middle(m, other) - sw_mesh_middle(m, e));
  return values[e] + share * (values[other] - values[e]);
}

double sw_mesh_edge_value(const sw_mesh *m, const double *values, double s, const double *held,
                          size_t held_count) {
  const resample p = {.old = m, .held = held, .held_count = held_count};
  return edge_value_at(&p, values, s);
}

/* --- strains --------------------------------------------------------------------- */

static sw_vec edge_vector(const double *x, size_t e) {
  return sw_sub(sw_vec_at(x, e + 1), sw_vec_at(x, e));
}

/* Solves for the edges' multipliers, into rhs. */
static void solve_tridiagonal(resample *p) {
  const size_t m = p->out->n - 1;
  for (size_t e = 0; e + 1 < m; e++) {
    const double factor = p->next[e] / p->diagonal[e];
    p->diagonal[e + 1] -= factor * p->next[e];
    p->rhs[e + 1] -= factor * p->rhs[e];
  }
  for (size_t e = m; e-- > 0;) {
    const double known = e + 1 < m ? p->next[e] * p->rhs[e + 1] : 0.0;
    p->rhs[e] = (p->rhs[e] - known) / p->diagonal[e];
  }
}

static double weight(const resample *p, size_t i) {
  return is_held(p, p->out->s[i], p->out->s[i]) ? 0.0 : 1.0;
}

/* Shifts node quantities (positions x or velocities) to remove their error along the edges at x,
 * given in rhs. */
static void shift(resample *p, const double *x, double *values) {
  const sw_mesh *m = p->out;
  double w = weight(p, 0);
  for (size_t e = 0; e + 1 < m->n; e++) {
    const double after = weight(p, e + 1);
    const int fixed = w + after == 0;
    p->diagonal[e] = fixed ? 1.0 : w + after + STIFFENING;
    p->next[e] =
        e + 2 < m->n ? -after * sw_dot(sw_edge_direction(x, e), sw_edge_direction(x, e + 1)) : 0.0;
    if (fixed) p->rhs[e] = 0;
    w = after;
  }
  solve_tridiagonal(p);
  sw_vec pull = sw_v(0, 0, 0);
  for (size_t i = 0; i < m->n; i++) { /* node i moves after both its edges were read */
    const sw_vec own = i + 1 < m->n ? sw_scale(sw_edge_direction(x, i), p->rhs[i]) : sw_v(0, 0, 0);
    sw_accumulate(values + 3 * i, sw_scale(sw_sub(own, pull), weight(p, i)));
    pull = own;
  }
}

/* Shifts nodes at x until each chord has the length that its strain requires. */
static void give_strains(resample *p, double *x, const double *strain) {
  sw_mesh *m = p->out;
  double before = HUGE_VAL;
  for (int k = 0; k < MOST_SHIFTS; k++) {
    double worst = 0;
    for (size_t e = 0; e + 1 < m->n; e++) {
      const double want = (m->s[e + 1] - m->s[e]) * (1.0 + strain[e]);
      p->rhs[e] = sw_norm(edge_vector(x, e)) - want;
      if (!is_held(p, m->s[e], m->s[e + 1])) worst = fmax(worst, fabs(p->rhs[e]) / want);
    }
    if (worst <= SAME_CHORD || worst > 0.9 * before) return;
    before = worst;
    shift(p, x, x);
  }
}

/* Computes the rate at which each edge gets longer, over its length [1/s]. */
static void old_rates(const sw_mesh *m, double *rate) {
  for (size_t e = 0; e + 1 < m->n; e++)
    rate[e] = sw_dot(sw_edge_direction(m->x, e), edge_vector(m->v, e)) / (m->s[e + 1] - m->s[e]);
}

static void give_rates(resample *p) {
  sw_mesh *m = p->out;
  for (int k = 0; k < 3; k++) {
    for (size_t e = 0; e + 1 < m->n; e++)
      p->rhs[e] = sw_dot(sw_edge_direction(m->x, e), edge_vector(m->v, e)) - p->want[e];
    shift(p, m->x, m->v);
  }
}

/* --- frames ---------------------------------------------------------------------- */

static sw_edge_frame frame_of(const double *x, const double *normals, size_t e) {
  return (sw_edge_frame){sw_edge_direction(x, e), sw_vec_at(normals, e)};
}

/* Computes the normals of the new edges: each is carried from the old edge before it and turned by
 * its share of the twist to the next old edge. p->turned has the twist up to each old edge. */
static void carry_normals(const resample *p, const double *old_x, const double *old_normals,
                          const double *x, double *normals) {
  const sw_mesh *m = p->old, *out = p->out;
  for (size_t e = 0; e + 1 < out->n; e++) {
    const double s = sw_mesh_middle(out, e);
    size_t k = edge_at(m, s);
    if (k > 0 && s < sw_mesh_middle(m, k)) k--;
    const sw_vec t = sw_edge_direction(x, e);
    const sw_edge_frame f = frame_of(old_x, old_normals, k);
    const sw_vec n = sw_carry_unit(f.m1, f.t, t);
    double turn = 0;
    if (k + 2 < m->n && s > sw_mesh_middle(m, k))
      turn = (p->turned[k + 1] - p->turned[k]) * (s - sw_mesh_middle(m, k)) /
             (sw_mesh_middle(m, k + 1) - sw_mesh_middle(m, k));
    sw_store(normals + 3 * e, sw_rotate(sw_quat_exp(sw_scale(t, turn)), n));
  }
}

/* Sums up the twist from the first edge on; of equal angles, takes those nearest to the hinges'
 * known twist. */
static void add_up_twist(resample *p, const double *x, const double *normals, const double *known) {
  p->turned[0] = 0;
  for (size_t e = 1; e + 1 < p->old->n; e++) {
    const sw_edge_frame a = frame_of(x, normals, e - 1), b = frame_of(x, normals, e);
    p->turned[e] = p->turned[e - 1] + sw_hinge_twist(&a, &b, known ? known[e] : 0.0);
  }
}

/* Places the nodes of the unloaded wire. Its edges keep their chords over their lengths, as those
 * of the wire do: else it would begin with a false bend. */
static void give_rest(resample *p) {
  const sw_mesh *m = p->old;
  sw_mesh *out = p->out;
  for (size_t e = 0; e + 1 < m->n; e++)
    p->known[e] = sw_norm(edge_vector(m->rest, e)) / (m->s[e + 1] - m->s[e]) - 1.0;
  for (size_t e = 0; e + 1 < out->n; e++)
    p->strain[e] = edge_value_at(p, p->known, sw_mesh_middle(out, e));
  for (size_t i = 0; i < out->n; i++) sw_store(out->rest + 3 * i, curve_at(p, m->rest, out->s[i]));
  give_strains(p, out->rest, p->strain);
}

static void give_frames(resample *p) {
  const sw_mesh *m = p->old;
  sw_mesh *out = p->out;
  give_rest(p);
  add_up_twist(p, m->rest, m->rest_normal, NULL);
  carry_normals(p, m->rest, m->rest_normal, out->rest, out->rest_normal);
  add_up_twist(p, m->x, m->normal, m->twist);
  carry_normals(p, m->x, m->normal, out->x, out->normal);
  for (size_t e = 0; e + 1 < out->n; e++) {
    out->turn[e] = edge_value_at(p, m->turn, sw_mesh_middle(out, e));
    out->spin[e] = edge_value_at(p, m->spin, sw_mesh_middle(out, e));
  }
  for (size_t i = 1; i + 1 < out->n; i++)
    out->twist[i] = edge_value_at(p, p->turned, sw_mesh_middle(out, i)) -
                    edge_value_at(p, p->turned, sw_mesh_middle(out, i - 1));
  for (size_t i = 0; i < out->n; i++) { /* at clamps, for both their sides */
    const size_t k = sw_mesh_node(m, out->s[i]);
    const int same = k < m->n && m->s[k] == out->s[i];
    if (same && (k == 0 || k + 1 == m->n || is_break(p, m->s[k]))) out->twist[i] = m->twist[k];
  }
}

void sw_mesh_strain_as_held(sw_mesh *m, double from, double to) {
  for (size_t e = sw_mesh_node(m, from); m->s[e] < to; e++)
    m->tension[e] = m->EA * (sw_norm(edge_vector(m->x, e)) / (m->s[e + 1] - m->s[e]) - 1.0);
}

sw_status sw_mesh_resample(const sw_mesh *from, const double *s, size_t count, const double *held,
                           size_t held_count, sw_mesh *out) {
  resample p = {.old = from, .out = out, .held = held, .held_count = held_count};
  SW_TRY(sw_mesh_like(from, count, out));
  double *block SW_LOCAL = sw_alloc(5 * count + 2 * from->n, sizeof *block);
  if (!block) {
    sw_mesh_free(out);
    return SW_ENOMEM;
  }
  p.diagonal = block, p.next = block + count, p.rhs = block + 2 * count, p.want = block + 3 * count;
  p.strain = block + 4 * count, p.turned = block + 5 * count;
  double *rate = p.known = p.turned + from->n; /* the rates are needed no more when known is made */
  out->drawn = 0;
  memcpy(out->s, s, count * sizeof *s);
  old_rates(from, rate);
  for (size_t i = 0; i < count; i++) {
    sw_store(out->x + 3 * i, curve_at(&p, from->x, s[i]));
    sw_store(out->v + 3 * i, curve_at(&p, from->v, s[i]));
  }
  for (size_t e = 0; e + 1 < count; e++) {
    out->tension[e] = edge_value_at(&p, from->tension, sw_mesh_middle(out, e));
    out->rate[e] = edge_value_at(&p, from->rate, sw_mesh_middle(out, e));
    p.want[e] = (s[e + 1] - s[e]) * edge_value_at(&p, rate, sw_mesh_middle(out, e));
  }
  for (size_t e = 0; e + 1 < count; e++) p.strain[e] = out->tension[e] / out->EA;
  give_strains(&p, out->x, p.strain);
  for (size_t k = 0; k < held_count; k++) sw_mesh_strain_as_held(out, held[2 * k], held[2 * k + 1]);
  give_rates(&p);
  if (from->rest) give_frames(&p);
  return SW_OK;
}
