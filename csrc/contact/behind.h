/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wires at the back of an open mesh (a sheet). Nothing holds them there: the back counts as inside,
 * and a wire that is inside without having come through the front has no touch. */
#ifndef SW_CONTACT_BEHIND_H
#define SW_CONTACT_BEHIND_H

#include "contact/contact.h"

/* A place of a wire that is near the back of a sheet, or passes through it from there. */
typedef struct sw_behind {
  int found;
  int obstacle; /* the owner's number */
  size_t body;
  double place; /* arc length [m] */
  double depth; /* of the axis behind the sheet [m] */
} sw_behind;

struct sw_candidate;
/* Notes a candidate whose axis crosses a sheet within the step, if it comes from the back. */
void sw_contact_note_crossing(sw_contact *contact, const sw_system *system,
                              const struct sw_candidate *candidate, const sw_closest *hit);
/* Notes a place that is left out because it is inside without memory. */
void sw_contact_note_inside(sw_contact *contact, const sw_system *system,
                            const struct sw_candidate *candidate, const sw_closest *near);
/* What a body did in the last step, or since the last call in poses. */
sw_behind sw_contact_behind(sw_contact *contact, const sw_system *system, size_t body);

#endif
