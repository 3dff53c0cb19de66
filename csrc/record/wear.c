/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Recorded wear on a tape. */
#include "record/wear.h"

#include <math.h>

#include "base/alloc.h"

void sw_wear_free(sw_wear *w) {
  SW_FREE_ALL(w->places, w->cycles, w->across);
  sw_window_free(&w->pressed);
  *w = (sw_wear){0};
}

static void tape_cycles(sw_tape *t, sw_cycles *c) {
  SW_TAPE_STRUCT(t, sw_cycles, 1872);
  sw_tape_int(t, &c->opened), sw_tape_int(t, &c->count), sw_tape_int(t, &c->begins);
  if (sw_tape_reads(t)) {
    const int fine = sw_cycles_sized(c);
    const sw_cycles none = {.opened = c->opened, .count = c->count, .begins = c->begins};
    sw_tape_expect(t, fine, "a count of cycles");
    *c = fine ? none : (sw_cycles){.opened = 0};
  }
  sw_tape_raw(t, c->begun, (size_t)c->begins * sizeof *c->begun);
  sw_tape_raw(t, c->open, (size_t)c->opened * sizeof *c->open);
  sw_tape_raw(t, c->kept, (size_t)c->count * sizeof *c->kept);
  if (sw_tape_reads(t)) sw_tape_expect(t, sw_cycles_fine(c), "a count of cycles");
}

static void tape_place(sw_tape *t, sw_wear_place *x) {
  SW_TAPE_STRUCT(t, sw_wear_place, 104); /* load and touches belong to one state and are not kept */
  sw_tape_double(t, &x->s), sw_tape_double(t, &x->rubbed), sw_tape_double(t, &x->slid);
  sw_tape_double(t, &x->turn), sw_tape_vec(t, &x->tangent), sw_tape_vec(t, &x->across);
  sw_tape_int(t, &x->side), sw_tape_int(t, &x->seen);
  const double all = x->s + x->rubbed + x->slid + x->turn;
  sw_tape_expect(t, isfinite(all) && sw_finite(x->tangent) && sw_finite(x->across), "wear");
}

/* Makes room for the tape's content. */
static sw_status make_room(sw_wear *w, size_t count) {
  sw_wear_free(w);
  if (!count) return SW_OK;
  w->places = sw_alloc(count, sizeof *w->places);
  w->cycles = sw_alloc(SW_WEAR_SIGNALS * count, sizeof *w->cycles);
  if (!w->places || !w->cycles) {
    sw_wear_free(w);
    return SW_ENOMEM;
  }
  w->count = count;
  return SW_OK;
}

void sw_tape_wear(sw_tape *t, sw_wear *w) {
  size_t count = w->count, nodes = w->nodes;
  SW_TAPE_STRUCT(t, sw_wear, 264); /* across is work space */
  sw_tape_count(t, &count, 8 * (10 + SW_WEAR_SIGNALS)), sw_tape_size(t, &nodes);
  sw_tape_expect(t, nodes <= count && (nodes > 0) == (count > 0), "wear");
  if (!sw_tape_good(t)) return;
  if (sw_tape_reads(t) && count != w->count) {
    const sw_status status = make_room(w, count);
    if (status != SW_OK) {
      sw_tape_fail(t, status);
      return;
    }
  }
  w->nodes = nodes;
  sw_tape_raw(t, &w->holds, sizeof w->holds);
  sw_tape_double(t, &w->sidewall.value), sw_tape_double(t, &w->sidewall.s);
  sw_tape_double(t, &w->sidewall.time);
  sw_tape_window(t, &w->pressed);
  for (size_t k = 0; k < w->count && sw_tape_good(t); k++) tape_place(t, &w->places[k]);
  for (size_t k = 0; k < SW_WEAR_SIGNALS * w->count && sw_tape_good(t); k++)
    tape_cycles(t, &w->cycles[k]);
}
