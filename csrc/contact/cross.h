/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wires that pass through or by obstacles within a step. Shared by the files of contact. */
#ifndef SW_CONTACT_CROSS_H
#define SW_CONTACT_CROSS_H

#include "contact/touch.h"

/* 1 if the candidate's piece of the wire, with its smooth curve, stays clear of the box that its
 * obstacle sweeps on the way to x1 (nodes x 3) [m]. */
int sw_contact_stays_away(const sw_contact *contact, const sw_system *system,
                          const sw_candidate *candidate, const double *x1);

/* 1 if a wire overlaps an obstacle on its way to x1, which the step's ends do not show. */
int sw_contact_brushes(const sw_contact *contact, const sw_system *system, const double *x1);

#endif
