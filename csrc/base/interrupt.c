/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The flag of Ctrl-C. */
#include "base/interrupt.h"

#include <signal.h>

static volatile sig_atomic_t raised;
static volatile unsigned count; /* only the signal handler of the thread of Lua writes it */

int sw_interrupted(void) { return raised; }

void sw_interrupt_clear(void) { raised = 0; }

unsigned sw_interrupt_count(void) { return count; }

void sw_interrupt_raise(void) {
  raised = 1;
  count = count + 1;
}
