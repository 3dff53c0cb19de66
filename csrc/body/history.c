/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What forces remember outlives a change of the system: clamps put on and taken
 * off, nodes moved and inserted, other forces made. */
#include "body/history.h"

#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "contact/mutual.h"
#include "force/solid.h"
#include "scene/forces.h"
#include "scene/wire.h"
#include "scene/world.h"
#include "state/state_tape.h"

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
    SW_ITEMS(const sw_term, term, s->system.bodies[b].terms, s->system.bodies[b].term_count) {
      if (!term->history) continue;
      SW_TRY(keep(s, b, term, &s->kept_histories[s->kept_history_count]));
      s->kept_history_count++;
    }
  return SW_OK;
}

static const sw_kept_history *find(const sw_scene *s, size_t wire, const sw_term *term) {
  SW_ITEMS(const sw_kept_history, h, s->kept_histories, s->kept_history_count) {
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
    SW_ITEMS(const sw_term, term, s->system.bodies[b].terms, s->system.bodies[b].term_count) {
      if (!term->history) continue;
      const sw_kept_history *old = find(s, b, term);
      const sw_field *field = &s->system.bodies[b].field;
      if (old)
        term->cls->inherit(old->plan, old->data, field, term->history);
      else if (term->cls->begin)
        term->cls->begin(term->args, field, term->history);
    }
}

/* --- on a tape, with what contact remembers ---------------------------------------------- */

void sw_tape_kept_contact(sw_tape *t, sw_scene *s) {
  int there = !sw_tape_reads(t) && s->kept.memory != NULL;
  sw_tape_int(t, &there);
  if (!there) return;
  sw_tape_mark(t, "contact", sw_contact_layout());
  sw_tape_mark(t, "contact of wires", sw_mutual_layout());
  sw_tape_count(t, &s->kept.bytes, 1), sw_tape_count(t, &s->kept.pair_bytes, 1);
  sw_tape_array(t, &s->kept.memory, s->kept.bytes, 1);
  sw_tape_array(t, &s->kept.pairs, s->kept.pair_bytes, 1);
  sw_tape_mark(t, "contact of particles", sw_mutual_layout());
  sw_tape_count(t, &s->kept.grain_bytes, 1);
  sw_tape_array(t, &s->kept.grains, s->kept.grain_bytes, 1);
  sw_tape_count(t, &s->kept.wires, sizeof *s->kept.first);
  SW_TAPE_ARRAY(t, s->kept.first, s->kept.wires + 1);
  SW_TAPE_ARRAY(t, s->kept.now, s->kept.wires);
  const size_t expected = s->kept.first ? s->kept.first[s->kept.wires] : 0;
  size_t nodes = expected;
  sw_tape_count(t, &nodes, sizeof *s->kept.s);
  sw_tape_expect(t, nodes == expected, "contact");
  SW_TAPE_ARRAY(t, s->kept.s, nodes);
  sw_tape_int(t, &s->kept.fresh), sw_tape_size(t, &s->kept.changed);
}

/* May a force of this class have a history of the plan, and give it to the wire's next one? */
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
  sw_tape_expect(t, x->wire < s->wire_count && (x->inner || !inner[0]), "what a force remembers");
  sw_tape_expect(t, x->inner || x->force < s->force_count, "what a force remembers");
  if (!sw_tape_good(t)) return;
  sw_tape_plan(t, &x->plan, s->wires[x->wire].strand.web, sizeof(sw_solid));
  if (!sw_tape_good(t)) return;
  const sw_force_class *cls = x->inner ? x->inner : s->forces[x->force].cls;
  sw_tape_expect(t, remembers(cls, x->plan, &s->wires[x->wire]), "what a force remembers");
  if (!sw_tape_good(t)) return;
  size_t count = cls->state_size(x->plan);
  const size_t expected = count;
  sw_tape_count(t, &count, sizeof *x->data);
  sw_tape_expect(t, count == expected, "what a force remembers");
  SW_TAPE_ARRAY(t, x->data, count);
}
