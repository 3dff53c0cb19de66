/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers with one meaning for all contact: with obstacles, between wires and of particles. */
#ifndef SW_CONTACT_SAME_H
#define SW_CONTACT_SAME_H

/* Places nearer than this along a segment are one touch: in two iterates, of a blow and a touch, of
 * crossings and candidates. Contact specs pass with half and twice of it [-]. */
#define SW_SAME_TOUCH 0.25

/* Slower approaches are left to the integrator; their energy does not matter [m/s]. */
#define SW_SLOWEST_IMPACT 5e-4

/* Shorter updates keep a touch's place and normal; of the radii [-]. */
#define SW_SMALL_SHIFT 0.05

/* Reserve: things are candidates up to this multiple of the way that speeds and gravity close in a
 * step [-]. */
#define SW_RESERVE 1.5

/* A wire begins to go round another one where curvature times the sum of radii is above this. The
 * excess is its firmness, so a place never becomes worse defined than where that begins; up to an
 * excess of one the lean fades out. Pulls of spec/contact/crossing_spec, radii of 0.8 edges
 * together: at T h^2/EI = 2 the pull swings by 10 % with 0.3, by 1 % with 0.5; at 100 by 10 % with
 * 0.5, by 80 % with 0.7 [-]. */
#define SW_GOES_ROUND 0.5

/* In an object of many particles friction's springs are softer than touches, by the number of
 * particles and at most by this. Hundreds of equally stiff springs would alternate between sticking
 * and sliding. Sticking then gives way by tens of micrometres under its weight, and comes back [-].
 */
#define SW_SOFTEST 1000.0

/* A step may make two things this much deeper in each other; of the sum of radii [-]. */
#define SW_DEEPER 0.05

/* Steps shorter than this share of the nominal one accept any depth [-]. */
#define SW_SMALLEST_CARE (1.0 / 64)

#endif
