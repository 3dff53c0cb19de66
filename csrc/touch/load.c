/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Adds a touch's force F and stiffness K to its place's nodes: w_i F, w_i w_j K with weights w. */
#include "touch/load.h"

#include "solve/band3.h"

/* Entries of a symmetric 3 x 3 matrix, by rows, in its upper half [-]. */
static const size_t FULL[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};

void sw_load_couple(sw_body *body, uint32_t i, uint32_t j, const double K[9]) {
  const size_t from = i - body->first_node, to = j - body->first_node;
  double *row = body->field.rows + SW_ROW_SIZE * from;
  row += to == from + 1 ? SW_ROW_NEXT : SW_ROW_SECOND;
  if (body->plan->web)
    sw_body_couple(body, from, to, K);
  else
    for (int m = 0; m < 9; m++) row[m] += K[m];
}

void sw_load_force(sw_body *body, const sw_mean *at, sw_vec force) {
  for (uint32_t i = 0; i < at->count; i++) {
    double *on = body->field.force + 3 * (at->node[i] - body->first_node);
    sw_accumulate(on, sw_scale(force, at->w[i]));
  }
}

void sw_load_add(sw_body *body, const sw_mean *at, sw_vec force, const double *K) {
  sw_load_force(body, at, force);
  for (uint32_t i = 0; K && i < at->count; i++) {
    double *row = body->field.rows + SW_ROW_SIZE * (at->node[i] - body->first_node), between[9];
    for (int m = 0; m < 6; m++) row[SW_ROW_OWN + m] += at->w[i] * at->w[i] * K[m];
    for (uint32_t j = i + 1; j < at->count; j++) {
      for (int m = 0; m < 9; m++) between[m] = at->w[i] * at->w[j] * K[FULL[m]];
      sw_load_couple(body, at->node[i], at->node[j], between);
    }
  }
}
