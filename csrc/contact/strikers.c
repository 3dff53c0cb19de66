/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds wires that strike an obstacle and wires that rest on it, and the blow of each. */
#include "contact/strikers.h"

#include "base/alloc.h"

/* A wire rests on an obstacle if its pressing force changes in the step by no more than this share
 * of its usual force [-]. */
static const double CALM = 0.1;

/* --- forces of one wire -------------------------------------------------------------- */

static int are_several(const sw_contact *c) {
  return c->touch_count && c->touches[0].body != c->touches[c->touch_count - 1].body;
}

static sw_vec pressing_of(const sw_touch *t) {
  return sw_scale(t->press.normal, -t->press.normal_force);
}

static void keep_first(sw_contact *c) {
  sw_singles *k = &c->singles;
  k->count = 0;
  if (!are_several(c) || SW_GROW(k->first, k->capacity, c->touch_count) != SW_OK) return;
  for (size_t i = 0; i < c->touch_count; i++) {
    const sw_touch *t = &c->touches[i];
    if (!(t->press.normal_force > 0)) continue;
    k->first[k->count++] =
        (sw_pressing){.body = t->body, .obstacle = t->obstacle, .force = pressing_of(t)};
  }
}

/* As the obstacles' impulses are booked, but by weights: forces of single wires are only computed
 * if there may be a blow. */
void sw_contact_book_singles(sw_contact *c, const sw_booking *b) {
  const sw_weights one = c->singles.stage[0];
  const int later = b->stage > 0;
  c->singles.stage[b->stage] = (sw_weights){.start = b->first * one.start + b->start,
                                            .first = b->first * one.first + (later ? 0 : b->own),
                                            .later = later ? b->own : 0};
  if (!later && b->own != 0) keep_first(c);
}

/* Begins with a wire, unless it is the one looked at already. */
static sw_strikers *look_at(sw_contact *c, size_t obstacle, size_t body) {
  sw_strikers *l = &c->loads[obstacle].strikers;
  const sw_vec none = sw_v(0, 0, 0);
  if (l->looked != body + 1) l->from = l->to = l->first = l->kicks = none, l->looked = body + 1;
  return l;
}

/* Adds the loads of a body at the step's start, from memory number m on. Returns the next
 * number. */
static size_t add_start(sw_contact *c, const sw_system *s, size_t body, size_t m) {
  const size_t first = s->bodies[body].first_node, end = first + s->bodies[body].plan->nodes;
  while (m < c->memory_count && c->memory[m].node < first) m++;
  for (; m < c->memory_count && c->memory[m].node < end; m++) {
    const sw_memory *k = &c->memory[m];
    const size_t o = sw_contact_index(c, k->obstacle);
    if (o >= c->count) continue;
    sw_strikers *l = look_at(c, o, body);
    const sw_vec normal = sw_rotate(c->start[o].pose.q, k->normal);
    l->from = sw_madd(l->from, normal, -k->kept.normal_force);
  }
  return m;
}

/* The same for the loads after the first stage. */
static size_t add_first(sw_contact *c, size_t body, size_t n) {
  const sw_singles *k = &c->singles;
  while (n < k->count && k->first[n].body < body) n++;
  for (; n < k->count && k->first[n].body == body; n++) {
    sw_strikers *l = look_at(c, (size_t)k->first[n].obstacle, body);
    l->first = sw_add(l->first, k->first[n].force);
  }
  return n;
}

static void add_kicks(sw_contact *c, const sw_system *s, size_t body) {
  const size_t first = s->bodies[body].first_node, end = first + s->bodies[body].plan->nodes;
  for (size_t i = first; c->impact_count && i < end; i++)
    for (uint32_t k = c->impact_at[i]; k; k = c->impacts[k - 1].before) {
      sw_strikers *l = look_at(c, (size_t)c->impacts[k - 1].obstacle, body);
      l->kicks = sw_add(l->kicks, c->impacts[k - 1].kick);
    }
}

int sw_contact_look_at_next(sw_contact *c, const sw_system *s, sw_wire_look *at) {
  if (at->end >= c->touch_count) return 0;
  at->first = at->end;
  at->body = c->touches[at->first].body;
  at->memory = add_start(c, s, at->body, at->memory);
  at->pressing = add_first(c, at->body, at->pressing);
  add_kicks(c, s, at->body);
  for (; at->end < c->touch_count && c->touches[at->end].body == at->body; at->end++) {
    sw_strikers *l = look_at(c, (size_t)c->touches[at->end].obstacle, at->body);
    l->to = sw_add(l->to, pressing_of(&c->touches[at->end]));
  }
  return 1;
}

/* The weights of methods that use earlier steps do not add up to the step. */
sw_blow sw_contact_own_blow(const sw_contact *c, const sw_strikers *on, double usual) {
  const sw_weights w = c->singles.stage[c->last_stage];
  const double all = w.start + w.first + w.later;
  const sw_vec after = c->last_stage ? on->first : on->to;
  sw_vec sum = sw_madd(sw_scale(on->from, w.start), after, w.first);
  sum = sw_madd(sum, on->to, w.later);
  const sw_vec steady = all > 0 ? sw_scale(sum, 1.0 / all) : on->to;
  return (sw_blow){.mean = sw_madd(steady, on->kicks, 1.0 / c->h),
                   .start = on->from,
                   .end = on->to,
                   .usual = usual};
}

/* --- who strikes ----------------------------------------------------------------------- */

/* 1 if the wire looked at rests. A single wire on its obstacle may also strike and bounce between
 * the step's ends; this makes no difference, see sw_contact_find_strikers. */
static int rests(const sw_contact *c, const sw_strikers *l, double usual) {
  if (!(sw_norm2(l->from) > 0 && sw_norm2(l->to) > 0)) return 0;
  if (sw_dist(l->from, l->to) > CALM * usual) return 0;
  if (!c->singles.count || !(c->h > 0)) return 1;
  const sw_vec middle = sw_scale(sw_add(l->from, l->to), 0.5);
  return sw_dist(sw_contact_own_blow(c, l, usual).mean, middle) <= CALM * usual;
}

/* Counts a wire with the strikers or with the resting wires. */
static void judge(const sw_contact *c, sw_strikers *l, double usual) {
  l->all += usual;
  if (rests(c, l, usual))
    l->rest_start = sw_add(l->rest_start, l->from), l->rest_end = sw_add(l->rest_end, l->to);
  else
    l->usual += usual, l->count++;
  l->looked = 0;
}

void sw_contact_forget_strikers(sw_contact *c) {
  for (size_t i = 0; i < c->busy_count; i++)
    c->loads[c->busy[i]].strikers = (sw_strikers){.usual = 0};
}

void sw_contact_find_strikers(sw_contact *c, const sw_system *s) {
  for (size_t i = 0; i < c->busy_count; i++) {
    sw_contact_loads *l = &c->loads[c->busy[i]];
    const sw_vec waits = l->resting.force;
    l->strikers = (sw_strikers){.rest_start = waits, .rest_end = waits};
  }
  for (sw_wire_look w = {.first = 0}; sw_contact_look_at_next(c, s, &w);) {
    const double usual = sw_contact_usual_force(s, s->bodies[w.body].plan);
    for (size_t k = w.first; k < w.end; k++) {
      sw_strikers *l = &c->loads[c->touches[k].obstacle].strikers;
      if (l->looked == w.body + 1) judge(c, l, usual);
    }
  }
  for (size_t i = 0; i < c->busy_count; i++) {
    sw_strikers *l = &c->loads[c->busy[i]].strikers;
    const sw_vec waits = c->loads[c->busy[i]].resting.force;
    if (!l->count) *l = (sw_strikers){.usual = l->all, .rest_start = waits, .rest_end = waits};
  }
}
