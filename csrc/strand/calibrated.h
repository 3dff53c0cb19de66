/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Calibrations of meshes, with their owners, and those that were made last. A run that chooses its
 * model makes the same mesh several times, and the search for its springs often takes longer than
 * the run. */
#ifndef SW_STRAND_CALIBRATED_H
#define SW_STRAND_CALIBRATED_H

#include "calibrate/calibrate.h"

/* The calibration of a mesh, shared by all strands that have its web. It does not change. */
typedef struct sw_strand_calibrated {
  int references;
  sw_calibration calibration;
} sw_strand_calibrated;

void sw_strand_calibrated_retain(void *calibrated);
void sw_strand_calibrated_release(void *calibrated); /* NULL is allowed */

/* All that a calibration depends on. Its bytes are compared, so make it with all bytes 0 first; a
 * byte that differs by chance only costs another calibration. */
typedef struct sw_strand_need {
  sw_calibrate_args args;
  sw_section section;
  sw_lattice_args lattice;
} sw_strand_need;

/* Returns the calibration for this need, for one more owner; NULL: there is none. recent may be
 * NULL. */
typedef struct sw_strand_recent sw_strand_recent;
sw_strand_calibrated *sw_strand_recent_find(const sw_strand_recent *recent,
                                            const sw_strand_need *need);
/* Keeps a calibration in place of the oldest one. recent may be NULL. */
void sw_strand_recent_keep(sw_strand_recent *recent, const sw_strand_need *need,
                           sw_strand_calibrated *made);
/* Returns an empty list of recent calibrations, or NULL without memory; to be used by one thread.
 */
sw_strand_recent *sw_strand_recent_new(void);
void sw_strand_recent_free(sw_strand_recent *recent); /* NULL is allowed */

#endif
