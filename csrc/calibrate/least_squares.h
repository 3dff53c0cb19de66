/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Smallest sum of squares of residuals whose derivatives are known. */
#ifndef SW_CALIBRATE_LEAST_SQUARES_H
#define SW_CALIBRATE_LEAST_SQUARES_H

#include <stddef.h>

#include "base/status.h"

/* r: rows residuals at x (n numbers); jacobian: rows x n. A failure stops the search. */
typedef sw_status (*sw_residuals)(void *user, const double *x, double *r, double *jacobian,
                                  sw_error *err);

/* Levenberg and Marquardt from x, replaced by the best found; rows >= n. Ends where nothing is
 * gained any more or after max_iterations; either is SW_OK. */
sw_status sw_least_squares(sw_residuals f, void *user, size_t n, size_t rows, double *x,
                           size_t max_iterations, sw_error *err);

typedef enum sw_fit_end {
  SW_FIT_NEAR,  /* the last step was below the tolerance */
  SW_FIT_STUCK, /* no step makes the sum smaller */
  SW_FIT_USED   /* iterations used up */
} sw_fit_end;

/* The same where an evaluation is dear: f is asked for residuals alone (jacobian NULL), and for
 * the derivatives (r NULL) only at x and at places that are better than all before. Residuals of
 * 1e100 reject a place. It ends when no x moves by more than tolerance * |x|. */
sw_status sw_fit(sw_residuals f, void *user, size_t n, size_t rows, double *x, double tolerance,
                 size_t max_iterations, sw_fit_end *end, size_t *iterations, sw_error *err);

#endif
