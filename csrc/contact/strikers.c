/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "contact/strikers.h"

/* A wire rests on an obstacle if its pressing force changes in the step by no more than this share
 * of its usual force [-]. */
static const double CALM = 0.1;

/* Begins with a wire, unless it is the one looked at already. */
static sw_strikers *look_at(sw_contact *c, size_t obstacle, size_t body) {
  sw_strikers *l = &c->loads[obstacle].strikers;
  if (l->looked != body + 1) l->from = l->to = sw_v(0, 0, 0), l->looked = body + 1;
  return l;
}

/* Adds the loads of a body at the step's start, from memory number m on. Returns the number of the
 * first memory that is left. */
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

/* Counts a wire among the strikers or among those that rest. */
static void judge(sw_strikers *l, double usual) {
  const int lies = sw_norm2(l->from) > 0 && sw_norm2(l->to) > 0;
  l->all += usual;
  if (lies && sw_dist(l->from, l->to) <= CALM * usual)
    l->rest_start = sw_add(l->rest_start, l->from), l->rest_end = sw_add(l->rest_end, l->to);
  else
    l->usual += usual;
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
  for (size_t i = 0, first = 0, m = 0; i < c->touch_count; first = i) {
    const size_t body = c->touches[i].body;
    const double usual = sw_contact_usual_force(s, s->bodies[body].plan);
    m = add_start(c, s, body, m);
    for (; i < c->touch_count && c->touches[i].body == body; i++) {
      const sw_press *press = &c->touches[i].press;
      sw_strikers *l = look_at(c, (size_t)c->touches[i].obstacle, body);
      l->to = sw_madd(l->to, press->normal, -press->normal_force);
    }
    for (size_t k = first; k < i; k++) {
      sw_strikers *l = &c->loads[c->touches[k].obstacle].strikers;
      if (l->looked == body + 1) judge(l, usual);
    }
  }
  for (size_t i = 0; i < c->busy_count; i++) {
    sw_strikers *l = &c->loads[c->busy[i]].strikers;
    const sw_vec waits = c->loads[c->busy[i]].resting.force;
    if (l->usual > 0) continue;
    *l = (sw_strikers){.usual = l->all, .rest_start = waits, .rest_end = waits};
  }
}
