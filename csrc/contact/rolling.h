/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stiffness of a wire that rolls on a round side. */
#ifndef SW_CONTACT_ROLLING_H
#define SW_CONTACT_ROLLING_H

#include "contact/touch.h"

/* Adds the stiffness of a touch that moves along the wire as the wire tilts, with nodes at y. If
 * the wire's piece tilts by phi, its touch moves by R phi, and the normal force N there turns the
 * piece back with the moment N R phi. A wire that goes round an obstacle has the tension T. Then
 * this moment is as large as that of T, and three times as large where only each third chord
 * presses. Without this stiffness an update goes too far, by its own size or more, and statics
 * never comes to rest. The solution does not depend on it. A smooth curve with friction comes to
 * rest without it. */
void sw_contact_add_rolling(const sw_contact *c, sw_system *s, const sw_touch *t, const double *y);

#endif
