/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Blows: how large a force is that appears within a step, between wires and obstacles or between
 * wires. Steps with a blow are divided into parts (substeps), see step/blow.c. */
#ifndef SW_CONTACT_JOLT_H
#define SW_CONTACT_JOLT_H

#include "contact/contact.h"

/* Longest part (substep) during a blow. The number of parts is the square of the jolt, see
 * step/blow.c. Sections of a soft mesh, and the end of a stiff wire that falls on a peg, throw a
 * blow back within a millisecond [s]. */
#define SW_LONGEST_PART 3e-4

/* Smallest force of a blow that needs parts, from the wire's usual force and the hardest blow so
 * far [N]. followed: 1 if this blow continues one that already has parts. */
double sw_contact_least_blow(double usual, double hardest, int followed);
/* 1 if a force came and went within a step: its end, or the mean of start and end, differs much
 * from its mean over the step [N]. followed: as above. sw_contact_jolt_of returns the jolt of a
 * force of this size in a step of size h [-]. */
int sw_contact_comes_and_goes(double usual, sw_vec start, sw_vec mean, sw_vec end, int followed);
double sw_contact_jolt_of(double size, double usual, double h);
/* Returns the hardest blow of a body so far, to read or to change [N]. A blow needs parts if it is
 * harder than earlier ones on its obstacle or of its wire. */
typedef double *(*sw_blow_of)(void *user, size_t body);

/* Returns the jolt of the hardest new blow on an obstacle in a trial step: its mean force over the
 * weights or bending forces of the striking wires; 0: no blow [-]. followed: 1 if a blow that has
 * parts goes on. */
double sw_contact_jolt(sw_contact *contact, const sw_system *system, int followed, sw_blow_of of,
                       void *user);
/* Call when a run begins: forgets earlier blows. The owner's sw_contact_past must forget them
 * too. */
void sw_contact_forget_hardest(sw_contact *contact);
/* Longest part of a step for a wire whose end is pushed onto an obstacle; HUGE_VAL: there is no
 * such wire [s]. */
double sw_contact_push_part(const sw_contact *contact, const sw_system *system);
/* Largest speed of the wire of touch k towards its obstacle, along the normal [m/s]. */
double sw_contact_push_speed(const sw_contact *contact, const sw_system *system, size_t k);
/* Half wave in which a straight wire buckles whose end is stopped on this free length while the
 * rest moves on with this speed. Its force grows to P = EA v T/L in the time T for which it stays
 * straight, and the bending that grows fastest under P has the half wave pi sqrt(2 EI/P) [m]. */
double sw_contact_half_wave(const sw_body *body, double length, double speed);
/* Length from an end of the wire (0: its start) to the next held node, or to its other end [m]. */
double sw_contact_free_length(const sw_plan *plan, int last);

/* Friction that a body's touches lose as they begin to slide in the last step, where friction of
 * sliding is less than that of sticking (loose.c) [N]. */
double sw_contact_lost(const sw_contact *contact, const sw_body *body);

/* 1 if a slip turns round now, before a step of size h: friction of the last step is over (turn.c).
 */
int sw_contact_turned(const sw_contact *contact, const sw_system *system, double h);

#endif
