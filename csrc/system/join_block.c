/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Adds forces and stiffness of joins to the bodies' rows and the bridges. */
#include "solve/band3.h"
#include "system/hub.h"

void sw_join_add_force(sw_system *s, uint32_t node, sw_vec f) {
  sw_body *b = &s->bodies[sw_system_body_of(s, node)];
  sw_accumulate(b->field.force + 3 * (node - b->first_node), f);
}

sw_status sw_join_add_block(sw_system *s, uint32_t i, uint32_t j, const double k[9]) {
  static const size_t upper[6] = {0, 1, 2, 4, 5, 8};
  if (i > j) {
    const double turned[9] = {k[0], k[3], k[6], k[1], k[4], k[7], k[2], k[5], k[8]};
    return sw_join_add_block(s, j, i, turned);
  }
  if (!sw_join_in_band(s, i, j)) return sw_system_add_bridge(s, i, j, k);
  sw_body *b = &s->bodies[sw_system_body_of(s, i)];
  double *row = b->field.rows + SW_ROW_SIZE * (i - b->first_node);
  for (size_t m = 0; i == j && m < 6; m++) row[SW_ROW_OWN + m] += k[upper[m]];
  for (size_t m = 0; j == i + 1 && m < 9; m++) row[SW_ROW_NEXT + m] += k[m];
  for (size_t m = 0; j == i + 2 && m < 9; m++) row[SW_ROW_SECOND + m] += k[m];
  return SW_OK;
}
