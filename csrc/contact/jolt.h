/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Blows: how hard a force is that comes up within a step, between wires and obstacles or between
 * wires. Steps with a blow are divided into parts (substeps), see step/blow.c. */
#ifndef SW_CONTACT_JOLT_H
#define SW_CONTACT_JOLT_H

#include "contact/contact.h"

/* Longest part (substep) in which a blow is followed. The number of parts is the jolt's square, see
 * step/blow.c. Sections of a soft mesh throw a blow back within a millisecond, and the end of a
 * stiff wire that falls on a peg bounces as fast [s]. */
#define SW_LONGEST_PART 3e-4

/* Least force of a blow that is followed in parts, from the wire's usual force and the hardest blow
 * before. followed: 1 if a blow is being followed and this one continues it [N]. */
double sw_contact_least_blow(double usual, double hardest, int followed);
/* 1 if a force came and went within a step: its end, or the middle of its start and end, differs
 * much from its mean [N]. followed: as above. sw_contact_jolt_of returns the jolt of a force of
 * this size in a step of size h [-]. */
int sw_contact_comes_and_goes(double usual, sw_vec start, sw_vec mean, sw_vec end, int followed);
double sw_contact_jolt_of(double size, double usual, double h);
/* Gives the hardest blow of a body so far, to read or to change [N]. A blow is followed if it is
 * harder than those before on its obstacle, or than those of its wire. */
typedef double *(*sw_blow_of)(void *user, size_t body);

/* Hardest new blow on an obstacle in a trial step: its mean force over the step divided by the
 * striking wires' weights or bending forces. 0: none [-]. followed: 1 if a blow that is followed in
 * parts goes on. */
double sw_contact_jolt(sw_contact *contact, const sw_system *system, int followed, sw_blow_of of,
                       void *user);
/* A run begins: no blow came before. The owner's sw_contact_past must forget it too. */
void sw_contact_forget_hardest(sw_contact *contact);
/* Longest part of a step for a wire whose end is pushed onto an obstacle; HUGE_VAL: there is no
 * such wire [s]. */
double sw_contact_push_part(const sw_contact *contact, const sw_system *system);
/* Length from an end of the wire (0: its start) to the next held node, or to its other end [m]. */
double sw_contact_free_length(const sw_plan *plan, int last);

#endif
