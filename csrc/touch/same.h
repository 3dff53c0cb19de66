/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Constants with the same meaning for all contact: with obstacles, between wires and of
 * particles. */
#ifndef SW_TOUCH_SAME_H
#define SW_TOUCH_SAME_H

/* Places nearer to each other along a segment than this are one touch: between iterates, for a blow
 * and a touch, for crossings and candidates. Contact specs pass with half and twice this [-]. */
#define SW_SAME_TOUCH 0.25

/* Slower approaches are not impacts; the integrator treats them. Their energy does not matter
 * [m/s]. */
#define SW_SLOWEST_IMPACT 5e-4

/* A touch keeps its place and normal in shorter updates; share of the radii [-]. */
#define SW_SMALL_SHIFT 0.05

/* Reserve: candidates are nearer than this multiple of the approach by speed and gravity in a step
 * [-]. */
#define SW_RESERVE 1.5

/* A wire begins to go round another one where its curvature times the sum of radii is above this.
 * The excess is the firmness of touches, so no place is less well defined than at this limit. The
 * lean fades out up to an excess of one. Pulls of spec/contact/crossing_spec, with a sum of radii
 * of 0.8 edges: at T h^2/EI = 2 the pull swings by 10 % with 0.3, by 1 % with 0.5; at 100 by 10 %
 * with 0.5, by 80 % with 0.7 [-]. */
#define SW_GOES_ROUND 0.5

/* In an object of many particles the springs of friction are softer than touches by the number of
 * particles, at most by this factor. Hundreds of equally stiff springs would alternate between
 * sticking and sliding. A sticking object yields by some 10 um under its weight, and comes back
 * [-]. */
#define SW_SOFTEST 1000.0

/* A step may increase the depth of two things in each other by at most this share of the sum of
 * radii [-]. */
#define SW_DEEPER 0.05

/* Largest overlap within a step that may be missed, and the least path on which there is a larger
 * one; shares of the radius, or of the sum of radii. Of 72 runs of cables struck by boxes as they
 * fall past their edges, in steps of 5 to 20 ms, 12 have no force at all without this limit, and 3
 * with it, all of one grazing cable. In another 180 runs 8 and 3; with an overlap of 0.25 6, with
 * 0.1 3 (spec/contact/brush_spec) [-]. */
#define SW_MISSED 0.03
#define SW_MISSED_WAY 0.48

/* A wire at rest sinks in by this if one touch carries its whole weight; by less if it is thin. A
 * round pad has the same depth at its force [m]. */
#define SW_ALLOWED_DEPTH 20e-6

/* Steps shorter than this share of the nominal one may end at any depth [-]. */
#define SW_SMALLEST_CARE (1.0 / 64)

#endif
