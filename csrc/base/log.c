/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A log's rows and their copies on a tape. */
#include "base/log.h"

#include "base/alloc.h"

/* Stored in front of the rows. */
typedef struct head {
  size_t references;
  size_t kept; /* doubles of the block that snapshots use: the largest of all snapshots */
} head;

enum { HEAD = sizeof(head) / sizeof(double), FIRST = 64 };

static head *head_of(double *rows) { return (head *)(void *)(rows - HEAD); }

static void retain(void *rows) { head_of(rows)->references++; }

static void release(void *rows) {
  head *h = head_of(rows);
  if (--h->references == 0) sw_free(h);
}

static sw_status move(sw_log *log, size_t capacity) {
  head *h = sw_alloc(HEAD + capacity, sizeof(double));
  if (!h) return SW_ENOMEM;
  double *rows = (double *)(void *)h + HEAD;
  if (log->count) memcpy(rows, log->rows, log->count * sizeof *rows);
  h->references = 1;
  if (log->rows) release(log->rows);
  log->rows = rows, log->capacity = capacity;
  return SW_OK;
}

sw_status sw_log_add(sw_log *log, const double *row, size_t n) {
  const size_t need = log->count + n;
  if (need > log->capacity)
    SW_TRY(move(log, need > FIRST / 2 ? 2 * need : FIRST));
  else if (head_of(log->rows)->kept > log->count)
    SW_TRY(move(log, log->capacity));
  memcpy(log->rows + log->count, row, n * sizeof *row);
  log->count = need;
  return SW_OK;
}

void sw_log_free(sw_log *log) {
  if (log->rows) release(log->rows);
  *log = (sw_log){0};
}

void sw_tape_log(sw_tape *t, sw_log *x) {
  static const sw_sharing sharing = {retain, release};
  size_t count = x->count;
  SW_TAPE_STRUCT(t, sw_log, 24);
  sw_tape_count(t, &count, sizeof *x->rows);
  if (sw_tape_share(t, &x->rows, &sharing)) {
    if (!sw_tape_reads(t) && x->rows && head_of(x->rows)->kept < count)
      head_of(x->rows)->kept = count;
    sw_tape_size(t, &x->capacity);
    if (sw_tape_good(t)) x->count = count;
    return;
  }
  if (!sw_tape_reads(t)) {
    sw_tape_raw(t, x->rows, count * sizeof *x->rows);
    return;
  }
  sw_log_free(x);
  if (!sw_tape_good(t) || !count) return;
  if (move(x, count) != SW_OK) {
    sw_tape_fail(t, SW_ENOMEM);
    return;
  }
  sw_tape_raw(t, x->rows, count * sizeof *x->rows);
  x->count = count;
}
