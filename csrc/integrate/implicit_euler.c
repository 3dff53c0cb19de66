/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Backward Euler: first order, damps everything; the most robust method. */
#include "integrate/integrate.h"

const sw_integrator sw_integrator_implicit_euler = {
    .name = "implicit-euler",
    .summary = "backward Euler: first order, strongly damped",
    .order = 1,
    .flags = SW_INTEGRATOR_IMPLICIT,
    .stages = 1,
    .rows = {{.time = 1, .hbar = 1, .xn = 1}},
};
