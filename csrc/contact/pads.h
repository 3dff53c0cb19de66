/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pads of grippers: where a wire touches them, and how stiff these touches are. */
#ifndef SW_CONTACT_PADS_H
#define SW_CONTACT_PADS_H

#include "contact/touch.h"

enum { SW_LEAST_SAMPLES = 2 }; /* least samples of a segment [-] */

/* Finds for a body the distance of samples along each pad (spaced), and the pads that touch only
 * its particles (dense). */
void sw_pads_look(sw_contact *c, const sw_plan *p);

/* Number of samples of segment i on obstacle o; 0: none [-]. */
int sw_pad_samples(const sw_contact *c, const sw_plan *p, size_t i, size_t o);

/* 1 if particles meet pad o with rounded rims, as the surface between them would meet sharp ones.
 */
int sw_pad_has_rims(const sw_contact *c, int o);
/* Nearest place of such a pad to a particle at p, in the pad's axes. Returns 0 beyond the reach. */
int sw_pad_point(const sw_contact *c, const sw_candidate *k, sw_vec p, double reach,
                 sw_closest *out);

/* Stiffness of a pad's touch on a wire without a section: that of a section, but no stiffer than
 * the force needs. Between rigid bodies no force could be set [N/m]. */
double sw_pad_stiffness(const sw_contact *c, const sw_plan *p, const sw_candidate *k, size_t edge);
/* Smallest stiffness of an obstacle's touch on a particle of a mesh at x. 0: no limit, if all
 * obstacles stand still and nothing squeezes [N/m]. */
double sw_pad_mesh_stiffness(const sw_contact *c, const sw_plan *p, size_t particle, sw_vec x,
                             size_t obstacle);

#endif
