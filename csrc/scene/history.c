/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What forces remember outlives a change of the system: clamps put on and taken
 * off, nodes moved and inserted, other forces made. */
#include <string.h>

#include "base/alloc.h"
#include "scene/world.h"

void sw_scene_forget_histories(sw_scene *s) {
  for (size_t k = 0; k < s->kept_history_count; k++) {
    sw_plan_release(s->kept_histories[k].plan);
    sw_free(s->kept_histories[k].data);
  }
  sw_free(s->kept_histories);
  s->kept_histories = NULL;
  s->kept_history_count = 0;
}

static sw_status keep(sw_scene *s, size_t wire, const sw_term *term, sw_kept_history *out) {
  sw_plan *plan = s->system.bodies[wire].plan;
  const size_t size = term->cls->state_size(plan);
  double *data = sw_alloc(size, sizeof *data);
  if (!data) return SW_ENOMEM;
  memcpy(data, term->history, size * sizeof *data);
  *out = (sw_kept_history){.force = (size_t)term->id,
                           .wire = wire,
                           .inner = term->id < 0 ? term->cls : NULL,
                           .generation = term->id < 0 ? 0 : s->forces[term->id].generation,
                           .plan = sw_plan_retain(plan),
                           .data = data};
  return SW_OK;
}

sw_status sw_scene_keep_histories(sw_scene *s) {
  size_t count = 0;
  sw_scene_forget_histories(s);
  for (size_t b = 0; b < s->system.body_count; b++)
    for (size_t k = 0; k < s->system.bodies[b].term_count; k++)
      count += s->system.bodies[b].terms[k].history != NULL;
  if (!count) return SW_OK;
  s->kept_histories = sw_alloc(count, sizeof *s->kept_histories);
  if (!s->kept_histories) return SW_ENOMEM;
  for (size_t b = 0; b < s->system.body_count; b++)
    for (size_t k = 0; k < s->system.bodies[b].term_count; k++) {
      const sw_term *term = &s->system.bodies[b].terms[k];
      if (!term->history) continue;
      SW_TRY(keep(s, b, term, &s->kept_histories[s->kept_history_count]));
      s->kept_history_count++;
    }
  return SW_OK;
}

static const sw_kept_history *find(const sw_scene *s, size_t wire, const sw_term *term) {
  for (size_t k = 0; k < s->kept_history_count; k++) {
    const sw_kept_history *h = &s->kept_histories[k];
    if (h->wire != wire || (long)h->force != term->id) continue;
    if (term->id < 0 ? h->inner == term->cls : h->generation == s->forces[term->id].generation)
      return h;
  }
  return NULL;
}

static int any_begins(const sw_scene *s) {
  for (size_t b = 0; b < s->system.body_count; b++)
    for (size_t k = 0; k < s->system.bodies[b].term_count; k++)
      if (s->system.bodies[b].terms[k].cls->begin) return 1;
  return 0;
}

void sw_scene_inherit_histories(sw_scene *s) {
  if (!s->kept_history_count && !any_begins(s)) return;
  sw_system_refresh(&s->system);
  for (size_t b = 0; b < s->system.body_count; b++)
    for (size_t k = 0; k < s->system.bodies[b].term_count; k++) {
      const sw_term *term = &s->system.bodies[b].terms[k];
      if (!term->history) continue;
      const sw_kept_history *old = find(s, b, term);
      const sw_field *field = &s->system.bodies[b].field;
      if (old)
        term->cls->inherit(old->plan, old->data, field, term->history);
      else if (term->cls->begin)
        term->cls->begin(term->args, field, term->history);
    }
}
