/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Grippers, as other parts of the scene and steps use them. */
#ifndef SW_GRIP_JAWS_H
#define SW_GRIP_JAWS_H

#include "base/tape.h"
#include "grip/tool.h"
#include "scene/gripper.h"
#include "scene/scene.h"

void sw_scene_clear_tool(sw_tool *tool);
/* Returns the force per finger of the last trial, which ended at time t [N]. */
double sw_tool_squeeze(sw_scene *scene, const sw_tool *tool, double t);
/* Opens the jaws at once as far as no finger reaches into a wire of the built scene that is a line,
 * and forgets their force. */
sw_status sw_jaws_clear(sw_scene *scene, sw_tool *tool, size_t wire, sw_error *err);
/* Updates the tools' held wires at the accepted state, and adds a row to their logs. */
sw_status sw_tool_observe(sw_scene *scene, sw_error *err);
/* Checks whether the tool runs into obstacles. */
sw_status sw_tool_look_out(sw_scene *scene, size_t tool, sw_error *err);
/* 1 if a run should end: a tool that ends runs slipped, it or a frozen one lost its wire, or any
 * tool ran into an obstacle after `since`, the step's start. */
int sw_tool_slipped(const sw_scene *scene, double since);
/* *over: 1 if a frozen grip would bear far more than its pads at the time `until`, where the last
 * trial ends, or where the scene is if it went there by a pose. The grip then counts as lost at the
 * time `since`, and the scene must stay or go back there [s]. sw_grips_frozen: 1 if one may be. */
sw_status sw_grips_overloaded(sw_scene *scene, double since, double until, int *over,
                              sw_error *err);
int sw_grips_frozen(const sw_scene *scene);

void sw_tape_tool(sw_tape *tape, sw_scene *scene, sw_tool *tool);
void sw_tape_jaw(sw_tape *tape, sw_jaw *jaw);

#endif
