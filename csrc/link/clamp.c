/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Holds position and direction at one arc length. It acts exactly there on any mesh (the corrected
 * clamp of state/plan.c). */
#include <math.h>

#include "link/hold.h"

static const sw_param rows[] = {
    {"s", SW_PARAM_NUMBER, "m", 0, 0, HUGE_VAL, 0, NULL, offsetof(sw_hold_args, s),
     "arc length of the held point"},
    {"direction", SW_PARAM_VECTOR, "-", NAN, -HUGE_VAL, HUGE_VAL, 0, NULL,
     offsetof(sw_hold_args, direction),
     "tangent that is held (default: the wire's present tangent)"},
    SW_NAME_ROW(sw_hold_args),
};

static const sw_hold_acts acts = {.direction = 1};

const sw_link_class sw_link_clamp = {
    .name = "clamp",
    .summary = "holds position and direction at one arc length",
    .params = SW_PARAMS("clamp", rows),
    .hold = &acts,
};
