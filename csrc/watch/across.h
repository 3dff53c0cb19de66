/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How wires that are straight or plane leave their line or plane under a push. */
#ifndef SW_WATCH_ACROSS_H
#define SW_WATCH_ACROSS_H

#include "modal/modal.h"
#include "scene/parts.h"
#include "system/pushed.h"
#include "system/system.h"

/* 1 if the wire lies in a plane, bent by more than `bent` [-]; fills the plane's normal. */
int sw_scene_lies_in_plane(const sw_system *system, const sw_body *b, double bent, sw_vec *normal);
/* Counts the motions across this plane that grow faster than sqrt(slow); *rate: of the fastest
 * [1/s]. The system must be linearised, if `slips` by sw_scene_linearise_slipping: then motions do
 * not count that friction holds when the bend has grown so far, as a logarithm. Status as of
 * sw_modal_solve. */
typedef struct sw_across {
  sw_vec normal; /* of the plane */
  double slow;   /* [1/s2] */
  int slips;
  double growth; /* [-] */
} sw_across;
sw_status sw_scene_unstable_across(const sw_scene *s, size_t w, const sw_across *of, size_t *count,
                                   double *rate);
/* 1 if a motion of a wire overcomes the friction of obstacles, see above. */
int sw_scene_overcomes(const sw_scene *s, size_t w, const sw_modes *modes, size_t k, double growth);

/* By how much the obstacles on which a wire lies slow down a motion where they are hollow, as tubes
 * are: to be added to its omega2 [1/s2]. */
double sw_scene_drawn_back(const sw_scene *s, size_t w, const sw_modes *modes, size_t k);

/* How a wire that is pushed would bend to the side, if it were straight where it is pushed. */
typedef struct sw_bend {
  sw_pushed piece;
  double rate;     /* of growth without friction; 0: it does not grow [1/s] */
  double friction; /* that holds the piece, per length [N/m] */
} sw_bend;
void sw_scene_bend_of(const sw_scene *s, const sw_body *b, sw_bend *out);
/* The rate of growth where the obstacles on which the wire lies may be hollow, as tubes are: they
 * draw it back. 0: it does not grow [1/s]. */
double sw_bend_rate_in_trough(const sw_scene *s, const sw_body *b, const sw_bend *bend);
/* 1 if the bend of a real wire overcomes friction. growth: its logarithm so far [-]. */
int sw_bend_grows(const sw_body *b, const sw_bend *bend, double growth);

#endif
