/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An arm of a hub is the vector a with direction p; r = R d. Its energy k (1 - p.r) has the
 * derivative -k u/|a| with u = r - (p.r) p, and the second derivative
 *   k (p u' + u p' + (p.r)(I - p p'))/|a|^2.
 * A further turn w of the hub has the coupling k (I - p p')[r x]/|a| with the arm, and with itself
 * the sum of k ((p.r) I - (p r' + r p')/2). It is eliminated, since it has no inertia. */
#include "system/join.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "solve/band3.h"
#include "solve/rotation.h"
#include "state/tie.h"
#include "system/part.h"

void sw_joins_free(sw_system *s) {
  if (!s->joins) return;
  SW_FREE_ALL(s->joins->springs, s->joins->hubs, s->joins);
  s->joins = NULL;
}

static struct sw_joins *joins_of(sw_system *s) {
  if (!s->joins) s->joins = sw_alloc(1, sizeof *s->joins);
  return s->joins;
}

/* --- plan ------------------------------------------------------------------------ */

/* 1 if the block of nodes i < j is in the rows of their body's own band. */
static int in_band(const sw_system *s, uint32_t i, uint32_t j) {
  return j - i <= 2 && sw_system_body_of(s, i) == sw_system_body_of(s, j);
}

static sw_status plan(sw_system *s, uint32_t i, uint32_t j) {
  const uint32_t low = i < j ? i : j, high = i < j ? j : i;
  return in_band(s, low, high) ? SW_OK : sw_system_plan_bridge(s, low, high);
}

static sw_status plan_hub(sw_system *s, const sw_join_hub *h) {
  for (size_t a = 0; a < h->count; a++)
    for (size_t b = a + 1; b < h->count; b++) {
      SW_TRY(plan(s, h->arms[a].from, h->arms[b].from));
      SW_TRY(plan(s, h->arms[a].from, h->arms[b].to));
      SW_TRY(plan(s, h->arms[a].to, h->arms[b].from));
      SW_TRY(plan(s, h->arms[a].to, h->arms[b].to));
    }
  return SW_OK;
}

sw_status sw_joins_plan(sw_system *s) {
  const struct sw_joins *all = s->joins;
  for (size_t k = 0; all && k < all->spring_count; k++)
    SW_TRY(plan(s, all->springs[k].i, all->springs[k].j));
  for (size_t k = 0; all && k < all->hub_count; k++) SW_TRY(plan_hub(s, &all->hubs[k]));
  return SW_OK;
}

sw_status sw_system_add_spring(sw_system *s, const sw_join_spring *spring) {
  struct sw_joins *all = joins_of(s);
  if (!all) return SW_ENOMEM;
  SW_TRY(SW_GROW(all->springs, all->spring_capacity, all->spring_count + 1));
  all->springs[all->spring_count++] = *spring;
  return plan(s, spring->i, spring->j);
}

sw_status sw_system_add_hub(sw_system *s, const sw_join_hub *hub) {
  struct sw_joins *all = joins_of(s);
  if (!all) return SW_ENOMEM;
  SW_TRY(SW_GROW(all->hubs, all->hub_capacity, all->hub_count + 1));
  all->hubs[all->hub_count++] = *hub;
  return plan_hub(s, hub);
}

/* --- forces ---------------------------------------------------------------------- */

static void add_force(sw_system *s, uint32_t node, sw_vec f) {
  sw_body *b = &s->bodies[sw_system_body_of(s, node)];
  sw_accumulate(b->field.force + 3 * (node - b->first_node), f);
}

/* Adds stiffness between nodes i and j, with i's rows; for i == j the whole symmetric block. */
static sw_status add_block(sw_system *s, uint32_t i, uint32_t j, const double k[9]) {
  static const size_t upper[6] = {0, 1, 2, 4, 5, 8};
  if (i > j) {
    const double turned[9] = {k[0], k[3], k[6], k[1], k[4], k[7], k[2], k[5], k[8]};
    return add_block(s, j, i, turned);
  }
  if (!in_band(s, i, j)) return sw_system_add_bridge(s, i, j, k);
  sw_body *b = &s->bodies[sw_system_body_of(s, i)];
  double *row = b->field.rows + SW_ROW_SIZE * (i - b->first_node);
  for (size_t m = 0; i == j && m < 6; m++) row[SW_ROW_OWN + m] += k[upper[m]];
  for (size_t m = 0; j == i + 1 && m < 9; m++) row[SW_ROW_NEXT + m] += k[m];
  for (size_t m = 0; j == i + 2 && m < 9; m++) row[SW_ROW_SECOND + m] += k[m];
  return SW_OK;
}

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
  add_force(s, p->i, f);
  add_force(s, p->j, sw_neg(f));
  SW_TRY(add_block(s, p->i, p->i, own));
  SW_TRY(add_block(s, p->j, p->j, own));
  return add_block(s, p->i, p->j, other);
}

/* --- matrices of three by three --------------------------------------------------- */

static void add_unit(double out[9], double f) { out[0] += f, out[4] += f, out[8] += f; }

static void multiply(const double a[9], const double b[9], double out[9]) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      out[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
}

static void transpose(const double a[9], double out[9]) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) out[3 * i + j] = a[3 * j + i];
}

/* Inverts a regular symmetric matrix. */
static void invert(const double a[9], double out[9]) {
  const double c0 = a[4] * a[8] - a[5] * a[7], c1 = a[5] * a[6] - a[3] * a[8];
  const double c2 = a[3] * a[7] - a[4] * a[6];
  const double r = 1.0 / (a[0] * c0 + a[1] * c1 + a[2] * c2);
  out[0] = r * c0, out[1] = out[3] = r * c1, out[2] = out[6] = r * c2;
  out[4] = r * (a[0] * a[8] - a[2] * a[6]), out[8] = r * (a[0] * a[4] - a[1] * a[3]);
  out[5] = out[7] = r * (a[2] * a[3] - a[0] * a[5]);
}

/* --- hubs ------------------------------------------------------------------------ */

/* The present state of an arm. */
typedef struct arm {
  sw_vec p, r;       /* its direction; its rest direction turned with the hub [-] */
  double inverse, c; /* 1 over its length [1/m], p.r [-] */
} arm;

static void measure(const sw_join_hub *h, const double *x, arm *arms) {
  double B[9] = {0};
  for (size_t a = 0; a < h->count; a++) {
    const sw_vec edge = sw_sub(sw_vec_at(x, h->arms[a].to), sw_vec_at(x, h->arms[a].from));
    arms[a].inverse = 1.0 / sw_norm(edge);
    arms[a].p = sw_scale(edge, arms[a].inverse);
    sw_add_outer(B, arms[a].p, h->arms[a].rest, h->arms[a].k);
  }
  const sw_quat q = sw_rotation_fit(B);
  for (size_t a = 0; a < h->count; a++) {
    arms[a].r = sw_rotate(q, h->arms[a].rest);
    arms[a].c = sw_dot(arms[a].p, arms[a].r);
  }
}

/* Returns the energy of a hub's arms at nodes from .. to - 1. */
static double hub_energy(const sw_join_hub *h, const double *x, size_t from, size_t to) {
  arm arms[SW_HUB_ARMS];
  double sum = 0;
  measure(h, x, arms);
  for (size_t a = 0; a < h->count; a++) /* |p - r|^2/2 = 1 - p.r, without cancellation */
    if (h->arms[a].node >= from && h->arms[a].node < to)
      sum += 0.5 * h->arms[a].k * sw_norm2(sw_sub(arms[a].p, arms[a].r));
  return sum;
}

sw_vec sw_join_hub_moment(const sw_join_hub *h, size_t number, const double *x) {
  arm arms[SW_HUB_ARMS];
  measure(h, x, arms);
  return sw_scale(sw_cross(arms[number].p, arms[number].r), h->arms[number].k);
}

/* Stiffness about a free axis, so that the matrix is regular; over the sum of all arms' stiffness
 * [-]. */
static const double FREE_AXIS = 1e-9;

/* Computes the inverse of the hub's own stiffness against turning. An axis along all arms is free:
 * FREE_AXIS makes the matrix regular. */
static void turn_compliance(const sw_join_hub *h, const arm *arms, double out[9]) {
  double H[9] = {0}, sum = 0;
  for (size_t a = 0; a < h->count; a++) {
    const double k = h->arms[a].k;
    add_unit(H, k * arms[a].c);
    sw_add_outer(H, arms[a].p, arms[a].r, -0.5 * k);
    sw_add_outer(H, arms[a].r, arms[a].p, -0.5 * k);
    sum += k;
  }
  /* parallel arms do not turn with that axis: any stiffness there gives the same result */
  add_unit(H, FREE_AXIS * sum);
  invert(H, out);
}

/* Computes (I - p p') [r x] k/|a| of an arm. */
static void turn_coupling(const arm *v, double k, double out[9]) {
  const sw_vec r = v->r, columns[3] = {{0, r.z, -r.y}, {-r.z, 0, r.x}, {r.y, -r.x, 0}};
  for (size_t j = 0; j < 3; j++) {
    const sw_vec c = sw_scale(sw_madd(columns[j], v->p, -sw_dot(columns[j], v->p)), k * v->inverse);
    out[j] = c.x, out[3 + j] = c.y, out[6 + j] = c.z;
  }
}

/* Adds the stiffness K between the vectors of two arms to their nodes. */
static sw_status add_arms(sw_system *s, const struct sw_join_arm *a, const struct sw_join_arm *b,
                          const double K[9]) {
  double minus[9], both[9];
  for (size_t m = 0; m < 9; m++) minus[m] = -K[m];
  if (a == b) {
    SW_TRY(add_block(s, a->from, a->from, K));
    SW_TRY(add_block(s, a->to, a->to, K));
    return add_block(s, a->from, a->to, minus);
  }
  const uint32_t i[2] = {a->from, a->to}, j[2] = {b->from, b->to};
  for (size_t m = 0; m < 2; m++)
    for (size_t n = 0; n < 2; n++) {
      const double *k = m == n ? K : minus;
      /* a node in both arms gets the block and its transpose */
      for (int c = 0; c < 9; c++) both[c] = k[c] + k[3 * (c % 3) + c / 3];
      SW_TRY(add_block(s, i[m], j[n], i[m] == j[n] ? both : k));
    }
  return SW_OK;
}

/* Stiffness of an arm's vector while the hub does not turn. */
static void own_stiffness(const arm *v, double k, double out[9]) {
  const sw_vec u = sw_madd(v->r, v->p, -v->c);
  const double f = k * v->inverse * v->inverse;
  memset(out, 0, 9 * sizeof *out);
  sw_add_outer(out, v->p, u, f);
  sw_add_outer(out, u, v->p, f);
  sw_add_outer(out, v->p, v->p, -f * v->c);
  add_unit(out, f * v->c);
}

static sw_status eval_hub(sw_system *s, const sw_join_hub *h, const double *y) {
  arm arms[SW_HUB_ARMS];
  double coupling[SW_HUB_ARMS][9], C[9], own[9];
  measure(h, y, arms);
  turn_compliance(h, arms, C);
  for (size_t a = 0; a < h->count; a++) {
    const arm *v = &arms[a];
    const sw_vec pull = sw_scale(sw_madd(v->r, v->p, -v->c), h->arms[a].k * v->inverse);
    add_force(s, h->arms[a].to, pull);
    add_force(s, h->arms[a].from, sw_neg(pull));
    turn_coupling(v, h->arms[a].k, coupling[a]);
  }
  for (size_t a = 0; a < h->count; a++)
    for (size_t b = a; b < h->count; b++) {
      double left[9], turned[9], K[9];
      multiply(coupling[a], C, left);
      transpose(coupling[b], turned);
      multiply(left, turned, K);
      if (a == b) own_stiffness(&arms[a], h->arms[a].k, own);
      for (size_t m = 0; m < 9; m++) K[m] = (a == b ? own[m] : 0.0) - K[m];
      SW_TRY(add_arms(s, &h->arms[a], &h->arms[b], K));
    }
  return SW_OK;
}

/* --- all together ----------------------------------------------------------------- */

static void mark(sw_system *s, uint32_t node) {
  sw_body *b = &s->bodies[sw_system_body_of(s, node)];
  if (!b->waits) b->coupled |= SW_JOINED;
}

void sw_joins_mark(sw_system *s) {
  const struct sw_joins *l = s->joins;
  if (!l) return;
  for (size_t k = 0; k < l->spring_count; k++) mark(s, l->springs[k].i), mark(s, l->springs[k].j);
  for (size_t k = 0; k < l->hub_count; k++)
    for (size_t a = 0; a < l->hubs[k].count; a++) mark(s, l->hubs[k].arms[a].from);
}

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

/* Wakes the body at node `other` if that at `node` is awake. Returns 1 if it did. */
static int wake(sw_system *s, uint32_t node, uint32_t other) {
  sw_body *b = &s->bodies[sw_system_body_of(s, other)];
  if (!b->waits || s->bodies[sw_system_body_of(s, node)].waits) return 0;
  b->waits = 0;
  return 1;
}

static int wake_once(sw_system *s) {
  const struct sw_joins *all = s->joins;
  int any = 0;
  SW_ITEMS(const sw_join_spring, p, all->springs, all->spring_count) {
    any |= wake(s, p->i, p->j) | wake(s, p->j, p->i);
  }
  SW_ITEMS(const sw_join_hub, h, all->hubs, all->hub_count) {
    for (size_t a = 0; a < h->count * h->count; a++)
      any |= wake(s, h->arms[a / h->count].from, h->arms[a % h->count].from);
  }
  return any;
}

int sw_joins_wake(sw_system *s) {
  int any = 0;
  while (s->joins && wake_once(s)) any = 1;
  return any;
}

/* Returns the length along the wire from the edge that starts at a node to another node; infinite
 * on another wire [m]. */
static double along(const sw_system *s, uint32_t edge, uint32_t node) {
  const sw_body *b = &s->bodies[sw_system_body_of(s, edge)];
  if (node < b->first_node || node >= b->first_node + b->plan->nodes) return HUGE_VAL;
  const double *at = b->plan->s + (edge - b->first_node), to = b->plan->s[node - b->first_node];
  return to < at[0] ? at[0] - to : to > at[1] ? to - at[1] : 0.0;
}

/* Along both wires within this distance from a join, over the sum of their radii, contact between
 * them is ignored [-]. */
static const double AT_A_JOIN = 4.0;

static double radius_at(const sw_system *s, uint32_t node) {
  return s->bodies[sw_system_body_of(s, node)].plan->beam.radius;
}

int sw_joins_near(const sw_system *s, uint32_t one, uint32_t two) {
  const struct sw_joins *all = s->joins;
  const double reach = all ? AT_A_JOIN * (radius_at(s, one) + radius_at(s, two)) : 0;
  for (size_t k = 0; all && k < all->spring_count; k++) {
    const sw_join_spring *p = &all->springs[k];
    if (p->tie) continue; /* tied wires lie on each other */
    if (along(s, one, p->i) <= reach && along(s, two, p->j) <= reach) return 1;
    if (along(s, one, p->j) <= reach && along(s, two, p->i) <= reach) return 1;
  }
  return 0;
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
  for (size_t k = 0; all && k < all->hub_count; k++)
    sum += hub_energy(&all->hubs[k], s->x, from, to);
  return sum;
}
