/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies that wait: wires at rest, which nothing disturbs in a step, are not solved. Whether a body
 * rests is part of the state: its velocities and accelerations are exactly zero. So a restored
 * state goes on with the same bits. */
#ifndef SW_SYSTEM_WAIT_H
#define SW_SYSTEM_WAIT_H

#include "system/system.h"

/* A step is accepted: finds the wires that came to rest in it (sw_body.stops); 0: there are none.
 * The couplings then take out those whose touches change by themselves. */
int sw_waits_stopping(sw_system *system);
void sw_waits_stop(sw_system *system); /* stops the others */
/* A step begins: finds the bodies that wait in it. may: 0 = none does, for instance because the
 * scene was changed. The couplings then wake those that they may disturb (sw_body.waits = 0). */
void sw_waits_find(sw_system *system, int may);
/* 1 if the bodies that wait are those with a flag (bodies). */
int sw_waits_are(const sw_system *system, const unsigned char *flags);
/* A stage begins, and is solved: the bodies that wait keep their places, without velocity. */
void sw_waits_place(const sw_system *system, const sw_stage *stage);
void sw_waits_finish(const sw_system *system, const sw_stage *stage);
/* Their strains stay as well, without rates: guess and rate of a stage (strains), see sw_stage. */
void sw_waits_strain(const sw_system *system, double *guess);
void sw_waits_strain_rate(const sw_system *system, double *rate);
/* A step must be tried again with all bodies awake. */
static inline void sw_waits_wake(sw_system *s) { s->awake = 1; }

#endif
