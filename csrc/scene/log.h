/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A log: rows of a fixed number of doubles, growing. */
#ifndef SW_SCENE_LOG_H
#define SW_SCENE_LOG_H

#include "base/tape.h"

typedef struct sw_log {
  double *rows;
  size_t count, capacity; /* in doubles */
} sw_log;

/* Add a row of n. SW_ENOMEM. */
sw_status sw_log_add(sw_log *log, const double *row, size_t n);
void sw_tape_log(sw_tape *tape, sw_log *log);

#endif
