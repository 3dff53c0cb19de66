/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decides if bodies are solved one by one, and lists each body's held nodes. */
#include "system/part.h"

#include "system/join.h"

int sw_parts_any(const sw_system *s, const sw_newton *newton) {
  const sw_coupling *c = &s->coupling;
  int any = 0;
  if (s->body_count < 2 || newton->statics) return 0;
  if ((c->eval || c->settled) && !c->part) return 0;
  for (size_t b = 0; b < s->body_count; b++) {
    if (s->bodies[b].plan->web) return 0; /* webs keep their factors from stage to stage */
    any |= !s->bodies[b].coupled;
  }
  return any;
}

void sw_parts_begin(sw_system *s) {
  s->part = 0, s->part_end = s->body_count, s->group = 0;
  for (size_t b = 0; b < s->body_count; b++) s->bodies[b].held = 0, s->bodies[b].coupled = 0;
  sw_joins_mark(s);
  for (size_t i = s->held_count; i-- > 0;) {
    s->held[i].next = s->bodies[s->held[i].body].held;
    s->bodies[s->held[i].body].held = i + 1;
  }
}
