/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two-step backward differentiation with equal steps: second order, L-stable. sdirk2 takes the
 * first step and every step whose size changed. */
#include "integrate/integrate.h"

const sw_integrator sw_integrator_bdf2 = {
    .name = "bdf2",
    .summary = "two-step backward differences: second order, one solve per step",
    .order = 2,
    .flags = SW_INTEGRATOR_IMPLICIT | SW_INTEGRATOR_HISTORY,
    .stages = 1,
    .rows = {{.time = 1, .hbar = 2.0 / 3.0, .xn = 4.0 / 3.0, .xp = -1.0 / 3.0}},
    .start = "sdirk2",
};
