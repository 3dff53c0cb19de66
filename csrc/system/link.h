/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stiffness between nodes that no wire connects: wires that touch, branches. While
 * there is any, the bodies it links are solved together; the others keep their bands. */
#ifndef SW_SYSTEM_LINK_H
#define SW_SYSTEM_LINK_H

#include "system/system.h"

/* An evaluation begins: no links. */
void sw_links_begin(sw_system *system);

/* Any in this evaluation? */
int sw_links_any(const sw_system *system);

/* With rows and right hand sides (in delta) of all bodies assembled, held nodes taken
 * out: solve for the linked bodies, twist included; marks them. Adds to negative. */
sw_status sw_links_solve(sw_system *system, size_t *negative);

/* What the last update makes links pull at the held nodes, added to their reactions. */
void sw_links_react(sw_system *system);

void sw_links_free(sw_system *system);

#endif
