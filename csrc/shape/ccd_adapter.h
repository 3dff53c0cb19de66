/* SPDX-License-Identifier: GPL-3.0-or-later */
/* libccd's intersection test as an early-out for hulls. */
#ifndef SW_SHAPE_CCD_ADAPTER_H
#define SW_SHAPE_CCD_ADAPTER_H

#include "shape/shape.h"

/* Is the hull of the vertices (n x 3) certainly further than reach from the
 * hull of the corners? size is the vertices' largest extent, centre lies among
 * them [m]. 0 when it is not certain. */
int sw_ccd_apart(const double *vertices, size_t n, sw_vec centre, double size,
                 const sw_vec *corners, int corner_count, double reach);

#endif
