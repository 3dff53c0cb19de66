/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Repelling force between neighbouring nodes of the string model: the axial spring for l < l0 only,
 * E = 1/2 (EA/l0)(l - l0)^2. */
#include "force/axial.h"

static sw_status eval(const void *args, sw_field *field, sw_error *err SW_UNUSED) {
  return sw_axial_eval(((const sw_repel_args *)args)->EA, SW_AXIAL_COMPRESSION, field);
}

static double stable_dt(const void *args, const sw_plan *plan) {
  return sw_axial_stable_dt(((const sw_repel_args *)args)->EA, plan);
}

const sw_force_class sw_force_repel = {
    .name = "repel",
    .summary = "axial spring of each edge against being shortened",
    .flags = SW_FORCE_INNER,
    .params = {"force repel", NULL, 0},
    .eval = eval,
    .stable_dt = stable_dt,
};
