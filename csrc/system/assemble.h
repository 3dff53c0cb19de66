/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps of the assembly that stages and linearisations share. Private to this room. */
#ifndef SW_SYSTEM_ASSEMBLE_H
#define SW_SYSTEM_ASSEMBLE_H

#include "system/system.h"

/* Evaluates forces and stiffness of a body's own terms at y, into its field. Statics pass an
 * infinite hbar: no damping, and edges under pressure have their geometric stiffness. */
sw_status sw_body_evaluate(sw_system *s, sw_body *b, double time, double hbar, const double *y,
                           const double *v, int statics, int iteration, sw_error *err);

/* rows += mass * rate2 + what the field's edges add to the stiffness. */
void sw_gather_rows(const sw_field *f, double rate2, double *rows);

/* right = forces - M (y - yhat) * rate2 */
void sw_gather_residual(const sw_field *f, double rate2, const double *restrict y,
                        const double *restrict yhat, double *restrict right);

/* Uncouples node i: its own block becomes the identity. */
void sw_drop_row(double *rows, size_t i);

#endif
