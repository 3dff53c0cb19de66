/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hands the contact memory of the last built system over to the next one. */
#include <stdint.h>

#include "base/alloc.h"
#include "body/body.h"
#include "body/build.h"
#include "body/touching.h"
#include "contact/resample.h"
#include "mutual/resample.h"
#include "scene/lists.h"
#include "scene/parts.h"
#include "scene/wire.h"

/* Finds the present nodes of wire w's nodes in the contact memory, and of its segments, by their
 * first nodes. */
static void find_again(const sw_scene *s, size_t w, size_t *new_node, size_t *new_edge) {
  const sw_kept_contact *kept = sw_scene_kept(s);
  const size_t first = kept->first[w], end = kept->first[w + 1], now = kept->now[w];
  for (size_t k = first; k < end; k++) new_node[k] = new_edge[k] = SIZE_MAX;
  if (now == SIZE_MAX || kept->changed == w + 1) return;
  sw_body_class_of(sw_scene_wire_in(s, now))
      ->carry_over(&sw_scene_system(s)->bodies[now], kept->s + first, end - first, new_node + first,
                   new_edge + first);
}

/* 1 if wire w of the contact memory is a line that has got other nodes. Feeding makes nodes in its
 * hold, and none of those that touch something are others; an edit of a wire that is fed may. */
static int is_changed(const sw_scene *s, size_t w, const size_t *new_node) {
  const sw_kept_contact *k = sw_scene_kept(s);
  if (k->now[w] == SIZE_MAX) return 0;
  const sw_body *b = &sw_scene_system(s)->bodies[k->now[w]];
  if (b->plan->web) return 0;
  if (k->changed == w + 1) return 1;
  if (k->fed) return 0;
  int changed = b->plan->nodes != k->first[w + 1] - k->first[w];
  for (size_t i = k->first[w]; i < k->first[w + 1] && !changed; i++)
    changed = new_node[i] == SIZE_MAX;
  return changed;
}

/* Lines that have got other edges: their touches with obstacles go on as they were. */
static sw_status keep_touches(sw_scene *s, const size_t *new_node) {
  const sw_kept_contact *k = sw_scene_kept(s);
  const sw_system *system = sw_scene_system(s);
  sw_contact *c = sw_scene_contact(s);
  for (size_t w = 0; w < k->wires; w++) {
    if (!is_changed(s, w, new_node)) continue;
    const sw_body *b = &system->bodies[k->now[w]];
    const size_t first = k->first[w];
    const sw_former former = {.memory = k->memory,
                              .bytes = k->bytes,
                              .first = first,
                              .nodes = k->first[w + 1] - first,
                              .s = k->s + first,
                              .new_node = new_node};
    SW_TRY(sw_contact_resample(c, system, k->now[w], &former));
    sw_contact_keep_depth(c, b->first_node, b->first_node + b->plan->nodes);
  }
  return SW_OK;
}

/* The same of touches of wires with each other. */
static sw_status inherit_pairs(sw_scene *s, sw_mutual *pairs, const size_t *new_node) {
  const sw_kept_contact *k = sw_scene_kept(s);
  char *changed SW_LOCAL = sw_alloc(k->wires + 1, 1);
  int any = 0;
  if (!changed) return SW_ENOMEM;
  for (size_t w = 0; w < k->wires; w++) any |= changed[w] = (char)is_changed(s, w, new_node);
  const sw_pairs_former former = {
      .s = k->s, .first = k->first, .now = k->now, .changed = changed, .wires = k->wires};
  return sw_mutual_inherit(pairs, sw_scene_system(s), k->pairs, k->pair_bytes, new_node, k->now,
                           any ? &former : NULL);
}

sw_status sw_scene_inherit_contact(sw_scene *s) {
  const sw_kept_contact *k = sw_scene_kept(s);
  sw_mutual *pairs = sw_scene_pairs(s), *grains = sw_scene_grains(s);
  if (!sw_scene_has_contact(s) || !k->memory) return SW_OK;
  const size_t old_nodes = k->first[k->wires];
  size_t *new_node SW_LOCAL = sw_alloc(2 * old_nodes, sizeof *new_node);
  if (!new_node) return SW_ENOMEM;
  size_t *new_edge = new_node + old_nodes;
  for (size_t w = 0; w < k->wires; w++) find_again(s, w, new_node, new_edge);
  if (sw_scene_contact(s)) {
    SW_TRY(
        sw_contact_inherit(sw_scene_contact(s), k->memory, k->bytes, k->fresh, new_node, new_edge));
    SW_TRY(keep_touches(s, new_node));
  }
  if (pairs) SW_TRY(inherit_pairs(s, pairs, new_node));
  if (!grains) return SW_OK;
  return sw_mutual_inherit(grains, sw_scene_system(s), k->grains, k->grain_bytes, new_node, k->now,
                           NULL);
}

int sw_scene_was_pressed(const sw_scene *s, size_t obstacle) {
  const sw_kept_contact *k = sw_scene_kept(s);
  const sw_contact *c = sw_scene_contact(s);
  if (c) {
    size_t bytes;
    const void *memory = sw_contact_memory(c, &bytes);
    return sw_contact_memory_presses(memory, bytes, (int)obstacle, 0, SIZE_MAX);
  }
  for (size_t w = 0; k->memory && w < k->wires; w++)
    if (k->now[w] != SIZE_MAX &&
        sw_contact_memory_presses(k->memory, k->bytes, (int)obstacle, k->first[w], k->first[w + 1]))
      return 1;
  return 0;
}
