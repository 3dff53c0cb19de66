/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Implicit midpoint: second order, no damping; conserves quadratic invariants, gains energy in
 * contact. */
#include "integrate/integrate.h"

const sw_integrator sw_integrator_implicit_midpoint = {
    .name = "implicit-midpoint",
    .summary = "second order, undamped; not for contact",
    .order = 2,
    .flags = SW_INTEGRATOR_IMPLICIT | SW_INTEGRATOR_ONWARDS | SW_INTEGRATOR_NO_CONTACT,
    .stages = 1,
    .reach = 2,
    .at_infinity = 1,
    .rows = {{.time = 0.5, .hbar = 0.5, .xn = 1}},
};
