/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The books of a run's energy, which the scene owns. Steps write them. */
#include "scene/ledger.h"

#include "base/alloc.h"
#include "scene/parts.h"

void sw_ledger_free(sw_books *b) {
  sw_free(b->holds);
  sw_free(b->obstacles);
  sw_log_free(&b->log);
  *b = (sw_books){0};
}

sw_status sw_scene_ledger(sw_scene *s, sw_ledger *out, sw_error *err SW_UNUSED) {
  *out = sw_scene_books(s)->sums;
  return SW_OK;
}

const double *sw_scene_energy_log(const sw_scene *s, size_t *rows) {
  sw_books *books = sw_scene_books(s);
  *rows = books->log.count / SW_LOG_ENERGY_SIZE;
  return books->log.rows;
}

/* --- on tape ------------------------------------------------------------------------ */

void sw_tape_ledger(sw_tape *t, sw_books *b) {
  SW_TAPE_STRUCT(t, sw_books, 1208);
  SW_TAPE_STRUCT(t, sw_ledger, 464);
  sw_tape_raw(t, &b->sums, sizeof b->sums);
  sw_tape_raw(t, &b->now, sizeof b->now);
  if (t->home) sw_tape_raw(t, b->outer, sizeof b->outer);
  sw_tape_double(t, &b->contact), sw_tape_double(t, &b->highest);
  sw_tape_double(t, &b->most_kinetic), sw_tape_double(t, &b->work);
  sw_tape_double(t, &b->released), sw_tape_double(t, &b->made);
  sw_tape_double(t, &b->rise), sw_tape_double(t, &b->lowest), sw_tape_double(t, &b->highest_rise);
  sw_tape_int(t, &b->begun), sw_tape_int(t, &b->put);
  sw_tape_log(t, &b->log);
  b->known = sw_tape_reads(t) ? 0 : b->known;
}
