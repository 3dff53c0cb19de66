/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the obstacles near a place. One tree holds the standing obstacles. A second tree holds
 * those that may move, each with the box that it may reach in a step. Unbounded obstacles are
 * always checked; if there are few obstacles, all are. The result has the order of the
 * obstacles. */
#include "contact/broad.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/halving.h"
#include "contact/touch.h"

enum { FEW = 8 }; /* up to this many obstacles need no tree [-] */
/* The tree of moving boxes is rebuilt after this many steps [-]. */
enum { MOST_REFITS = 32 };
/* An obstacle that turns by more than this over sqrt(3) in the step may reach any place [rad]. */
static const double FASTEST_TURN = 0.5;
static const double EVERYWHERE = 1e300;  /* [m] */
static const double ROUNDING = 1.000001; /* [-] */

sw_status sw_broad_new(sw_broad *b, size_t count) {
  *b = (sw_broad){.count = count, .factor = 1.0};
  b->numbers = sw_alloc(5 * count, sizeof *b->numbers);
  b->boxes = (sw_bounds *)sw_alloc(count, sizeof *b->boxes);
  if (!b->numbers || !b->boxes) {
    sw_broad_free(b);
    return SW_ENOMEM;
  }
  b->moves = b->numbers;
  b->mover = b->moves + count;
  b->member = b->mover + count;
  b->aside = b->member + count;
  b->found = b->aside + count;
  sw_broad_forget(b);
  return SW_OK;
}

void sw_broad_free(sw_broad *b) {
  sw_free(b->numbers);
  sw_free(b->boxes);
  for (int k = 0; k < 2; k++) sw_box_tree_free(&b->group[k].tree);
  *b = (sw_broad){.count = 0};
}

void sw_broad_forget(sw_broad *b) {
  for (size_t o = 0; o < b->count; o++) b->moves[o] = 1, b->mover[o] = (int)o;
  b->mover_count = b->count;
  b->placed = b->sorted = 0;
}

void sw_broad_know(sw_broad *b, const sw_contact *c, sw_contact_moves_function moves) {
  b->mover_count = 0;
  for (size_t o = 0; o < b->count; o++) {
    b->moves[o] = moves(c->user, c->obstacles[o].id);
    if (b->moves[o]) b->mover[b->mover_count++] = (int)o;
  }
  b->placed = b->sorted = 0;
}

static sw_status place_one(sw_contact *c, size_t o, double t, sw_contact_at *out, sw_error *err) {
  sw_motion_state m;
  SW_TRY(c->place(c->user, c->obstacles[o].id, t, &m, err));
  *out = (sw_contact_at){m.pose, m.v, m.omega, m.pivot};
  return SW_OK;
}

sw_status sw_broad_place(sw_contact *c, double t, sw_contact_at *out, sw_error *err) {
  sw_broad *b = &c->broad;
  if (b->placed) {
    for (size_t k = 0; k < b->mover_count; k++)
      SW_TRY(place_one(c, (size_t)b->mover[k], t, &out[b->mover[k]], err));
    return SW_OK;
  }
  for (size_t o = 0; o < c->count; o++) {
    SW_TRY(place_one(c, o, t, &out[o], err));
    if (!b->moves[o]) c->start[o] = c->now[o] = out[o];
  }
  b->placed = 1;
  return SW_OK;
}

/* Axis-parallel box around a turned box. */
static sw_bounds world_bounds(const sw_shape *shape, const sw_pose *pose) {
  const sw_bounds b = sw_shape_bounds(shape);
  if (!isfinite(b.min.x + b.max.x + b.min.y + b.max.y + b.min.z + b.max.z))
    return (sw_bounds){{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL, HUGE_VAL}};
  const sw_vec half = sw_scale(sw_sub(b.max, b.min), 0.5);
  const sw_vec middle = sw_pose_point(*pose, sw_scale(sw_add(b.max, b.min), 0.5));
  const sw_vec ex = sw_rotate(pose->q, sw_v(half.x, 0, 0));
  const sw_vec ey = sw_rotate(pose->q, sw_v(0, half.y, 0));
  const sw_vec ez = sw_rotate(pose->q, sw_v(0, 0, half.z));
  const sw_vec reach =
      sw_v(fabs(ex.x) + fabs(ey.x) + fabs(ez.x), fabs(ex.y) + fabs(ey.y) + fabs(ez.y),
           fabs(ex.z) + fabs(ey.z) + fabs(ez.z));
  return (sw_bounds){sw_sub(middle, reach), sw_add(middle, reach)};
}

/* Largest distance of a corner of the box from p. */
static double farthest(const sw_bounds *b, sw_vec p) {
  return sw_norm(sw_v(fmax(fabs(b->max.x - p.x), fabs(b->min.x - p.x)),
                      fmax(fabs(b->max.y - p.y), fabs(b->min.y - p.y)),
                      fmax(fabs(b->max.z - p.z), fabs(b->min.z - p.z))));
}

/* Returns the box in which an obstacle may touch something that is at most `a` away. Its material
 * at x moves by (v + omega |x - p|) h in the step, and x is within `a` plus this distance. The
 * equation is solved for the largest reach: factor (a + the margin of the box). */
static sw_bounds swept(sw_broad *b, const sw_contact *c, size_t o) {
  const sw_contact_at *at = &c->start[o];
  const sw_bounds *box = &c->bounds[o];
  const double omega = sw_norm(at->omega), turn = 1.7320508075688773 * omega * c->h;
  const double factor = 1.0 / (1.0 - turn);
  const double way =
      ROUNDING * factor * c->h * (sw_norm(at->v) + omega * farthest(box, at->pose.p));
  if (!(turn < FASTEST_TURN) || !(way < EVERYWHERE))
    return (sw_bounds){sw_v(-EVERYWHERE, -EVERYWHERE, -EVERYWHERE),
                       sw_v(EVERYWHERE, EVERYWHERE, EVERYWHERE)};
  b->factor = fmax(b->factor, factor);
  b->omega = fmax(b->omega, omega);
  const sw_vec w = sw_v(way, way, way);
  return (sw_bounds){sw_sub(box->min, w), sw_add(box->max, w)};
}

void sw_broad_bound_movers(sw_contact *c) {
  for (size_t k = 0; k < c->broad.mover_count; k++) {
    const size_t o = (size_t)c->broad.mover[k];
    c->bounds[o] = world_bounds(c->obstacles[o].shape, &c->start[o].pose);
  }
}

static void measure(sw_contact *c) {
  sw_broad *b = &c->broad;
  b->factor = 1.0, b->omega = 0, b->turning_time = c->h;
  sw_broad_bound_movers(c);
  for (size_t k = 0; k < b->group[1].count; k++)
    b->group[1].boxes[k] = swept(b, c, (size_t)b->group[1].member[k]);
}

static void add_member(sw_broad *b, int group, size_t o) {
  sw_broad_group *g = &b->group[group];
  g->member[g->count++] = (int)o;
}

/* Sorts obstacles into the trees' groups. */
static void sort_out(sw_contact *c) {
  sw_broad *b = &c->broad;
  const int few = c->count <= FEW;
  b->aside_count = b->group[0].count = b->group[1].count = 0;
  for (int moves = 0; moves < 2; moves++) {
    sw_broad_group *g = &b->group[moves];
    g->member = b->member + (moves ? b->group[0].count : 0);
    g->boxes = b->boxes + (moves ? b->group[0].count : 0);
    for (size_t o = 0; !few && o < c->count; o++)
      if (isfinite(c->bounds[o].max.x) && b->moves[o] == moves) add_member(b, moves, o);
  }
  for (size_t o = 0; o < c->count; o++)
    if (few || !isfinite(c->bounds[o].max.x)) b->aside[b->aside_count++] = (int)o;
}

static sw_status plant(sw_broad_group *g) {
  sw_box_tree_free(&g->tree);
  g->refits = 0;
  return g->count ? sw_box_tree_new(g->boxes, NULL, g->count, &g->tree) : SW_OK;
}

static sw_status make(sw_contact *c) {
  sw_broad *b = &c->broad;
  for (size_t o = 0; o < c->count; o++)
    c->bounds[o] = world_bounds(c->obstacles[o].shape, &c->start[o].pose);
  sort_out(c);
  measure(c);
  for (size_t k = 0; k < b->group[0].count; k++)
    b->group[0].boxes[k] = c->bounds[b->group[0].member[k]];
  for (int k = 0; k < 2; k++) SW_TRY(plant(&b->group[k]));
  b->sorted = 1;
  return SW_OK;
}

sw_status sw_broad_update(sw_contact *c) {
  sw_broad_group *moving = &c->broad.group[1];
  if (!c->broad.sorted) return make(c);
  measure(c);
  if (!moving->count) return SW_OK;
  if (moving->refits++ >= MOST_REFITS) {
    c->broad.sorted = 0; /* out of memory: the next update starts anew */
    SW_TRY(plant(moving));
    c->broad.sorted = 1;
    return SW_OK;
  }
  sw_box_tree_refit(&moving->tree, moving->boxes);
  return SW_OK;
}

static int by_number(const void *a, const void *b) {
  const int p = *(const int *)a, q = *(const int *)b;
  return (p > q) - (p < q);
}

enum { QUICKLY = 32 }; /* up to this many numbers are sorted by insertion [-] */

static void sort(int *a, size_t n) {
  if (n > QUICKLY) {
    qsort(a, n, sizeof *a, by_number);
    return;
  }
  for (size_t i = 1; i < n; i++) {
    const int v = a[i];
    size_t j = i;
    for (; j > 0 && a[j - 1] > v; j--) a[j] = a[j - 1];
    a[j] = v;
  }
}

const int *sw_broad_near(sw_broad *b, const sw_bounds *box, double reach, size_t *count,
                         size_t *looks) {
  *count = b->aside_count;
  *looks += b->aside_count;
  if (!b->group[0].count && !b->group[1].count) return b->aside;
  size_t n = 0;
  for (int k = 0; k < 2; k++) {
    const sw_broad_group *g = &b->group[k];
    if (!g->count) continue;
    const double length = sw_dist(box->min, box->max);
    const double most = k ? b->factor * (reach + b->omega * b->turning_time * length) : reach;
    const sw_vec w = sw_v(ROUNDING * most, ROUNDING * most, ROUNDING * most);
    const sw_bounds near = {sw_sub(box->min, w), sw_add(box->max, w)};
    const size_t found = sw_box_tree_find(&g->tree, g->boxes, &near, b->found + n, looks);
    for (size_t i = n; i < n + found; i++) b->found[i] = g->member[b->found[i]];
    n += found;
  }
  for (size_t i = 0; i < b->aside_count; i++) b->found[n++] = b->aside[i];
  sort(b->found, n);
  *count = n;
  return b->found;
}

int sw_broad_disturbs(const sw_contact *c, size_t o, const sw_bounds *box, double reach) {
  const sw_contact_at *at = &c->start[o];
  const sw_bounds *own = &c->bounds[o];
  const double omega = sw_norm(at->omega), arm = farthest(own, at->pose.p) + reach;
  const double most = reach + 2.0 * c->h * (sw_norm(at->v) + omega * arm);
  if (!(most < EVERYWHERE) || !(omega * c->h < FASTEST_TURN)) return 1;
  return own->min.x - most <= box->max.x && own->max.x + most >= box->min.x &&
         own->min.y - most <= box->max.y && own->max.y + most >= box->min.y &&
         own->min.z - most <= box->max.z && own->max.z + most >= box->min.z;
}

int sw_broad_moves(const sw_contact *c) {
  for (size_t k = 0; k < c->broad.mover_count; k++) {
    const int o = c->broad.mover[k];
    const sw_pose *a = &c->start[o].pose, *b = &c->now[o].pose;
    const sw_quat p = a->q, q = b->q;
    if (sw_dist(a->p, b->p) > 0 || p.w != q.w || p.x != q.x || p.y != q.y || p.z != q.z) return 1;
  }
  return 0;
}

double sw_contact_shift(const sw_contact *c, double lever) {
  double most = 0;
  for (size_t k = 0; k < c->broad.mover_count; k++) {
    const int o = c->broad.mover[k];
    const sw_pose *a = &c->start[o].pose, *b = &c->now[o].pose;
    const double turn = sw_norm(sw_quat_log(sw_quat_mul(b->q, sw_quat_conj(a->q))));
    most = sw_larger(most, sw_dist(a->p, b->p) + lever * turn);
  }
  return most;
}

size_t sw_contact_index(const sw_contact *c, int id) {
  size_t o;
  SW_FIRST_NOT(c->obstacles[o].id < id, o, 0, c->count); /* they ascend */
  return o < c->count && c->obstacles[o].id == id ? o : c->count;
}
