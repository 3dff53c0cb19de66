/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds lines that pass through each other, or through themselves, where no contact keeps them
 * apart. Between two states nodes move on straight paths. Axes that cross on these paths have
 * passed when they are clear of each other again on the other side. */
#ifndef SW_MUTUAL_THROUGH_H
#define SW_MUTUAL_THROUGH_H

#include "mutual/mutual.h"

typedef struct sw_through sw_through;

/* A pass of two lines, or of one (both bodies are the same). */
typedef struct sw_pass {
  size_t body[2];
  double s[2]; /* where, along each line [m] */
} sw_pass;

/* Begins, or begins anew, at the system's state. contact: lines that touch by its rules are not
 * watched; NULL: all are watched. Passes under way go on, unless the time has gone back [s].
 * SW_ENOMEM. */
sw_status sw_through_begin(sw_through **through, const sw_system *system, const sw_mutual *contact,
                           double time);
void sw_through_free(sw_through *through); /* NULL is allowed */
/* Follows the lines to the system's state. SW_ENOMEM. */
sw_status sw_through_follow(sw_through *through, const sw_system *system, const sw_mutual *contact,
                            double time);
/* The state followed last: places of nodes [m] and twist of spans [rad], with the time [s]. 0: the
 * system has other nodes now. */
typedef struct sw_through_state {
  const double *x, *twist;
  double time;
} sw_through_state;
int sw_through_last(const sw_through *through, const sw_system *system, sw_through_state *out);
/* Takes the next pass that is over. 0: there is none. */
int sw_through_next(sw_through *through, const sw_system *system, sw_pass *out);

#endif
