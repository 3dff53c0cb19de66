/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of joins: their bridges, and the bodies that they couple. */
#include "system/join.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "solve/band3.h"
#include "state/tie.h"
#include "system/hub.h"
#include "system/part.h"

void sw_joins_free(sw_system *s) {
  if (!s->joins) return;
  SW_FREE_ALL(s->joins->springs, s->joins->hubs, s->joins->places, s->joins->links,
              s->joins->twisted, s->joins->number, s->joins->give, s->joins);
  s->joins = NULL;
}

static struct sw_joins *joins_of(sw_system *s) {
  if (!s->joins) s->joins = sw_alloc(1, sizeof *s->joins);
  return s->joins;
}

/* --- plan ------------------------------------------------------------------------ */

static sw_status plan(sw_system *s, uint32_t i, uint32_t j) {
  const uint32_t low = i < j ? i : j, high = i < j ? j : i;
  return sw_join_in_band(s, low, high) ? SW_OK : sw_system_plan_bridge(s, low, high);
}

static sw_status plan_hub(sw_system *s, const sw_join_hub *h) {
  for (size_t a = 0; a < h->count; a++)
    for (size_t b = a + 1; b < h->count; b++) {
      SW_TRY(plan(s, h->arms[a].from, h->arms[b].from));
      SW_TRY(plan(s, h->arms[a].from, h->arms[b].to));
      SW_TRY(plan(s, h->arms[a].to, h->arms[b].from));
      SW_TRY(plan(s, h->arms[a].to, h->arms[b].to));
    }
  return SW_OK;
}

sw_status sw_joins_plan(sw_system *s) {
  const struct sw_joins *all = s->joins;
  for (size_t k = 0; all && k < all->spring_count; k++)
    SW_TRY(plan(s, all->springs[k].i, all->springs[k].j));
  for (size_t k = 0; all && k < all->hub_count; k++) SW_TRY(plan_hub(s, &all->hubs[k]));
  return SW_OK;
}

sw_status sw_system_add_spring(sw_system *s, const sw_join_spring *spring) {
  struct sw_joins *all = joins_of(s);
  if (!all) return SW_ENOMEM;
  SW_TRY(SW_GROW(all->springs, all->spring_capacity, all->spring_count + 1));
  all->springs[all->spring_count++] = *spring;
  return plan(s, spring->i, spring->j);
}

sw_status sw_system_add_hub(sw_system *s, const sw_join_hub *hub) {
  struct sw_joins *all = joins_of(s);
  if (!all) return SW_ENOMEM;
  SW_TRY(SW_GROW(all->hubs, all->hub_capacity, all->hub_count + 1));
  all->hubs[all->hub_count++] = *hub;
  return plan_hub(s, hub);
}

/* --- bodies ----------------------------------------------------------------------- */

static void mark(sw_system *s, uint32_t node) {
  sw_body *b = &s->bodies[sw_system_body_of(s, node)];
  if (!b->waits) b->coupled |= SW_JOINED;
}

void sw_joins_mark(sw_system *s) {
  const struct sw_joins *l = s->joins;
  if (!l) return;
  for (size_t k = 0; k < l->spring_count; k++) mark(s, l->springs[k].i), mark(s, l->springs[k].j);
  for (size_t k = 0; k < l->hub_count; k++)
    for (size_t a = 0; a < l->hubs[k].count; a++) mark(s, l->hubs[k].arms[a].from);
}

/* Wakes the body at node `other` if that at `node` is awake. Returns 1 if it did. */
static int wake(sw_system *s, uint32_t node, uint32_t other) {
  sw_body *b = &s->bodies[sw_system_body_of(s, other)];
  if (!b->waits || s->bodies[sw_system_body_of(s, node)].waits) return 0;
  b->waits = 0;
  return 1;
}

static int wake_once(sw_system *s) {
  const struct sw_joins *all = s->joins;
  int any = 0;
  SW_ITEMS(const sw_join_spring, p, all->springs, all->spring_count) {
    any |= wake(s, p->i, p->j) | wake(s, p->j, p->i);
  }
  SW_ITEMS(const sw_join_hub, h, all->hubs, all->hub_count) {
    for (size_t a = 0; a < h->count * h->count; a++)
      any |= wake(s, h->arms[a / h->count].from, h->arms[a % h->count].from);
  }
  return any;
}

int sw_joins_wake(sw_system *s) {
  int any = 0;
  while (s->joins && wake_once(s)) any = 1;
  return any;
}
