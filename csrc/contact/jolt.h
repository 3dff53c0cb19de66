/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Blows: how hard a force is that comes within a step, of obstacles and of wires on each other.
 * Steps with a blow in them are taken in parts (step/blow.c). */
#ifndef SW_CONTACT_JOLT_H
#define SW_CONTACT_JOLT_H

#include "contact/contact.h"
#include "contact/mutual.h"

/* The force above which a blow is followed in parts: of what is usual for the wire, and beside the
 * hardest before; followed: 1, it is, and goes on so [N]. */
double sw_contact_least_blow(double usual, double hardest, int followed);
/* Did a force come and go within a step? At its start, its mean, at its end [N]. And the jolt that
 * one of this size is, in a step of size h [-]. */
int sw_contact_comes_and_goes(double usual, sw_vec start, sw_vec mean, sw_vec end);
double sw_contact_jolt_of(double size, double usual, double h);
/* The hardest new blow on an obstacle in a trial step: its mean over the step, over the striking
 * wire's weight or bending force. 0: none [-]. followed: 1, a blow that is followed in parts goes
 * on. */
double sw_contact_jolt(sw_contact *contact, const sw_system *system, int followed);
/* As sw_contact_jolt, of few wires on each other. dull: the trial took implicit Euler. hardest: of
 * the blows before, and of this one, unless one is followed [N]. */
double sw_pairs_jolt(const sw_mutual *pairs, const sw_system *system, int dull, int followed,
                     double *hardest);

#endif
