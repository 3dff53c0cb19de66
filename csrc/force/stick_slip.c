/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strands that rub on each other. The wire's own EI is that of slipping strands; this force adds a
 * spring of stiffness EI_stick - EI that carries at most the friction moment (elastic-perfectly
 * plastic, in both planes; see slip.c). From rest the moment rises with EI_stick up to kappa_f =
 * friction_moment / (EI_stick - EI) and with EI beyond. A cycle to +-kappa_max dissipates 4
 * friction_moment (kappa_max - kappa_f) per length. All strands slip at once, at a moment that does
 * not depend on tension. */
#include <math.h>
#include <stddef.h>

#include "force/force.h"
#include "force/memory.h"

typedef struct stick_slip_args {
  double EI_stick;        /* [N m2] */
  double friction_moment; /* [N m] */
} stick_slip_args;

static const sw_param rows[] = {
    {"EI_stick", SW_PARAM_NUMBER, "N m2", 0, 0, HUGE_VAL, SW_PARAM_REQUIRED | SW_PARAM_ABOVE_MIN,
     NULL, offsetof(stick_slip_args, EI_stick),
     "bending stiffness while the strands stick; the wire's EI is the stiffness of slipping "
     "strands"},
    {"friction_moment", SW_PARAM_NUMBER, "N m", 0, 0, HUGE_VAL,
     SW_PARAM_REQUIRED | SW_PARAM_ABOVE_MIN, NULL, offsetof(stick_slip_args, friction_moment),
     "moment that friction between slipping strands carries"},
};

static sw_status check(const void *args, const sw_beam *beam, sw_error *err) {
  const stick_slip_args *a = args;
  if (a->EI_stick > beam->EI) return SW_OK;
  return sw_fail(err, SW_EINVAL,
                 "force stick_slip: EI_stick = %g N m2 must be above the wire's EI = %g N m2, "
                 "which is the stiffness of slipping strands",
                 a->EI_stick, beam->EI);
}

static sw_memory_law law_of(const void *args, const sw_plan *plan) {
  const stick_slip_args *a = args;
  const double stiffness = a->EI_stick - plan->beam.EI;
  return (sw_memory_law){stiffness, stiffness, 0.0, a->friction_moment};
}

SW_MEMORY_FORCE(law_of)

/* The limit of bending with both stiffnesses together. */
static double stable_dt(const void *args, const sw_plan *plan) {
  const double EI = ((const stick_slip_args *)args)->EI_stick;
  double smallest = HUGE_VAL;
  for (size_t e = 0; e < plan->edges; e++)
    smallest = fmin(smallest, 0.5 * plan->rest[e] * plan->rest[e] * sqrt(plan->beam.mass / EI));
  return smallest;
}

const sw_force_class sw_force_stick_slip = {
    .name = "stick_slip",
    .summary = "friction between strands: stiff until the strands slip",
    .params = SW_PARAMS("force stick_slip", rows),
    .eval = eval,
    .stable_dt = stable_dt,
    .clamp_moment = clamp_moment,
    .clamp_energy = clamp_energy,
    .check = check,
    .state_size = sw_memory_size,
    .commit = commit,
    .inherit = sw_memory_inherit,
};
