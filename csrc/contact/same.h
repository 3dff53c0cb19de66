/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers that mean the same wherever something touches: with obstacles, of wires and of particles.
 */
#ifndef SW_CONTACT_SAME_H
#define SW_CONTACT_SAME_H

/* Touches are the same one up to so far along a segment: of two iterates, of a blow and a touch, of
 * crossings and candidates. Specs of contact pass with half and with twice of it, too [-]. */
#define SW_SAME_TOUCH 0.25

/* Slower approaches are left to the integrator; their energy does not matter [m/s]. */
#define SW_SLOWEST_IMPACT 5e-4

/* Shorter updates leave place and normal of a touch as they are; of the radii [-]. */
#define SW_SMALL_SHIFT 0.05

/* Of what speeds and gravity can close in a step: what is as near may touch in it [-]. */
#define SW_RESERVE 1.5

/* A wire whose curvature times the radii is above this begins to go round what it touches. What it
 * is more than this is the firmness: so a place is never less of a nearest one than where it
 * begins. And as far as it goes round, up to one, it does not lean. Of the pulls of
 * spec/contact/crossing_spec at radii of 0.8 edges together, that at T h^2/EI = 2 swings by 10 %
 * with 0.3, by 1 % with 0.5; with 0.7 a limp one, at 100, by 80 % instead of 10 [-]. */
#define SW_GOES_ROUND 0.5

/* Friction's springs in an object of many particles are softer than its touches, by their number
 * and up to this: hundreds of touches at once whose springs are as stiff as they themselves go to
 * and fro between sticking and sliding. What sticks gives way by some tens of micrometres under
 * its weight, and comes back [-]. */
#define SW_SOFTEST 1000.0

/* A step may leave two things this much deeper in each other than it found them; of the sum of
 * their radii [-]. */
#define SW_DEEPER 0.05

/* In shorter steps than this share of the nominal one depth is taken as it comes [-]. */
#define SW_SMALLEST_CARE (1.0 / 64)

#endif
