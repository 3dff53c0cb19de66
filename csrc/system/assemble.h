/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps of the assembly for stages and linearisations. Private to this room. */
#ifndef SW_SYSTEM_ASSEMBLE_H
#define SW_SYSTEM_ASSEMBLE_H

#include "system/system.h"

/* Evaluates forces and stiffness of a body's own terms at y, into its field. In statics hbar is
 * infinite: no damping, and edges under pressure keep their geometric stiffness. */
sw_status sw_body_evaluate(sw_system *s, sw_body *b, double time, double hbar, const double *y,
                           const double *v, int statics, int iteration, sw_error *err);

/* 1 for iterations (from 1 on) that overestimate stiffness, see evaluate.c. */
int sw_evaluate_cautious(int iteration);

/* rows += mass * rate2 + the stiffness of the field's edges */
void sw_gather_rows(const sw_field *f, double rate2, double *rows);

/* right = forces - M (y - yhat) * rate2 */
void sw_gather_residual(const sw_field *f, double rate2, const double *restrict y,
                        const double *restrict yhat, double *restrict right);

/* Uncouples node i: its own block becomes the identity. */
void sw_drop_row(double *rows, size_t i);

#endif
