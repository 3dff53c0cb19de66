/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is the same one, and what is too slow to strike: of touches with obstacles, with other wires
 * and with themselves. */
#ifndef SW_CONTACT_SAME_H
#define SW_CONTACT_SAME_H

/* Touches are the same one up to so far along a segment: of two iterates, of a blow and a touch, of
 * crossings and candidates. Specs of contact pass with half and with twice of it, too [-]. */
#define SW_SAME_TOUCH 0.25

/* Slower approaches are left to the integrator; their energy does not matter [m/s]. */
#define SW_SLOWEST_IMPACT 5e-4

/* A step may leave two things this much deeper in each other than it found them; of the sum of
 * their radii [-]. */
#define SW_DEEPER 0.05

/* In shorter steps than this share of the nominal one depth is taken as it comes [-]. */
#define SW_SMALLEST_CARE (1.0 / 64)

#endif
