/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Least squares with known derivatives. */
#ifndef SW_CALIBRATE_LEAST_SQUARES_H
#define SW_CALIBRATE_LEAST_SQUARES_H

#include <stddef.h>

#include "base/status.h"

/* Computes `rows` residuals r at x (n numbers) and the jacobian (rows x n). A failure stops the
 * search. */
typedef sw_status (*sw_residuals)(void *user, const double *x, double *r, double *jacobian,
                                  sw_error *err);

/* Levenberg and Marquardt from x, which is replaced by the best point found; rows >= n. Ends at
 * convergence or after max_iterations; both give SW_OK. */
sw_status sw_least_squares(sw_residuals f, void *user, size_t n, size_t rows, double *x,
                           size_t max_iterations, sw_error *err);

typedef enum sw_fit_end {
  SW_FIT_NEAR,  /* the last step was below the tolerance */
  SW_FIT_STUCK, /* no step reduces the sum */
  SW_FIT_USED   /* iterations used up */
} sw_fit_end;

/* The same for expensive evaluations. f gets calls for residuals alone (jacobian NULL), and for
 * derivatives alone (r NULL) only at the start and at places better than all before. Residuals of
 * 1e100 reject a place. Ends when no x changes by more than tolerance * |x|. */
sw_status sw_fit(sw_residuals f, void *user, size_t n, size_t rows, double *x, double tolerance,
                 size_t max_iterations, sw_fit_end *end, size_t *iterations, sw_error *err);

#endif
