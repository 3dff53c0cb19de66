/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stiffness of a wire that rolls on a round side. */
#ifndef SW_CONTACT_ROLLING_H
#define SW_CONTACT_ROLLING_H

#include "contact/touch.h"

/* Adds the stiffness of a touch that moves along the wire as the wire tilts, with nodes at y. If
 * the wire's piece tilts by phi, its touch moves by R phi, and the normal force N turns the piece
 * back with the moment N R phi. For a wire with the tension T round an obstacle this moment is as
 * large as that of T, and three times as large where only each third chord presses. Without this
 * stiffness an update goes too far, by its own size or more, and statics does not converge. The
 * solution does not depend on it. A smooth curve with friction converges without it. */
void sw_contact_add_rolling(const sw_contact *c, sw_system *s, const sw_touch *t, const double *y);

#endif
