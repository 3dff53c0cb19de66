/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A user's function as a force (in Lua: scene:force{ kind = function ... }). It has no stiffness,
 * so the solver finds its fixed point by iteration. This works for forces softer than the wire's
 * own; for stiffer ones the run asks for smaller steps. */
#include "force/force.h"

static sw_status eval(const void *args, sw_field *field, sw_error *err) {
  const sw_callback_args *a = args;
  if (!(field->want & SW_WANT_FORCE)) return SW_OK;
  return a->function(a->user, field, err);
}

const sw_force_class sw_force_callback = {
    .name = "callback",
    .summary = "a function that adds to the node forces",
    .flags = SW_FORCE_INNER | SW_FORCE_EXPLICIT | SW_FORCE_ANY_BODY,
    .params = {"force callback", NULL, 0},
    .eval = eval,
};
