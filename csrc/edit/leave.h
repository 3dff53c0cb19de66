/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Removes wires, objects of particles and tools from a scene. */
#ifndef SW_EDIT_LEAVE_H
#define SW_EDIT_LEAVE_H

#include "base/tape.h"
#include "scene/parts.h"

/* Removes a wire or an object of particles. Its holds release it, its joins, ties and forces end,
 * and tools that hold it rigidly get their pads back. Slots of others may change: see
 * sw_scene_body_now. Its frames, series and snapshots stay. SW_ECALLBACK from the motion of one of
 * its holds; nothing is changed then. */
sw_status sw_scene_remove_body(sw_scene *scene, sw_handle body, sw_error *err);

/* Removes a tool with its pads. It releases its wires; its series can still be read. */
sw_status sw_scene_remove_tool(sw_scene *scene, sw_handle tool, sw_error *err);

/* Puts the data of removed bodies on a tape, and checks their numbers. */
void sw_tape_gone(sw_tape *tape, sw_gone *gone);
void sw_tape_check_numbers(sw_tape *tape, const sw_scene *scene);

#endif
