/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lays out the state's arrays in one block, and lengthens the block. */
#include "system/arrays.h"

#include <string.h>

#include "base/alloc.h"
#include "base/halving.h"

size_t sw_system_body_of(const sw_system *s, size_t node) {
  size_t after;
  SW_FIRST_NOT(s->bodies[after].first_node <= node, after, 1, s->body_count);
  return after - 1;
}

void sw_system_lay_out(sw_system *s) {
  s->x = s->state;
  s->v = s->x + s->freedoms;
  s->a = s->v + s->freedoms;
  s->tension = s->a + s->freedoms;
  s->twist = s->tension + s->edges;
  s->turn = s->twist + s->span_count;
  s->frames = s->turn + 4 * s->hold_count;
}

sw_status sw_system_grow_state(sw_system *s, size_t more, double **added) {
  double *state = sw_alloc(s->state_size + more, sizeof *state); /* zeros */
  if (!state) return SW_ENOMEM;
  memcpy(state, s->state, s->state_size * sizeof *state);
  if (s->strain)
    s->strain = state + (s->strain - s->state), s->strain_rate = s->strain + s->strains;
  if (s->even) {
    s->even = state + (s->even - s->state);
    s->between = s->even + s->edges, s->turning = s->between + s->edges;
  }
  sw_free(s->state);
  s->state = state;
  *added = state + s->state_size;
  s->state_size += more;
  sw_system_lay_out(s);
  return SW_OK;
}
