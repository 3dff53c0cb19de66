/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact with obstacles: creation, steps, read-outs. */
#include "contact/contact.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "base/halving.h"
#include "contact/curve.h"
#include "touch/tally.h"

sw_status sw_contact_new(const sw_contact_obstacle *obstacles, size_t count, sw_contact_place place,
                         void *user, sw_contact **out) {
  sw_contact *c = sw_alloc(1, sizeof *c);
  if (!c) return SW_ENOMEM;
  const sw_status status =
      SW_ALLOC_ALL(SW_ROOM(c->obstacles, count), SW_ROOM(c->loads, count), SW_ROOM(c->start, count),
                   SW_ROOM(c->now, count), SW_ROOM(c->before, count), SW_ROOM(c->flat, 9 * count),
                   SW_ROOM(c->spaced, 4 * count), SW_ROOM(c->bounds, count));
  if (status != SW_OK || sw_broad_new(&c->broad, count) != SW_OK) {
    sw_contact_free(c);
    return SW_ENOMEM;
  }
  c->dense = c->flat + count, c->busy = c->dense + count, c->pads = c->busy + count;
  c->pressing = c->pads + count, c->straight = c->pressing + count;
  c->sharp = c->straight + count, c->wound = c->sharp + count, c->curved = c->wound + count;
  c->round = c->spaced + count, c->facet = c->round + count;
  c->facet_radius = c->facet + count;
  memcpy(c->obstacles, obstacles, count * sizeof *obstacles);
  for (size_t o = 0; o < count; o++) {
    c->flat[o] = sw_shape_is(obstacles[o].shape, SW_SHAPE_FLAT);
    c->straight[o] = sw_shape_is(obstacles[o].shape, SW_SHAPE_SQUARE);
    c->sharp[o] = sw_shape_has_edges(obstacles[o].shape);
    c->open_count += sw_shape_is_open(obstacles[o].shape) != 0;
    c->slick_count += obstacles[o].kinetic < obstacles[o].friction;
    sw_vec q, along;
    if (obstacles[o].grips > 0) continue;
    c->round[o] = sw_shape_middle(obstacles[o].shape, sw_v(0, 0, 0), &q, &along);
    c->facet[o] = sw_shape_facet(obstacles[o].shape, &c->facet_radius[o]);
  }
  for (size_t o = 0; o < count; o++)
    if (obstacles[o].grips > 0) c->pads[c->pad_count++] = (int)o;
  c->count = count;
  c->fresh = SW_CONTACT_FRESH;
  c->place = place;
  c->user = user;
  *out = c;
  return SW_OK;
}

sw_status sw_contact_copy(const sw_contact *c, sw_contact **out) {
  const size_t bytes = c->memory_count * sizeof *c->memory;
  SW_TRY(sw_contact_new(c->obstacles, c->count, c->place, c->user, out));
  const sw_status status = sw_contact_set_memory(*out, c->memory, bytes, c->fresh);
  if (status == SW_OK) return SW_OK;
  sw_contact_free(*out);
  *out = NULL;
  return status;
}

void sw_contact_keep(sw_contact *c, const size_t *ids, size_t count) {
  for (size_t o = 0; o < c->count; o++) {
    c->obstacles[o].off = 1;
    for (size_t k = 0; k < count; k++)
      if (ids[k] == (size_t)c->obstacles[o].id) c->obstacles[o].off = 0;
  }
}

void sw_contact_slip(sw_contact *c) {
  for (size_t o = 0; o < c->count; o++)
    if (!(c->obstacles[o].grips > 0)) c->obstacles[o].friction = c->obstacles[o].kinetic = 0;
}

void sw_contact_free(sw_contact *c) {
  if (!c) return;
  SW_FREE_ALL(c->obstacles, c->loads, c->start, c->now, c->before, c->flat, c->sunk, c->spaced,
              c->bounds, c->candidates, c->touches, c->last, c->memory, c->next_memory, c->pressed,
              c->turns, c->barriers, c->impacts, c->impact_at, c->marks, c->room, c->reach,
              c->ahead, c->ranges, c->singles.first, c->strikes);
  sw_broad_free(&c->broad);
  sw_still_free(&c->still);
  sw_free(c);
}

/* --- steps ------------------------------------------------------------------- */

/* Finds the pads that press on anything at the step's start. */
static void find_pressing(sw_contact *c) {
  for (size_t k = 0; k < c->pad_count; k++) c->pressing[c->pads[k]] = 0;
  for (size_t i = 0; c->pad_count && i < c->memory_count; i++) {
    const size_t o = sw_contact_index(c, c->memory[i].obstacle);
    if (o < c->count && c->memory[i].kept.normal_force > 0) c->pressing[o] = 1;
  }
}

sw_status sw_contact_open(sw_contact *c, double t, double h, sw_error *err) {
  c->time = t;
  c->h = h;
  return sw_broad_place(c, t, c->start, err);
}

sw_status sw_contact_begin_step(sw_contact *c, sw_system *s, sw_contact_regime regime,
                                double nominal, sw_error *err) {
  c->nominal = c->asked = nominal, c->brakes = c->adaptive = 0;
  c->regime = regime;
  c->pressed_count = 0;
  c->plastic = c->hasty = c->careful = 0;
  c->parts = (sw_contact_parts){.on = 0};
  c->struck = 0;
  c->widening = 1.0;
  sw_contact_forget_blows(c);
  if (sw_contact_calm(c, s->nodes) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "contact: out of memory");
  find_pressing(c), sw_contact_find_carried(c, s);
  if (sw_contact_sink(c, s) != SW_OK) return sw_fail(err, SW_ENOMEM, "contact: out of memory");
  return sw_contact_find_candidates(c, s, err);
}

sw_status sw_contact_begin_look(sw_contact *c, sw_system *s, double t, sw_error *err) {
  SW_TRY(sw_contact_open(c, t, 0, err));
  SW_TRY(sw_contact_begin_step(c, s, SW_CONTACT_STATIC, 0, err));
  for (size_t i = 0; i < c->memory_count; i++) sw_kept_as_felt(&c->memory[i].kept);
  return SW_OK;
}

sw_status sw_contact_begin_stage(sw_contact *c, double time, double first, sw_error *err) {
  c->stage++;
  c->first = first;
  c->pressed_before = c->pressed_count;
  c->stage_time = time;
  c->updates = c->looked = c->passes = c->softer = c->made = 0;
  c->ahead_count = 0;
  c->parts = (sw_contact_parts){.on = 0};
  for (size_t k = 0; k < c->broad.mover_count; k++)
    c->before[c->broad.mover[k]] = c->now[c->broad.mover[k]].pose.q;
  return sw_broad_place(c, time, c->now, err);
}

/* --- read-outs ---------------------------------------------------------------- */

/* Touch number k: first those of wires that are solved, then those of wires that wait. */
static const sw_touch *touch_at(const sw_contact *c, size_t k) {
  return k < c->touch_count ? &c->touches[k] : &c->still.list[k - c->touch_count];
}

void sw_contact_force(const sw_contact *c, int id, sw_vec about, sw_vec *force, sw_vec *moment) {
  *force = *moment = sw_v(0, 0, 0);
  for (size_t i = 0; i < sw_contact_touches(c); i++) {
    const sw_touch *t = touch_at(c, i);
    if (c->obstacles[t->obstacle].id != id || !(t->press.normal_force > 0)) continue;
    const sw_vec f = sw_neg(sw_madd(t->press.tangential, t->press.normal, t->press.normal_force));
    *force = sw_add(*force, f);
    *moment = sw_add(*moment, sw_touch_moment(t, about, f));
  }
}

double sw_touch_arc(const sw_system *s, const sw_touch *t) {
  const sw_body *b = &s->bodies[t->body];
  const sw_plan *p = b->plan;
  const size_t a = t->node - b->first_node, e = t->other - b->first_node;
  const double *arc = p->web ? p->web->s : p->s;
  return arc[a] + t->at * (arc[e] - arc[a]) - (p->web ? 0.0 : arc[0]);
}

double sw_contact_penetration(const sw_contact *c, size_t *node) {
  double deepest = 0;
  for (size_t i = 0; i < c->touch_count; i++) {
    const double depth = sw_touch_depth(&c->touches[i]);
    if (depth <= deepest) continue;
    deepest = depth;
    if (node) *node = c->touches[i].node;
  }
  if (c->still.deepest <= deepest) return deepest;
  if (node) *node = c->still.deepest_node;
  return c->still.deepest;
}

sw_presses sw_contact_presses(const sw_contact *c) {
  return SW_PRESSES(sw_touch, c->touches, c->touch_count);
}

sw_presses sw_contact_still_presses(const sw_contact *c) {
  sw_presses list = SW_PRESSES(sw_touch, c->still.list, c->still.count);
  list.known = &c->still.sums;
  return list;
}

size_t sw_contact_touches(const sw_contact *c) { return c->touch_count + c->still.count; }

/* Returns the first touch at or after this node. Touches are in the order of nodes. */
static size_t first_touch(const sw_touch *touches, size_t count, size_t node) {
  size_t i;
  SW_FIRST_NOT(touches[i].node < node, i, 0, count);
  return i;
}

/* All nodes must be of one body. */
void sw_contact_touches_of(const sw_contact *c, size_t node, size_t end_node, size_t *first,
                           size_t *end) {
  *first = first_touch(c->touches, c->touch_count, node);
  *end = first_touch(c->touches, c->touch_count, end_node);
  if (*end > *first || !c->still.count) return;
  *first = c->touch_count + first_touch(c->still.list, c->still.count, node);
  *end = c->touch_count + first_touch(c->still.list, c->still.count, end_node);
}

int sw_contact_pusher(const sw_contact *c, size_t k) {
  const sw_touch *t = touch_at(c, k);
  return t->press.normal_force > 0 ? c->obstacles[t->obstacle].id : -1;
}

int sw_contact_slides(const sw_contact *c, size_t k, double least) {
  const sw_touch *t = touch_at(c, k);
  return t->press.normal_force > 0 && t->friction > 0 && sw_norm(t->press.slip) > least;
}

int sw_contact_push_at(const sw_contact *c, const sw_system *s, size_t k, sw_contact_push *out) {
  const sw_touch *t = touch_at(c, k);
  const sw_press *p = &t->press;
  *out = (sw_contact_push){.obstacle = c->obstacles[t->obstacle].id,
                           .node = t->node,
                           .other = t->other,
                           .at = fmin(fmax(t->at, 0.0), 1.0),
                           .normal_force = p->normal_force,
                           .friction = t->friction,
                           .normal = p->normal,
                           .slip = p->slip,
                           .slides = p->next_sliding != 0,
                           .point = t->point,
                           .acts = t->acts,
                           .place = sw_touch_arc(s, t),
                           .slid = t->slid + sw_norm(p->slip),
                           .force = sw_madd(p->tangential, p->normal, p->normal_force)};
  return p->normal_force > 0;
}

int sw_contact_may_press(const sw_contact *c, size_t body, double force) {
  return !c->still.any || !c->still.kept[body] || c->still.sums.hardest > force;
}

double sw_contact_largest_push(const sw_contact *c, size_t first, size_t end) {
  double most = 0;
  for (size_t k = first; k < end; k++) most = fmax(most, touch_at(c, k)->press.normal_force);
  return most;
}

/* --- for the energy ledger ------------------------------------------------------ */

sw_status sw_contact_began(sw_contact *c, double t, sw_error *err) {
  return c->time > t || c->time < t ? sw_broad_place(c, t, c->start, err) : SW_OK;
}

int sw_contact_poses(const sw_contact *c, int id, sw_pose *from, sw_pose *to) {
  const size_t o = sw_contact_index(c, id);
  if (o == c->count) return 0;
  *from = c->start[o].pose, *to = c->now[o].pose;
  return 1;
}

double sw_contact_hardened(const sw_contact *c) {
  double sum = 0;
  if (!c->hardens) return 0;
  for (size_t i = 0; i < c->touch_count; i++) sum += c->touches[i].hardened;
  return sum;
}

/* Work on wires round an obstacle that bend less than at the step's start: the arc comes nearer to
 * the chord (contact/arc.h). The wire did this work before, while it bent more. */
double sw_contact_unbent(const sw_contact *c) {
  double sum = 0;
  if (!c->falls) return 0;
  for (size_t i = 0; i < c->touch_count; i++)
    sum += c->touches[i].fallen * c->touches[i].press.normal_force;
  return sum;
}

double sw_contact_fastest(const sw_contact *c) {
  double fastest = 0;
  for (size_t k = 0; k < c->broad.mover_count; k++)
    fastest = fmax(fastest, sw_norm(c->now[c->broad.mover[k]].v));
  return fastest;
}

/* 1 if anything is deeper in an obstacle than its force explains. */
static int emerges(const sw_contact *c) {
  for (size_t i = 0; i < c->touch_count; i++)
    if (c->touches[i].forgiven > 0 || c->touches[i].let_out > 0) return 1;
  for (size_t i = 0; i < c->pressed_count; i++)
    if (c->pressed[i].let_out > 0) return 1;
  return 0;
}

int sw_contact_emerges(const sw_contact *c) { return c->fresh && emerges(c); }

/* Wires squeezed by two obstacles do not count: they cannot come out of either. */
double sw_contact_emerged(const sw_contact *c) {
  double sum = 0;
  if (!sw_contact_emerges(c)) return 0;
  SW_ITEMS(const sw_touch, t, c->touches, c->touch_count) {
    if (t->let_out > 0 && !(t->squeezed && sw_contact_is_pinched(c, t)))
      sum += t->let_out * t->press.normal_force;
  }
  return sum;
}

int sw_contact_steady(const sw_contact *c) {
  size_t before = 0, now = c->still.sums.pressing;
  for (size_t i = 0; i < c->memory_count; i++) before += c->memory[i].kept.normal_force > 0;
  for (size_t i = 0; i < c->touch_count; i++) {
    if (!(c->touches[i].press.normal_force > 0)) continue;
    if (!c->touches[i].known) return 0;
    now++;
  }
  return before == now && !c->impact_count && !c->plastic;
}

void sw_contact_cut(sw_contact *c, double least) { c->least = least; }
void sw_contact_brake(sw_contact *c) { c->brakes = 1; }
void sw_contact_ask(sw_contact *c, double part, int adaptive) {
  c->asked = fmin(c->nominal, part), c->adaptive = adaptive;
}
double sw_contact_soonest(const sw_contact *c) { return c->soonest; }
size_t sw_contact_impacts(const sw_contact *c) { return c->impact_count; }
double sw_contact_struck(const sw_contact *c) { return c->struck; }
