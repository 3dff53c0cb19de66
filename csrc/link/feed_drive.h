/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The force of a feed's drive. Private to this room. */
#ifndef SW_LINK_FEED_DRIVE_H
#define SW_LINK_FEED_DRIVE_H

#include "link/hold.h"

/* Returns the direction in which wire is paid out [-]. */
sw_vec sw_feed_direction(const sw_hold *hold, const sw_system *system);
/* Returns the drive's share of the force on the wire in the guide, with nodes at x [N]. */
double sw_feed_drive(const sw_hold *hold, const sw_link_wire *wire, const double *x, sw_vec force);

#endif
