/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pattern of the bridges' sparse matrix: planned pairs, pairs added in a step, and numbers of
 * nodes. */
#include "system/bridge.h"

#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "system/join.h"
#include "system/web.h"

static const uint32_t NONE = UINT32_MAX;

void sw_bridges_free(sw_system *s) {
  struct sw_bridges *l = s->bridges;
  if (!l) return;
  sw_sparse_free(l->matrix);
  sw_sparse_free(l->spare);
  SW_FREE_ALL(l->list, l->pairs, l->known, l->planned, l->taken, l->table, l->number, l->first,
              l->x, l->right, l->spans, l);
  s->bridges = NULL;
}

void sw_bridges_begin(sw_system *s) {
  if (s->bridges) s->bridges->count = 0;
}

int sw_bridges_any(const sw_system *s) { return s->bridges && s->bridges->count > 0; }

static struct sw_bridges *bridges_of(sw_system *s) {
  if (!s->bridges) s->bridges = sw_alloc(1, sizeof *s->bridges);
  return s->bridges;
}

sw_status sw_system_begin_plan(sw_system *s) {
  if (s->bridges) s->bridges->planned_count = 0, s->bridges->anew = 1;
  return sw_joins_plan(s);
}

sw_status sw_system_plan_bridge(sw_system *s, size_t i, size_t j) {
  struct sw_bridges *l = bridges_of(s);
  if (!l) return SW_ENOMEM;
  SW_TRY(SW_GROW(l->planned, l->planned_capacity, l->planned_count + 1));
  l->planned[l->planned_count++] =
      (sw_couple){(uint32_t)(i < j ? i : j), (uint32_t)(i < j ? j : i)};
  return SW_OK;
}

sw_status sw_system_add_bridge(sw_system *s, size_t i, size_t j, const double k[9]) {
  struct sw_bridges *l = bridges_of(s);
  if (!l) return SW_ENOMEM;
  SW_TRY(SW_GROW(l->list, l->capacity, l->count + 1));
  sw_bridge *at = &l->list[l->count++];
  if (i < j) {
    *at = (sw_bridge){(uint32_t)i, (uint32_t)j, {0}, NONE};
    memcpy(at->k, k, sizeof at->k);
  } else {
    *at = (sw_bridge){(uint32_t)j, (uint32_t)i, {0}, NONE};
    for (int r = 0; r < 3; r++)
      for (int c = 0; c < 3; c++) at->k[3 * r + c] = k[3 * c + r];
  }
  return SW_OK;
}

/* --- pattern -------------------------------------------------------------------- */

static size_t hash_of(const struct sw_bridges *l, uint32_t i, uint32_t j) {
  uint64_t h = ((uint64_t)i << 32 | j) * 0x9E3779B97F4A7C15u;
  return (size_t)(h >> 20) & (l->table_size - 1);
}

/* Returns the number of the bridge between nodes i < j in the pattern, or NONE. */
static uint32_t find(const struct sw_bridges *l, uint32_t i, uint32_t j) {
  if (!l->table_size) return NONE;
  for (size_t h = hash_of(l, i, j); l->table[h]; h = (h + 1) & (l->table_size - 1)) {
    const sw_couple *k = &l->known[l->table[h] - 1];
    if (k->i == i && k->j == j) return l->table[h] - 1;
  }
  return NONE;
}

static void enter(struct sw_bridges *l, uint32_t number) {
  const sw_couple *k = &l->known[number];
  size_t h = hash_of(l, k->i, k->j);
  while (l->table[h]) h = (h + 1) & (l->table_size - 1);
  l->table[h] = number + 1;
}

/* Makes a hash table for at least count pairs and enters the known ones. */
static sw_status make_table(struct sw_bridges *l, size_t count) {
  size_t size = 64;
  while (size < 2 * count) size *= 2;
  SW_TRY(SW_GROW(l->table, l->table_capacity, size));
  l->table_size = size;
  memset(l->table, 0, size * sizeof *l->table);
  for (size_t k = 0; k < l->known_count; k++) enter(l, (uint32_t)k);
  return SW_OK;
}

/* Adds a bridge to the pattern if it is new. *number: of its pair there. */
static sw_status add_known(struct sw_bridges *l, uint32_t i, uint32_t j, uint32_t *number) {
  *number = find(l, i, j);
  if (*number != NONE) return SW_OK;
  SW_TRY(SW_GROW(l->known, l->known_capacity, l->known_count + 1));
  if (2 * l->known_count >= l->table_size) SW_TRY(make_table(l, 2 * l->known_count + 1));
  l->known[l->known_count] = (sw_couple){i, j};
  *number = (uint32_t)l->known_count++;
  enter(l, *number);
  return SW_OK;
}

/* Returns to the planned pattern. Drops the pairs added in a step: with them, the next step's
 * rounding would depend on more than the scene's state. */
static sw_status take_plan(struct sw_bridges *l) {
  const size_t n = l->planned_count;
  const int more = l->anew && l->known_count > l->from_plan;
  l->anew = 0;
  if (!more && n == l->taken_count && (!n || !memcmp(l->planned, l->taken, n * sizeof *l->planned)))
    return SW_OK;
  SW_TRY(SW_GROW(l->taken, l->taken_capacity, n));
  if (n) memcpy(l->taken, l->planned, n * sizeof *l->taken);
  l->taken_count = n;
  l->known_count = 0;
  if (l->table_size) memset(l->table, 0, l->table_size * sizeof *l->table);
  uint32_t number;
  for (size_t k = 0; k < n; k++) SW_TRY(add_known(l, l->planned[k].i, l->planned[k].j, &number));
  l->from_plan = l->known_count;
  if (l->matrix) {
    sw_sparse_free(l->spare);
    l->spare = l->matrix;
    l->matrix = NULL;
    sw_sparse_forget_order(l->spare);
  }
  return SW_OK;
}

/* Marks the bodies with bridges and numbers their nodes consecutively. */
static sw_status number_nodes(sw_system *s) {
  struct sw_bridges *l = s->bridges;
  if (!l->number) l->number = sw_alloc(s->nodes, sizeof *l->number);
  if (!l->first) l->first = sw_alloc(s->body_count, sizeof *l->first);
  if (!l->number || !l->first) return SW_ENOMEM;
  for (size_t b = 0; b < s->body_count; b++) s->bodies[b].bridged = 0;
  for (size_t k = 0; k < l->known_count; k++) {
    s->bodies[sw_system_body_of(s, l->known[k].i)].bridged = 1;
    s->bodies[sw_system_body_of(s, l->known[k].j)].bridged = 1;
  }
  l->nodes = 0;
  l->block = 3;
  for (size_t b = 0; b < s->body_count; b++) {
    const sw_body *body = &s->bodies[b];
    l->first[b] = l->nodes;
    if (body->bridged && body->spin_block) l->block = 4;
    for (size_t i = 0; i < body->plan->nodes; i++)
      l->number[body->first_node + i] = body->bridged ? (uint32_t)l->nodes++ : NONE;
  }
  SW_TRY(SW_GROW(l->right, l->right_capacity, l->block * l->nodes));
  return SW_GROW(l->x, l->x_capacity, l->block * l->nodes);
}

/* Lists a web's pairs in the matrix's numbers. */
static size_t list_couples(sw_body *b, size_t first, sw_couple *out) {
  const size_t count = sw_web_couples(b, out);
  for (size_t k = 0; k < count; k++) {
    out[k].i += (uint32_t)first;
    out[k].j += (uint32_t)first;
  }
  b->web_replanned = 0;
  return count;
}

/* Lists all pairs of the matrix: two for each node of a chain, or a web's own pairs; then the
 * bridges. */
static sw_status list_pairs(sw_system *s) {
  struct sw_bridges *l = s->bridges;
  size_t n = 0, room = 2 * l->nodes + l->known_count;
  for (size_t b = 0; b < s->body_count; b++)
    if (s->bodies[b].bridged && s->bodies[b].plan->web) room += sw_web_couples_room(&s->bodies[b]);
  SW_TRY(SW_GROW(l->pairs, l->pair_capacity, room));
  for (size_t b = 0; b < s->body_count; b++) {
    if (!s->bodies[b].bridged) continue;
    const size_t count = s->bodies[b].plan->nodes;
    const uint32_t first = (uint32_t)l->first[b];
    if (s->bodies[b].plan->web) {
      s->bodies[b].web_couples = list_couples(&s->bodies[b], first, l->pairs + n);
      n += s->bodies[b].web_couples;
      continue;
    }
    for (uint32_t i = 0; i + 1 < count; i++) {
      l->pairs[n++] = (sw_couple){first + i, first + i + 1};
      if (i + 2 < count) l->pairs[n++] = (sw_couple){first + i, first + i + 2};
    }
  }
  l->chain_pairs = n;
  for (size_t k = 0; k < l->known_count; k++)
    l->pairs[n++] = (sw_couple){l->number[l->known[k].i], l->number[l->known[k].j]};
  l->pair_count = n;
  return SW_OK;
}

static int replanned(const sw_system *s) {
  for (size_t b = 0; b < s->body_count; b++)
    if (s->bodies[b].bridged && s->bodies[b].web_replanned) return 1;
  return 0;
}

sw_status sw_bridges_prepare(sw_system *s) {
  struct sw_bridges *l = s->bridges;
  SW_TRY(take_plan(l));
  const size_t before = l->known_count;
  SW_ITEMS(sw_bridge, at, l->list, l->count) SW_TRY(add_known(l, at->i, at->j, &at->number));
  if (l->matrix && l->known_count == before && !replanned(s)) return SW_OK;
  sw_sparse *old = l->matrix ? l->matrix : l->spare;
  l->matrix = l->spare = NULL;
  sw_status status = number_nodes(s);
  if (status == SW_OK) status = list_pairs(s);
  if (status == SW_OK)
    status = sw_sparse_new(l->nodes, l->block, l->pairs, l->pair_count, old, &l->matrix);
  sw_sparse_free(old);
  return status;
}
