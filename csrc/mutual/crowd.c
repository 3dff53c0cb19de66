/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Particles that push each other apart: finds the pairs of a step and adds their force. */
#include "mutual/crowd.h"

#include <math.h>
#include <stdlib.h>

#include "base/alloc.h"
#include "base/couple.h"
#include "base/each.h"
#include "base/interrupt.h"
#include "mutual/cells.h"
#include "mutual/joined.h"
#include "touch/same.h"

/* In statics the search for pairs reaches this many distances; in motion, the distance plus the
 * approach that is possible in the step [-]. */
static const double STATIC_REACH = 2.0;
static const double FARTHEST = 5.0; /* largest reach of the search at any speed, in distances [-] */
static const double SMALL_PUSH = 0.01; /* smaller pushes, over the distance, do not count [-] */

typedef struct group {
  size_t body;
  double distance, stiffness; /* [m], [N/m] */
  sw_joined joined;
  sw_couple *near; /* pairs of this step */
  size_t count, capacity;
  void *grid; /* memory for the search */
  size_t grid_capacity;
} group;

struct sw_crowd {
  group *groups;
  size_t count;
};

static sw_status new_group(group *g, size_t body, const sw_web *w) {
  *g = (group){.body = body, .distance = w->repel_distance, .stiffness = w->repel_stiffness};
  return sw_joined_new(w, &g->joined);
}

sw_status sw_crowd_new(const sw_system *s, sw_crowd **out) {
  size_t count = 0;
  *out = NULL;
  for (size_t b = 0; b < s->body_count; b++)
    count += s->bodies[b].plan->web && s->bodies[b].plan->web->repel_stiffness > 0;
  if (!count) return SW_OK;
  sw_crowd *c = sw_alloc(1, sizeof *c);
  if (!c) return SW_ENOMEM;
  c->groups = sw_alloc(count, sizeof *c->groups);
  sw_status status = c->groups ? SW_OK : SW_ENOMEM;
  for (size_t b = 0; b < s->body_count && status == SW_OK; b++) {
    const sw_web *w = s->bodies[b].plan->web;
    if (w && w->repel_stiffness > 0) status = new_group(&c->groups[c->count++], b, w);
  }
  if (status == SW_OK)
    *out = c;
  else
    sw_crowd_free(c);
  return status;
}

void sw_crowd_free(sw_crowd *c) {
  if (!c) return;
  for (size_t k = 0; c->groups && k < c->count; k++) {
    group *g = &c->groups[k];
    sw_joined_free(&g->joined);
    sw_free(g->near);
    sw_free(g->grid);
  }
  sw_free(c->groups);
  sw_free(c);
}

/* --- who is near to whom ------------------------------------------------------------------ */

/* Largest speed of a particle relative to the mean of all [m/s]. */
static double fastest(const sw_body *b, const double *v) {
  sw_vec mean = sw_v(0, 0, 0);
  double most = 0;
  const size_t n = b->plan->nodes;
  for (size_t i = 0; i < n; i++) mean = sw_madd(mean, sw_vec_at(v, i), 1.0 / (double)n);
  for (size_t i = 0; i < n; i++) most = fmax(most, sw_dist(sw_vec_at(v, i), mean));
  return most;
}

static double reach_of(const group *g, double speed, double h) {
  if (!(h > 0)) return STATIC_REACH * g->distance;
  return fmin(g->distance + SW_RESERVE * h * speed, FARTHEST * g->distance);
}

/* With more near pairs than this, particles are much closer than they should be [-]. */
static const size_t MOST_NEAR = 30000000;

/* A search for pairs. */
typedef struct search {
  group *g;
  const double *x, *v;
  double h; /* [s] */
} search;

static sw_status look_at(void *user, const sw_thing *t, const sw_thing *u) {
  const search *all = user;
  group *g = all->g;
  const uint32_t a = t->node < u->node ? t->node : u->node,
                 b = t->node < u->node ? u->node : t->node;
  const double speed = sw_dist(sw_vec_at(all->v, a), sw_vec_at(all->v, b));
  const double apart = sw_dist(sw_vec_at(all->x, a), sw_vec_at(all->x, b));
  if (a == b || !(apart < reach_of(g, speed, all->h)) || sw_joined_are(&g->joined, a, b))
    return SW_OK;
  if (g->count == MOST_NEAR) return SW_ELIMIT;
  SW_TRY(SW_GROW(g->near, g->capacity, g->count + 1));
  g->near[g->count++] = (sw_couple){a, b};
  return SW_OK;
}

/* Finds the pairs: compares each particle with those already in the cells. */
static sw_status find_pairs(group *g, const sw_body *b, const double *x, const double *v,
                            double h) {
  search all = {g, x, v, h};
  sw_cells cells;
  SW_TRY(sw_cells_make(&g->grid, &g->grid_capacity, b->plan->nodes,
                       reach_of(g, 2.0 * fastest(b, v), h), &cells));
  g->count = 0;
  for (size_t i = 0; i < b->plan->nodes; i++) {
    if (sw_interrupted()) return SW_EINTR;
    sw_cells_put(&cells, x, 0, i, i, 0);
    SW_TRY(sw_cells_around(&cells, &cells.things[i], look_at, &all));
  }
  if (g->count)
    qsort(g->near, g->count, sizeof *g->near,
          sw_couple_order); /* an order independent of the cells */
  return SW_OK;
}

sw_status sw_crowd_begin_step(sw_crowd *c, sw_system *s, double h) {
  SW_ITEMS(group, g, c->groups, c->count) {
    sw_body *b = &s->bodies[g->body];
    const size_t at = 3 * b->first_node;
    SW_TRY(find_pairs(g, b, s->x + at, s->v + at, h));
    SW_TRY(sw_body_plan_pairs(b, (const uint32_t *)(const void *)g->near, g->count));
  }
  return SW_OK;
}

/* --- forces ------------------------------------------------------------------------------- */

/* Adds the stiffness along the line between both. The part across the line is negative (it turns
 * the line). It is added only in a search for an equilibrium and where iterations converge. */
static void add_stiffness(sw_body *b, const group *g, const sw_couple *p, double r, sw_vec t) {
  const double u[3] = {t.x, t.y, t.z};
  const sw_field *f = &b->field;
  const double across = f->statics && !f->cautious ? -g->stiffness * (g->distance - r) / r : 0.0;
  double between[9],
      *row[2] = {f->rows + SW_FIELD_ROW * (size_t)p->i, f->rows + SW_FIELD_ROW * (size_t)p->j};
  for (size_t i = 0, at = 0; i < 3; i++)
    for (size_t j = 0; j < 3; j++) {
      const double K = (g->stiffness - across) * u[i] * u[j] + (i == j ? across : 0.0);
      between[3 * i + j] = -K;
      if (j < i) continue;
      row[0][at] += K, row[1][at++] += K;
    }
  sw_body_couple(b, p->i, p->j, between);
}

void sw_crowd_eval(const sw_crowd *c, sw_system *s, const double *y, unsigned want) {
  SW_ITEMS(const group, g, c->groups, c->count) {
    sw_body *b = &s->bodies[g->body];
    const double *x = y + 3 * b->first_node;
    for (size_t i = 0; i < g->count; i++) {
      const sw_couple *p = &g->near[i];
      const sw_vec d = sw_sub(sw_vec_at(x, p->j), sw_vec_at(x, p->i));
      const double r = sw_norm(d);
      if (!(r < g->distance) || !(r > 0)) continue;
      const sw_vec t = sw_scale(d, 1.0 / r);
      const sw_vec push = sw_scale(t, g->stiffness * (g->distance - r));
      sw_accumulate(b->field.force + 3 * (size_t)p->i, sw_neg(push));
      sw_accumulate(b->field.force + 3 * (size_t)p->j, push);
      if (want & SW_WANT_STIFFNESS) add_stiffness(b, g, p, r, t);
    }
  }
}

int sw_crowd_settled(const sw_crowd *c, const sw_system *s, const double *y, const double *delta) {
  SW_ITEMS(const group, g, c->groups, c->count) {
    const size_t at = 3 * s->bodies[g->body].first_node;
    for (size_t i = 0; i < g->count; i++) {
      const sw_couple *p = &g->near[i];
      const sw_vec now = sw_sub(sw_vec_at(y + at, p->j), sw_vec_at(y + at, p->i));
      const sw_vec way = sw_sub(sw_vec_at(delta + at, p->j), sw_vec_at(delta + at, p->i));
      const double after = sw_norm(now) - g->distance;
      const double before = sw_norm(sw_sub(now, way)) - g->distance;
      if ((after < 0) != (before < 0) && fabs(after - before) > SMALL_PUSH * g->distance) return 0;
    }
  }
  return 1;
}

double sw_crowd_energy(const sw_crowd *c, const sw_system *s) {
  double sum = 0;
  SW_ITEMS(const group, g, c->groups, c->count) {
    const double *x = s->x + 3 * s->bodies[g->body].first_node;
    for (size_t i = 0; i < g->count; i++) {
      const sw_couple *p = &g->near[i];
      const double over = g->distance - sw_dist(sw_vec_at(x, p->i), sw_vec_at(x, p->j));
      if (over > 0) sum += 0.5 * g->stiffness * over * over;
    }
  }
  return sum;
}
