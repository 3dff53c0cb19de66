/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies are opened to be read: the scene is built, their state refreshed. */
#ifndef SW_BODY_OPEN_H
#define SW_BODY_OPEN_H

#include "scene/wire.h"

/* The wire of a handle, in a scene that is built, readable and refreshed. */
sw_status sw_scene_open_wire(sw_scene *scene, sw_handle h, sw_scene_wire **wire, sw_error *err);
/* SW_EINVAL when place is no arc length of the wire. */
sw_status sw_scene_check_place(const sw_scene_wire *wire, double place, sw_error *err);
/* The body of a handle, in a scene that is built, readable and refreshed. */
sw_status sw_scene_open_body(sw_scene *scene, sw_handle h, sw_scene_wire **body, sw_error *err);
/* SW_EINVAL for a speed that nothing has [m/s]. */
sw_status sw_scene_check_speed(const sw_scene *scene, const sw_scene_wire *body, double speed,
                               sw_error *err);

#endif
