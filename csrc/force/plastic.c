/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elastic-plastic bending with a yield moment and linear kinematic hardening (Prager), in both
 * planes: the moment is EI (kappa - kappa_p), and |EI (kappa - kappa_p) - hardening kappa_p| stays
 * within the yield moment. The wire's own bend gives 1/2 k phi^2; this force adds the difference,
 * so an elastic wire costs nothing and `bend` needs no history (see slip.c). The plastic curvature
 * turns with the tangent but not about it: it does not follow a bent wire that spins about its own
 * axis. The section yields as one hinge, without the gradual transition of a real section and
 * independently of tension. */
#include <math.h>
#include <stddef.h>

#include "force/force.h"
#include "force/memory.h"

typedef struct plastic_args {
  double yield_moment; /* [N m] */
  double hardening;    /* [N m2] */
} plastic_args;

static const sw_param rows[] = {
    {"yield_moment", SW_PARAM_NUMBER, "N m", 0, 0, HUGE_VAL, SW_PARAM_REQUIRED | SW_PARAM_ABOVE_MIN,
     NULL, offsetof(plastic_args, yield_moment), "bending moment above which the wire stays bent"},
    {"hardening", SW_PARAM_NUMBER, "N m2", 0, 0, HUGE_VAL, 0, NULL,
     offsetof(plastic_args, hardening),
     "yield moment gained per plastic curvature, lost in the other direction"},
};

static sw_memory_law law_of(const void *args, const sw_plan *plan) {
  const plastic_args *a = args;
  return (sw_memory_law){plan->beam.EI, 0.0, a->hardening, a->yield_moment};
}

SW_MEMORY_FORCE(law_of)

const sw_force_class sw_force_plastic = {
    .name = "plastic",
    .summary = "bending beyond a yield moment is permanent, with hardening",
    .flags = SW_FORCE_BY_ANGLE,
    .params = SW_PARAMS("force plastic", rows),
    .eval = eval,
    .clamp_moment = clamp_moment,
    .clamp_energy = clamp_energy,
    .state_size = sw_memory_size,
    .commit = commit,
    .inherit = sw_memory_inherit,
};
