/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact of wires with obstacles, each other and themselves. Rules of which wires touch each other
 * are a list of statements; later ones overrule earlier ones. The system gets a table. */
#include "body/touching.h"

#include <math.h>

#include "base/alloc.h"
#include "body/hold.h"
#include "scene/drive.h"
#include "scene/obstacle.h"
#include "scene/wire.h"
#include "scene/world.h"
#include "system/join.h"
#include "system/linear.h"
#include "system/part.h"
#include "system/system.h"
#include "system/wait.h"

static void state_rule(const sw_scene_rule *r, size_t wires, sw_pair_rule *table) {
  const size_t count = r->count ? r->count : wires;
  for (size_t i = 0; i < count; i++)
    for (size_t j = 0; j < count; j++) {
      const size_t a = r->count ? r->wires[i] : i, b = r->count ? r->wires[j] : j;
      if (a != b || r->self) table[wires * a + b] = r->rule;
    }
}

sw_status sw_scene_new_pairs(sw_scene *s) {
  int any = 0;
  const size_t n = s->wire_count;
  if (!s->rules.count) return SW_OK;
  sw_pair_rule *table SW_LOCAL = sw_alloc(n * n, sizeof *table);
  if (!table) return SW_ENOMEM;
  for (size_t k = 0; k < s->rules.count; k++) state_rule(&s->rules.list[k], n, table);
  for (size_t k = 0; k < n * n; k++) any |= table[k].on;
  if (!any) return SW_OK;
  SW_TRY(sw_pairs_new(&s->system, table, &s->pairs));
  return sw_grains_new(&s->system, table, &s->grains);
}

/* --- the system's coupling ------------------------------------------------------- */

static void part(void *user, sw_system *system) {
  const sw_scene *s = user;
  if (s->contact) sw_contact_part(s->contact, system);
}

static sw_status begin_stage(void *user, sw_system *system, double t, double first, sw_error *err) {
  const sw_scene *s = user;
  system->coupling.part = s->crowd || s->grains ? NULL : part;
  if (s->pairs) sw_pairs_mark(s->pairs, system);
  if (s->pairs) sw_mutual_begin_stage(s->pairs, first);
  if (s->grains) sw_mutual_begin_stage(s->grains, first);
  return s->contact ? sw_contact_begin_stage(s->contact, t, first, err) : SW_OK;
}

/* 1 if bodies may touch each other in this step, and such bodies are solved now. */
static int meets(const sw_scene *s) {
  return s->pairs && !sw_mutual_idle(s->pairs) && !sw_part_is_single(&s->system);
}

static sw_status eval(void *user, sw_system *system, double t, double hbar, const double *y,
                      unsigned want, sw_error *err) {
  const sw_scene *s = user;
  if (s->contact) SW_TRY(sw_contact_eval(s->contact, system, t, hbar, y, want, err));
  if (s->crowd) sw_crowd_eval(s->crowd, system, y, want);
  if (s->grains) SW_TRY(sw_mutual_eval(s->grains, system, y, want, err));
  return meets(s) ? sw_mutual_eval(s->pairs, system, y, want, err) : SW_OK;
}

static sw_status keeps(void *user, sw_system *system, const double *y, int *out, sw_error *err) {
  const sw_scene *s = user;
  *out = !s->crowd && !s->pairs && !s->grains;
  return s->contact && *out ? sw_contact_keeps(s->contact, system, y, out, err) : SW_OK;
}

static double refine(void *user, sw_system *system) {
  const sw_scene *s = user;
  if (s->contact) sw_contact_refine(s->contact, system);
  if (s->grains && !meets(s)) return sw_mutual_refine(s->grains, s->contact, system);
  return meets(s) ? sw_mutual_refine(s->pairs, s->contact, system) : 1.0;
}

static int settled(void *user, sw_system *system, const double *y, const double *delta) {
  const sw_scene *s = user;
  if (system->rough == SW_MAY_BE_MADE && (s->pairs || s->crowd || !s->contact)) return 1;
  int fine = !s->contact || sw_contact_settled(s->contact, system, y, delta);
  if (meets(s)) fine &= sw_mutual_settled(s->pairs, system, delta);
  if (s->crowd) fine &= sw_crowd_settled(s->crowd, system, y, delta);
  if (s->grains) fine &= sw_mutual_settled(s->grains, system, delta);
  return fine;
}

static void book(void *user, const sw_booking *booking) {
  sw_scene *s = user;
  if (s->contact) sw_contact_book(s->contact, booking);
  sw_hold_book(s, booking);
}

void sw_scene_couple(sw_scene *s) {
  if (s->contact || s->system.hold_count) s->system.coupling.book = book;
  if (!sw_scene_has_contact(s)) return;
  s->system.coupling.refine = refine;
  s->system.coupling.begin_stage = begin_stage;
  s->system.coupling.eval = eval;
  s->system.coupling.keeps = keeps;
  s->system.coupling.settled = settled;
}

int sw_scene_has_contact(const sw_scene *s) {
  return s->contact || s->pairs || s->crowd || s->grains;
}

static const sw_contact_past *past_of(void *user, int o) {
  return &((sw_scene *)user)->obstacles[o].past;
}

static int may_move(void *user, int o) {
  return sw_drive_moves(&((sw_scene *)user)->obstacles[o].drive);
}

/* Obstacles that are gone or off forget their past. */
void sw_scene_inform_contact(sw_scene *s) {
  SW_EACH(obstacle, o, s)
    if (!o->alive || o->off) o->past = (sw_contact_past){0};
  sw_contact_recall(s->contact, past_of, may_move);
}

static int is_remade(void *user, size_t body) {
  const sw_scene *s = user;
  return body < sw_scene_wire_slots(s) && sw_scene_wire_in(s, body)->remade;
}

sw_status sw_scene_clear_meshes(sw_scene *s, sw_error *err) {
  if (!s->contact) return SW_OK;
  if (!sw_contact_informed(s->contact)) sw_scene_inform_contact(s);
  return sw_contact_clear(s->contact, &s->system, s->time, is_remade, s, err);
}

/* 1 if the hold does not move after time t. */
static int stands(const sw_hold *h, double t) {
  return sw_drive_stands(&h->drive, t) && !sw_hold_passes(h) && !h->cls->hold->rail;
}

/* Marks the holds that stand, and stores their loads while their wire waits. */
static void inform_holds(sw_scene *s, double t) {
  for (size_t k = 0; k < s->system.hold_count; k++) {
    const sw_hold *h = sw_scene_held_by(s, k);
    s->system.standing[k] = (sw_standing){stands(h, t), h->wire, {h->end_force, h->end_moment}};
  }
}

/* Finds the wires that wait in the step. */
static sw_status find_waiting(sw_scene *s, sw_contact_regime regime, double t, double h,
                              double nominal, sw_error *err) {
  const int alone = !s->crowd && !s->grains && regime == SW_CONTACT_IMPLICIT;
  inform_holds(s, t);
  sw_waits_find(&s->system, alone && s->course.next == SW_AS_BEFORE);
  if (!s->system.waiting) return SW_OK;
  if (s->contact) SW_TRY(sw_contact_wake(s->contact, &s->system, err));
  if (s->pairs) sw_mutual_regard(s->pairs, &s->system, regime, h, nominal);
  sw_joins_wake(&s->system);
  for (int any = s->pairs != NULL; any; any = sw_joins_wake(&s->system)) {
    const sw_status status = sw_mutual_wake(s->pairs, &s->system);
    if (status != SW_OK) return sw_fail(err, status, "contact of wires: out of memory");
  }
  return SW_OK;
}

sw_status sw_scene_begin_contact(sw_scene *s, sw_contact_regime regime, double t, double h,
                                 double nominal, sw_error *err) {
  if (s->contact && !sw_contact_informed(s->contact)) sw_scene_inform_contact(s);
  if (s->contact) SW_TRY(sw_contact_open(s->contact, t, h, err));
  SW_TRY(find_waiting(s, regime, t, h, nominal, err));
  if (s->contact) SW_TRY(sw_contact_begin_step(s->contact, &s->system, regime, nominal, err));
  const sw_status crowd = s->crowd ? sw_crowd_begin_step(s->crowd, &s->system, h) : SW_OK;
  if (crowd != SW_OK)
    return sw_fail(err, crowd, "particles that repel each other: %s",
                   crowd == SW_ELIMIT ? "too many are near each other" : sw_status_text(crowd));
  if (s->pairs) SW_TRY(sw_mutual_begin_step(s->pairs, &s->system, regime, h, nominal, err));
  if (!s->grains) return SW_OK;
  if (!s->pairs) SW_TRY(sw_system_begin_plan(&s->system));
  return sw_mutual_begin_step(s->grains, &s->system, regime, h, nominal, err);
}

void sw_scene_stop_wires(sw_scene *s) {
  if (!sw_waits_stopping(&s->system)) return;
  sw_contact_keep_moving(s->contact, &s->system);
  if (s->pairs) sw_mutual_keep_moving(s->pairs, &s->system);
  sw_waits_stop(&s->system);
}

/* A wider search may have found pairs with wires that wait: they have no touches with obstacles. */
static int found_waiting(sw_scene *s) {
  if (!s->pairs || !s->system.waiting || !sw_pairs_meet_waiting(s->pairs, &s->system)) return 0;
  sw_waits_wake(&s->system);
  return 1;
}

int sw_scene_expects_strike(const sw_scene *s, double h) {
  return s->pairs && sw_pairs_expect(s->pairs, &s->system, h);
}

int sw_scene_was_struck(const sw_scene *s) { return s->pairs && sw_mutual_impacts(s->pairs) > 0; }

sw_contact_verdict sw_scene_review_contact(sw_scene *s, const double *x1, const double *v1,
                                           double h) {
  sw_contact_verdict verdict = SW_CONTACT_ACCEPT;
  const int dull = s->pairs && !sw_mutual_idle(s->pairs) && s->course.stepper.plastic;
  if (s->contact) verdict = sw_contact_review(s->contact, &s->system, x1, v1, h, dull);
  if (verdict == SW_CONTACT_SOONER) return verdict;
  if (s->pairs && verdict != SW_CONTACT_SMALLER) {
    const sw_contact_verdict other =
        sw_mutual_review(s->pairs, &s->system, x1, h, s->course.stepper.plastic);
    if (other != SW_CONTACT_ACCEPT) verdict = other;
    if (found_waiting(s)) return SW_CONTACT_SMALLER;
  }
  if (s->grains && verdict != SW_CONTACT_SMALLER) {
    const sw_contact_verdict other =
        sw_mutual_review(s->grains, &s->system, x1, h, s->course.stepper.plastic);
    if (other != SW_CONTACT_ACCEPT) verdict = other;
  }
  return verdict;
}

int sw_scene_review_static(sw_scene *s, const double *x1) {
  int again = s->contact && sw_contact_review_static(s->contact, &s->system, x1);
  if (s->pairs) again |= sw_mutual_review_static(s->pairs, &s->system, x1);
  if (s->grains) again |= sw_mutual_review_static(s->grains, &s->system, x1);
  return again;
}

void sw_scene_commit_contact(sw_scene *s, int holds) {
  if (s->contact) {
    sw_contact_commit(s->contact, &s->system, holds);
    size_t count;
    const int *busy = sw_contact_busy(s->contact, &count);
    for (size_t i = 0; i < count; i++) {
      const size_t k = (size_t)busy[i];
      s->obstacles[sw_contact_id(s->contact, k)].past = *sw_contact_past_of(s->contact, k);
    }
  }
  if (s->pairs) sw_mutual_commit(s->pairs, &s->system, holds);
  if (s->grains) sw_mutual_commit(s->grains, &s->system, holds);
}

/* Uses copies of contact as it presses now; other wires stay where they are. */
static sw_status linearise(sw_scene *s, const size_t *only, size_t count, int slips,
                           sw_error *err) {
  sw_contact *const own = s->contact;
  sw_mutual *const pairs = s->pairs;
  sw_mutual *const grains = s->grains;
  sw_status status = SW_OK;
  s->contact = NULL, s->pairs = NULL, s->grains = NULL;
  if (own) status = sw_contact_copy(own, &s->contact);
  if (pairs && status == SW_OK) status = sw_mutual_copy(pairs, &s->system, &s->pairs);
  if (grains && status == SW_OK) status = sw_mutual_copy(grains, &s->system, &s->grains);
  if (status != SW_OK) sw_fail(err, status, "out of memory");
  if (own && only && status == SW_OK) sw_contact_keep(s->contact, only, count);
  if (own && slips && status == SW_OK) sw_contact_slip(s->contact);
  if (own && status == SW_OK) status = sw_contact_begin_look(s->contact, &s->system, s->time, err);
  if (pairs && status == SW_OK) status = sw_mutual_begin_look(s->pairs, &s->system, err);
  if (grains && !pairs && status == SW_OK) status = sw_system_begin_plan(&s->system);
  if (grains && status == SW_OK) status = sw_mutual_begin_look(s->grains, &s->system, err);
  if (status == SW_OK) status = sw_system_linearise(&s->system, s->time, err);
  sw_contact_free(s->contact);
  sw_mutual_free(s->pairs);
  sw_mutual_free(s->grains);
  s->contact = own, s->pairs = pairs, s->grains = grains;
  return status;
}

sw_status sw_scene_linearise(sw_scene *s, const size_t *only, size_t count, sw_error *err) {
  return linearise(s, only, count, 0, err);
}

sw_status sw_scene_linearise_slipping(sw_scene *s, sw_error *err) {
  return linearise(s, NULL, 0, 1, err);
}

/* Keeps the touches of contact as it presses now, while it has none of a step. */
sw_status sw_scene_find_touches(sw_scene *s, sw_error *err) {
  sw_contact *const own = s->contact;
  sw_mutual *const pairs = s->pairs;
  sw_mutual *const grains = s->grains;
  const void *seen;
  size_t bytes;
  if (!own || sw_contact_touches(own) > 0) return SW_OK;
  s->contact = NULL, s->pairs = NULL, s->grains = NULL;
  sw_status status = sw_contact_copy(own, &s->contact);
  if (status == SW_OK) status = sw_contact_begin_look(s->contact, &s->system, s->time, err);
  if (status == SW_OK) status = sw_system_linearise(&s->system, s->time, err);
  if (status == SW_OK) {
    seen = sw_contact_seen(s->contact, &bytes);
    status = sw_contact_set_seen(own, seen, bytes, &s->system);
  }
  sw_contact_free(s->contact);
  s->contact = own, s->pairs = pairs, s->grains = grains;
  return status == SW_ENOMEM ? sw_fail(err, status, "out of memory") : status;
}

/* --- read-outs ------------------------------------------------------------------- */

double sw_scene_deepest(const sw_scene *s, size_t *node) {
  size_t other = 0;
  const double obstacle = s->contact ? sw_contact_penetration(s->contact, node) : 0.0;
  const double wire = s->pairs ? sw_mutual_penetration(s->pairs, &s->system, &other) : 0.0;
  if (wire > obstacle && node) *node = other;
  const double grain = s->grains ? sw_mutual_penetration(s->grains, &s->system, &other) : 0.0;
  if (grain > fmax(obstacle, wire) && node) *node = other;
  return fmax(grain, fmax(obstacle, wire));
}

size_t sw_scene_presses(const sw_scene *s, sw_presses list[SW_SCENE_PRESSES]) {
  size_t n = 0;
  if (s->contact) list[n++] = sw_contact_presses(s->contact);
  if (s->contact) list[n++] = sw_contact_still_presses(s->contact);
  if (s->pairs) list[n++] = sw_mutual_presses(s->pairs);
  if (s->pairs) list[n++] = sw_mutual_still_presses(s->pairs);
  if (s->grains) list[n++] = sw_mutual_presses(s->grains);
  return n;
}

static double sum_of(const sw_scene *s, double (*what)(sw_presses)) {
  sw_presses list[SW_SCENE_PRESSES];
  const size_t n = sw_scene_presses(s, list);
  double sum = 0;
  for (size_t k = 0; k < n; k++) sum += what(list[k]);
  return sum;
}

double sw_scene_contact_energy(const sw_scene *s) { return sum_of(s, sw_presses_energy); }

double sw_scene_rubbed(const sw_scene *s) { return sum_of(s, sw_presses_rubbed); }

static size_t places_of(const sw_mutual *m) {
  if (!m) return 0;
  return sw_presses_count(sw_mutual_presses(m)) + sw_presses_count(sw_mutual_still_presses(m));
}

size_t sw_scene_places(const sw_scene *s) { return places_of(s->pairs) + places_of(s->grains); }

int sw_scene_next_place(const sw_scene *s, size_t body, size_t next[2], sw_pair_place *out) {
  if (s->pairs && sw_mutual_next_place(s->pairs, body, &next[0], out)) return 1;
  return s->grains && sw_mutual_next_place(s->grains, body, &next[1], out);
}

int sw_scene_relief(const sw_scene *s, size_t body, sw_relief *out) {
  return s->pairs && sw_mutual_relief(s->pairs, &s->system, body, out);
}

void sw_scene_push_out(const sw_scene *s, size_t body, const sw_relief *relief, double *out) {
  sw_mutual_part(s->pairs, &s->system, body, relief, out);
}
