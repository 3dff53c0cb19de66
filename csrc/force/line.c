/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A dead force spread evenly over the wire's length: f_i = q l_i, l_i being the length that belongs
 * to node i. */
#include <math.h>
#include <stddef.h>

#include "force/force.h"

typedef struct line_args {
  sw_vec force; /* per length [N/m] */
} line_args;

static const sw_param rows[] = {
    {"force", SW_PARAM_VECTOR, "N/m", 0, -HUGE_VAL, HUGE_VAL, SW_PARAM_REQUIRED | SW_PARAM_CHANGES,
     NULL, offsetof(line_args, force), "force per length of wire, fixed in world axes"},
};

static sw_status eval(const void *args, sw_field *f, sw_error *err SW_UNUSED) {
  const line_args *a = args;
  for (size_t i = 0; i < f->plan->nodes; i++) {
    const sw_vec q = sw_scale(a->force, f->plan->lumped[i] / f->plan->beam.mass);
    if (f->want & SW_WANT_FORCE) sw_accumulate(f->force + 3 * i, q);
    if (f->want & SW_WANT_ENERGY) f->energy -= sw_dot(q, sw_load(f->x + 3 * i));
  }
  return SW_OK;
}

const sw_force_class sw_force_line = {
    .name = "line",
    .summary = "a force of fixed direction spread over the whole wire",
    .flags = SW_FORCE_ANY_BODY | SW_FORCE_LOAD,
    .params = SW_PARAMS("force line", rows),
    .eval = eval,
};
