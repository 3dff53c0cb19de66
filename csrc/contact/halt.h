/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Friction of wires that come to rest together with what drives them. */
#ifndef SW_CONTACT_HALT_H
#define SW_CONTACT_HALT_H

#include "contact/contact.h"

struct sw_kept;
struct sw_memory;
struct sw_touch;

/* For a trial at whose end a drive comes to rest. While the system is still at the step's start: 1
 * if friction turned round in it, because the method's error carried wires past their place of
 * rest. */
int sw_contact_turned(const sw_contact *contact, const sw_system *system);
/* When it is the state of the system, before sw_contact_commit: sets friction at places that come
 * to rest to the force that keeps them there, and stops them. Returns the most friction of those
 * that were faster than `still` along their obstacle [m/s], [N]. */
double sw_contact_halt(sw_contact *contact, sw_system *system, double still);

/* Before sw_contact_commit: most friction of the touches of lines that began to press in this step
 * and slide, of those that a hold holds down on an obstacle: others hang from it, and swing [N]. */
double sw_contact_landed(const sw_contact *contact, const sw_system *system);
/* Most friction of all touches together [N]. */
double sw_contact_friction(const sw_contact *contact);

/* Displacement of friction's spring by the memory of a touch, in the obstacle's axes [m]. */
sw_vec sw_contact_stretch(const sw_contact *contact, const struct sw_touch *touch,
                          const struct sw_kept *kept);
/* As soft of sw_press; memory: the touch's, or NULL. On a rod whose drive comes to rest
 * (sw_contact_brake) friction's spring is as stiff as the rod's edge, and stays so while it sticks
 * [-]. */
double sw_contact_softness(const sw_contact *contact, const sw_system *system,
                           const struct sw_memory *memory, const struct sw_touch *touch);

#endif
