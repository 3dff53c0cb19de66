/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory of contact with obstacles between steps. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "contact/curve.h"
#include "contact/depth.h"

/* The normal force in friction is a mean over this many steps, because the pressure of chords round
 * a peg changes from step to step. The swing of a wire through a ring (spec/shape/torus_spec) is
 * three times as sensitive to rounding with half as many steps, four times with one step, and no
 * better with twice as many [-]. */
static const double MEAN_STEPS = 8.0;

static double steady_force(const sw_contact *c, const sw_system *s, const sw_touch *t) {
  if (t->sharp && t->sharp != SW_SHARP_ROUND) return sw_contact_steady_force(s, t, c->h);
  return t->steady + (t->press.normal_force - t->steady) / MEAN_STEPS;
}

/* Stiffness to which a touch returns where it presses less [N/m]. That of a mesh stays in statics.
 * Otherwise parts pressed together in steps of motion would come apart a little in every search,
 * and the force of the jaws that hold them would fall. */
static double goes_back_to(const sw_contact *c, const sw_system *s, const sw_touch *t) {
  const int stays = c->regime == SW_CONTACT_STATIC && s->bodies[t->body].plan->web;
  return stays ? fmax(t->usual, t->press.k) : t->usual;
}

/* Stiffness that is no longer needed decreases per step, in shorter steps than this per time. Parts
 * of fixed steps are rarely shorter; steps of a tight tolerance are. By the size of the step itself
 * a soft wire in pads sprang when it was thawed (spec/physics/mixed_narrow_spec) [s]. */
static const double FULL = 1e-4;

static sw_status remember(sw_contact *c, const sw_system *s, const sw_touch *t, int holds) {
  const sw_contact_at *o = &c->now[t->obstacle];
  sw_touch_fetch(t, SW_FETCH_ALL);
  const sw_quat back = sw_quat_conj(o->pose.q);
  const double deepest = sw_contact_deepest(c, s, t);
  const double share = c->regime == SW_CONTACT_IMPLICIT ? c->h / FULL : 1.0;
  SW_TRY(SW_GROW(c->next_memory, c->next_capacity, c->next_count + 1));
  sw_memory *m = &c->next_memory[c->next_count++];
  *m = (sw_memory){
      .obstacle = c->obstacles[t->obstacle].id,
      .segment = t->segment,
      .node = t->node,
      .feature = t->feature,
      .at = t->at,
      .rise = t->rise,
      .kept = sw_press_keep(&t->press, goes_back_to(c, s, t), t->stiffer, deepest, share),
      .normal = sw_rotate(back, t->press.normal),
      .point = t->local,
      .seen = t->seen};
  m->kept.steady = steady_force(c, s, t), m->kept.left = t->left;
  m->kept.edited = t->edited, m->kept.curve = c->candidates[t->candidate].smooth;
  if (t->squeezed && c->regime == SW_CONTACT_IMPLICIT && !sw_contact_is_pinched(c, t))
    sw_kept_harden(&m->kept, sw_contact_edge_stiffness(s, t->body, t->node), deepest);
  if (holds) sw_kept_hold_slide(&m->kept, &t->press, t->known);
  if (!(m->kept.normal_force > 0)) return SW_OK;
  m->slid = holds ? t->slid : t->slid + sw_norm(t->press.slip);
  m->kept.elastic = sw_rotate(back, m->kept.elastic);
  return SW_OK;
}

/* Copies the memory of a waiting body, from number m on. Returns the next number. */
static size_t carry_over(sw_contact *c, const sw_body *b, size_t m) {
  const size_t end = b->first_node + b->plan->nodes;
  while (m < c->memory_count && c->memory[m].node < b->first_node) m++;
  for (; m < c->memory_count && c->memory[m].node < end; m++) {
    if (SW_GROW(c->next_memory, c->next_capacity, c->next_count + 1) == SW_OK)
      c->next_memory[c->next_count++] = c->memory[m];
  }
  return m;
}

static void swap_memories(sw_contact *c) {
  SW_SWAP(c->memory, c->next_memory);
  SW_SWAP(c->memory_capacity, c->next_capacity);
}

void sw_contact_commit(sw_contact *c, sw_system *s, int holds) {
  c->next_count = 0;
  c->fresh = sw_contact_emerges(c) ? SW_CONTACT_EMERGING : 0;
  sw_contact_conclude(c, s);
  c->still.accepted = 1;
  if (sw_contact_all_wait(c, s)) return; /* their memory stays as it is */
  if (!c->still.any) swap_memories(c);   /* nothing is carried over: one list is enough */
  (void)SW_GROW_EMPTY(c->next_memory, c->next_capacity, c->touch_count);
  for (size_t b = 0, i = 0, m = 0; b < s->body_count; b++) {
    if (c->still.any && c->still.kept[b]) m = carry_over(c, &s->bodies[b], m);
    for (; i < c->touch_count && c->touches[i].body == b; i++)
      (void)remember(c, s, &c->touches[i], holds); /* a lost anchor starts anew */
  }
  swap_memories(c);
  c->memory_count = c->next_count;
}

double sw_contact_slid(const sw_contact *c) {
  double most = 0;
  for (size_t i = 0; i < c->memory_count; i++) most = fmax(most, c->memory[i].slid);
  return most;
}

const void *sw_contact_memory(const sw_contact *c, size_t *bytes) {
  *bytes = c->memory_count * sizeof *c->memory;
  return c->memory;
}

int sw_contact_is_fresh(const sw_contact *c) { return c->fresh; }

sw_status sw_contact_set_memory(sw_contact *c, const void *memory, size_t bytes, int fresh) {
  const size_t n = bytes / sizeof *c->memory;
  SW_TRY(SW_FILL(c->memory, c->memory_capacity, memory, n));
  c->memory_count = n;
  c->fresh = fresh;
  c->touch_count = 0;
  c->still.accepted = 0;
  sw_contact_forget_still(c);
  sw_contact_ask_again(c);
  return SW_OK;
}

size_t sw_contact_layout(void) { return 4096 * sizeof(sw_memory) + sizeof(sw_touch); }

const void *sw_contact_seen(sw_contact *c, size_t *bytes) {
  if (sw_contact_put_back(c) != SW_OK) c->touch_count = 0, c->still.accepted = 0;
  *bytes = c->touch_count * sizeof *c->touches;
  return c->touches;
}

/* 1 if the touch's obstacle, body and nodes exist. */
static int is_possible(const sw_contact *c, const sw_system *s, const sw_touch *t) {
  if (t->obstacle < 0 || (size_t)t->obstacle >= c->count || t->body >= s->body_count) return 0;
  const sw_body *b = &s->bodies[t->body];
  const size_t first = b->first_node, end = first + b->plan->nodes;
  if (t->node < first || t->node >= end || t->other < first || t->other >= end) return 0;
  if (t->spot.count < 1 || t->spot.count > SW_MEAN_MOST) return 0;
  for (size_t i = 0; i < t->spot.count; i++)
    if (t->spot.node[i] < first || t->spot.node[i] >= end) return 0;
  return 1;
}

sw_status sw_contact_set_seen(sw_contact *c, const void *seen, size_t bytes, const sw_system *s) {
  const size_t n = bytes / sizeof *c->touches;
  c->touch_count = 0;
  if (bytes % sizeof *c->touches != 0) return SW_EINVAL;
  SW_TRY(SW_FILL(c->touches, c->touch_capacity, seen, n));
  for (size_t i = 0; i < n; i++)
    if (!is_possible(c, s, &c->touches[i])) return SW_EINVAL;
  c->touch_count = n;
  c->still.accepted = 1;
  return SW_OK;
}

int sw_contact_is_faceted(const sw_contact *c, size_t o) {
  return !c->sharp[o] && !c->flat[o] && !(c->round[o] > 0);
}

int sw_contact_on_facets(const sw_contact *c) {
  for (size_t i = 0; i < c->memory_count; i++) {
    const size_t o = sw_contact_index(c, c->memory[i].obstacle);
    if (c->memory[i].kept.normal_force > 0 && o < c->count && sw_contact_is_faceted(c, o)) return 1;
  }
  return 0;
}

int sw_contact_memory_fits(const void *memory, size_t bytes, size_t nodes, size_t obstacles) {
  const size_t count = bytes / sizeof(sw_memory);
  for (size_t i = 0; i < count; i++) {
    sw_memory m;
    memcpy(&m, (const char *)memory + i * sizeof m, sizeof m);
    if (m.node >= nodes || m.obstacle < 0 || (size_t)m.obstacle >= obstacles || m.segment < 0 ||
        !isfinite(m.at))
      return 0;
  }
  return bytes % sizeof(sw_memory) == 0;
}

int sw_contact_memory_names(const void *memory, size_t bytes, size_t node) {
  const sw_memory *m = memory;
  for (size_t i = 0; i < bytes / sizeof *m; i++)
    if (m[i].node == node || (m[i].segment && m[i].node + 1 == node)) return 1;
  return 0;
}

sw_status sw_contact_inherit(sw_contact *c, const void *memory, size_t bytes, int fresh,
                             const size_t *new_node, const size_t *new_edge) {
  size_t kept = 0;
  SW_TRY(sw_contact_set_memory(c, memory, bytes, fresh));
  for (size_t i = 0; i < c->memory_count; i++) {
    const size_t *now = c->memory[i].segment ? new_edge : new_node;
    const size_t node = now[c->memory[i].node];
    if (node == SIZE_MAX) continue;
    c->memory[kept] = c->memory[i];
    c->memory[kept++].node = node;
  }
  c->memory_count = kept;
  return SW_OK;
}

static int in_order(const void *a, const void *b) {
  const sw_memory *p = a, *q = b;
  if (p->node != q->node) return p->node < q->node ? -1 : 1;
  if (p->obstacle != q->obstacle) return p->obstacle < q->obstacle ? -1 : 1;
  if (p->segment != q->segment) return p->segment < q->segment ? -1 : 1;
  return (p->at > q->at) - (p->at < q->at);
}

void sw_contact_sort_memory(sw_contact *c) {
  if (c->memory_count) qsort(c->memory, c->memory_count, sizeof *c->memory, in_order);
}

sw_status sw_contact_add_memory(sw_contact *c, const void *memory, size_t bytes, size_t old_first,
                                size_t old_end, size_t new_first, const size_t *obstacles,
                                size_t count) {
  const sw_memory *from = memory;
  const size_t n = bytes / sizeof *from;
  SW_TRY(SW_GROW(c->memory, c->memory_capacity, c->memory_count + n));
  for (size_t i = 0; i < n; i++) {
    int wanted = 0;
    for (size_t k = 0; k < count; k++) wanted |= (size_t)from[i].obstacle == obstacles[k];
    if (!wanted || from[i].node < old_first || from[i].node >= old_end) continue;
    c->memory[c->memory_count] = from[i];
    c->memory[c->memory_count++].node += new_first - old_first;
  }
  sw_contact_sort_memory(c);
  c->fresh = 0;
  return SW_OK;
}
