/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stiffness of a wire that rolls on a round side. */
#ifndef SW_CONTACT_ROLLING_H
#define SW_CONTACT_ROLLING_H

#include "contact/touch.h"

/* Adds the stiffness of a touch that moves on along the wire as the wire tilts, with nodes at y. If
 * the wire's piece tilts by phi, its touch moves on by R phi, and the normal force N there turns it
 * back with N R phi. For a wire that goes round with the tension T that is as much as T itself
 * does, and three times as much where only each third chord presses. Without it each update goes
 * too far, by up to more than its size, and statics never comes to rest. The solution does not
 * depend on it. A smooth curve with friction comes to rest without it. */
void sw_contact_add_rolling(const sw_contact *c, sw_system *s, const sw_touch *t, const double *y);

#endif
