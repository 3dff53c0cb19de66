/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A function on a stack of its own, which can be left in the middle and gone on with: so that a
 * minimiser, which calls its objective, becomes something that is asked for places and told values.
 */
#ifndef SW_CALIBRATE_FIBER_H
#define SW_CALIBRATE_FIBER_H

typedef struct sw_fiber sw_fiber;

/* Begins with the first resume. NULL: no memory. run must leave by returning. */
sw_fiber *sw_fiber_new(void (*run)(void *user), void *user);

/* Go on until it yields (1) or has returned (0); of one that has returned, 0 at once. */
int sw_fiber_resume(sw_fiber *f);

/* Within it: leave, until resumed. */
void sw_fiber_yield(sw_fiber *f);

/* NULL is allowed. One that has begun must have returned. */
void sw_fiber_free(sw_fiber *f);

#endif
