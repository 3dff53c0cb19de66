/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes, measures and clears a field. */
#include "state/field.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/clear.h"
#include "base/simd.h"

enum { ROW = SW_FIELD_ROW, EDGE_ARRAYS = 5 + 3 + 6, NODE_ARRAYS = 9 + 4 };

sw_status sw_field_new(sw_field *field, size_t nodes, void **block) {
  const size_t stride = (nodes + 3 * SW_LANES - 1) / SW_LANES * SW_LANES;
  const size_t arrays = EDGE_ARRAYS + NODE_ARRAYS;
  double *p = sw_alloc(arrays * stride + nodes * (3 + ROW) + SW_LANES, sizeof *p);
  if (!p) return SW_ENOMEM;
  *block = p;
  memset(field, 0, sizeof *field);
  p += SW_LANES; /* index -1 of the first array must be readable zero too */
  double **const singles[] = {&field->length, &field->reciprocal};
  for (int k = 0; k < 2; k++, p += stride) *singles[k] = p;
  for (int k = 0; k < 3; k++, p += stride) field->tangent[k] = p;
  for (int k = 0; k < 3; k++, p += stride) field->gradient[k] = p;
  for (int k = 0; k < 6; k++, p += stride) field->own[k] = p;
  for (int k = 0; k < 9; k++, p += stride) field->next[k] = p;
  for (int k = 0; k < 4; k++, p += stride) field->scratch[k] = p;
  field->force = p;
  field->rows = p + 3 * nodes;
  return SW_OK;
}

SW_HOT
static void geometry(size_t m, const double *restrict x, double *restrict length,
                     double *restrict reciprocal, double *restrict tx, double *restrict ty,
                     double *restrict tz) {
  for (size_t e = 0; e < m; e++) {
    const double ax = x[3 * e + 3] - x[3 * e];
    const double ay = x[3 * e + 4] - x[3 * e + 1];
    const double az = x[3 * e + 5] - x[3 * e + 2];
    const double l = sqrt(ax * ax + ay * ay + az * az);
    const double r = 1.0 / l;
    length[e] = l;
    reciprocal[e] = r;
    tx[e] = ax * r;
    ty[e] = ay * r;
    tz[e] = az * r;
  }
}

void sw_field_geometry(sw_field *field) {
  field->is_judged = 0;
  geometry(field->plan->edges, field->x, field->length, field->reciprocal, field->tangent[0],
           field->tangent[1], field->tangent[2]);
}

void sw_field_clear(sw_field *field) {
  const size_t n = field->plan->nodes, m = field->plan->edges;
  field->energy = field->bending = 0;
  if (field->want & SW_WANT_FORCE) {
    for (int k = 0; k < 3; k++) sw_clear(field->gradient[k], m);
    sw_clear(field->force, 3 * n);
  }
  if (field->want & SW_WANT_STIFFNESS) {
    for (int k = 0; k < 6; k++) sw_clear(field->own[k], m);
    for (int k = 0; k < 9; k++) sw_clear(field->next[k], n);
    sw_clear(field->rows, n * ROW);
  }
  if (field->normals[0]) { /* one block, see sw_spin_new */
    sw_clear(field->spin, 12 * (n + SW_LANES));
    if (field->spin_node[0]) sw_clear(field->spin_node[0], 6 * (n + SW_LANES));
  }
}
