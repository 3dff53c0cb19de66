/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Series of wires, forces and other objects, and the crashes of holds. */
#ifndef SW_WATCH_SERIES_H
#define SW_WATCH_SERIES_H

#include "scene/scene.h"

/* Lets the wire's holds that no step has watched yet look at obstacles. Call before the wire gets
 * another model: later pushes into obstacles then count as caused by the change. */
sw_status sw_scene_watch_holds(sw_scene *scene, sw_handle wire, sw_error *err);
/* The last crash of a hold: when [s], how deep [m], and the obstacle's name; NAN, 0 and "" if there
 * was none. */
sw_status sw_scene_hold_crash(const sw_scene *scene, sw_handle hold, double *time, double *depth,
                              const char **obstacle, sw_error *err);

/* Row of a wire: time, largest tension [N], largest curvature [1/m]. Row of a force with a read-out
 * force_x (clip, tether): time, force on the wires [N]. */
enum { SW_LOG_WIRE_SIZE = 3, SW_LOG_FORCE_SIZE = 4 };

/* Returns the rows of an object, in the format of its kind (SW_LOG_SIZE of a hold,
 * SW_LOG_OBSTACLE_SIZE, SW_LOG_TOOL_SIZE, ...); of a tie between wires the force on the first wire.
 * Works after the object was released or removed. count is 0 where nothing was recorded. */
sw_status sw_scene_log(sw_scene *scene, sw_kind kind, sw_handle of, const double **rows,
                       size_t *count, sw_error *err);

#endif
