/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elimination order and supernodes by CHOLMOD. */
#include "solve/cholmod_adapter.h"

#include <string.h>
#include <suitesparse/cholmod.h>

#include "base/alloc.h"

static sw_status status_of(const cholmod_common *common) {
  switch (common->status) {
    case CHOLMOD_OUT_OF_MEMORY: return SW_ENOMEM;
    case CHOLMOD_TOO_LARGE: return SW_ELIMIT;
    default: return common->status < CHOLMOD_OK ? SW_EINVAL : SW_OK;
  }
}

/* CHOLMOD tries minimum degree first, then nested dissection if that fills a lot. */
static sw_status analyse(size_t nodes, const uint32_t *first, const uint32_t *column,
                         const int32_t *order, cholmod_common *common, cholmod_factor **out) {
  const size_t blocks = first[nodes];
  cholmod_sparse *graph =
      cholmod_allocate_sparse(nodes, nodes, blocks, 1, 1, 1, CHOLMOD_PATTERN, common);
  if (!graph) return SW_ENOMEM;
  int *start = graph->p, *row = graph->i;
  for (size_t i = 0; i <= nodes; i++) start[i] = (int)first[i];
  for (size_t k = 0; k < blocks; k++) row[k] = (int)column[k];
  int *given = order ? cholmod_malloc(nodes, sizeof *given, common) : NULL;
  if (given) memcpy(given, order, nodes * sizeof *given);
  if (order) common->nmethods = 1, common->method[0].ordering = CHOLMOD_GIVEN;
  if (!order || given) *out = cholmod_analyze_p(graph, given, NULL, 0, common);
  if (given) cholmod_free(nodes, sizeof *given, given, common);
  cholmod_free_sparse(&graph, common);
  const sw_status status = status_of(common);
  return status == SW_OK && !*out ? SW_ENOMEM : status;
}

static uint32_t *copy(const void *from, size_t count) {
  const int *list = from;
  uint32_t *to = sw_alloc(count, sizeof *to);
  for (size_t k = 0; to && k < count; k++) to[k] = (uint32_t)list[k];
  return to;
}

void sw_cholmod_free_plan(sw_cholmod_plan *plan) {
  SW_FREE_ALL(plan->order, plan->pivot, plan->start, plan->row);
}

sw_status sw_cholmod_analyse(size_t nodes, const uint32_t *first, const uint32_t *column,
                             const int32_t *order, sw_cholmod_plan *plan) {
  cholmod_common common;
  cholmod_factor *factor = NULL;
  cholmod_start(&common);
  common.print = 0;
  common.metis_memory = 2.0; /* allocated on trial before METIS runs, which may end the process */
  common.supernodal = CHOLMOD_SUPERNODAL;
  sw_status status = analyse(nodes, first, column, order, &common, &factor);
  if (status == SW_OK) {
    plan->fronts = factor->nsuper;
    plan->order = copy(factor->Perm, nodes);
    plan->pivot = copy(factor->super, factor->nsuper + 1);
    plan->start = copy(factor->pi, factor->nsuper + 1);
    plan->row = copy(factor->s, factor->ssize);
    if (!plan->order || !plan->pivot || !plan->start || !plan->row) status = SW_ENOMEM;
    if (status != SW_OK) sw_cholmod_free_plan(plan);
  }
  cholmod_free_factor(&factor, &common);
  cholmod_finish(&common);
  return status;
}
