/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The user's wish to stop (Ctrl-C). A signal handler raises it, whatever runs
 * long polls it between two steps and returns SW_EINTR, and whoever turns it
 * into an error clears it: one Ctrl-C, one error. */
#ifndef SW_BASE_INTERRUPT_H
#define SW_BASE_INTERRUPT_H

/* Not 0 when a stop is asked for. Costs one load: poll it in every step. */
int sw_interrupted(void);

void sw_interrupt_clear(void);

/* Ask for a stop. May be called from a signal handler. */
void sw_interrupt_raise(void);

#endif
