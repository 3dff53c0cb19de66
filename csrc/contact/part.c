/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of touches of an iterate and of the previous one. The system may solve a stage in parts,
 * each with some of the bodies. Touches of finished parts stay in the list; those of the current
 * part are its tail. The previous list begins with the touches of the previous stage. The coupled
 * bodies are the last part; its touches are then sorted into those of the other bodies. */
#include "system/part.h"

#include <string.h>

#include "base/alloc.h"
#include "contact/touch.h"

/* Matches a candidate with its touches of the previous iterate, from number i on; both lists have
 * the same order. Returns the next touch. */
static size_t match_one(const sw_contact *c, sw_candidate *k, size_t i) {
  k->last = (uint32_t)i;
  while (i < c->last_count && c->last[i].node == k->node && c->last[i].obstacle == k->obstacle &&
         c->last[i].segment == k->segment) {
    sw_touch_fetch(&c->last[i], SW_FETCH_FORCE);
    i++;
  }
  k->last_end = (uint32_t)i;
  return i;
}

/* Matches all candidates of the part with touches from number i to end. Skips those of other
 * bodies. */
static size_t match(sw_contact *c, size_t i, size_t end) {
  for (size_t r = 0; r < c->parts.ranges; r++) {
    const sw_range *range = &c->ranges[r];
    const size_t body = c->candidates[range->first].body;
    while (i < end && c->last[i].body < body) i++;
    for (size_t n = range->first; n < range->end; n++) i = match_one(c, &c->candidates[n], i);
  }
  return i;
}

void sw_contact_match(const sw_contact *c, sw_glance *at) {
  const size_t beside = at->next ? c->candidates[at->next - 1].node + 1 : 0;
  for (; at->match < at->end; at->match++) {
    sw_candidate *k = &c->candidates[at->match];
    if (at->match >= at->next && k->node > beside) return;
    at->last = match_one(c, k, at->last);
  }
}

static void swap_lists(sw_contact *c) {
  SW_SWAP(c->touches, c->last);
  SW_SWAP(c->touch_capacity, c->last_capacity);
  c->last_count = c->touch_count, c->touch_count = 0;
}

/* Finds the candidates of the part's bodies, from the last body's on. */
static void find_ranges(sw_contact *c, const sw_system *s) {
  sw_contact_parts *p = &c->parts;
  size_t n = p->next;
  p->ranges = 0;
  SW_PART_EACH(s, b) {
    while (n < c->candidate_count && c->candidates[n].body < b) n++;
    const size_t first = n;
    while (n < c->candidate_count && c->candidates[n].body == b) n++;
    if (n > first) c->ranges[p->ranges++] = (sw_range){first, n};
  }
  p->next = n;
}

/* Moves the tail of the list to its places between the other touches, without additional memory. */
static void put_in_order_slowly(sw_contact *c) {
  for (size_t i = c->parts.touch; i < c->touch_count; i++) {
    const sw_touch t = c->touches[i];
    size_t to = i;
    for (; to > 0 && c->touches[to - 1].candidate > t.candidate; to--)
      c->touches[to] = c->touches[to - 1];
    c->touches[to] = t;
  }
}

/* As put_in_order_slowly, but faster: uses the memory of the previous list, which is not needed any
 * more. */
static void put_in_order(sw_contact *c) {
  size_t to = c->touch_count, left = c->parts.touch, tail = to - left;
  if (!tail || !left || c->touches[left - 1].candidate < c->touches[left].candidate) return;
  c->last_count = 0;
  if (SW_GROW(c->last, c->last_capacity, tail) != SW_OK) {
    put_in_order_slowly(c);
    return;
  }
  memcpy(c->last, c->touches + left, tail * sizeof *c->last);
  while (tail) {
    const int other = left && c->touches[left - 1].candidate > c->last[tail - 1].candidate;
    c->touches[--to] = other ? c->touches[--left] : c->last[--tail];
  }
}

void sw_contact_part(void *contact, sw_system *s) {
  sw_contact *c = contact;
  sw_contact_parts *p = &c->parts;
  if (!sw_part_is_single(s) && !s->group) {
    if (p->group) put_in_order(c);
    *p = (sw_contact_parts){.on = 0};
    return;
  }
  if (!p->on) {
    swap_lists(c);
    *p = (sw_contact_parts){.on = 1, .before = c->last_count};
  }
  if (s->group) p->group = 1, p->next = p->matched = 0;
  find_ranges(c, s);
  p->touch = c->touch_count;
  p->matched = match(c, p->matched, p->before);
  p->begun = 0;
  c->pressed_before = c->pressed_count;
  c->updates = c->looked = 0;
}

/* Makes the touches of the current part those of the previous iterate. */
static sw_status turn_tail_over(sw_contact *c) {
  const size_t count = c->touch_count - c->parts.touch, at = c->parts.before;
  SW_TRY(SW_GROW(c->last, c->last_capacity, at + count));
  if (count) memcpy(c->last + at, c->touches + c->parts.touch, count * sizeof *c->last);
  c->last_count = at + count;
  c->touch_count = c->parts.touch;
  (void)match(c, at, c->last_count);
  return SW_OK;
}

int sw_contact_next_range(const sw_contact *c, sw_glance *at) {
  if (++at->range >= c->parts.ranges) return 0;
  at->next = c->ranges[at->range].first;
  at->match = at->end = c->ranges[at->range].end;
  return 1;
}

sw_status sw_contact_turn_over(sw_contact *c, sw_glance *at) {
  *at = (sw_glance){.end = c->candidate_count};
  if (!c->parts.on) {
    swap_lists(c);
    return SW_OK;
  }
  at->range = SIZE_MAX; /* its next one is the first */
  at->end = 0;
  if (!sw_contact_next_range(c, at)) at->range = 0;
  if (c->parts.begun) return turn_tail_over(c);
  c->parts.begun = 1;
  return SW_OK;
}
