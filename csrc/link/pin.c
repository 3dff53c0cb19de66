/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Holds the position at one arc length. The wire turns freely there. */
#include <math.h>

#include "link/hold.h"

static const sw_param rows[] = {
    {"s", SW_PARAM_NUMBER, "m", 0, 0, HUGE_VAL, 0, NULL, offsetof(sw_hold_args, s),
     "arc length of the held point"},
    SW_NAME_ROW(sw_hold_args),
};

static const sw_hold_acts acts = {.direction = 0};

const sw_link_class sw_link_pin = {
    .name = "pin",
    .summary = "holds the position at one arc length",
    .params = SW_PARAMS("pin", rows),
    .hold = &acts,
};
