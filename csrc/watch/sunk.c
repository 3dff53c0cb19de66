/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports wires that are drawn taut round each other and are in each other so deep that this takes
 * some of their tension: their way is shorter than that of wires that only touch. The state with
 * the largest tension counts. An estimate from the turns of the wires (mutual/relief.h) is an upper
 * bound: between few touches wires give way. Where it is large, small motions about the state
 * decide. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "body/touching.h"
#include "link/hold.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/linear.h"
#include "system/system.h"
#include "watch/observe.h"

/* A smaller share of the tension is not told [-]. */
static const double TOLD = 0.05;
/* A state is looked at if its tension is this much above that of the last one [-]. */
static const double GROWN = 1.05;
/* A tension below this share of the largest one does not count at a run's end [-]. */
static const double LITTLE = 0.2;

/* Tension below which a wire only hangs: its weight on earth, or what bends it [N]. */
static double usual_of(const sw_body *b) {
  const sw_plan *p = b->plan;
  return fmax(9.81 * p->beam.mass * p->length, p->beam.EI / (p->length * p->length));
}

static double largest_pull(const sw_system *s, const sw_body *b) {
  double most = 0;
  for (size_t e = 0; e < b->plan->edges; e++) most = fmax(most, s->tension[b->first_edge + e]);
  return most;
}

/* Mean tension that a stretch gains by a motion of its body [N]. */
static double gained(const sw_system *s, const sw_body *b, const sw_relief *r,
                     const double *shift) {
  double sum = 0, length = 0;
  for (size_t i = r->from; i < r->to; i++) {
    const size_t e = i - b->first_node;
    const sw_vec along =
        sw_unit_or(sw_sub(sw_vec_at(s->x, i + 1), sw_vec_at(s->x, i)), sw_v(0, 0, 0));
    sum += sw_dot(along, sw_sub(sw_vec_at(shift, e + 1), sw_vec_at(shift, e)));
    length += b->plan->rest[e];
  }
  return b->EA * sum / length;
}

/* Tension that a stretch gains where its touches are pushed out by their depth, in small motions of
 * the linearised scene; the other wires stay [N]. */
static sw_status answer(const sw_scene *s, size_t body, const sw_relief *r, double *gain) {
  const sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[body];
  const size_t n = b->plan->nodes, unknowns = sw_system_unknowns(system, body), w = unknowns / n;
  double *factor SW_LOCAL = sw_alloc(sw_system_factor_size(system, body), sizeof *factor);
  double *motion SW_LOCAL = sw_alloc(unknowns + 3 * n, sizeof *motion);
  if (!factor || !motion) return SW_ENOMEM;
  double *nodes = motion + unknowns;
  sw_scene_push_out(s, body, r, nodes);
  memset(motion, 0, unknowns * sizeof *motion);
  for (size_t i = 0; i < n; i++) memcpy(motion + w * i, nodes + 3 * i, 3 * sizeof *motion);
  sw_system_fix_held(system, body, motion);
  SW_TRY(sw_system_factor(system, body, 0.0, factor, NULL));
  sw_system_factor_solve(system, body, factor, motion);
  sw_system_shifts(system, body, motion, nodes);
  *gain = gained(system, b, r, nodes);
  return SW_OK;
}

/* Sets what the wire loses to that by small motions. If these cannot say, the estimate stays. */
static sw_status look_closer(sw_scene *s, size_t body, const sw_relief *r, double *taken,
                             sw_error *err) {
  double gain = 0;
  sw_scene_enter(s, 1); /* a force may be a user's function */
  sw_status status = sw_scene_linearise(s, NULL, 0, err);
  if (status == SW_OK) status = answer(s, body, r, &gain);
  sw_scene_enter(s, -1);
  sw_system_refresh(sw_scene_system(s));
  if (status == SW_ENOMEM || status == SW_ECALLBACK) return status;
  if (status == SW_OK) *taken = fmin(*taken, fmax(gain, 0.0));
  return SW_OK;
}

/* 1 if a feed of the wire obeys a force, which then is the tension. */
static int is_given(const sw_scene *s, size_t body) {
  const sw_system *system = sw_scene_system(s);
  for (size_t k = 0; k < system->held_count; k++) {
    if (system->held[k].body != body || !system->held[k].slides) continue;
    sw_hold *h = sw_scene_held_by(s, (size_t)system->held[k].hold);
    const sw_slip *slip = h->cls->hold->slips ? h->cls->hold->slips(h) : NULL;
    if (slip && (isfinite(slip->push) || slip->way != 0)) return 1;
  }
  return 0;
}

/* Notes the state if it has a larger tension than the last one; at the end of a run also one that
 * is not much smaller. Only the closer look says how large it would be: the bound of wires that
 * just begin to touch may be above all tensions that follow. */
static sw_status note(sw_scene *s, size_t body, int ends, sw_error *err) {
  const sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[body];
  sw_sunk *last = &sw_scene_wire_in(s, body)->sunk;
  const double from = ends ? LITTLE * last->most : fmax(usual_of(b), GROWN * last->most);
  sw_relief r;
  if (!sw_scene_relief(s, body, &r)) r.node = b->first_node, r.tension = largest_pull(system, b);
  const double pull = fmax(r.tension, 0.0), bound = pull + r.taken;
  if (!(bound > from) || (!ends && !(pull > from) && !(bound > GROWN * last->bound))) return SW_OK;
  double taken = r.taken;
  last->bound = fmax(last->bound, bound);
  if (taken > TOLD * bound) SW_TRY(look_closer(s, body, &r, &taken, err));
  if (!(pull + taken > from)) return SW_OK;
  const double at = b->plan->s[r.node - b->first_node] - b->plan->s[0];
  const int counts = taken > TOLD * (pull + taken);
  *last = (sw_sunk){pull + taken, last->bound,      pull,   taken, r.depth,
                    at,           sw_scene_time(s), r.with, counts};
  return SW_OK;
}

sw_status sw_scene_watch_sunk(sw_scene *s, sw_error *err) {
  const sw_system *system = sw_scene_system(s);
  if (!sw_scene_pairs(s)) return SW_OK;
  for (size_t k = 0; k < system->body_count; k++) {
    const sw_body *b = &system->bodies[k];
    const double from = fmax(usual_of(b), GROWN * sw_scene_wire_in(s, k)->sunk.most);
    if (b->waits || b->plan->web || is_given(s, k) || !(largest_pull(system, b) > 0.1 * from))
      continue;
    SW_TRY(note(s, k, 0, err));
  }
  return SW_OK;
}

/* Above this share the touches would be pushed out further than small motions can say: 62 % were
 * told of a braid whose tension was 35 % too small, 30 % of wires drawn in each other with 60 % too
 * little [-]. */
static const double MUCH = 0.15;

static void tell(sw_scene *s, const sw_scene_wire *w) {
  const sw_sunk *k = &w->sunk;
  const double share = k->taken / (k->tension + k->taken);
  sw_scene_tell(s, "pressed", w->name, k->s, k->taken,
                "wires '%s' and '%s' are %.2g mm in each other where they press. This shortens "
                "their way: the tension of '%s' at t = %.4g s, and the forces of its holds, are "
                "too small by %s %.0f %%",
                w->name, sw_scene_wire_in(s, k->with)->name, 1e3 * k->depth, w->name, k->time,
                share > MUCH ? "very roughly" : "about", 100.0 * share);
}

void sw_scene_end_sunk(sw_scene *s) {
  sw_error ignored;
  if (!sw_scene_pairs(s) || !sw_scene_is_built(s)) return;
  for (size_t k = 0; k < sw_scene_system(s)->body_count; k++) {
    sw_scene_wire *w = sw_scene_wire_in(s, k);
    if (!w->sunk.counts && w->sunk.most > 0) (void)note(s, k, 1, &ignored);
    if (w->sunk.counts) tell(s, w);
  }
}
