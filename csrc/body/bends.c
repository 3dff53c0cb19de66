/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bends beside holds of a wire that gets other edges. All free nodes lie k h^2/12 further from a
 * clamp's tangent than the axis (state/near.c), with their own edges h. Where edges become longer
 * or shorter, nodes beside a clamp that does not move must lie elsewhere, too. */
#include "body/bends.h"

#include <math.h>

#include "base/alloc.h"
#include "base/each.h"
#include "body/join.h"
#include "link/hold.h"
#include "scene/parts.h"
#include "scene/wire.h"

static int clamps(const sw_hold *h, size_t wire) {
  return h->alive && h->wire == wire && h->cls->hold->direction && !sw_hold_passes(h) && !h->formed;
}

/* Returns the places that holds and joins need as nodes, to be freed; NULL: out of memory [m]. */
static double *kept_places(const sw_scene *s, size_t wire, size_t *count) {
  const size_t joins = sw_scene_join_places(s, wire, NULL);
  double *out = sw_alloc(2 * sw_scene_hold_slots(s) + joins + 1, sizeof *out);
  *count = 0;
  if (!out) return NULL;
  SW_EACH(hold, h, s) {
    if (h->alive && h->wire == wire) out[(*count)++] = h->s1, out[(*count)++] = h->s2;
  }
  *count += sw_scene_join_places(s, wire, out + *count);
  return out;
}

static sw_vec leaving(const sw_hold *h, int side) {
  return sw_scale(sw_rotate(h->turn, h->director[side > 0]), side);
}

/* Returns the longest edge between nodes, for as many edges as bends were read on this side [m]. */
static double longest_of(const sw_mesh_bends *b) {
  double longest = 0;
  for (size_t k = 1; k < b->count; k++) longest = fmax(longest, fabs(b->s[k] - b->s[k - 1]));
  return longest;
}

sw_status sw_scene_keep_bends(const sw_scene *s, size_t wire, sw_wire_bends *out) {
  const sw_mesh *m = &sw_scene_wire_in((sw_scene *)s, wire)->mesh;
  size_t count;
  double *keep SW_LOCAL = kept_places(s, wire, &count);
  *out = (sw_wire_bends){sw_alloc(2 * sw_scene_hold_slots(s) + 1, sizeof *out->list), 0};
  if (!keep || !out->list) return SW_ENOMEM;
  for (size_t k = 0; k < sw_scene_hold_slots(s); k++) {
    const sw_hold *h = sw_scene_hold_in((sw_scene *)s, k);
    for (int side = -1; side < 2 && clamps(h, wire); side += 2) {
      sw_side_bends *b = &out->list[out->count];
      const double at = side > 0 ? h->s2 : h->s1;
      if (!sw_mesh_read_bends(m, sw_mesh_node(m, at), side, leaving(h, side), at, keep, count,
                              &b->bends))
        continue;
      b->hold = k, b->side = side, b->longest = longest_of(&b->bends);
      out->count++;
    }
  }
  return SW_OK;
}

sw_status sw_scene_give_bends(const sw_scene *s, size_t wire, const sw_wire_bends *bends,
                              sw_mesh *m) {
  size_t count;
  double *keep SW_LOCAL = kept_places(s, wire, &count);
  if (!keep) return SW_ENOMEM;
  SW_ITEMS(const sw_side_bends, b, bends->list, bends->count) {
    const sw_hold *h = sw_scene_hold_in((sw_scene *)s, b->hold);
    if (!clamps(h, wire)) continue;
    const size_t from = sw_mesh_node(m, b->side > 0 ? h->s2 : h->s1);
    SW_TRY(
        sw_mesh_leave(m, from, b->side, leaving(h, b->side), &b->bends, b->longest, keep, count));
  }
  return SW_OK;
}
