/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wires, objects of particles and tools leave a scene. */
#ifndef SW_EDIT_LEAVE_H
#define SW_EDIT_LEAVE_H

#include "base/tape.h"
#include "scene/parts.h"

/* Take a wire or an object of particles away. Its holds release it, its joins, ties and forces end,
 * tools that hold it rigidly have their pads again. Slots of others may change: see body_now. Its
 * frames, series and snapshots stay. SW_ECALLBACK from the motion of one of its holds; nothing is
 * changed then. */
sw_status sw_scene_remove_body(sw_scene *scene, sw_handle body, sw_error *err);

/* Take a tool away, with its pads. It releases its wires; its series can still be read. */
sw_status sw_scene_remove_tool(sw_scene *scene, sw_handle tool, sw_error *err);

/* What is known of those that have left, on a tape. */
void sw_tape_gone(sw_tape *tape, sw_gone *gone);
void sw_tape_check_numbers(sw_tape *tape, const sw_scene *scene);

#endif
