/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The grasped region of a gripper: the interval of the given width around s is rigid in the shape
 * it had when grasped. Each face is a corrected clamp (state/plan.c). */
#include <math.h>

#include "link/hold.h"

static const sw_param rows[] = {
    {"s", SW_PARAM_NUMBER, "m", 0, 0, HUGE_VAL, 0, NULL, offsetof(sw_hold_args, s),
     "arc length of the region's middle, also the tool centre"},
    {"width", SW_PARAM_NUMBER, "m", 0, 0, HUGE_VAL, 0, NULL, offsetof(sw_hold_args, width),
     "length of wire between the pads"},
    SW_NAME_ROW(sw_hold_args),
};

static const sw_hold_acts acts = {.direction = 1};

const sw_link_class sw_link_grip = {
    .name = "grip",
    .summary = "holds an interval of the wire rigidly",
    .params = SW_PARAMS("grip", rows),
    .hold = &acts,
};
