/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Friction of wires that come to rest together with what drives them. */
#ifndef SW_CONTACT_HALT_H
#define SW_CONTACT_HALT_H

#include "contact/contact.h"

struct sw_kept;
struct sw_memory;
struct sw_touch;

/* Friction against the slide at a step's start, and its largest possible value [N]. */
typedef struct sw_against {
  double against, most;
} sw_against;
/* For a trial at whose end a drive comes to rest, while the system is still at the step's start:
 * adds the touches. sw_against_turned: 1 if friction changed its direction in the trial because the
 * method's error carried wires past their place of rest. */
void sw_contact_against(const sw_contact *contact, const sw_system *system, sw_against *sum);
int sw_against_turned(const sw_against *sum);
/* Call when the trial is the state of the system, before sw_contact_commit. At places that come to
 * rest, sets friction to the force that keeps them there, and stops them. Returns the largest
 * possible friction of places that were faster than `still` along their obstacle [m/s], [N]. */
double sw_contact_halt(sw_contact *contact, sw_system *system, double still);

/* Call before sw_contact_commit. Returns the largest possible friction of line touches that began
 * to press in this step and slide [N]. Only lines that a hold presses on an obstacle count: others
 * hang from it and swing. */
double sw_contact_landed(const sw_contact *contact, const sw_system *system);
/* Largest possible friction of all touches together; of those of one body on obstacles that may
 * move [N]. */
double sw_contact_friction(const sw_contact *contact);
double sw_contact_friction_moved(const sw_contact *contact, const sw_body *body);

/* Friction of a wire's touches along the wire, from its start, and its largest possible value.
 * Touches with friction mostly across the wire are left out [N]. */
typedef struct sw_along {
  double along, most;
} sw_along;
void sw_contact_along(const sw_contact *contact, const sw_system *system, size_t body,
                      sw_along *sum);
/* Adds a touch's friction at a node, of at most `most` [N]. */
void sw_along_add(const sw_system *system, size_t body, size_t node, sw_vec friction, double most,
                  sw_along *sum);

/* Displacement of friction's spring, from the memory of a touch, in the obstacle's axes [m]. */
sw_vec sw_contact_stretch(const sw_contact *contact, const struct sw_touch *touch,
                          const struct sw_kept *kept);
/* As `soft` of sw_press; memory: the touch's, or NULL. On a rod whose drive comes to rest
 * (sw_contact_brake), friction's spring is as stiff as the rod's edge, and stays so while it
 * sticks. Where a touch holds with more than the wire's weight see sw_kept_grip [-]. */
double sw_contact_softness(const sw_contact *contact, const sw_system *system,
                           const struct sw_memory *memory, const struct sw_touch *touch);

#endif
