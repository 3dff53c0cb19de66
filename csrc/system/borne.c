/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums axial forces of bending forces and those of springs, for read-outs. */
#include "system/borne.h"

#include <string.h>

#include "base/alloc.h"
#include "base/each.h"

sw_status sw_system_add_borne(sw_system *s) {
  int any = 0;
  SW_ITEMS(const sw_body, b, s->bodies, s->body_count) {
    any |= b->bears;
  }
  if (!any) return SW_OK;
  s->borne = sw_alloc((2 + SW_BORNE_SUMS) * s->edges, sizeof *s->borne); /* zeros */
  return s->borne ? SW_OK : SW_ENOMEM;
}

void sw_system_find_borne(sw_system *s, const sw_body *b) {
  if (!b->bears || !s->borne) return;
  double *borne = s->borne + b->first_edge;
  memset(borne, 0, b->plan->edges * sizeof *borne);
  SW_ITEMS(const sw_term, t, b->terms, b->term_count) {
    if (t->cls->axial) t->cls->axial(t->args, &b->field, borne);
  }
}

void sw_system_keep_borne(sw_system *s) {
  if (s->borne) memcpy(s->borne + s->edges, s->borne, s->edges * sizeof *s->borne);
}

const double *sw_system_with_borne(const sw_system *s, const sw_body *b, const double *T,
                                   int room) {
  if (!b->bears || !s->borne) return T;
  const double *now = s->borne + b->first_edge, *before = now + s->edges;
  double *sum = s->borne + (2 + (size_t)room) * s->edges + b->first_edge;
  for (size_t e = 0; e < b->plan->edges; e++)
    sum[e] = T[e] + (room == SW_BORNE_MEAN ? 0.5 * (before[e] + now[e]) : now[e]);
  return sum;
}
