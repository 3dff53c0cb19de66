/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A table of joined particles: for each particle its partners, in order. */
#include "mutual/joined.h"

#include <stdlib.h>

#include "base/alloc.h"
#include "base/couple.h"
#include "base/halving.h"

static size_t put(sw_couple *out, size_t n, uint32_t a, uint32_t b) {
  if (out) out[n] = (sw_couple){a, b}, out[n + 1] = (sw_couple){b, a};
  return n + 2;
}

/* Lists all joined pairs, in both orders, in out (may be NULL). Returns their number. */
static size_t list(const sw_web *w, sw_couple *out) {
  size_t n = 0;
  for (size_t e = 0; e < w->links; e++) n = put(out, n, w->link[e].a, w->link[e].b);
  for (size_t k = 0; k < w->folds; k++) {
    const sw_web_fold *f = &w->fold[k];
    n = put(out, n, f->a, f->b);
    n = put(out, n, f->b, f->c);
    n = put(out, n, f->a, f->c);
  }
  for (size_t k = 0; k < w->solids; k++)
    for (uint32_t i = 1; i < w->solid[k].count; i++)
      for (uint32_t j = 0; j < i; j++) n = put(out, n, w->solid[k].node[j], w->solid[k].node[i]);
  return n;
}

sw_status sw_joined_new(const sw_web *w, sw_joined *out) {
  const size_t n = list(w, NULL);
  sw_couple *all = sw_alloc(n, sizeof *all);
  *out = (sw_joined){.first = sw_alloc(w->particles + 1, sizeof *out->first),
                     .partner = sw_alloc(n, sizeof *out->partner)};
  if (!all || !out->first || !out->partner) {
    sw_free(all);
    return SW_ENOMEM;
  }
  list(w, all);
  if (n) qsort(all, n, sizeof *all, sw_couple_order);
  size_t at = 0;
  for (size_t p = 0; p < w->particles; p++) {
    out->first[p] = at;
    for (; at < n && all[at].i == p; at++) out->partner[at] = all[at].j;
  }
  out->first[w->particles] = at;
  sw_free(all);
  return SW_OK;
}

void sw_joined_free(sw_joined *j) {
  sw_free(j->first);
  sw_free(j->partner);
  *j = (sw_joined){NULL, NULL};
}

int sw_joined_are(const sw_joined *j, uint32_t a, uint32_t b) {
  const size_t end = j->first[a + 1];
  size_t i;
  SW_FIRST_NOT(j->partner[i] < b, i, j->first[a], end);
  return i < end && j->partner[i] == b;
}

int sw_joined_nearly(const sw_joined *j, uint32_t a, uint32_t b) {
  if (sw_joined_are(j, a, b)) return 1;
  for (size_t i = j->first[a]; i < j->first[a + 1]; i++)
    if (sw_joined_are(j, j->partner[i], b)) return 1;
  return 0;
}
