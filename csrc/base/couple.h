/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pairs of numbers, and their order for qsort. */
#ifndef SW_BASE_COUPLE_H
#define SW_BASE_COUPLE_H

#include <stdint.h>

typedef struct sw_couple {
  uint32_t i, j;
} sw_couple;

static inline int sw_couple_order(const void *left, const void *right) {
  const sw_couple *p = left, *q = right;
  if (p->i != q->i) return p->i < q->i ? -1 : 1;
  return p->j < q->j ? -1 : p->j > q->j;
}

#endif
