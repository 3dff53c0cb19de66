/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wires that pass through or by obstacles within a step. Shared by the files of contact. */
#ifndef SW_CONTACT_CROSS_H
#define SW_CONTACT_CROSS_H

#include "contact/touch.h"

/* 1 if the candidate's piece of wire and its smooth curve stay outside the box that its obstacle
 * sweeps in the step to x1 (nodes x 3) [m]. */
int sw_contact_stays_away(const sw_contact *contact, const sw_system *system,
                          const sw_candidate *candidate, const double *x1);

/* 1 if a wire overlaps an obstacle between the step's ends, but at neither end. */
int sw_contact_brushes(const sw_contact *contact, const sw_system *system, const double *x1);

#endif
