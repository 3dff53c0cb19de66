/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Series of wires and forces, and the crashes of holds. */
#ifndef SW_WATCH_SERIES_H
#define SW_WATCH_SERIES_H

#include "scene/scene.h"

/* When what it holds was last driven into an obstacle, how far then, and into which one: NAN, 0
 * and "" when it never was [s], [m]. */
sw_status sw_scene_hold_crash(const sw_scene *scene, sw_handle hold, double *time, double *depth,
                              const char **obstacle, sw_error *err);

/* Of a wire: time, largest tension [N], largest curvature [1/m]. Of a force that tells what it does
 * to wires (clip, tether): time, force on them [N]. count is 0 where nothing was recorded. */
enum { SW_LOG_WIRE_SIZE = 3, SW_LOG_FORCE_SIZE = 4 };

/* The series of an object: rows as of its kind (SW_LOG_SIZE of a hold, SW_LOG_OBSTACLE_SIZE,
 * SW_LOG_TOOL_SIZE, ...), also when it was released or taken away; of a tie between wires its force
 * on the first one. */
sw_status sw_scene_log(sw_scene *scene, sw_kind kind, sw_handle of, const double **rows,
                       size_t *count, sw_error *err);

#endif
