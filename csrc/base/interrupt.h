/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The flag of the user's wish to stop (Ctrl-C). A signal handler raises it. Long computations
 * poll it between two steps and return SW_EINTR. The code that turns it into an error
 * clears it: one Ctrl-C gives one error. */
#ifndef SW_BASE_INTERRUPT_H
#define SW_BASE_INTERRUPT_H

/* Not 0 if the user wants to stop. It costs one load: poll it in every step. */
int sw_interrupted(void);

void sw_interrupt_clear(void);

/* How often a stop was asked for, cleared or not. A loop of calls of the user's functions compares:
 * such a function may catch the error of the Ctrl-C, which clears the flag. */
unsigned sw_interrupt_count(void);

/* Asks for a stop. May be called from a signal handler. */
void sw_interrupt_raise(void);

#endif
