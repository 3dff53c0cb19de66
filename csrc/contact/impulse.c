/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Loads of obstacles in a step: the impulse that changed the wires' momentum. The stages of a
 * method add forces to it with the weights that they have in the velocity. Impacts change
 * velocities at the step's start and add their own impulse. */
#include <math.h>

#include "contact/jolt.h"
#include "contact/strikers.h"

static sw_contact_load sum(sw_contact_load a, double share, sw_contact_load b) {
  return (sw_contact_load){sw_madd(a.force, b.force, share), sw_madd(a.moment, b.moment, share)};
}

/* Force on the wire: in implicit steps the force of the solve, else that of the contact law. */
static sw_vec force_on(const sw_contact *c, const sw_touch *t) {
  const sw_press *p = &t->press;
  if (c->regime == SW_CONTACT_IMPLICIT) return sw_press_borne(p, t->friction);
  return p->normal_force > 0 ? sw_madd(p->tangential, p->normal, p->normal_force) : sw_v(0, 0, 0);
}

/* Adds share times the forces of the touches, with moments about the obstacles' present pivots. The
 * fingers of a tool share one pivot; with two pivots their pressing forces would turn the tool
 * while it turns in a step. */
static void add_now(const sw_contact *c, double share, sw_contact_load *(*at)(sw_contact_loads *)) {
  for (size_t i = 0; c->still.any && i < c->busy_count; i++) {
    sw_contact_loads *l = &c->loads[c->busy[i]];
    *at(l) = sum(*at(l), share, l->resting);
  }
  for (size_t i = 0; i < c->touch_count; i++) {
    const sw_touch *t = &c->touches[i];
    sw_touch_fetch(t, SW_FETCH_FORCE);
    if (!t->press.active && !t->press.opened) continue;
    const sw_vec f = sw_neg(force_on(c, t));
    sw_contact_load *to = at(&c->loads[t->obstacle]);
    *to = sum(*to, share, (sw_contact_load){f, sw_touch_moment(t, c->now[t->obstacle].pivot, f)});
  }
}

static sw_contact_load *first_of(sw_contact_loads *l) { return &l->stage[0]; }
static sw_contact_load *second_of(sw_contact_loads *l) { return &l->stage[1]; }
static sw_contact_load *end_of(sw_contact_loads *l) { return &l->past.end; }
static sw_contact_load *trial_of(sw_contact_loads *l) { return &l->trial; }

void sw_contact_book(void *contact, const sw_booking *b) {
  sw_contact *c = contact;
  const sw_contact_load none = {.force = {.x = 0}};
  for (size_t i = 0; i < c->busy_count; i++) {
    sw_contact_loads *l = &c->loads[c->busy[i]];
    sw_contact_load all = sum(none, b->first, l->stage[0]);
    all = sum(all, b->start, l->past.end);
    l->stage[b->stage] = sum(all, -b->before, l->past.gained);
  }
  c->last_stage = b->stage;
  sw_contact_book_singles(c, b);
  if (b->own != 0) add_now(c, b->own, b->stage ? second_of : first_of);
}

/* The lever of a pad that turns with its tool is taken at mid-step: the mean force has the
 * direction of mid-step, and the lever at the end would be half a turn of the step ahead. */
void sw_contact_gained(const sw_contact *c, int id, sw_vec *force, sw_vec *moment) {
  const size_t o = sw_contact_index(c, id);
  const sw_contact_at *from = &c->start[o], *to = &c->now[o];
  const sw_contact_load all = c->loads[o].stage[c->last_stage];
  const sw_vec twice = sw_add(sw_sub(from->pivot, from->pose.p), sw_sub(to->pivot, to->pose.p));
  *force = all.force;
  *moment = sw_add(all.moment, sw_cross(sw_scale(twice, 0.5), all.force));
}

void sw_contact_add_blow(sw_contact *c, int obstacle, sw_vec point, sw_vec impulse) {
  const sw_vec arm = sw_sub(point, c->start[obstacle].pivot);
  sw_contact_load *to = &c->loads[obstacle].blows;
  *to = sum(*to, 1.0, (sw_contact_load){impulse, sw_cross(arm, impulse)});
}

static int is_none(const sw_contact_load *l) {
  const sw_vec f = l->force, m = l->moment;
  return f.x == 0 && f.y == 0 && f.z == 0 && m.x == 0 && m.y == 0 && m.z == 0;
}

static int remembers(const sw_contact_past *past) {
  return !is_none(&past->mean) || !is_none(&past->end) || !is_none(&past->gained);
}

void sw_contact_expect(sw_contact *c, int obstacle) {
  if (c->loads[obstacle].busy) return;
  c->loads[obstacle].busy = 1;
  c->busy[c->busy_count++] = obstacle;
}

void sw_contact_forget_blows(sw_contact *c) {
  size_t kept = 0;
  for (size_t i = 0; i < c->busy_count; i++) {
    sw_contact_loads *l = &c->loads[c->busy[i]];
    const int busy = remembers(&l->past);
    *l = (sw_contact_loads){.past = l->past, .resting = l->resting, .busy = busy};
    if (busy) c->busy[kept++] = c->busy[i];
  }
  c->busy_count = kept;
  c->last_stage = 0;
}

/* A force at a step's end comes from a shock if it differs from the mean by more than SHOCK times
 * the larger of both, and by more than SHARP times the usual force [-]. */
static const double SHOCK = 0.3, SHARP = 0.5;

/* 1 if an obstacle's load at the end differs from its mean by enough for a shock of some wire. */
static int any_may_shake(const sw_contact *c, const sw_system *s) {
  double most = 0;
  for (size_t i = 0; i < c->busy_count; i++) {
    const sw_contact_past *past = &c->loads[c->busy[i]].past;
    most = fmax(most, sw_dist(past->end.force, past->mean.force));
  }
  for (size_t b = 0; most > 0 && b < s->body_count; b++)
    if (most > SHARP * sw_contact_usual_force(s, s->bodies[b].plan)) return 1;
  return 0;
}

void sw_contact_conclude(sw_contact *c, const sw_system *s) {
  const sw_contact_load none = {.force = {.x = 0}};
  for (size_t i = 0; i < c->busy_count; i++) c->loads[c->busy[i]].past.end = none;
  add_now(c, 1.0, end_of);
  for (size_t i = 0; i < c->busy_count; i++) {
    sw_contact_loads *l = &c->loads[c->busy[i]];
    const int moves = c->regime != SW_CONTACT_STATIC && c->h > 0;
    const sw_contact_load gained = l->stage[c->last_stage];
    l->past.gained = moves ? gained : none;
    l->past.mean = moves ? sum(none, 1.0 / c->h, sum(gained, 1.0, l->blows)) : l->past.end;
    const sw_vec turned = sw_cross(c->now[c->busy[i]].pivot, l->past.mean.force);
    l->past.mean.moment = sw_add(l->past.mean.moment, turned);
  }
  if (any_may_shake(c, s)) sw_contact_find_strikers(c, s);
}

double sw_contact_usual_force(const sw_system *s, const sw_plan *p) {
  const double weight = p->beam.mass * p->length * sw_norm(sw_load(s->gravity));
  return weight > 0 ? weight : p->beam.EI / (p->length * p->length);
}

/* Squeezing force over the usual force [-]. */
static const double FAR_ABOVE = 100.0;

double sw_contact_squeezing_force(const sw_system *s, const sw_plan *p) {
  return p->web ? 0.0 : FAR_ABOVE * sw_contact_usual_force(s, p);
}

double sw_contact_edge_stiffness(const sw_system *s, size_t body, size_t node) {
  const sw_body *b = &s->bodies[body];
  const size_t e = node - b->first_node, edges = b->plan->edges;
  if (b->plan->web || !edges) return 0;
  return b->EA / b->plan->rest[e < edges ? e : edges - 1];
}

/* 1 if a difference of forces is a shock for one of the wires that touch obstacle o. */
static int shakes(const sw_contact *c, const sw_system *s, int o, double off) {
  for (size_t i = 0; i < c->touch_count; i++) {
    const sw_plan *p = s->bodies[c->touches[i].body].plan;
    if (c->touches[i].obstacle != o || p->web) continue; /* meshes would hop, see bounces */
    if (off > SHARP * sw_contact_usual_force(s, p)) return 1;
  }
  return 0;
}

int sw_contact_shaken(const sw_contact *c, const sw_system *s) {
  for (size_t k = 0; k < c->busy_count && c->touch_count; k++) {
    const sw_contact_past *past = &c->loads[c->busy[k]].past;
    const sw_strikers *who = &c->loads[c->busy[k]].strikers;
    const sw_vec resting = sw_scale(sw_add(who->rest_start, who->rest_end), 0.5);
    const sw_vec mean = sw_sub(past->mean.force, resting);
    const sw_vec end = sw_sub(past->end.force, who->rest_end);
    const double off = sw_dist(end, mean), most = fmax(sw_norm(end), sw_norm(mean));
    if (off > SHOCK * most && shakes(c, s, c->busy[k], off)) return 1;
  }
  return 0;
}

/* A new blow is harder than this multiple of the usual force, as a mean over the step [-]. */
static const double LIGHT = 1.1;
/* A new blow on an obstacle is this many times as hard as the hardest one before [-]. */
static const double HARDER = 1.5;
/* A blow goes on while forces come and go that are above GOES_ON times its hardest force and above
 * HARD times the usual force [-]. */
static const double GOES_ON = 0.5, HARD = 5.0; /* HARD: of usual forces [-] */

double sw_contact_least_blow(double usual, double hardest, int followed) {
  return followed ? fmax(HARD * usual, GOES_ON * hardest) : fmax(LIGHT * usual, HARDER * hardest);
}

/* A new blow may add little to a force that already presses: a cable that rolls down on a table
 * presses with several times its weight before its end slaps down. A blow differs from the mean by
 * more than PASSING times the larger of both, and by more than BRIEF times the usual force. With
 * SHOCK and SHARP instead, bend radii of 41 of 450 landings were off by more than 15 % without an
 * event [-]. */
static const double PASSING = 0.15, BRIEF = 0.25;

static int is_passing(double usual, sw_vec end, sw_vec mean, int followed) {
  const double off = sw_norm(sw_sub(end, mean)), most = fmax(sw_norm(end), sw_norm(mean));
  return off > (followed ? SHOCK : PASSING) * most && off > (followed ? SHARP : BRIEF) * usual;
}

int sw_contact_comes_and_goes(double usual, sw_vec start, sw_vec mean, sw_vec end, int followed) {
  const sw_vec middle = sw_scale(sw_add(end, start), 0.5);
  return is_passing(usual, end, mean, followed) || is_passing(usual, middle, mean, followed);
}

double sw_contact_jolt_of(double size, double usual, double h) {
  return fmax(size / usual, sqrt(h / SW_LONGEST_PART));
}

/* Load of the only striker: that of the obstacle without the wires that rest on it. Among several
 * strikers each wire has its own load: many that shake a little would hide the blow of one. */
static sw_blow blow_on(const sw_contact *c, const sw_contact_loads *l, double usual) {
  const sw_strikers *k = &l->strikers;
  if (k->count > 1) return sw_contact_own_blow(c, k, usual);
  const sw_vec impulse = sw_add(l->stage[c->last_stage].force, l->blows.force);
  const sw_vec resting = sw_scale(sw_add(k->rest_start, k->rest_end), 0.5);
  return (sw_blow){.usual = k->usual,
                   .mean = sw_sub(sw_scale(impulse, 1.0 / c->h), resting),
                   .start = sw_sub(l->past.end.force, k->rest_start),
                   .end = sw_sub(l->trial.force, k->rest_end)};
}

/* 1 if some touch may be a blow. A touch that pressed before only slips or sticks, unless it
 * belongs to a present blow. */
static int any_may_strike(const sw_contact *c, int followed) {
  for (size_t i = 0; i < c->touch_count; i++)
    if (followed || !c->touches[i].known) return 1;
  return 0;
}

/* Jolt of a wire's touch; *own: the wire's hardest blow so far [N]. Pads of a gripper do not count;
 * the gripper closes slowly on a wire by other means. */
static double jolt_of(sw_contact *c, const sw_system *s, const sw_touch *t, int followed,
                      double *own) {
  sw_contact_loads *l = &c->loads[t->obstacle];
  const sw_plan *p = s->bodies[t->body].plan;
  if (c->obstacles[t->obstacle].grips > 0 || (!followed && t->known)) return 0;
  const sw_blow b = blow_on(c, l, sw_contact_usual_force(s, p));
  const double size = sw_norm(b.mean);
  if (!(size > sw_contact_least_blow(b.usual, fmin(l->past.hardest, *own), followed))) return 0;
  if (size > p->beam.EA)
    return 0; /* a hold drives the wire in: a blow of the wire would be weaker */
  if (!sw_contact_comes_and_goes(b.usual, b.start, b.mean, b.end, followed)) return 0;
  if (!followed) l->past.hardest = fmax(l->past.hardest, size), *own = fmax(*own, size);
  return sw_contact_jolt_of(size, b.usual, c->h);
}

double sw_contact_jolt(sw_contact *c, const sw_system *s, int followed, sw_blow_of of, void *user) {
  const sw_contact_load none = {.force = {.x = 0}};
  double hardest = 0;
  if (c->regime != SW_CONTACT_IMPLICIT || !(c->h > 0)) return 0;
  sw_contact_forget_strikers(c);
  if (!any_may_strike(c, followed)) return 0;
  for (size_t i = 0; i < c->busy_count; i++) c->loads[c->busy[i]].trial = none;
  add_now(c, 1.0, trial_of);
  sw_contact_find_strikers(c, s);
  for (sw_wire_look w = {.first = 0}; sw_contact_look_at_next(c, s, &w);)
    for (size_t i = w.first; i < w.end; i++)
      hardest = fmax(hardest, jolt_of(c, s, &c->touches[i], followed, of(user, w.body)));
  return hardest;
}

void sw_contact_forget_hardest(sw_contact *c) {
  for (size_t o = 0; o < c->count; o++) c->loads[o].past.hardest = 0;
}

int sw_contact_id(const sw_contact *c, size_t k) { return c->obstacles[k].id; }

const sw_contact_past *sw_contact_past_of(const sw_contact *c, size_t k) {
  return &c->loads[k].past;
}

const int *sw_contact_busy(const sw_contact *c, size_t *count) {
  *count = c->busy_count;
  return c->busy;
}

const int *sw_contact_movers(const sw_contact *c, size_t *count) {
  *count = c->broad.mover_count;
  return c->broad.mover;
}

int sw_contact_informed(const sw_contact *c) { return c->informed; }

void sw_contact_recall(sw_contact *c, sw_contact_past_function past,
                       sw_contact_moves_function moves) {
  c->busy_count = 0;
  for (size_t o = 0; o < c->count; o++) {
    const sw_contact_past *own = past(c->user, c->obstacles[o].id);
    c->loads[o] = (sw_contact_loads){.past = *own, .resting = c->loads[o].resting};
    if (remembers(own)) sw_contact_expect(c, (int)o);
  }
  sw_broad_know(&c->broad, c, moves);
  c->informed = 1;
}

void sw_contact_ask_again(sw_contact *c) {
  c->informed = 0;
  sw_broad_forget(&c->broad);
}
