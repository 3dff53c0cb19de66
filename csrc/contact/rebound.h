/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rebounds from obstacles with restitution: when a place meets its obstacle within a step, whether
 * the step must be cut for it, and how much the rebound may change the velocity. */
#ifndef SW_CONTACT_REBOUND_H
#define SW_CONTACT_REBOUND_H

#include "contact/touch.h"

/* A gap up to this is closed; the touch already moves with the obstacle [m]. */
#define SW_CLOSED 1e-6

/* How a touch with restitution meets its obstacle within a step. */
typedef struct sw_meeting {
  double after; /* time after the step's start [s] */
  double speed; /* approach at that moment [m/s] */
} sw_meeting;

/* Returns how a gap closes, with gravity acting until the surfaces meet. pull: gravity towards the
 * obstacle [m/s2]. */
sw_meeting sw_rebound_meet(double gap, double approach, double pull);

/* 1 if a rebound from the step's start would be wrong; c->soonest is then the time at which the
 * step should end. e: restitution [-]; h: the step [s]. */
int sw_rebound_too_early(sw_contact *c, double e, double gap, double pull, sw_meeting m, double h);

/* A rebound of a touch. */
typedef struct sw_rebound {
  const double *w; /* change of each node of the touch for a change of 1 of its place [-] */
  sw_vec wall;     /* velocity of the obstacle there [m/s] */
  double wanted;   /* change of the place's velocity along the normal [m/s] */
  double least;    /* change that just keeps the place out of the obstacle [m/s] */
} sw_rebound;

/* Returns the reduced change of velocity with which the step's impacts give the touch's body no
 * kinetic energy relative to the wall; at least r->least [m/s]. Books the energy. */
double sw_rebound_limit(sw_contact *c, const sw_system *s, const sw_pressed *t,
                        const sw_rebound *r);

/* 1 if a free wire's slip on a moving obstacle turns round within a step that ends with velocities
 * v1; c->soonest is then the time at which the step should end (turn.c). */
int sw_contact_turns(sw_contact *c, const sw_system *s, const double *v1, double h);
/* 1 if a wire breaks loose within a step of h; c->soonest is then half of it (loose.c). */
int sw_contact_breaks_loose(sw_contact *contact, const sw_system *system, double h);

#endif
