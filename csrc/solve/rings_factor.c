/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eliminates ring by ring, and solves. */
#include <string.h>

#include "base/interrupt.h"
#include "solve/blocks.h"
#include "solve/blocks_front.h"
#include "solve/rings.h"

static int any(const unsigned char *flags, size_t n) {
  int found = 0;
  for (size_t i = 0; i < n; i++) found |= flags[i];
  return found;
}

/* Returns the ring's values without the rows and columns of fixed nodes. */
static const double *mask_ring(const sw_rings *r, const unsigned char *fixed, size_t ring) {
  const unsigned char *here = fixed + ring * r->per_ring;
  const double *values = r->values + ring * r->n * r->stride;
  const size_t before = ring > 0 ? r->per_ring : 0;
  if (!any(here - before, before + r->per_ring)) return values;
  memcpy(r->masked, values, r->n * r->stride * sizeof *values);
  for (size_t i = 0; i < r->n; i++) {
    double *row = r->masked + i * r->stride;
    if (here[i / 3]) memset(row, 0, r->stride * sizeof *row);
    for (size_t p = 0; p < r->per_ring; p++) {
      if (ring > 0 && (here - r->per_ring)[p]) memset(row + 3 * p, 0, 3 * sizeof *row);
      if (here[p]) memset(row + r->padded + 3 * p, 0, 3 * sizeof *row);
    }
    if (here[i / 3]) row[r->padded + i] = 1.0;
  }
  return r->masked;
}

static sw_front front_of(const sw_rings *r, size_t ring) {
  const size_t first = ring * r->n;
  return (sw_front){.n = r->n,
                    .before = ring > 0 ? r->padded : 0,
                    .place = r->padded,
                    .stride = r->stride,
                    .factor = r->factor + first * r->stride,
                    .kept = r->kept + first * SW_FRONT_KEPT,
                    .scaled = r->scaled + ring % 2 * r->n * r->stride};
}

sw_status sw_rings_factor(sw_rings *r, const unsigned char *fixed, size_t *negative) {
  size_t count = 0, bad = 0;
  sw_front f, next = {.factor = NULL};
  for (size_t k = r->rings; k-- > 0 && !bad; next = f) {
    if (sw_interrupted()) return SW_EINTR;
    f = front_of(r, k);
    f.a = fixed ? mask_ring(r, fixed, k) : r->values + k * r->n * r->stride;
    f.next_factor = next.factor, f.next_scaled = next.scaled;
    sw_front_eliminate(&f);
    count += f.negative, bad += f.bad;
  }
  if (negative) *negative = count;
  return bad ? SW_ESINGULAR : SW_OK;
}

/* Half a cube for the part of the next ring in a ring's own rows, half a cube for the columns
 * before them, a sixth for the rows themselves. */
double sw_blocks_rings_work(size_t rings, size_t per_ring) {
  const double n = 3.0 * (double)per_ring, joints = (double)(rings - 1);
  return n * n * n * (joints / 2 + joints / 2 + (double)rings / 6);
}

void sw_rings_solve(const sw_rings *r, double *x) {
  sw_rings_pad(r, x, r->x);
  for (size_t k = r->rings; k-- > 0;) {
    const sw_front f = front_of(r, k);
    double *own = r->x + k * r->padded;
    sw_front_forward(&f, own, k > 0 ? own - r->padded : NULL);
  }
  for (size_t k = 0; k < r->rings; k++) {
    const sw_front f = front_of(r, k);
    double *own = r->x + k * r->padded;
    sw_front_backward(&f, own, k > 0 ? own - r->padded : NULL);
  }
  sw_rings_unpad(r, r->x, x);
}
