/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes tools to a tape and reads them. */
#include <math.h>

#include "grip/frozen.h"
#include "grip/jaws.h"
#include "scene/drive.h"
#include "scene/gripper.h"

#define DOUBLE(field) sw_tape_double(t, &x->field)
#define SIZE(field) sw_tape_size(t, &x->field)
#define UINT32(field) sw_tape_uint32(t, &x->field)
#define VEC(field) sw_tape_vec(t, &x->field)
#define QUAT(field) sw_tape_quat(t, &x->field)
#define NAME(field) sw_tape_name(t, x->field)
#define INT(field) sw_tape_int(t, &x->field)

void sw_tape_jaw(sw_tape *t, sw_jaw *x) {
  SW_TAPE_STRUCT(t, sw_jaw, 128);
  INT(mode), INT(status), DOUBLE(opening), DOUBLE(since), DOUBLE(step), DOUBLE(speed);
  DOUBLE(most), DOUBLE(goal), DOUBLE(force), DOUBLE(now), DOUBLE(stiffness);
  sw_tape_bracket(t, &x->found, "jaws");
  INT(trials), INT(guessed);
  sw_tape_expect(t, x->mode >= SW_JAW_STILL && x->mode <= SW_JAW_FORCE, "jaws");
  sw_tape_expect(t, x->status >= SW_JAW_RESTS && x->status <= SW_JAW_EMPTY, "jaws");
  sw_tape_expect(t, isfinite(x->opening + x->since + x->speed), "jaws");
}

static void tape_tool_state(sw_tape *t, sw_tool_state *x) {
  SW_TAPE_STRUCT(t, sw_tool_state, 240); /* the names in a crash are filled in when asked for */
  DOUBLE(opening), INT(status), DOUBLE(squeeze), DOUBLE(normal), DOUBLE(most), DOUBLE(margin);
  DOUBLE(sliding), DOUBLE(slip), VEC(slipped), VEC(turned), VEC(centre), QUAT(q), DOUBLE(place);
  DOUBLE(slip_time), DOUBLE(slip_place), INT(frozen), DOUBLE(lost_time);
  sw_tape_expect(t, x->status >= SW_JAW_RESTS && x->status <= SW_JAW_EMPTY, "jaws");
}

void sw_tape_tool(sw_tape *t, sw_scene *s, sw_tool *x) {
  SW_TAPE_STRUCT(t, sw_tool, 984); /* room is a growing buffer; way to searched last a pose */
  UINT32(generation), INT(alive), NAME(name);
  sw_tape_drive(t, s, &x->drive);
  sw_tape_jaw(t, &x->jaw);
  SIZE(pads), INT(fingers), DOUBLE(limit), DOUBLE(tolerance), INT(stops);
  sw_tape_expect(t, x->pads <= SW_TOOL_PADS, "the pads of a gripper");
  for (size_t k = 0; k < x->pads && sw_tape_good(t); k++)
    sw_tape_size(t, &x->pad[k].obstacle), sw_tape_int(t, &x->pad[k].finger);
  sw_tape_frozen(t, &x->frozen);
  SW_TAPE_STRUCT(t, sw_crash, 32);
  DOUBLE(crash.time), DOUBLE(crash.depth), SIZE(crash.part), SIZE(crash.obstacle), INT(crashing);
  tape_tool_state(t, &x->now);
  sw_tape_log(t, &x->log);
}
