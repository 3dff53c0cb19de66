/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A function on its own stack, which can be suspended and resumed. It turns a minimiser, which
 * calls its objective, into an object that is asked for places and told their values. */
#ifndef SW_CALIBRATE_FIBER_H
#define SW_CALIBRATE_FIBER_H

typedef struct sw_fiber sw_fiber;

/* Makes a fiber; run starts at the first resume. NULL: out of memory. run must leave by
 * returning. */
sw_fiber *sw_fiber_new(void (*run)(void *user), void *user);

/* Continues until the fiber yields (1) or has returned (0). A fiber that has returned gives 0 at
 * once. */
int sw_fiber_resume(sw_fiber *f);

/* Called within the fiber: suspends it until the next resume. */
void sw_fiber_yield(sw_fiber *f);

/* NULL is allowed. A started fiber must have returned. */
void sw_fiber_free(sw_fiber *f);

#endif
