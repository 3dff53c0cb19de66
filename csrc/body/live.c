/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The live part of a built scene, without its objects: the state of the system, of contact and of
 * the stepper. Put back into a scene built of the same objects it gives the same bits. */
#include "body/live.h"

#include <string.h>

#include "base/alloc.h"
#include "body/body.h"
#include "mutual/mutual.h"
#include "scene/course.h"
#include "scene/gripper.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/system.h"
#include "system/wait.h"

sw_live sw_live_of(const sw_scene *s) {
  sw_mutual *grains = sw_scene_grains(s), *pairs = sw_scene_pairs(s);
  sw_contact *contact = sw_scene_contact(s);
  sw_course *c = sw_scene_course(s);
  sw_system *system = sw_scene_system(s);
  sw_live p = {.state = system->state, .state_size = system->state_size};
  if (contact) {
    p.fresh = sw_contact_is_fresh(contact);
    p.memory = sw_contact_memory(contact, &p.memory_size);
    p.seen[0] = sw_contact_seen(contact, &p.seen_size[0]);
  }
  if (pairs) {
    p.pairs = sw_mutual_memory(pairs, &p.pairs_size);
    p.seen[1] = sw_mutual_seen(pairs, &p.seen_size[1]);
  }
  if (grains) {
    p.grains = sw_mutual_memory(grains, &p.grains_size);
    p.seen[2] = sw_mutual_seen(grains, &p.seen_size[2]);
  }
  if (!c->has_stepper) return p;
  p.method = c->method;
  p.last_h = c->stepper.last_h;
  p.restart = c->stepper.restart;
  if (!(c->method->flags & SW_INTEGRATOR_HISTORY)) return p;
  p.history_size = sw_stepper_history(&c->stepper, system);
  p.history = c->stepper.xp;
  return p;
}

/* Copies n doubles of the state, from index `from` on, to a new block. */
static sw_status copy_out(const sw_live *p, size_t from, size_t n, double **to) {
  if (n > p->state_size || from > p->state_size - n) return SW_EINVAL;
  sw_free(*to);
  *to = sw_alloc(n, sizeof **to);
  if (!*to) return SW_ENOMEM;
  if (n) memcpy(*to, (const char *)p->state + from * sizeof **to, n * sizeof **to);
  return SW_OK;
}

sw_status sw_live_place(sw_scene *s, const sw_live *p) {
  size_t freedoms = 0, node = 0, edge = 0;
  SW_EACH(wire, wire, s) {
    freedoms += 3 * sw_body_state_of(wire).points + (wire->beam.rolls ? wire->mesh.n - 1 : 0);
  }
  SW_EACH(hold, h, s) freedoms += h->alive && h->cls->hold->rail;
  for (size_t w = 0; w < sw_scene_wire_slots(s); w++) {
    sw_strand *strand = &sw_scene_wire_in(s, w)->strand;
    const sw_web *web = strand->web;
    const size_t n = sw_body_state_of(sw_scene_wire_in(s, w)).points,
                 edges = web ? web->links : n - 1;
    if (web) {
      SW_TRY(copy_out(p, 3 * node, 3 * n, &strand->x));
      SW_TRY(copy_out(p, freedoms + 3 * node, 3 * n, &strand->v));
      SW_TRY(copy_out(p, 2 * freedoms + 3 * node, 3 * n, &strand->a));
      SW_TRY(copy_out(p, 3 * freedoms + edge, edges, &strand->axial));
    }
    node += n, edge += edges;
  }
  return SW_OK;
}

static sw_status put_contact(sw_scene *s, const sw_live *p) {
  sw_mutual *grains = sw_scene_grains(s), *pairs = sw_scene_pairs(s);
  sw_contact *contact = sw_scene_contact(s);
  sw_system *system = sw_scene_system(s);
  if (contact) {
    SW_TRY(sw_contact_set_memory(contact, p->memory, p->memory_size, p->fresh));
    SW_TRY(sw_contact_set_seen(contact, p->seen[0], p->seen_size[0], system));
  }
  if (pairs) {
    SW_TRY(sw_mutual_set_memory(pairs, p->pairs, p->pairs_size));
    SW_TRY(sw_mutual_set_seen(pairs, p->seen[1], p->seen_size[1], system));
  }
  if (!grains) return SW_OK;
  SW_TRY(sw_mutual_set_memory(grains, p->grains, p->grains_size));
  return sw_mutual_set_seen(grains, p->seen[2], p->seen_size[2], system);
}

sw_status sw_live_put(sw_scene *s, const sw_live *p, sw_error *err) {
  sw_course *c = sw_scene_course(s);
  sw_system *system = sw_scene_system(s);
  memcpy(system->state, p->state, p->state_size * sizeof(double));
  system->first.x = NULL;
  sw_waits_find(system, 0);
  const sw_status status = put_contact(s, p);
  if (status == SW_EINVAL)
    return sw_fail(err, SW_EFORMAT, "its contact does not go with its objects");
  SW_TRY(status);
  if (p->method && (!c->has_stepper || c->method != p->method)) {
    sw_stepper_free(&c->stepper);
    c->has_stepper = 0;
    SW_TRY(sw_stepper_new(&c->stepper, p->method, system));
    c->has_stepper = 1;
    c->method = p->method;
  }
  if (p->method) {
    c->stepper.last_h = p->last_h;
    c->stepper.restart = p->restart;
    if (p->history_size) memcpy(c->stepper.xp, p->history, p->history_size * sizeof(double));
  } else if (c->has_stepper) { /* taken before the first run */
    sw_stepper_free(&c->stepper);
    c->has_stepper = 0;
    c->method = NULL;
  }
  return sw_system_place_holds(system, sw_scene_time(s), NULL, NULL, NULL, err);
}

size_t sw_live_size(const sw_live *p) {
  return sizeof(double) * (p->state_size + p->history_size) + p->memory_size + p->pairs_size +
         p->grains_size + p->seen_size[0] + p->seen_size[1] + p->seen_size[2];
}

/* What slipped in grippers in the searches for this pose. A search that is given up slips nothing.
 */
static void tape_ways(sw_tape *tape, const sw_scene *s) {
  SW_EACH(tool, t, s) sw_tape_vec(tape, &t->way), sw_tape_vec(tape, &t->swing);
}

sw_status sw_live_take(const sw_scene *s, sw_tape *out) {
  sw_live live = sw_live_of(s);
  *out = sw_tape_at_home(sw_live_size(&live) + 256, NULL);
  sw_tape_live(out, &live);
  tape_ways(out, s);
  return out->status;
}

sw_status sw_live_back(sw_scene *s, const sw_tape *taken, sw_error *err) {
  sw_live live = {0};
  sw_tape t = sw_tape_read_home(taken, err);
  sw_tape_live(&t, &live);
  SW_TRY(t.status);
  tape_ways(&t, s);
  return sw_live_put(s, &live, err);
}

/* 1 if the memories of pairs and grains refer to nodes that exist. */
static int mutual_fit(const sw_scene *s, const sw_live *p) {
  sw_system *system = sw_scene_system(s);
  const size_t n = system->body_count;
  if (!p->pairs_size && !p->grains_size) return 1;
  size_t *first SW_LOCAL = sw_alloc(n + 1, sizeof *first);
  if (!first) return 0;
  for (size_t b = 0; b < n; b++) first[b] = system->bodies[b].first_node;
  first[n] = system->nodes;
  return sw_mutual_memory_fits(p->pairs, p->pairs_size, first, n) &&
         sw_mutual_memory_fits(p->grains, p->grains_size, first, n);
}

int sw_live_fits(const sw_scene *s, const sw_live *p) {
  sw_system *system = sw_scene_system(s);
  const size_t n = 2 * system->freedoms + (system->strain ? system->strains : 0);
  const int history = p->method && (p->method->flags & SW_INTEGRATOR_HISTORY);
  return p->state_size == system->state_size && p->history_size == (history ? n : 0) &&
         sw_contact_memory_fits(p->memory, p->memory_size, system->nodes,
                                sw_scene_obstacle_slots(s)) &&
         mutual_fit(s, p);
}

/* --- on a tape ------------------------------------------------------------------------ */

static void block(sw_tape *t, const void **p, size_t *size) {
  sw_tape_count(t, size, 1);
  sw_tape_view(t, p, *size);
}

void sw_tape_live(sw_tape *t, sw_live *x) {
  char word[SW_NAME_SIZE];
  SW_TAPE_STRUCT(t, sw_live, 160);
  sw_tape_mark(t, "contact", sw_contact_layout());
  sw_tape_mark(t, "contact of wires", sw_mutual_layout());
  sw_tape_mark(t, "contact of particles", sw_mutual_layout());
  sw_tape_count(t, &x->state_size, sizeof(double));
  sw_tape_view(t, &x->state, x->state_size * sizeof(double));
  if (!sw_tape_address(t, &x->method)) {
    const char *method =
        sw_tape_word(t, !sw_tape_reads(t) && x->method ? x->method->name : NULL, word);
    if (sw_tape_reads(t)) x->method = method[0] ? sw_integrator_find(method) : NULL;
    sw_tape_expect(t, x->method || !method[0], "an unknown integrator");
  }
  sw_tape_double(t, &x->last_h), sw_tape_int(t, &x->restart);
  sw_tape_count(t, &x->history_size, sizeof(double));
  sw_tape_view(t, &x->history, x->history_size * sizeof(double));
  block(t, &x->memory, &x->memory_size), sw_tape_int(t, &x->fresh);
  block(t, &x->pairs, &x->pairs_size), block(t, &x->grains, &x->grains_size);
  for (size_t k = 0; k < 3; k++) block(t, &x->seen[k], &x->seen_size[k]);
  if (!sw_tape_reads(t) || t->home) return;
  for (size_t i = 0; i < x->state_size && sw_tape_good(t); i++) {
    double value;
    memcpy(&value, (const char *)x->state + i * sizeof value, sizeof value);
    sw_tape_expect(t, isfinite(value), "the state of a scene");
  }
}
