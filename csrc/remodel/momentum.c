/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Momentum of a wire whose model changes: measured before, restored afterwards. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "read/reading.h"
#include "remodel/line.h"
#include "scene/parts.h"
#include "solve/dense.h"
#include "system/system.h"

/* Returns the mass matrix' row of node i, times v: the momentum of node i [N s]. */
static sw_vec mass_times(const sw_plan *p, const double *v, size_t i) {
  sw_vec m = sw_scale(sw_vec_at(v, i), p->mass_own[i]);
  if (i > 0) m = sw_madd(m, sw_vec_at(v, i - 1), p->mass_next[i - 1]);
  if (i + 1 < p->nodes) m = sw_madd(m, sw_vec_at(v, i + 1), p->mass_next[i]);
  return m;
}

/* Momentum of velocities v and its moment about a point: out (6) [N s], [N m s]. */
static void momentum(const sw_plan *p, const double *x, const double *v, sw_vec about,
                     double out[6]) {
  sw_vec P = sw_v(0, 0, 0), L = sw_v(0, 0, 0);
  for (size_t i = 0; i < p->nodes; i++) {
    const sw_vec m = mass_times(p, v, i);
    P = sw_add(P, m);
    L = sw_add(L, sw_cross(sw_sub(sw_vec_at(x, i), about), m));
  }
  sw_store(out, P);
  sw_store(out + 3, L);
}

/* A rigid motion with less inertia than this share of the largest is left out, such as a straight
 * wire's turn about its axis [-]. */
static const double LEAST = 1e-10;
/* If the correction would have more energy than the wire, the turn about its own axis of a line
 * that is straight within this share of its radius is left out, too [-]. A rolling mesh would pass
 * this turn on to nodes micrometres off that axis, as metres per second. */
static const double STRAIGHT = 0.1;

/* Velocities of a rigid motion of the free nodes: number k < 3 shifts along an axis, others turn
 * about an axis through a point. A turn's unit is the speed at a given distance. */
static void rigid(const sw_plan *p, const double *x, sw_vec about, double distance, size_t k,
                  double *v) {
  const sw_vec unit = sw_v(k % 3 == 0, k % 3 == 1, k % 3 == 2);
  for (size_t i = 0; i < p->nodes; i++) {
    const sw_vec arm = sw_scale(sw_sub(sw_vec_at(x, i), about), 1.0 / distance);
    const sw_vec at = k < 3 ? unit : sw_cross(unit, arm);
    sw_store(v + 3 * i, p->held[i] == SW_FREE ? at : sw_v(0, 0, 0));
  }
}

/* Finds the rigid motion that gives the velocities v the wanted momentum. field: work (3 x
 * nodes). */
static void lacks(const sw_plan *p, const double *x, const double *v, sw_vec about,
                  const double wanted[6], double least, double *field, double *lack) {
  double A[6][6], y[6], now[6], column[6];
  momentum(p, x, v, about, now);
  for (size_t k = 0; k < 6; k++) {
    rigid(p, x, about, p->length, k, field);
    momentum(p, x, field, about, column);
    for (size_t i = 0; i < 6; i++) A[i][k] = column[i] / (i < 3 ? 1.0 : p->length);
    y[k] = (wanted[k] - now[k]) / (k < 3 ? 1.0 : p->length);
  }
  if (!sw_dense_least(A[0], 6, y, least)) memset(y, 0, sizeof y);
  memset(lack, 0, 3 * p->nodes * sizeof *lack);
  for (size_t k = 0; k < 6; k++) {
    rigid(p, x, about, p->length, k, field);
    for (size_t i = 0; i < 3 * p->nodes; i++) lack[i] += y[k] * field[i];
  }
}

static double kinetic(const sw_plan *p, const double *v) {
  double sum = 0;
  for (size_t i = 0; i < p->nodes; i++) sum += 0.5 * p->lumped[i] * sw_norm2(sw_vec_at(v, i));
  return sum;
}

sw_status sw_momentum_match(sw_scene *s, size_t wire, sw_vec about, const double wanted[6]) {
  sw_system *system = sw_scene_system(s);
  const sw_plan *p = system->bodies[wire].plan;
  const size_t first = 3 * system->bodies[wire].first_node, n = 3 * p->nodes;
  const double *x = system->x + first, slender = STRAIGHT * p->beam.radius / p->length;
  double *v = system->v + first;
  double *lack SW_LOCAL = sw_alloc(2 * n, sizeof *lack);
  if (!lack) return SW_ENOMEM;
  lacks(p, x, v, about, wanted, LEAST, lack + n, lack);
  if (!p->web && kinetic(p, lack) > kinetic(p, v))
    lacks(p, x, v, about, wanted, fmax(LEAST, slender * slender), lack + n, lack);
  for (size_t i = 0; i < n; i++) v[i] += lack[i];
  return SW_OK;
}

void sw_momentum_of(const sw_scene *s, size_t wire, sw_vec *about, double out[6]) {
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[wire];
  const double *x = system->x + 3 * b->first_node;
  double mass = 0;
  sw_vec sum = sw_v(0, 0, 0);
  for (size_t i = 0; i < b->plan->nodes; i++) {
    sum = sw_madd(sum, sw_vec_at(x, i), b->plan->lumped[i]);
    mass += b->plan->lumped[i];
  }
  *about = sw_scale(sum, 1.0 / mass);
  momentum(b->plan, x, system->v + 3 * b->first_node, *about, out);
}

void sw_momentum_about(const sw_scene *s, size_t wire, sw_vec about, double out[6]) {
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[wire];
  const size_t at = 3 * b->first_node;
  momentum(b->plan, system->x + at, system->v + at, about, out);
}

void sw_inertia_of(const sw_system *s, const double *a, double *out) {
  for (size_t b = 0; b < s->body_count; b++) {
    const sw_plan *p = s->bodies[b].plan;
    const double *own = a + 3 * s->bodies[b].first_node;
    double *to = out + 3 * s->bodies[b].first_node;
    for (size_t i = 0; i < p->nodes; i++) sw_store(to + 3 * i, sw_neg(mass_times(p, own, i)));
  }
}

double sw_scene_total_energy(sw_scene *s, sw_error *err) {
  sw_energy e;
  double sum = 0;
  if (sw_scene_energy(s, &e, err) != SW_OK) return (double)NAN;
  for (size_t k = 0; k < e.count; k++) sum += e.value[k];
  return sum;
}
