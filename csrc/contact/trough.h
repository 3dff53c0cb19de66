/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Obstacles that are hollow across a wire, as the floor of a tube. What presses the wire on draws
 * it back to the lowest line. */
#ifndef SW_CONTACT_TROUGH_H
#define SW_CONTACT_TROUGH_H

#include "contact/contact.h"

/* The force that draws a body back at its touch k, over the touch's normal force and the shift to a
 * side: 1/(R - r) in a bore of radius R, r the wire's radius. 0: flat, or round to the other side;
 * all touches of meshes. aside: the largest shift that matters [m]. [1/m] */
double sw_contact_trough(const sw_contact *contact, const sw_system *system, const sw_body *body,
                         size_t k, double aside);

#endif
