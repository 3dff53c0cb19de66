/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Resistance to elongation: E = 1/2 (EA/l0)(l - l0)^2 for each edge; with tension_only for l > l0
 * only. Valid for small axial strain (a few per cent), like Hooke's law. */
#include "force/axial.h"

static sw_status eval(const void *args, sw_field *field, sw_error *err SW_UNUSED) {
  const sw_stretch_args *a = args;
  return sw_axial_eval(a->EA, SW_AXIAL_TENSION | (a->tension_only > 0 ? 0 : SW_AXIAL_COMPRESSION),
                       field);
}

static double stable_dt(const void *args, const sw_plan *plan) {
  return sw_axial_stable_dt(((const sw_stretch_args *)args)->EA, plan);
}

const sw_force_class sw_force_stretch = {
    .name = "stretch",
    .summary = "axial spring of each edge against elongation (rod: also against shortening)",
    .flags = SW_FORCE_INNER,
    .params = {"force stretch", NULL, 0},
    .eval = eval,
    .stable_dt = stable_dt,
};
