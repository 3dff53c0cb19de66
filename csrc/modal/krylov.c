/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Block Krylov basis, and its Ritz values by a small dense eigenproblem. */
#include "modal/krylov.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/simd.h"
#include "modal/eigen.h"
#include "system/linear.h"

/* A direction that keeps less than this share is already in the basis [-]. */
static const double NOTHING_NEW = 1e-11;
enum { PASSES = 2 };

sw_status sw_krylov_new(sw_krylov *k, const sw_system *system, size_t body, double *factor,
                        size_t most) {
  const size_t n = sw_system_unknowns(system, body);
  *k = (sw_krylov){
      .system = system, .body = body, .n = n, .factor = factor, .capacity = most, .seed = 20};
  const sw_status status =
      SW_ALLOC_ALL(SW_ROOM(k->projected, most * most), SW_ROOM(k->coefficients, most),
                   SW_ROOM(k->work, n), SW_ROOM(k->image, n), SW_ROOM(k->vectors, most));
  if (status != SW_OK) sw_krylov_free(k);
  return status;
}

void sw_krylov_free(sw_krylov *k) {
  SW_FREE_ALL(k->projected, k->coefficients, k->work, k->image);
  for (size_t j = 0; k->vectors && j < k->count; j++) sw_free(k->vectors[j]);
  sw_free(k->vectors);
  *k = (sw_krylov){0};
}

SW_HOT
double sw_krylov_dot(const double *a, const double *b, size_t n) {
  double part[8] = {0};
  size_t i = 0;
  for (; i + 8 <= n; i += 8)
    for (size_t k = 0; k < 8; k++) part[k] += a[i + k] * b[i + k];
  for (; i < n; i++) part[0] += a[i] * b[i];
  return ((part[0] + part[4]) + (part[1] + part[5])) + ((part[2] + part[6]) + (part[3] + part[7]));
}

SW_HOT
static void subtract(double *restrict a, const double *restrict b, double share, size_t n) {
  for (size_t i = 0; i < n; i++) a[i] -= share * b[i];
}

static double length_of_work(sw_krylov *k) {
  sw_system_mass_times(k->system, k->body, k->work, k->image);
  return sqrt(fmax(0.0, sw_krylov_dot(k->work, k->image, k->n)));
}

/* Removes the basis from work and adds the removed coefficients to sums. Returns the M-norm of the
 * rest; image = M work. */
static double orthogonalise(sw_krylov *k, double *sums) {
  for (int pass = 0; pass < PASSES; pass++) {
    sw_system_mass_times(k->system, k->body, k->work, k->image);
    for (size_t j = 0; j < k->count; j++)
      k->coefficients[j] = sw_krylov_dot(k->vectors[j], k->image, k->n);
    for (size_t j = 0; j < k->count; j++) {
      subtract(k->work, k->vectors[j], k->coefficients[j], k->n);
      if (sums) sums[j] += k->coefficients[j];
    }
  }
  return length_of_work(k);
}

static sw_status append(sw_krylov *k, double length) {
  double *v = sw_alloc(k->n, sizeof *v);
  if (!v) return SW_ENOMEM;
  for (size_t i = 0; i < k->n; i++) v[i] = k->work[i] / length;
  k->vectors[k->count++] = v;
  return SW_OK;
}

static double random_number(sw_krylov *k) {
  k->seed = k->seed * 6364136223846793005ULL + 1442695040888963407ULL;
  return (double)(k->seed >> 11) / 4503599627370496.0 - 1.0;
}

sw_status sw_krylov_add_random(sw_krylov *k, size_t count) {
  for (size_t c = 0; c < count && k->count < k->capacity; c++) {
    for (size_t i = 0; i < k->n; i++) k->work[i] = random_number(k);
    sw_system_fix_held(k->system, k->body, k->work);
    const double before = length_of_work(k), left = orthogonalise(k, NULL);
    if (!isfinite(left)) return SW_EDIVERGED;
    if (left > NOTHING_NEW * before) SW_TRY(append(k, left));
  }
  return SW_OK;
}

sw_status sw_krylov_extend(sw_krylov *k) {
  const size_t end = k->count;
  for (; k->done < end; k->done++) {
    double *row = k->projected + k->done * k->capacity;
    if (k->count == k->capacity) return SW_ELIMIT;
    sw_system_mass_times(k->system, k->body, k->vectors[k->done], k->work);
    sw_system_factor_solve(k->system, k->body, k->factor, k->work);
    const double before = length_of_work(k), left = orthogonalise(k, row);
    if (!isfinite(left)) return SW_EDIVERGED;
    if (!(left > NOTHING_NEW * before)) continue;
    row[k->count] = left;
    SW_TRY(append(k, left));
  }
  return SW_OK;
}

sw_status sw_krylov_ritz(const sw_krylov *k, double *scratch, double *values, double *vectors,
                         double *residuals) {
  const size_t m = k->done, c = k->capacity;
  for (size_t i = 0; i < m; i++)
    for (size_t j = 0; j < m; j++)
      scratch[i * m + j] = 0.5 * (k->projected[i * c + j] + k->projected[j * c + i]);
  SW_TRY(sw_eigen_dense(scratch, NULL, m, values, vectors));
  for (size_t r = 0; r < m; r++) {
    double sum = 0;
    for (size_t j = m; j < k->count; j++) {
      double part = 0;
      for (size_t i = 0; i < m; i++) part += vectors[r * m + i] * k->projected[i * c + j];
      sum += part * part;
    }
    residuals[r] = sqrt(sum);
  }
  return SW_OK;
}

void sw_krylov_combine(const sw_krylov *k, const double *coefficients, double *out) {
  memset(out, 0, k->n * sizeof *out);
  for (size_t j = 0; j < k->done; j++) subtract(out, k->vectors[j], -coefficients[j], k->n);
}
