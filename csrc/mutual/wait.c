/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Touches between bodies that wait (system/wait.h). They are put aside as they were at the last
 * accepted state, like touches with obstacles (contact/wait.h); their memory stays unchanged. */
#include "system/wait.h"

#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "mutual/meet.h"

static int wait(const sw_system *s, const uint32_t body[2]) {
  return s->bodies[body[0]].waits && s->bodies[body[1]].waits;
}

static int were_kept(const sw_mutual *m, const uint32_t body[2]) {
  return m->still.kept[body[0]] && m->still.kept[body[1]];
}

void sw_mutual_forget_still(sw_mutual *m) {
  m->still.count = 0, m->still.any = 0;
  m->still.sums = (sw_press_sums){0};
  memset(m->still.kept, 0, m->bodies * sizeof *m->still.kept);
}

void sw_meets_free(sw_still_meets *still) {
  sw_free(still->list);
  sw_free(still->room);
  sw_free(still->kept);
}

/* 1 if wires that were placed in each other still come out: their touches change in each step. */
static int come_out(const sw_meet *t) { return t->let_out > 0 || t->emerges; }

static int changes(const sw_meet *t) {
  return come_out(t) || sw_press_eases(&t->press, t->usual, t->stiffer, sw_meet_depth(t));
}

void sw_mutual_keep_moving(const sw_mutual *m, sw_system *s) {
  SW_ITEMS(const sw_meet, t, m->touches, m->touch_count) {
    sw_body *one = &s->bodies[t->of.body[0]], *two = &s->bodies[t->of.body[1]];
    if ((one->stops || two->stops) && changes(t)) one->stops = two->stops = 0;
  }
}

/* Wakes the bodies with unknown or changing touches. */
static void wake_unknown(const sw_mutual *m, sw_system *s) {
  for (size_t b = 0; b < s->body_count; b++)
    if (!m->still.accepted && !m->still.kept[b]) s->bodies[b].waits = 0;
  for (size_t i = 0; m->still.accepted && i < m->touch_count; i++)
    for (int k = 0; k < 2; k++)
      if (come_out(&m->touches[i])) s->bodies[m->touches[i].of.body[k]].waits = 0;
}

sw_status sw_mutual_wake(sw_mutual *m, sw_system *s) {
  if (!s->waiting) return SW_OK;
  wake_unknown(m, s);
  return m->finder->wake ? m->finder->wake(m, s) : SW_OK;
}

/* Merges the touches of two lists whose bodies wait into the room. */
static size_t merge(const sw_mutual *m, const sw_system *s, sw_meet *out) {
  const sw_still_meets *still = &m->still;
  size_t i = 0, k = 0, n = 0;
  while (i < m->touch_count || k < still->count) {
    const int own = k == still->count || (i < m->touch_count &&
                                          sw_ends_order(&m->touches[i].of, &still->list[k].of) < 0);
    const sw_meet *t = own ? &m->touches[i++] : &still->list[k++];
    if (!s || wait(s, t->of.body)) out[n++] = *t;
  }
  return n;
}

sw_status sw_mutual_set_aside(sw_mutual *m, const sw_system *s) {
  sw_still_meets *still = &m->still;
  const int changed = (s->waiting || still->any) && !sw_waits_are(s, still->kept);
  if (changed) {
    SW_TRY(SW_GROW_EMPTY(still->room, still->room_capacity, m->touch_count + still->count));
    const size_t count = merge(m, s, still->room);
    SW_SWAP(still->list, still->room);
    SW_SWAP(still->capacity, still->room_capacity);
    still->count = count, still->any = 0;
    for (size_t b = 0; b < s->body_count; b++) {
      still->kept[b] = s->bodies[b].waits != 0;
      still->any |= still->kept[b];
    }
    still->sums = sw_presses_sums(SW_PRESSES(sw_meet, still->list, still->count));
  }
  still->accepted = 0;
  return SW_OK;
}

/* Puts the touches back among the others. */
static sw_status put_back(sw_mutual *m) {
  sw_still_meets *still = &m->still;
  const size_t all = m->touch_count + still->count;
  if (still->count) {
    SW_TRY(SW_GROW_EMPTY(still->room, still->room_capacity, all));
    SW_TRY(SW_GROW(m->touches, m->touch_capacity, all));
    (void)merge(m, NULL, still->room);
    memcpy(m->touches, still->room, all * sizeof *m->touches);
  }
  m->touch_count = all;
  sw_mutual_forget_still(m);
  return SW_OK;
}

const void *sw_mutual_seen(sw_mutual *m, size_t *bytes) {
  if (put_back(m) != SW_OK) m->touch_count = 0, m->still.accepted = 0;
  *bytes = m->touch_count * sizeof *m->touches;
  return m->touches;
}

/* Adds the memory of touches between bodies that wait to the next memory, in the order of ends. */
sw_status sw_mutual_carry_over(sw_mutual *m) {
  size_t carried = 0, from = m->memory_count, to = 0, left = m->next_count;
  for (size_t i = 0; m->still.any && i < m->memory_count; i++)
    carried += were_kept(m, m->memory[i].of.body);
  if (!carried) return SW_OK;
  SW_TRY(SW_GROW(m->next_memory, m->next_capacity, m->next_count + carried));
  m->next_count = to = left + carried;
  while (carried) {
    const sw_met *t = &m->memory[from - 1];
    if (!were_kept(m, t->of.body)) {
      from--;
    } else if (left && sw_ends_order(&m->next_memory[left - 1].of, &t->of) > 0) {
      m->next_memory[--to] = m->next_memory[--left];
    } else {
      m->next_memory[--to] = *t;
      from--, carried--;
    }
  }
  return SW_OK;
}
