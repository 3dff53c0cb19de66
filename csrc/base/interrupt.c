/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The flag of Ctrl-C. */
#include "base/interrupt.h"

#include <signal.h>

static volatile sig_atomic_t raised;

int sw_interrupted(void) { return raised; }

void sw_interrupt_clear(void) { raised = 0; }

void sw_interrupt_raise(void) { raised = 1; }
