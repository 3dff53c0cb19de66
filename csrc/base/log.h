/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A log: rows of a fixed number of doubles, growing. */
#ifndef SW_BASE_LOG_H
#define SW_BASE_LOG_H

#include "base/tape.h"

/* Its block may be shared with snapshots, each of which has some of the rows: rows that another
 * one has are never written over, the log takes a block of its own first. */
typedef struct sw_log {
  double *rows;
  size_t count, capacity; /* in doubles */
} sw_log;

/* Add a row of n. SW_ENOMEM. */
sw_status sw_log_add(sw_log *log, const double *row, size_t n);
void sw_log_free(sw_log *log);
void sw_tape_log(sw_tape *tape, sw_log *log);

#endif
