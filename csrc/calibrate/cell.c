/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Displacements u(x, y, z) = strains of the beam + v, with the same v in every slice. The energy
 * per slice is 1/2 e'C e + e'G'v + 1/2 v'K v, minimal for v = -K^+ G e, so S = (C - G'K^+G)/h. K is
 * singular, but K v = -G e has solutions because both come from the same springs and elements; all
 * solutions have the same energy. */
#include "calibrate/cell.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "base/vec.h"
#include "calibrate/cell_inner.h"
#include "calibrate/dense.h"

enum { SIDES = SW_CELL_SIDES };
static const double IN_RANGE = 1e-6; /* relative residual of a right-hand side in range [-] */

/* Returns the place of a link's far end in the unstrained mesh. */
static sw_vec far_end(const sw_cell *c, const sw_cell_link *l) {
  sw_vec q = sw_vec_at(c->at, l->to);
  q.z += l->slices * c->spacing;
  return q;
}

double sw_cell_length(const sw_cell *c, const sw_cell_link *l) {
  return sw_dist(far_end(c, l), sw_vec_at(c->at, l->from));
}

void sw_cell_macro(sw_vec p, sw_vec u[SW_CELL_STRAINS]) {
  u[SW_CELL_STRETCH] = sw_v(0, 0, p.z);
  u[SW_CELL_ABOUT_X] = sw_v(0, -0.5 * p.z * p.z, p.y * p.z);
  u[SW_CELL_ABOUT_Y] = sw_v(0.5 * p.z * p.z, 0, -p.x * p.z);
  u[SW_CELL_TWIST] = sw_v(-p.y * p.z, p.x * p.z, 0);
}

/* Returns the link's direction; fills its elongation e under each unit strain
 * [m; m2 for curvatures]. */
static sw_vec elongations(const sw_cell *c, const sw_cell_link *l, double e[SW_CELL_STRAINS]) {
  const sw_vec p = sw_vec_at(c->at, l->from), q = far_end(c, l);
  const sw_vec n = sw_unit_or(sw_sub(q, p), sw_v(0, 0, 0));
  sw_vec a[SW_CELL_STRAINS], b[SW_CELL_STRAINS];
  sw_cell_macro(p, a);
  sw_cell_macro(q, b);
  for (int s = 0; s < SW_CELL_STRAINS; s++) e[s] = sw_dot(n, sw_sub(b[s], a[s]));
  return n;
}

/* Adds the energy of a link with elongations e to the symmetric S. */
static void add_energy(double *S, const double e[SW_CELL_STRAINS], double factor) {
  for (int i = 0; i < SW_CELL_STRAINS; i++)
    for (int j = 0; j < SW_CELL_STRAINS; j++) S[i * SW_CELL_STRAINS + j] += factor * e[i] * e[j];
}

/* Adds a spring against the angle h kappa between neighbours in a line; it does not depend on v. */
static void add_bend(double *S, double factor, double h) {
  S[SW_CELL_ABOUT_X * (SW_CELL_STRAINS + 1)] += factor * h * h;
  S[SW_CELL_ABOUT_Y * (SW_CELL_STRAINS + 1)] += factor * h * h;
}

/* Shares the plates' unit forces equally among the particles at the largest and at the least x. */
static void squeeze_load(const sw_cell *c, double *f) {
  double low = HUGE_VAL, high = -HUGE_VAL, count[2] = {0, 0};
  for (size_t i = 0; i < c->particles; i++) {
    low = fmin(low, c->at[3 * i]);
    high = fmax(high, c->at[3 * i]);
  }
  const double near = 1e-9 * (high - low);
  for (size_t i = 0; i < c->particles; i++) {
    count[0] += c->at[3 * i] <= low + near;
    count[1] += c->at[3 * i] >= high - near;
  }
  for (size_t i = 0; i < c->particles; i++) {
    if (!(high > low)) break;
    if (c->at[3 * i] <= low + near) f[3 * i] += 1 / count[0];
    if (c->at[3 * i] >= high - near) f[3 * i] -= 1 / count[1];
  }
}

/* Assembles K (n x n) and the right-hand sides: -G and the plates' forces (SIDES x n). */
static void assemble(const sw_cell *c, const double *k, double *K, double *right) {
  const size_t n = 3 * c->particles;
  SW_ITEMS(const sw_cell_link, l, c->link, c->links) {
    const double stiffness = k[l->group] * l->weight;
    double e[SW_CELL_STRAINS];
    if (l->bend || l->from == l->to) continue;
    const sw_vec direction = elongations(c, l, e);
    const double d[3] = {direction.x, direction.y, direction.z};
    const size_t p = 3 * (size_t)l->from, q = 3 * (size_t)l->to;
    for (size_t i = 0; i < 3; i++) {
      for (size_t j = 0; j < 3; j++) {
        const double value = stiffness * d[i] * d[j];
        K[(p + i) * n + p + j] += value;
        K[(q + i) * n + q + j] += value;
        K[(p + i) * n + q + j] -= value;
        K[(q + i) * n + p + j] -= value;
      }
      for (size_t s = 0; s < SW_CELL_STRAINS; s++) {
        right[s * n + p + i] += stiffness * e[s] * d[i];
        right[s * n + q + i] -= stiffness * e[s] * d[i];
      }
    }
  }
  sw_cell_assemble_solids(c, k, K, right);
  squeeze_load(c, right + SW_CELL_STRAINS * n);
}

/* Sums the energy of each link in the relaxed state v (SIDES x n; NULL: none) into the parts of its
 * group; returns the compliance under the plates [m/N]. */
static double collect(const sw_cell *c, const double *k, const double *v, double *parts) {
  const size_t n = 3 * c->particles, size = SW_CELL_SIZE + 1;
  double compliance = 0;
  memset(parts, 0, c->groups * size * sizeof *parts);
  SW_ITEMS(const sw_cell_link, l, c->link, c->links) {
    double *part = parts + l->group * size, e[SIDES] = {0};
    const double stiffness = k[l->group] * l->weight;
    if (l->bend) {
      add_bend(part, stiffness / c->spacing, c->spacing);
      continue;
    }
    const sw_vec d = elongations(c, l, e);
    for (size_t s = 0; v && s < SIDES; s++)
      e[s] += sw_dot(d, sw_sub(sw_vec_at(v + s * n, l->to), sw_vec_at(v + s * n, l->from)));
    add_energy(part, e, stiffness / c->spacing);
    part[SW_CELL_SIZE] += stiffness * e[SW_CELL_STRAINS] * e[SW_CELL_STRAINS];
    compliance += stiffness * e[SW_CELL_STRAINS] * e[SW_CELL_STRAINS];
  }
  return compliance + sw_cell_collect_solids(c, k, v, parts);
}

static void sum_parts(const sw_cell *c, const double *parts, double S[SW_CELL_SIZE]) {
  for (size_t i = 0; i < SW_CELL_SIZE; i++) {
    S[i] = 0;
    for (size_t g = 0; g < c->groups; g++) S[i] += parts[g * (SW_CELL_SIZE + 1) + i];
  }
}

static sw_status check(const sw_cell *c, const double *k, sw_error *err) {
  if (c->particles < 1 || c->particles > SW_CELL_PARTICLES)
    return sw_fail(err, SW_EINVAL, "cell: %zu particles in a slice; allowed are 1 to %d",
                   c->particles, SW_CELL_PARTICLES);
  if (!(c->spacing > 0) || !isfinite(c->spacing))
    return sw_fail(err, SW_EINVAL, "cell: spacing = %g m must be above 0 m", c->spacing);
  for (size_t i = 0; i < 3 * c->particles; i++)
    if (!isfinite(c->at[i]))
      return sw_fail(err, SW_EINVAL, "cell: particle %zu has a place that is not finite",
                     i / 3 + 1);
  for (size_t g = 0; g < c->groups; g++)
    if (!(k[g] >= 0) || !isfinite(k[g]))
      return sw_fail(err, SW_EINVAL,
                     "cell: group %zu has a stiffness of %g N/m; it must be at least 0", g + 1,
                     k[g]);
  for (size_t m = 0; m < c->links; m++) {
    const sw_cell_link *l = c->link + m;
    if (l->from >= c->particles || l->to >= c->particles || l->group >= c->groups)
      return sw_fail(err, SW_EINVAL, "cell: link %zu names a particle or group that does not exist",
                     m + 1);
    if (!(l->weight >= 0) || !isfinite(l->weight))
      return sw_fail(err, SW_EINVAL, "cell: link %zu has the weight %g; it must be at least 0",
                     m + 1, l->weight);
    if (!l->bend && !(sw_cell_length(c, l) > 0))
      return sw_fail(err, SW_EINVAL, "cell: link %zu has no length", m + 1);
  }
  return sw_cell_check_solids(c, err);
}

sw_status sw_cell_stiffness(const sw_cell *c, const double *k, sw_cell_result *out, double *parts,
                            sw_error *err) {
  SW_TRY(check(c, k, err));
  const size_t n = 3 * c->particles, size = SW_CELL_SIZE + 1;
  double left[SIDES], *K SW_LOCAL = sw_alloc(n * n + SIDES * n + c->groups * size, sizeof *K);
  if (!K) return sw_fail(err, SW_ENOMEM, "cell: out of memory");
  double *right = K + n * n, *own = right + SIDES * n;
  assemble(c, k, K, right);
  const sw_status status = sw_dense_semidefinite(K, n, right, SIDES, left);
  if (status == SW_OK) {
    const double compliance = collect(c, k, right, own);
    const int resists = left[SW_CELL_STRAINS] < IN_RANGE && compliance > 0;
    sum_parts(c, own, out->S);
    out->squeeze = resists ? 1 / (c->spacing * compliance) : 0;
    for (size_t g = 0; g < c->groups; g++)
      own[g * size + SW_CELL_SIZE] *= resists ? 1 / compliance : 0;
    if (parts) memcpy(parts, own, c->groups * size * sizeof *parts);
  }
  return status == SW_OK ? SW_OK
                         : sw_fail(err, status, "cell: %s",
                                   status == SW_ENOMEM ? "out of memory" : "not a finite matrix");
}

/* Subtracts the mean shift and the mean turn about z from v (particles x 3). */
static void remove_motion(const sw_cell *c, const double *share, double *v) {
  sw_vec mean = sw_v(0, 0, 0), middle = sw_v(0, 0, 0);
  for (size_t i = 0; i < c->particles; i++) {
    mean = sw_madd(mean, sw_vec_at(v, i), share[i]);
    middle = sw_madd(middle, sw_vec_at(c->at, i), share[i]);
  }
  double turn = 0, inertia = 0;
  for (size_t i = 0; i < c->particles; i++) {
    const sw_vec r = sw_sub(sw_vec_at(c->at, i), middle);
    const sw_vec d = sw_sub(sw_vec_at(v, i), mean);
    turn += share[i] * (r.x * d.y - r.y * d.x);
    inertia += share[i] * (r.x * r.x + r.y * r.y);
  }
  const double rate = inertia > 0 ? turn / inertia : 0.0;
  for (size_t i = 0; i < c->particles; i++) {
    const sw_vec r = sw_sub(sw_vec_at(c->at, i), middle);
    const sw_vec rigid = sw_add(mean, sw_v(-rate * r.y, rate * r.x, 0));
    sw_store(v + 3 * i, sw_sub(sw_vec_at(v, i), rigid));
  }
}

sw_status sw_cell_warp(const sw_cell *c, const double *k, const double *share, double *warp,
                       sw_error *err) {
  SW_TRY(check(c, k, err));
  const size_t n = 3 * c->particles;
  double left[SIDES], *K SW_LOCAL = sw_alloc(n * n + SIDES * n, sizeof *K);
  if (!K) return sw_fail(err, SW_ENOMEM, "cell: out of memory");
  assemble(c, k, K, K + n * n);
  const sw_status status = sw_dense_semidefinite(K, n, K + n * n, SIDES, left);
  if (status == SW_OK) {
    memcpy(warp, K + n * n, SW_CELL_STRAINS * n * sizeof *warp);
    for (size_t s = 0; s < SW_CELL_STRAINS; s++) remove_motion(c, share, warp + s * n);
  }
  return status == SW_OK ? SW_OK : sw_fail(err, status, "cell: not a finite matrix");
}

void sw_cell_affine(const sw_cell *c, const double *k, double S[SW_CELL_SIZE], double *parts) {
  collect(c, k, NULL, parts);
  sum_parts(c, parts, S);
}
