/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Grippers, for the other rooms of a scene and for steps. */
#ifndef SW_GRIP_JAWS_H
#define SW_GRIP_JAWS_H

#include "base/tape.h"
#include "grip/tool.h"
#include "scene/gripper.h"
#include "scene/scene.h"

void sw_scene_clear_tool(sw_tool *tool);
/* Force per finger as of the last trial, which ended at time t [N]. */
double sw_tool_squeeze(sw_scene *scene, const sw_tool *tool, double t);
/* What tools hold at the accepted state; their logs. */
sw_status sw_tool_observe(sw_scene *scene, sw_error *err);
/* Does the tool run into obstacles? */
sw_status sw_tool_look_out(sw_scene *scene, size_t tool, sw_error *err);
/* 1: one that ends a run with it slipped after this time, that of a step's start. */
int sw_tool_slipped(const sw_scene *scene, double since);

void sw_tape_tool(sw_tape *tape, sw_scene *scene, sw_tool *tool);
void sw_tape_jaw(sw_tape *tape, sw_jaw *jaw);

#endif
