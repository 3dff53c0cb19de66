/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds which wires strike an obstacle and which rest on it, and the blow of each. Only for the
 * files of this folder. */
#ifndef SW_CONTACT_STRIKERS_H
#define SW_CONTACT_STRIKERS_H

#include "contact/touch.h"

/* Call after a trial: finds the wires that strike the obstacles. Only their load is judged as a
 * blow. With the load of all wires, 25 wires that lie on a table would hide the blow of one more,
 * and wires that are laid on it together would count as a blow. */
void sw_contact_find_strikers(sw_contact *c, const sw_system *s);
/* Call when a trial begins: forgets the strikers. */
void sw_contact_forget_strikers(sw_contact *c);

/* State of a look at one wire after the other: the present wire, its touches (end exclusive), and
 * the next memory and the next force after the first stage. Begins with zeros. */
typedef struct sw_wire_look {
  size_t body, first, end, memory, pressing;
} sw_wire_look;

/* Finds the forces of the next wire on the obstacles that it touches, for sw_contact_own_blow; 0:
 * no more wires. */
int sw_contact_look_at_next(sw_contact *c, const sw_system *s, sw_wire_look *at);

/* A load as a mean over the step, at its start and at its end, and the usual force of its wires
 * [N]. */
typedef struct sw_blow {
  sw_vec mean, start, end;
  double usual;
} sw_blow;

/* Pressing force of the wire looked at. usual: its usual force [N]. */
sw_blow sw_contact_own_blow(const sw_contact *c, const sw_strikers *on, double usual);
/* Notes the data for sw_contact_own_blow if several wires touch obstacles. */
void sw_contact_book_singles(sw_contact *c, const sw_booking *b);

#endif
