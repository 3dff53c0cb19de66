/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Viscous bending: the moment eta d(kappa)/dt of a Kelvin-Voigt wire, clamps'
 * hinges included (see force/dashpot.h). A mode of angular frequency omega has
 * the damping ratio eta omega / (2 EI). */
#include <math.h>
#include <stddef.h>

#include "force/dashpot.h"
#include "force/force.h"

typedef struct viscous_args {
  double eta; /* [N m2 s] */
} viscous_args;

static const sw_param rows[] = {
    {"eta", SW_PARAM_NUMBER, "N m2 s", 0, 0, HUGE_VAL, SW_PARAM_REQUIRED | SW_PARAM_CHANGES, NULL,
     offsetof(viscous_args, eta), "bending moment per rate of curvature"},
};

static sw_vec clamp_moment(const void *args, const sw_field *f, const sw_clamp_hinge *h) {
  return sw_dashpot_clamp_moment(((const viscous_args *)args)->eta, f, h);
}

static sw_status eval(const void *args, sw_field *f, sw_error *err SW_UNUSED) {
  const double eta = ((const viscous_args *)args)->eta;
  sw_dashpot_hinges(eta, f);
  for (size_t c = 0; c < f->plan->clamp_count; c++) sw_dashpot_clamp(eta, f, &f->plan->clamps[c]);
  return SW_OK;
}

static double viscosity(const void *args, const sw_plan *plan SW_UNUSED) {
  return ((const viscous_args *)args)->eta;
}

const sw_force_class sw_force_viscous_bend = {
    .name = "viscous_bend",
    .summary = "bending moment proportional to the rate of curvature",
    .flags = SW_FORCE_DISSIPATIVE | SW_FORCE_POWER,
    .params = SW_PARAMS("force viscous_bend", rows),
    .eval = eval,
    .viscosity = viscosity,
    .clamp_moment = clamp_moment,
};
