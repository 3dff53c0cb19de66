/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gaussian elimination, with or without row swaps. */
#include "solve/dense.h"

#include <math.h>

/* Swaps row k with the row from k on that has the largest number in column k; 1: it is another row.
 */
static int swap_rows(double *a, size_t n, double *b, size_t k) {
  size_t best = k;
  for (size_t i = k + 1; i < n; i++)
    if (fabs(a[n * i + k]) > fabs(a[n * best + k])) best = i;
  for (size_t j = 0; best != k && j < n; j++) {
    const double kept = a[n * k + j];
    a[n * k + j] = a[n * best + j], a[n * best + j] = kept;
  }
  const double kept = b[k];
  b[k] = b[best], b[best] = kept;
  return best != k;
}

size_t sw_dense_eliminate(double *a, size_t n, double *b, int swaps) {
  size_t negative = 0;
  for (size_t k = 0; k < n; k++) {
    const int swapped = swaps == SW_DENSE_SWAPS && swap_rows(a, n, b, k);
    const double pivot = a[n * k + k];
    negative += pivot < 0 && !swapped;
    for (size_t i = k + 1; i < n; i++) {
      const double f = a[n * i + k] / pivot;
      for (size_t j = k; j < n; j++) a[n * i + j] -= f * a[n * k + j];
      b[i] -= f * b[k];
    }
  }
  for (size_t k = n; k-- > 0;) {
    for (size_t j = k + 1; j < n; j++) b[k] -= a[n * k + j] * b[j];
    b[k] /= a[n * k + k];
  }
  return negative;
}
