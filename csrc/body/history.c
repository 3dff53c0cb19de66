/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Carries the histories of forces over a change of the system: clamps put on and taken off, nodes
 * moved and inserted, other forces made. */
#include "body/history.h"

#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "force/solid.h"
#include "mutual/mutual.h"
#include "scene/forces.h"
#include "scene/lists.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "state/state_tape.h"
#include "system/system.h"

void sw_scene_forget_histories(sw_scene *s) {
  sw_histories *kept = sw_scene_histories_of(s);
  for (size_t k = 0; k < kept->count; k++) {
    sw_plan_release(kept->list[k].plan);
    sw_free(kept->list[k].data);
  }
  sw_free(kept->list);
  kept->list = NULL;
  kept->count = 0;
}

static sw_status keep(sw_scene *s, size_t wire, const sw_term *term, sw_kept_history *out) {
  sw_plan *plan = sw_scene_system(s)->bodies[wire].plan;
  const size_t size = term->cls->state_size(plan);
  double *data = sw_alloc(size, sizeof *data);
  if (!data) return SW_ENOMEM;
  memcpy(data, term->history, size * sizeof *data);
  *out =
      (sw_kept_history){.force = (size_t)term->id,
                        .wire = wire,
                        .inner = term->id < 0 ? term->cls : NULL,
                        .generation = term->id < 0 ? 0 : sw_scene_force_in(s, term->id)->generation,
                        .plan = sw_plan_retain(plan),
                        .data = data};
  return SW_OK;
}

sw_status sw_scene_keep_histories(sw_scene *s) {
  sw_histories *kept = sw_scene_histories_of(s);
  sw_system *system = sw_scene_system(s);
  size_t count = 0;
  sw_scene_forget_histories(s);
  for (size_t b = 0; b < system->body_count; b++)
    for (size_t k = 0; k < system->bodies[b].term_count; k++)
      count += system->bodies[b].terms[k].history != NULL;
  if (!count) return SW_OK;
  kept->list = sw_alloc(count, sizeof *kept->list);
  if (!kept->list) return SW_ENOMEM;
  for (size_t b = 0; b < system->body_count; b++)
    SW_ITEMS(const sw_term, term, system->bodies[b].terms, system->bodies[b].term_count) {
      if (!term->history) continue;
      SW_TRY(keep(s, b, term, &kept->list[kept->count]));
      kept->count++;
    }
  return SW_OK;
}

static const sw_kept_history *find(const sw_scene *s, size_t wire, const sw_term *term) {
  sw_histories *kept = sw_scene_histories_of(s);
  SW_ITEMS(const sw_kept_history, h, kept->list, kept->count) {
    if (h->wire != wire || (long)h->force != term->id) continue;
    if (term->id < 0 ? h->inner == term->cls
                     : h->generation == sw_scene_force_in(s, term->id)->generation)
      return h;
  }
  return NULL;
}

static int any_begins(const sw_scene *s) {
  sw_system *system = sw_scene_system(s);
  for (size_t b = 0; b < system->body_count; b++)
    for (size_t k = 0; k < system->bodies[b].term_count; k++)
      if (system->bodies[b].terms[k].cls->begin) return 1;
  return 0;
}

void sw_scene_inherit_histories(sw_scene *s) {
  sw_system *system = sw_scene_system(s);
  if (!sw_scene_histories_of(s)->count && !any_begins(s)) return;
  sw_system_refresh(system);
  for (size_t b = 0; b < system->body_count; b++)
    SW_ITEMS(const sw_term, term, system->bodies[b].terms, system->bodies[b].term_count) {
      if (!term->history) continue;
      const sw_kept_history *old = find(s, b, term);
      const sw_field *field = &system->bodies[b].field;
      if (old)
        term->cls->inherit(old->plan, old->data, field, term->history);
      else if (term->cls->begin)
        term->cls->begin(term->args, field, term->history);
    }
}

/* --- on a tape, with contact's memory ---------------------------------------------------- */

void sw_tape_kept_contact(sw_tape *t, sw_scene *s) {
  sw_kept_contact *kept = sw_scene_kept(s);
  int there = !sw_tape_reads(t) && kept->memory != NULL;
  sw_tape_int(t, &there);
  if (!there) return;
  sw_tape_mark(t, "contact", sw_contact_layout());
  sw_tape_mark(t, "contact of wires", sw_mutual_layout());
  sw_tape_count(t, &kept->bytes, 1), sw_tape_count(t, &kept->pair_bytes, 1);
  sw_tape_array(t, &kept->memory, kept->bytes, 1);
  sw_tape_array(t, &kept->pairs, kept->pair_bytes, 1);
  sw_tape_mark(t, "contact of particles", sw_mutual_layout());
  sw_tape_count(t, &kept->grain_bytes, 1);
  sw_tape_array(t, &kept->grains, kept->grain_bytes, 1);
  sw_tape_count(t, &kept->wires, sizeof *kept->first);
  SW_TAPE_ARRAY(t, kept->first, kept->wires + 1);
  SW_TAPE_ARRAY(t, kept->now, kept->wires);
  const size_t expected = kept->first ? kept->first[kept->wires] : 0;
  size_t nodes = expected;
  sw_tape_count(t, &nodes, sizeof *kept->s);
  sw_tape_expect(t, nodes == expected, "contact");
  SW_TAPE_ARRAY(t, kept->s, nodes);
  sw_tape_int(t, &kept->fresh), sw_tape_size(t, &kept->changed);
}

/* 1 if a force of this class may have a history for the plan and give it to the wire's next one. */
static int remembers(const sw_force_class *cls, const sw_plan *plan, const sw_scene_wire *w) {
  if (!cls->state_size || (cls->applies && !cls->applies(plan))) return 0;
  if (!(cls->flags & SW_FORCE_OF_WEB)) return 1;
  return plan->web && w->strand.web && plan->web->links == w->strand.web->links;
}

void sw_tape_kept_history(sw_tape *t, sw_scene *s, sw_kept_history *x) {
  char word[SW_NAME_SIZE];
  SW_TAPE_STRUCT(t, sw_kept_history, 48);
  sw_tape_size(t, &x->force), sw_tape_size(t, &x->wire), sw_tape_uint32(t, &x->generation);
  const char *inner = sw_tape_word(t, !sw_tape_reads(t) && x->inner ? x->inner->name : NULL, word);
  if (sw_tape_reads(t)) x->inner = inner[0] ? sw_force_find(inner) : NULL;
  sw_tape_expect(t, x->wire < sw_scene_wire_slots(s) && (x->inner || !inner[0]),
                 "what a force remembers");
  sw_tape_expect(t, x->inner || x->force < sw_scene_force_slots(s), "what a force remembers");
  if (!sw_tape_good(t)) return;
  sw_tape_plan(t, &x->plan, sw_scene_wire_in(s, x->wire)->strand.web, sizeof(sw_solid));
  if (!sw_tape_good(t)) return;
  const sw_force_class *cls = x->inner ? x->inner : sw_scene_force_in(s, x->force)->cls;
  sw_tape_expect(t, remembers(cls, x->plan, sw_scene_wire_in(s, x->wire)),
                 "what a force remembers");
  if (!sw_tape_good(t)) return;
  size_t count = cls->state_size(x->plan);
  const size_t expected = count;
  sw_tape_count(t, &count, sizeof *x->data);
  sw_tape_expect(t, count == expected, "what a force remembers");
  SW_TAPE_ARRAY(t, x->data, count);
}
