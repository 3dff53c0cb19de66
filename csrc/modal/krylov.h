/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A basis that grows by blocks. Each block is the operator (K - shift M)^-1 M applied to the
 * previous one, made orthonormal in M against all vectors. For csrc/modal only. */
#ifndef SW_MODAL_KRYLOV_H
#define SW_MODAL_KRYLOV_H

#include "modal/modal.h"

enum { SW_KRYLOV_BLOCK = 6 }; /* a free wire has six motions without stiffness [-] */

typedef struct sw_krylov {
  const sw_system *system;
  size_t body, n;   /* unknowns */
  double *factor;   /* of K - shift M */
  double **vectors; /* (capacity) of (n) each, allocated when needed */
  size_t count;     /* basis vectors */
  size_t done;      /* number of vectors to which the operator was applied */
  size_t capacity;
  double *projected;    /* (capacity x capacity): row j = operator on vector j, in the basis */
  double *work, *image; /* (n) */
  double *coefficients; /* (capacity) */
  unsigned long long seed;
} sw_krylov;

/* Begins an empty basis. Borrows the factor, which the caller frees. SW_ENOMEM. */
sw_status sw_krylov_new(sw_krylov *k, const sw_system *system, size_t body, double *factor,
                        size_t most);
void sw_krylov_free(sw_krylov *k);

/* Adds up to count random directions; directions already in the basis are left out. */
sw_status sw_krylov_add_random(sw_krylov *k, size_t count);
/* Applies the operator to every vector to which it was not yet applied. SW_ELIMIT when the basis is
 * full. */
sw_status sw_krylov_extend(sw_krylov *k);

/* Ritz values of the operator over the `done` vectors, ascending, with Ritz vectors by row (done x
 * done) and residual norms (done). scratch: (done x done). */
sw_status sw_krylov_ritz(const sw_krylov *k, double *scratch, double *values, double *vectors,
                         double *residuals);
/* out = the combination of the `done` vectors with these coefficients. */
void sw_krylov_combine(const sw_krylov *k, const double *coefficients, double *out);

/* Sum of products. */
double sw_krylov_dot(const double *a, const double *b, size_t n);

#endif
