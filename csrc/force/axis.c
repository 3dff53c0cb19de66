/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Points of a wire's centre line: places, velocities and forces on them. */
#include "force/axis.h"

#include <math.h>
#include <stdint.h>

enum { ROW = SW_FIELD_ROW };

size_t sw_axis_points(const sw_plan *p) {
  if (!p->web) return p->nodes;
  return p->web->per_ring ? p->web->rings : 0;
}

double sw_axis_s(const sw_plan *p, size_t i) { return p->s[p->web ? p->web->first[i] : i]; }

sw_vec sw_axis_middle(const sw_field *f, const double *values, size_t i) {
  double middle[3];
  sw_web_middle(f->plan->web, values, i, middle);
  return sw_load(middle);
}

double sw_axis_mass(const sw_plan *p, size_t i) {
  double sum = 0;
  if (!p->web) return p->lumped[i];
  for (size_t k = p->web->first[i]; k < p->web->first[i + 1]; k++) sum += p->web->mass[k];
  return sum;
}

double sw_axis_stable_dt(const sw_plan *p, double stiffness) {
  double least = HUGE_VAL;
  for (size_t i = 0; i + 1 < sw_axis_points(p); i++)
    least = fmin(least, sw_axis_s(p, i + 1) - sw_axis_s(p, i));
  return 2.0 / sqrt(stiffness / (0.5 * least * p->beam.mass));
}

/* Adds factor * K to particle p's own block. */
static void add_own(sw_field *f, size_t p, double factor, const double *K) {
  double *row = f->rows + ROW * p;
  for (int k = 0, at = 0; k < 3; k++)
    for (int j = k; j < 3; j++, at++) row[at] += factor * K[3 * k + j];
}

/* Adds factor * K between particles p > q of a mesh. */
static void add_between(sw_field *f, size_t p, size_t q, double factor, const double *K) {
  const size_t slot = f->slot_of(f->matrix, p, q);
  double H[9];
  if (slot == SIZE_MAX) {
    add_own(f, p, factor, K), add_own(f, q, factor, K);
    return;
  }
  for (size_t k = 0; k < 9; k++) H[k] = factor * K[k];
  sw_field_add_block(f, p, q, slot, H, 3);
}

static double share_of(const sw_web *web, size_t ring, size_t p) {
  return sw_web_is_ring(web, ring) ? web->share[p - web->first[ring]] : 1.0;
}

/* Stiffness K of a point of a mesh that has these parts of rings i and i + 1. */
static void stiffen_rings(sw_field *f, size_t i, const double part[2], const double *K) {
  const sw_web *w = f->plan->web;
  for (size_t a = 0; a < 2; a++)
    for (size_t p = w->first[i + a]; part[a] > 0 && p < w->first[i + a + 1]; p++) {
      const double share = part[a] * share_of(w, i + a, p);
      add_own(f, p, share * share, K);
      for (size_t b = 0; b <= a; b++)
        for (size_t q = w->first[i + b]; part[b] > 0 && q < p && q < w->first[i + b + 1]; q++)
          add_between(f, p, q, share * part[b] * share_of(w, i + b, q), K);
    }
}

static void stiffen_line(sw_field *f, size_t i, const double part[2], const double *K) {
  enum { NEXT = 6 }; /* block between a node and the next one, in its row */
  double *next = f->rows + ROW * i + NEXT;
  for (size_t a = 0; a < 2; a++)
    if (part[a] > 0) add_own(f, i + a, part[a] * part[a], K);
  for (size_t k = 0; part[1] > 0 && k < 9; k++) next[k] += part[0] * part[1] * K[k];
}

void sw_axis_put_between(sw_field *f, size_t i, const double part[2], sw_vec force,
                         const double *K) {
  const sw_web *web = f->plan->web;
  for (size_t a = 0; f->want & SW_WANT_FORCE && a < 2; a++) {
    if (!(part[a] > 0)) continue;
    const size_t from = web ? web->first[i + a] : i + a,
                 to = web ? web->first[i + a + 1] : from + 1;
    for (size_t p = from; p < to; p++)
      sw_accumulate(f->force + 3 * p,
                    sw_scale(force, part[a] * (web ? share_of(web, i + a, p) : 1.0)));
  }
  if (!K) return;
  if (web)
    stiffen_rings(f, i, part, K);
  else
    stiffen_line(f, i, part, K);
}

void sw_axis_put(sw_field *f, size_t i, sw_vec force, const double *K) {
  sw_axis_put_between(f, i, (const double[2]){1.0, 0.0}, force, K);
}

void sw_axis_push(sw_field *f, size_t i, sw_vec force, sw_vec d, double k) {
  const double K[9] = {k * d.x * d.x, k * d.x * d.y, k * d.x * d.z, k * d.y * d.x, k * d.y * d.y,
                       k * d.y * d.z, k * d.z * d.x, k * d.z * d.y, k * d.z * d.z};
  sw_axis_put(f, i, force, f->want & SW_WANT_STIFFNESS && k > 0 ? K : NULL);
}
