/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A dead force on some particles of a mesh: fixed direction and size, shared evenly among them. */
#include <math.h>
#include <stddef.h>

#include "force/force.h"

typedef struct push_args {
  sw_force_some some;
  sw_vec force; /* on all particles together [N] */
} push_args;

static const sw_param rows[] = {
    {"particles", SW_PARAM_OTHER, "-", 0, 0, 0, SW_PARAM_REQUIRED, NULL, 0,
     "list of the particles' numbers, from 1 on"},
    {"force", SW_PARAM_VECTOR, "N", 0, -HUGE_VAL, HUGE_VAL, SW_PARAM_REQUIRED | SW_PARAM_CHANGES,
     NULL, offsetof(push_args, force), "the force on all of them together, fixed in world axes"},
};

static sw_status eval(const void *args, sw_field *f, sw_error *err SW_UNUSED) {
  const push_args *a = args;
  const sw_vec each = sw_scale(a->force, 1.0 / (double)a->some.count);
  for (size_t i = 0; i < a->some.count; i++) {
    const size_t at = 3 * (size_t)a->some.particle[i];
    if (f->want & SW_WANT_FORCE) sw_accumulate(f->force + at, each);
    if (f->want & SW_WANT_ENERGY) f->energy -= sw_dot(each, sw_load(f->x + at));
  }
  return SW_OK;
}

const sw_force_class sw_force_push = {
    .name = "push",
    .summary = "a force of fixed direction on some particles",
    .flags = SW_FORCE_ANY_BODY | SW_FORCE_OF_WEB | SW_FORCE_ON_SOME | SW_FORCE_LOAD,
    .params = SW_PARAMS("force push", rows),
    .eval = eval,
};
