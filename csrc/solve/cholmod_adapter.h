/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sparse factors of symmetric matrices of 3 x 3 blocks, by CHOLMOD (Chen, Davis, Hager and
 * Rajamanickam 2008). The pattern is analysed once. A definite matrix is factorised in dense
 * pieces as L L', another one column by column as L D L', which is many times slower. */
#ifndef SW_SOLVE_CHOLMOD_ADAPTER_H
#define SW_SOLVE_CHOLMOD_ADAPTER_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

typedef struct sw_cholmod sw_cholmod;

/* Node i has the blocks first[i] .. first[i + 1] - 1, of columns column[..] ascending, the last
 * one its own. Both lists must outlive the solver. SW_ENOMEM, SW_ELIMIT. */
sw_status sw_cholmod_new(size_t nodes, const uint32_t *first, const uint32_t *column,
                         sw_cholmod **out);
void sw_cholmod_free(sw_cholmod *c); /* NULL is allowed */

/* values: 9 a block, row by row. Otherwise as sw_blocks_factor. */
sw_status sw_cholmod_factor(sw_cholmod *c, const double *values, const unsigned char *fixed,
                            size_t *negative);

/* In place for x (nodes x 3). */
void sw_cholmod_solve(sw_cholmod *c, double *x);

#endif
