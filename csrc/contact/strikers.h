/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tells the wires that strike an obstacle from those that rest on it. Only for the files of this
 * folder. */
#ifndef SW_CONTACT_STRIKERS_H
#define SW_CONTACT_STRIKERS_H

#include "contact/touch.h"

/* After a trial: finds who strikes the obstacles. A blow is judged by the load of the strikers: 25
 * wires that lie on a table would hide the blow of one more, and wires that are laid on it together
 * would be taken for a blow. */
void sw_contact_find_strikers(sw_contact *c, const sw_system *s);
/* A trial begins: nobody is known to strike. */
void sw_contact_forget_strikers(sw_contact *c);

#endif
