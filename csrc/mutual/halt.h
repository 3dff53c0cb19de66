/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Friction between wires that come to rest together with their drive: contact/halt.h for touches of
 * wires with each other. */
#ifndef SW_MUTUAL_HALT_H
#define SW_MUTUAL_HALT_H

#include "contact/halt.h"
#include "mutual/mutual.h"

void sw_mutual_against(const sw_mutual *pairs, const sw_system *system, sw_against *sum);
/* contact: contact with obstacles, which support the wires too, or NULL. */
double sw_mutual_halt(sw_mutual *pairs, const sw_contact *contact, const sw_system *system,
                      double still);
double sw_mutual_friction(const sw_mutual *pairs);
void sw_mutual_along(const sw_mutual *pairs, const sw_system *system, size_t body, sw_along *sum);

#endif
