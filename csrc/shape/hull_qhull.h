/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The convex hull of points, by qhull. */
#ifndef SW_SHAPE_HULL_QHULL_H
#define SW_SHAPE_HULL_QHULL_H

#include "shape/shape.h"

/* Makes the triangles (point numbers, outward winding) of the hull of n >= 4 finite points. Free
 * *indices with sw_free. Flat sets of points are refused. */
sw_status sw_hull_triangles(const char *object, const double *points, size_t n, int **indices,
                            size_t *triangle_count, sw_error *err);

#endif
