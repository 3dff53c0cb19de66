/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies that wait: wires at rest and undisturbed in a step are not solved. Rest is part of the
 * state: velocities and accelerations are exactly zero. So a restored state goes on with the same
 * bits. */
#ifndef SW_SYSTEM_WAIT_H
#define SW_SYSTEM_WAIT_H

#include "system/system.h"

/* A step is accepted: finds the wires that came to rest in it (sw_body.stops); 0: none. The
 * couplings then take out those whose touches change by themselves. */
int sw_waits_stopping(sw_system *system);
void sw_waits_stop(sw_system *system); /* stops the remaining ones */
/* A step begins: finds the bodies that wait in it. may: 0 = none, e.g. after a change of the scene.
 * The couplings then wake those that they may disturb (sw_body.waits = 0). */
void sw_waits_find(sw_system *system, int may);
/* 1 if exactly the bodies with a flag (bodies) wait. */
int sw_waits_are(const sw_system *system, const unsigned char *flags);
/* A stage begins (place) and is solved (finish): waiting bodies keep their places, without
 * velocity. */
void sw_waits_place(const sw_system *system, const sw_stage *stage);
void sw_waits_finish(const sw_system *system, const sw_stage *stage);
/* Sets the waiting bodies' guess and rate of strain in a stage (strains), see sw_stage: their
 * strains stay, without rates. */
void sw_waits_strain(const sw_system *system, double *guess);
void sw_waits_strain_rate(const sw_system *system, double *rate);
/* A step must be repeated with all bodies awake. */
static inline void sw_waits_wake(sw_system *s) { s->awake = 1; }

#endif
