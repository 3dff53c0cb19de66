/* SPDX-License-Identifier: GPL-3.0-or-later */
/* TR-BDF2 (Bank et al. 1985): the trapezoidal rule over gamma h, then BDF2, with gamma = 2 - sqrt 2
 * so that both stages have the same matrix. Second order, L-stable, little damping of resolved
 * motion. The trapezoidal rule needs the acceleration at the step's start, so sdirk2 takes one step
 * after a discontinuity. The error estimate is that of the trapezoidal rule and BDF2, from the
 * three velocities. */
#include "integrate/integrate.h"

#define GAMMA 0.58578643762690495 /* 2 - sqrt 2 */
#define A1 (1.0 / (GAMMA * (2.0 - GAMMA)))
#define A2 ((1.0 - GAMMA) * (1.0 - GAMMA) / (GAMMA * (2.0 - GAMMA)))
#define E (2.0 * (-3.0 * GAMMA * GAMMA + 4.0 * GAMMA - 2.0) / (12.0 * (2.0 - GAMMA)))

const sw_integrator sw_integrator_tr_bdf2 = {
    .name = "tr-bdf2",
    .summary = "trapezoid then BDF2: second order, L-stable; the default",
    .order = 2,
    .flags = SW_INTEGRATOR_IMPLICIT | SW_INTEGRATOR_EMBEDDED,
    .stages = 2,
    .rows = {{.time = GAMMA, .hbar = 0.5 * GAMMA, .xn = 1, .xv = 1},
             {.time = 1, .hbar = (1.0 - GAMMA) / (2.0 - GAMMA), .x1 = A1, .xn = -A2}},
    .error = {E / GAMMA, -E / (GAMMA * (1.0 - GAMMA)), E / (1.0 - GAMMA)},
    .start = "sdirk2",
};
