/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A guide through which the wire slides along its axis: held there like a clamp,
 * exactly at the guide, while wire is paid out of a spool behind it or drawn in. In
 * mid-wire it passes wire from one side to the other. */
#include <math.h>

#include "constraint/constraint.h"

static const sw_param rows[] = {
    {"s", SW_PARAM_NUMBER, "m", 0, 0, HUGE_VAL, 0, NULL, offsetof(sw_hold_args, s),
     "arc length at the guide: 0 or the wire's length with a spool behind it"},
    {"direction", SW_PARAM_VECTOR, "-", NAN, -HUGE_VAL, HUGE_VAL, 0, NULL,
     offsetof(sw_hold_args, direction),
     "where the guide points, the way of the wire that is paid out (default: the wire's own)"},
    {"speed", SW_PARAM_NUMBER, "m/s", NAN, -1e4, 1e4, 0, NULL, offsetof(sw_hold_args, speed),
     "wire paid out per time, unstressed; negative draws it in (default 0, without force)"},
    {"force", SW_PARAM_NUMBER, "N", NAN, -1e9, 1e9, 0, NULL, offsetof(sw_hold_args, force),
     "pushes the wire out with this force instead of a speed; negative: a pull against it"},
    {"force_limit", SW_PARAM_NUMBER, "N", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(sw_hold_args, force_limit),
     "the wire slips through where holding its speed would take more (default: never)"},
    {"name", SW_PARAM_TEXT, "-", 0, 0, 0, 0, NULL, offsetof(sw_hold_args, name),
     "name used in messages and series"},
};

const sw_hold_class sw_hold_feed = {
    .name = "feed",
    .summary = "holds like a clamp while wire slides through",
    .clamped = 1,
    .feeds = 1,
    .params = SW_PARAMS("feed", rows),
};
