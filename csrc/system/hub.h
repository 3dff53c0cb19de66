/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The hub of a rigid join in the equations. Private to this room. */
#ifndef SW_SYSTEM_HUB_H
#define SW_SYSTEM_HUB_H

#include "system/join.h"

/* The present state of an arm. */
typedef struct sw_hub_arm {
  sw_vec p, r;       /* its direction; its rest direction turned with the hub [-] */
  double inverse, c; /* 1 over its length [1/m], p.r [-] */
} sw_hub_arm;

void sw_hub_measure(const sw_join_hub *hub, const double *x, sw_hub_arm *arms);

/* Computes the inverse of the hub's own stiffness against turning. An axis along all arms is free:
 * a very small stiffness makes the matrix regular [1/N m]. */
void sw_hub_compliance(const sw_join_hub *hub, const sw_hub_arm *arms, double out[9]);

/* Computes that at rest, turned to the directions r of the arms. */
void sw_hub_rest_compliance(const sw_join_hub *hub, const sw_hub_arm *arms, double out[9]);

/* Returns C v. */
static inline sw_vec sw_hub_times(const double C[9], sw_vec v) {
  return sw_v(C[0] * v.x + C[1] * v.y + C[2] * v.z, C[3] * v.x + C[4] * v.y + C[5] * v.z,
              C[6] * v.x + C[7] * v.y + C[8] * v.z);
}

/* Computes (I - p p') [r x] k/|a| of an arm [N]. */
void sw_hub_coupling(const sw_hub_arm *arm, double k, double out[9]);

/* Adds forces and stiffness at y. Measures the arms and computes the compliance C. SW_ENOMEM. */
sw_status sw_hub_eval(sw_system *system, const sw_join_hub *hub, const double *y, sw_hub_arm *arms,
                      double C[9]);

/* 1 if the block of nodes i < j is in the rows of their body's own band. */
static inline int sw_join_in_band(const sw_system *s, uint32_t i, uint32_t j) {
  return j - i <= 2 && sw_system_body_of(s, i) == sw_system_body_of(s, j);
}

void sw_join_add_force(sw_system *system, uint32_t node, sw_vec force);
/* Adds stiffness between nodes i and j, with i's rows; for i == j the whole symmetric block.
 * SW_ENOMEM. */
sw_status sw_join_add_block(sw_system *system, uint32_t i, uint32_t j, const double k[9]);

#endif
