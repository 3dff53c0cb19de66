/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of touches of an iterate and of the previous one, of all bodies or of the part (group of
 * bodies) that is solved now. In a stage that is solved by parts, touches of finished parts stay in
 * the list and those of the current part are its tail; the previous list begins with the touches of
 * the previous stage. */
#include <string.h>

#include "base/alloc.h"
#include "contact/touch.h"

/* Matches a candidate with its touches of the previous iterate, from number i on; both are in the
 * same order. Returns the first touch that is left. */
static size_t match_one(const sw_contact *c, sw_candidate *k, size_t i) {
  k->last = i;
  while (i < c->last_count && c->last[i].node == k->node && c->last[i].obstacle == k->obstacle &&
         c->last[i].segment == k->segment)
    i++;
  return k->last_end = i;
}

/* The same for candidates from first to end. */
static size_t match(sw_contact *c, size_t first, size_t end, size_t i) {
  for (size_t n = first; n < end; n++) i = match_one(c, &c->candidates[n], i);
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

void sw_contact_part(void *contact, sw_system *s) {
  sw_contact *c = contact;
  if (s->part_end - s->part == s->body_count) {
    c->parts = (sw_contact_parts){.on = 0};
    return;
  }
  if (!c->parts.on) {
    swap_lists(c);
    c->parts = (sw_contact_parts){.on = 1, .before = c->last_count};
  }
  sw_contact_parts *p = &c->parts;
  p->first = p->end;
  while (p->end < c->candidate_count && c->candidates[p->end].body < s->part_end) p->end++;
  p->touch = c->touch_count;
  p->matched = match(c, p->first, p->end, p->matched);
  p->begun = 0;
  c->pressed_before = c->pressed_count;
  c->updates = c->looked = 0;
}

/* The touches of the current part become those of the previous iterate. */
static sw_status turn_tail_over(sw_contact *c) {
  const size_t count = c->touch_count - c->parts.touch, at = c->parts.before;
  SW_TRY(sw_grow((void **)&c->last, &c->last_capacity, at + count, sizeof *c->last));
  if (count) memcpy(c->last + at, c->touches + c->parts.touch, count * sizeof *c->last);
  c->last_count = at + count;
  c->touch_count = c->parts.touch;
  (void)match(c, c->parts.first, c->parts.end, at);
  return SW_OK;
}

sw_status sw_contact_turn_over(sw_contact *c, sw_glance *at) {
  *at = (sw_glance){.end = c->candidate_count};
  if (!c->parts.on) {
    swap_lists(c);
    return SW_OK;
  }
  at->next = c->parts.first;
  at->match = at->end = c->parts.end;
  if (c->parts.begun) return turn_tail_over(c);
  c->parts.begun = 1;
  return SW_OK;
}
