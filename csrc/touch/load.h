/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Adds the force and stiffness of a touch to the nodes of its place. */
#ifndef SW_TOUCH_LOAD_H
#define SW_TOUCH_LOAD_H

#include "system/system.h"
#include "touch/mean.h"

/* Distributes a force to the nodes of a place [N]. */
void sw_load_force(sw_body *body, const sw_mean *at, sw_vec force);
/* Distributes force and stiffness K (upper half) [N/m]; NULL: no stiffness. */
void sw_load_add(sw_body *body, const sw_mean *at, sw_vec force, const double *K);
/* Adds stiffness between nodes i < j of one body [N/m]. */
void sw_load_couple(sw_body *body, uint32_t i, uint32_t j, const double K[9]);

#endif
