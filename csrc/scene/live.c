/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a built scene has besides its objects: the state of the system, of contact and of the
 * stepper. Put back into a scene built of the same objects it gives the same bits. */
#include <string.h>

#include "base/alloc.h"
#include "scene/world.h"

static sw_status copy_block(const void *from, size_t bytes, void *to_pointer) {
  void *copy = sw_alloc(bytes, 1);
  if (!copy) return SW_ENOMEM;
  if (bytes) memcpy(copy, from, bytes);
  *(void **)to_pointer = copy;
  return SW_OK;
}

sw_status sw_live_take(const sw_scene *s, sw_live *p) {
  p->state_size = s->system.state_size;
  SW_TRY(copy_block(s->system.state, p->state_size * sizeof(double), &p->state));
  if (s->contact) {
    p->fresh = sw_contact_is_fresh(s->contact);
    const void *memory = sw_contact_memory(s->contact, &p->memory_size);
    SW_TRY(copy_block(memory, p->memory_size, &p->memory));
    const void *seen = sw_contact_seen(s->contact, &p->seen_size[0]);
    SW_TRY(copy_block(seen, p->seen_size[0], &p->seen[0]));
  }
  if (s->pairs) {
    const void *memory = sw_pairs_memory(s->pairs, &p->pairs_size);
    SW_TRY(copy_block(memory, p->pairs_size, &p->pairs));
    const void *seen[2];
    sw_pairs_seen(s->pairs, seen, p->seen_size + 1);
    for (size_t k = 0; k < 2; k++)
      SW_TRY(copy_block(seen[k], p->seen_size[k + 1], &p->seen[k + 1]));
  }
  if (s->grains) {
    const void *memory = sw_grains_memory(s->grains, &p->grains_size);
    SW_TRY(copy_block(memory, p->grains_size, &p->grains));
  }
  if (!s->has_stepper) return SW_OK;
  p->method = s->method;
  p->last_h = s->stepper.last_h;
  p->restart = s->stepper.restart;
  if (!(s->method->flags & SW_INTEGRATOR_HISTORY)) return SW_OK;
  p->history_size = sw_stepper_history(&s->stepper, &s->system);
  return copy_block(s->stepper.xp, p->history_size * sizeof(double), &p->history);
}

static sw_status put_contact(sw_scene *s, const sw_live *p) {
  if (s->contact) {
    SW_TRY(sw_contact_set_memory(s->contact, p->memory, p->memory_size, p->fresh));
    SW_TRY(sw_contact_set_seen(s->contact, p->seen[0], p->seen_size[0], s->system.nodes));
  }
  if (s->grains) SW_TRY(sw_grains_set_memory(s->grains, p->grains, p->grains_size));
  if (!s->pairs) return SW_OK;
  const void *const seen[2] = {p->seen[1], p->seen[2]};
  SW_TRY(sw_pairs_set_memory(s->pairs, p->pairs, p->pairs_size));
  return sw_pairs_set_seen(s->pairs, seen, p->seen_size + 1, &s->system);
}

sw_status sw_live_put(sw_scene *s, const sw_live *p, sw_error *err) {
  memcpy(s->system.state, p->state, p->state_size * sizeof(double));
  const sw_status status = put_contact(s, p);
  if (status == SW_EINVAL)
    return sw_fail(err, SW_EFORMAT, "its contact does not go with its objects");
  SW_TRY(status);
  if (p->method && (!s->has_stepper || s->method != p->method)) {
    sw_stepper_free(&s->stepper);
    s->has_stepper = 0;
    SW_TRY(sw_stepper_new(&s->stepper, p->method, &s->system));
    s->has_stepper = 1;
    s->method = p->method;
  }
  if (p->method) {
    s->stepper.last_h = p->last_h;
    s->stepper.restart = p->restart;
    if (p->history) memcpy(s->stepper.xp, p->history, p->history_size * sizeof(double));
  } else if (s->has_stepper) { /* taken before the first run */
    sw_stepper_free(&s->stepper);
    s->has_stepper = 0;
    s->method = NULL;
  }
  return sw_system_place_holds(&s->system, s->time, NULL, NULL, NULL, err);
}

static int grains_fit(const sw_scene *s, const sw_live *p) {
  const size_t n = s->system.body_count;
  if (!p->grains_size) return 1;
  size_t *first = sw_alloc(n + 1, sizeof *first);
  if (!first) return 0;
  for (size_t b = 0; b < n; b++) first[b] = s->system.bodies[b].first_node;
  first[n] = s->system.nodes;
  const int fits = sw_grains_memory_fits(p->grains, p->grains_size, first, n);
  sw_free(first);
  return fits;
}

int sw_live_fits(const sw_scene *s, const sw_live *p) {
  const size_t n = 2 * s->system.freedoms + (s->system.strain ? s->system.edges : 0);
  const int history = p->method && (p->method->flags & SW_INTEGRATOR_HISTORY);
  return p->state_size == s->system.state_size && p->history_size == (history ? n : 0) &&
         sw_contact_memory_fits(p->memory, p->memory_size, s->system.nodes, s->obstacle_count) &&
         sw_pairs_memory_fits(p->pairs, p->pairs_size, s->system.nodes) && grains_fit(s, p);
}

void sw_live_free(sw_live *p) {
  sw_free(p->state);
  sw_free(p->history);
  sw_free(p->memory);
  sw_free(p->pairs);
  sw_free(p->grains);
  for (size_t k = 0; k < 3; k++) sw_free(p->seen[k]);
  memset(p, 0, sizeof *p);
}
