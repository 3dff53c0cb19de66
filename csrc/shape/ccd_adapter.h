/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Early rejection for hulls by libccd's intersection test. */
#ifndef SW_SHAPE_CCD_ADAPTER_H
#define SW_SHAPE_CCD_ADAPTER_H

#include "shape/shape.h"

/* 1 if the hull of the vertices (n x 3) is certainly further than reach from the hull of the
 * corners; 0 if this is not certain. size: the vertices' largest extent [m]; centre: a point among
 * them [m]. */
int sw_ccd_apart(const double *vertices, size_t n, sw_vec centre, double size,
                 const sw_vec *corners, int corner_count, double reach);

#endif
