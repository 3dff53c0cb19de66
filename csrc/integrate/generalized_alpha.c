/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Generalized-alpha method (Chung & Hulbert 1993). Forces are taken at the share 1 - f of the step,
 * accelerations at 1 - m, with Newmark's beta and gamma for the rest. Motions too fast for the
 * steps keep the share RHO of their size in each step; slow ones are damped as little as that
 * allows:
 *   m = (2 RHO - 1)/(RHO + 1), f = RHO/(RHO + 1), gamma = 1/2 - m + f, beta = (1 - m + f)^2/4.
 * With y, w and A the position, velocity and acceleration at which the forces act
 *   y = yhat + C A, w = what + D A, C = (1 - f) beta h^2/(1 - m), D = (1 - f) gamma h/(1 - m),
 *   yhat = x_n + (1 - f) h v_n + (1 - f) h^2 (1/2 - beta - beta m/(1 - m)) a_n,
 *   what = v_n + (1 - f) h (1 - gamma - gamma m/(1 - m)) a_n.
 * So w = (y - xhat)/hbar with hbar = C/D = beta h/gamma and xhat = yhat - hbar what, and
 * A = (hbar^2/C) (w - what)/hbar. */
#include "integrate/integrate.h"

#define RHO 0.8
#define M ((2 * RHO - 1) / (RHO + 1))
#define F (RHO / (RHO + 1))
#define GAMMA (0.5 - M + F)
#define BETA (0.25 * (1 - M + F) * (1 - M + F))
#define HBAR (BETA / GAMMA)
#define V_A ((1 - F) * (1 - GAMMA / (1 - M)))  /* of h a_n in what */
#define X_A ((1 - F) * (0.5 - BETA / (1 - M))) /* of h^2 a_n in yhat */
#define X_V ((1 - F - HBAR) / HBAR)            /* of hbar v_n in xhat */

const sw_integrator sw_integrator_generalized_alpha = {
    .name = "generalized-alpha",
    .summary =
        "second order, one solve per step, damps motion too fast for the step by a fifth; not for "
        "contact",
    .order = 2,
    .flags = SW_INTEGRATOR_IMPLICIT | SW_INTEGRATOR_ONWARDS | SW_INTEGRATOR_NO_CONTACT,
    .stages = 1,
    .reach = 1 / (1 - F),
    .keeps = 1 / (1 - M),
    .at_infinity = RHO,
    .rows = {{.time = 1 - F,
              .hbar = HBAR,
              .xn = 1,
              .xv = X_V,
              .inertia = BETA * (1 - M) / (GAMMA * GAMMA * (1 - F)),
              .xa = (X_A - HBAR * V_A) / (HBAR * HBAR),
              .va = V_A / HBAR - X_V}},
    .start = "sdirk2",
};
