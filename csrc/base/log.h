/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A log: a growing list of rows, each a fixed number of doubles. */
#ifndef SW_BASE_LOG_H
#define SW_BASE_LOG_H

#include "base/tape.h"

/* Snapshots may share the log's block; each uses some of its first rows. The log never overwrites a
 * row that a snapshot uses: it first moves to a new block. */
typedef struct sw_log {
  double *rows;
  size_t count, capacity; /* in doubles */
} sw_log;

/* Adds a row of n doubles. SW_ENOMEM. */
sw_status sw_log_add(sw_log *log, const double *row, size_t n);
void sw_log_free(sw_log *log);
void sw_tape_log(sw_tape *tape, sw_log *log);

#endif
