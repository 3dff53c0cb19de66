/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Puts the touches of waiting bodies aside, and puts them back (wait.h). */
#include "contact/wait.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "contact/broad.h"
#include "contact/depth.h"
#include "contact/touch.h"
#include "system/wait.h"

/* A wire is disturbed by anything that is, or may come, nearer than this many radii [-]. */
static const double NEAR = 2.0;

static sw_bounds box_of(const sw_system *s, const sw_body *b) {
  const double *x = s->x + 3 * b->first_node;
  sw_bounds box = {sw_vec_at(x, 0), sw_vec_at(x, 0)};
  for (size_t i = 1; i < b->plan->nodes; i++) {
    const sw_vec p = sw_vec_at(x, i);
    box.min = sw_v(fmin(box.min.x, p.x), fmin(box.min.y, p.y), fmin(box.min.z, p.z));
    box.max = sw_v(fmax(box.max.x, p.x), fmax(box.max.y, p.y), fmax(box.max.z, p.z));
  }
  return box;
}

static int may_be_disturbed(const sw_contact *c, const sw_system *s, const sw_body *b) {
  const sw_broad *all = &c->broad;
  if (!all->mover_count && !c->pad_count) return 0;
  const sw_bounds box = box_of(s, b);
  const double reach =
      NEAR * b->plan->beam.radius + sw_flight_reserve(c, s, sw_v(0, 0, 0)) + SW_FLIGHT_LEAST;
  for (size_t k = 0; k < all->mover_count; k++)
    if (sw_broad_disturbs(c, (size_t)all->mover[k], &box, reach)) return 1;
  for (size_t k = 0; k < c->pad_count; k++)
    if (sw_broad_disturbs(c, (size_t)c->pads[k], &box, reach)) return 1;
  return 0;
}

typedef struct list {
  sw_touch *touches;
  size_t count;
} list;

/* Returns the body's touches. *at: number of the first one to check; it is updated. */
static list touches_of(const sw_body *b, sw_touch *all, size_t count, size_t *at) {
  const size_t first = b->first_node, end = first + b->plan->nodes;
  while (*at < count && all[*at].node < first) ++*at;
  const size_t from = *at;
  while (*at < count && all[*at].node < end) ++*at;
  return (list){all + from, *at - from};
}

/* 1 if a wire is on its way out of an obstacle: its touches change in each step. */
static int comes_out(const sw_touch *t) { return t->forgiven > 0 || t->let_out > 0; }

static int any_comes_out(const list *l) {
  for (size_t i = 0; i < l->count; i++)
    if (comes_out(&l->touches[i])) return 1;
  return 0;
}

/* 1 if a touch becomes softer from step to step after a blow: its wire still sinks. */
static int eases(const sw_contact *c, const sw_system *s, const sw_touch *t) {
  return sw_press_eases(&t->press, t->usual, t->stiffer, sw_contact_deepest(c, s, t));
}

void sw_contact_keep_moving(const sw_contact *c, sw_system *s) {
  SW_ITEMS(const sw_touch, t, c->touches, c->touch_count) {
    sw_body *b = &s->bodies[t->body];
    if (b->stops) b->stops = !comes_out(t) && !eases(c, s, t);
  }
}

static void add_load(sw_contact *c, const sw_touch *t) {
  const sw_vec f = sw_neg(sw_press_borne(&t->press, t->friction));
  sw_contact_load *to = &c->loads[t->obstacle].resting;
  if (!t->press.active && !t->press.opened) return;
  to->force = sw_add(to->force, f);
  to->moment = sw_add(to->moment, sw_touch_moment(t, c->start[t->obstacle].pivot, f));
}

/* Loads of the touches set aside, and their sums. */
static void load_obstacles(sw_contact *c) {
  const sw_contact_load none = {.force = {.x = 0}};
  sw_still *still = &c->still;
  still->deepest = 0;
  for (size_t o = 0; o < c->count; o++) c->loads[o].resting = none;
  SW_ITEMS(const sw_touch, t, still->list, still->count) {
    const double depth = sw_touch_depth(t);
    add_load(c, t);
    if (depth > still->deepest) still->deepest = depth, still->deepest_node = t->node;
  }
  still->sums = sw_presses_sums(SW_PRESSES(sw_touch, still->list, still->count));
}

void sw_contact_forget_still(sw_contact *c) {
  if (!c->still.count && !c->still.any) return;
  c->still.count = 0, c->still.any = 0;
  memset(c->still.kept, 0, c->still.bodies * sizeof *c->still.kept);
  load_obstacles(c);
}

/* Makes room for one flag per body; 0: out of memory, and nothing waits. */
static int has_room(sw_contact *c, size_t bodies) {
  if (c->still.bodies == bodies) return 1;
  sw_contact_forget_still(c);
  sw_free(c->still.kept);
  c->still.kept = sw_alloc(bodies, sizeof *c->still.kept);
  c->still.bodies = c->still.kept ? bodies : 0;
  return c->still.kept != NULL;
}

sw_status sw_contact_wake(sw_contact *c, sw_system *s, sw_error *err) {
  size_t at = 0;
  if (!has_room(c, s->body_count)) return sw_fail(err, SW_ENOMEM, "contact: out of memory");
  sw_broad_bound_movers(c);
  for (size_t b = 0; b < s->body_count; b++) {
    sw_body *body = &s->bodies[b];
    if (body->waits && may_be_disturbed(c, s, body)) body->waits = 0;
    if (!body->waits || c->still.kept[b]) continue;
    const list l = touches_of(body, c->touches, c->touch_count, &at);
    if (!c->still.accepted || any_comes_out(&l)) body->waits = 0;
  }
  return SW_OK;
}

/* 1 if the touch's body waits and its touches are not in the list yet. */
static int begins(const sw_contact *c, const sw_system *s, const sw_touch *t) {
  return s->bodies[t->body].waits && !c->still.kept[t->body];
}

/* Removes the touches of bodies that do not wait any more. */
static void leave_out(sw_still *still, const sw_system *s) {
  size_t left = 0;
  for (size_t i = 0; i < still->count; i++) {
    if (!s->bodies[still->list[i].body].waits) continue;
    if (left < i) still->list[left] = still->list[i];
    left++;
  }
  still->count = left;
}

/* Makes room for so many touches. If most touches wait from now on, the list takes the memory of
 * the previous iterate's list, which has no use between steps: to write to new memory takes longer
 * than to copy. */
static sw_status make_room(sw_contact *c, size_t need) {
  sw_still *still = &c->still;
  if (need <= still->capacity) return SW_OK;
  if (need > c->last_capacity || 2 * need < c->touch_count)
    return SW_GROW(still->list, still->capacity, need);
  if (still->count) memcpy(c->last, still->list, still->count * sizeof *c->last);
  SW_SWAP(c->last, still->list);
  SW_SWAP(c->last_capacity, still->capacity);
  c->last_count = 0;
  return SW_OK;
}

/* Puts aside the touches of the waiting bodies: those that begin to wait are merged into the list,
 * from its end. */
static sw_status set_aside(sw_contact *c, const sw_system *s) {
  sw_still *still = &c->still;
  size_t more = 0;
  for (size_t i = 0; i < c->touch_count; i++) more += begins(c, s, &c->touches[i]) != 0;
  SW_TRY(make_room(c, still->count + more));
  leave_out(still, s);
  size_t left = still->count, to = still->count += more;
  for (size_t tail = c->touch_count; more; tail--) {
    const sw_touch *t = &c->touches[tail - 1];
    if (!begins(c, s, t)) continue;
    while (left && still->list[left - 1].node > t->node) still->list[--to] = still->list[--left];
    still->list[--to] = *t, more--;
  }
  still->any = 0;
  for (size_t b = 0; b < s->body_count; b++) {
    if (!still->kept[b]) s->bodies[b].weighed = 0;
    still->kept[b] = s->bodies[b].waits != 0;
    still->any |= still->kept[b];
  }
  load_obstacles(c);
  return SW_OK;
}

int sw_contact_all_wait(const sw_contact *c, const sw_system *s) {
  if (!c->still.any || c->touch_count) return 0;
  for (size_t b = 0; b < s->body_count; b++)
    if (!c->still.kept[b]) return 0;
  return 1;
}

sw_status sw_contact_wait(sw_contact *c, sw_system *s) {
  if (c->regime != SW_CONTACT_IMPLICIT || !has_room(c, s->body_count)) {
    for (size_t b = 0; b < s->body_count; b++) s->bodies[b].waits = 0;
    sw_contact_forget_still(c);
  } else if ((s->waiting || c->still.any) && !sw_waits_are(s, c->still.kept)) {
    SW_TRY(set_aside(c, s));
  }
  c->still.accepted = 0;
  for (size_t o = 0; c->still.any && o < c->count; o++)
    if (sw_norm2(c->loads[o].resting.force) > 0) sw_contact_expect(c, (int)o);
  return SW_OK;
}

void sw_still_free(sw_still *still) {
  sw_free(still->list);
  sw_free(still->kept);
}

sw_status sw_contact_put_back(sw_contact *c) {
  const size_t all = c->touch_count + c->still.count;
  if (!c->still.count) return SW_OK;
  SW_TRY(SW_GROW(c->touches, c->touch_capacity, all));
  for (size_t to = all, left = c->touch_count, tail = c->still.count; tail;) {
    const int other = left && c->touches[left - 1].node > c->still.list[tail - 1].node;
    c->touches[--to] = other ? c->touches[--left] : c->still.list[--tail];
  }
  c->touch_count = all;
  sw_contact_forget_still(c);
  return SW_OK;
}
