/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Constants with the same meaning for all contact: with obstacles, between wires and of
 * particles. */
#ifndef SW_TOUCH_SAME_H
#define SW_TOUCH_SAME_H

/* Places nearer to each other along a segment than this are one touch. Used between iterates, for a
 * blow and a touch, for crossings and candidates. Contact specs pass with half and twice this
 * [-]. */
#define SW_SAME_TOUCH 0.25

/* Slower approaches are no impacts; the integrator handles them. Their energy does not matter
 * [m/s]. */
#define SW_SLOWEST_IMPACT 5e-4

/* Updates shorter than this keep a touch's place and normal; share of the radii [-]. */
#define SW_SMALL_SHIFT 0.05

/* Reserve: things are candidates up to this multiple of the way that speeds and gravity can close
 * in a step [-]. */
#define SW_RESERVE 1.5

/* A wire begins to go round another one where its curvature times the sum of radii is above this.
 * The excess is the firmness of touches, so a place is never worse defined than where this begins.
 * The lean fades out up to an excess of one. Pulls of spec/contact/crossing_spec, with radii of 0.8
 * edges together: at T h^2/EI = 2 the pull swings by 10 % with 0.3, by 1 % with 0.5; at 100 by 10 %
 * with 0.5, by 80 % with 0.7 [-]. */
#define SW_GOES_ROUND 0.5

/* In an object of many particles friction's springs are softer than touches, by the number of
 * particles and at most by this factor. Hundreds of equally stiff springs would alternate between
 * sticking and sliding. A sticking object then gives way by tens of micrometres under its weight,
 * and comes back [-]. */
#define SW_SOFTEST 1000.0

/* A step may bring two things this much deeper into each other; share of the sum of radii [-]. */
#define SW_DEEPER 0.05

/* Largest overlap on the way of a step that the step may miss, and the least way on which there is
 * a larger one; shares of the radius, or of the sum of radii. Of 72 runs of cables that boxes
 * strike as they fall past their edges, in steps of 5 to 20 ms, 12 have no force at all without
 * this limit, 3 with it, all of one cable that grazes. In another 180 runs they are 8 and 3; with
 * an overlap of 0.25 they are 6, with 0.1 3 (spec/contact/brush_spec) [-]. */
#define SW_MISSED 0.03
#define SW_MISSED_WAY 0.48

/* A wire at rest sinks in by this much, or less if it is thin, if one touch carries its whole
 * weight. A round pad presses as deep at its force [m]. */
#define SW_ALLOWED_DEPTH 20e-6

/* Steps shorter than this share of the nominal one may end at any depth [-]. */
#define SW_SMALLEST_CARE (1.0 / 64)

#endif
