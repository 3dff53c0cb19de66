/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solid elements in the repeated slice, handled like springs: the element's second derivative at
 * rest takes the place of the spring's stiffness. */
#include <string.h>

#include "calibrate/cell_inner.h"
#include "force/solid.h"

enum { MOST = 3 * SW_SOLID_NODES };

/* One element of modulus 1 Pa. */
typedef struct element {
  int n;                             /* components [-] */
  size_t component[MOST];            /* numbers in the slice [-] */
  double moved[SW_CELL_SIDES][MOST]; /* displacements under unit strains [m] */
  double stiffness[MOST * MOST];     /* for modulus 1 Pa [m] */
} element;

static sw_status prepare(const sw_cell *c, const sw_cell_solid *s, element *e) {
  const double mu = 0.5 / (1 + s->nu), lambda = s->nu / ((1 + s->nu) * (1 - 2 * s->nu));
  double rest[MOST];
  sw_solid solid;
  e->n = 3 * s->nodes;
  memset(e->moved, 0, sizeof e->moved);
  for (int a = 0; a < s->nodes; a++) {
    sw_vec u[SW_CELL_STRAINS], p = sw_vec_at(c->at, s->particle[a]);
    if (2 * a >= s->nodes) p.z += c->spacing;
    sw_cell_macro(p, u);
    sw_store(rest + 3 * a, p);
    for (int t = 0; t < SW_CELL_STRAINS; t++) sw_store(e->moved[t] + 3 * a, u[t]);
    for (size_t i = 0; i < 3; i++) e->component[3 * (size_t)a + i] = 3 * (size_t)s->particle[a] + i;
  }
  SW_TRY(sw_solid_prepare(s->nodes, rest, mu, lambda, &solid));
  sw_solid_eval(&solid, rest, SW_WANT_STIFFNESS, NULL, e->stiffness);
  return SW_OK;
}

sw_status sw_cell_check_solids(const sw_cell *c, sw_error *err) {
  element e;
  for (size_t m = 0; m < c->solids; m++) {
    const sw_cell_solid *s = c->solid + m;
    if (s->group >= c->groups || !(s->nu > -1) || !(s->nu < 0.5))
      return sw_fail(err, SW_EINVAL, "cell: nu = %g must be in (-1, 0.5)", s->nu);
    if (s->nodes != SW_SOLID_PRISM && s->nodes != SW_SOLID_HEX)
      return sw_fail(err, SW_EINVAL, "cell: element %zu has %d particles; it must have 6 or 8",
                     m + 1, s->nodes);
    for (int a = 0; a < s->nodes; a++)
      if (s->particle[a] >= c->particles)
        return sw_fail(err, SW_EINVAL, "cell: element %zu names a particle that does not exist",
                       m + 1);
    if (prepare(c, s, &e) != SW_OK)
      return sw_fail(err, SW_EINVAL,
                     "cell: element %zu has no volume, is inverted, or is too flat; its face in "
                     "this slice goes anticlockwise seen from the next",
                     m + 1);
  }
  return SW_OK;
}

/* out = stiffness times u */
static void times(const element *e, const double *u, double *out) {
  for (int i = 0; i < e->n; i++) {
    out[i] = 0;
    for (int j = 0; j < e->n; j++) out[i] += e->stiffness[i * e->n + j] * u[j];
  }
}

void sw_cell_assemble_solids(const sw_cell *c, const double *of, double *K, double *right) {
  const size_t n = 3 * c->particles;
  element e;
  for (size_t m = 0; m < c->solids; m++) {
    const double k = of[c->solid[m].group];
    if (prepare(c, c->solid + m, &e) != SW_OK) continue; /* checked before */
    for (int i = 0; i < e.n; i++)
      for (int j = 0; j < e.n; j++)
        K[e.component[i] * n + e.component[j]] += k * e.stiffness[i * e.n + j];
    for (size_t t = 0; t < SW_CELL_STRAINS; t++) {
      double force[MOST];
      times(&e, e.moved[t], force);
      for (int i = 0; i < e.n; i++) right[t * n + e.component[i]] -= k * force[i];
    }
  }
}

double sw_cell_collect_solids(const sw_cell *c, const double *of, const double *v, double *parts) {
  const size_t n = 3 * c->particles;
  double compliance = 0;
  element e;
  for (size_t m = 0; m < c->solids; m++) {
    const uint32_t group = c->solid[m].group;
    double k = of[group], *part = parts + group * (SW_CELL_SIZE + 1);
    if (prepare(c, c->solid + m, &e) != SW_OK) continue;
    double force[SW_CELL_SIDES][MOST], all[SW_CELL_SIDES][SW_CELL_SIDES];
    for (size_t t = 0; t < SW_CELL_SIDES; t++) {
      for (int i = 0; v && i < e.n; i++) e.moved[t][i] += v[t * n + e.component[i]];
      times(&e, e.moved[t], force[t]);
    }
    for (int s = 0; s < SW_CELL_SIDES; s++)
      for (int t = 0; t < SW_CELL_SIDES; t++) {
        all[s][t] = 0;
        for (int i = 0; i < e.n; i++) all[s][t] += k * e.moved[s][i] * force[t][i];
      }
    for (int s = 0; s < SW_CELL_STRAINS; s++)
      for (int t = 0; t < SW_CELL_STRAINS; t++)
        part[s * SW_CELL_STRAINS + t] += 0.5 * (all[s][t] + all[t][s]) / c->spacing;
    part[SW_CELL_SIZE] += all[SW_CELL_STRAINS][SW_CELL_STRAINS];
    compliance += all[SW_CELL_STRAINS][SW_CELL_STRAINS];
  }
  return compliance;
}
