/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The history of zones on a tape. */
#include "record/zone.h"

#include "base/alloc.h"

void sw_zones_forget(sw_zone_watch *w) {
  SW_FREE_ALL(w->past, w->gaps, w->x);
  *w = (sw_zone_watch){0};
}

static void tape_past(sw_tape *t, sw_zone_past *x) {
  SW_TAPE_STRUCT(t, sw_zone_past, 112);
  sw_tape_double(t, &x->gap), sw_tape_double(t, &x->s), sw_tape_double(t, &x->time);
  sw_tape_double(t, &x->between), sw_tape_double(t, &x->inside), sw_tape_double(t, &x->until);
  sw_tape_double(t, &x->last), sw_tape_pose(t, &x->before);
}

void sw_tape_zone_watch(sw_tape *t, sw_zone_watch *w) {
  size_t zones = w->zones, edges = w->edges;
  SW_TAPE_STRUCT(t, sw_zone_watch, 40);
  sw_tape_count(t, &zones, 112), sw_tape_count(t, &edges, 48);
  sw_tape_expect(t, edges == 0 || zones <= ((size_t)1 << 40) / edges, "zones");
  if (!sw_tape_good(t)) return;
  if (sw_tape_reads(t)) w->zones = 0, w->edges = 0;
  SW_TAPE_ARRAY(t, w->gaps, zones * edges);
  SW_TAPE_ARRAY(t, w->x, 6 * edges);
  if (sw_tape_reads(t) && sw_tape_good(t)) {
    sw_free(w->past);
    w->past = sw_alloc(zones, sizeof *w->past);
    if (!w->past) sw_tape_fail(t, SW_ENOMEM);
  }
  for (size_t k = 0; k < zones && sw_tape_good(t); k++) tape_past(t, &w->past[k]);
  if (sw_tape_good(t)) w->zones = zones, w->edges = edges;
}
