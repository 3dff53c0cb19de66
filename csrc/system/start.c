/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks if a free flight turns edges over. */
#include "base/each.h"
#include "base/simd.h"
#include "system/stage_parts.h"
#include "system/web.h"

/* An edge counts as turned over if its projection on its old direction is below this share of its
 * length [-]. */
static const double LEAST_ALIGNMENT = 0.4;

SW_HOT
static long count_turned(size_t m, const double *restrict x, const double *restrict y) {
  long turned = 0;
  for (size_t e = 0; e < m; e++) {
    const double ex = x[3 * e + 3] - x[3 * e], ey = x[3 * e + 4] - x[3 * e + 1];
    const double ez = x[3 * e + 5] - x[3 * e + 2];
    const double along = ex * (y[3 * e + 3] - y[3 * e]) + ey * (y[3 * e + 4] - y[3 * e + 1]) +
                         ez * (y[3 * e + 5] - y[3 * e + 2]);
    turned += !(along >= LEAST_ALIGNMENT * (ex * ex + ey * ey + ez * ez));
  }
  return turned;
}

sw_status sw_start_check(const sw_system *s, const double *y, sw_error *err) {
  SW_ITEMS(const sw_body, body, s->bodies, s->body_count) {
    const size_t at = 3 * body->first_node;
    if (count_turned(body->plan->edges, s->x + at, y + at) ||
        (body->plan->web && sw_web_turned(body, s->x + at, y + at, LEAST_ALIGNMENT)))
      return sw_fail(err, SW_ENOCONV, "an edge would turn over within the step");
  }
  return SW_OK;
}
