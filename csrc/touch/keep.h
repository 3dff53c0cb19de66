/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The memory of one touch between steps, the same for all kinds of bodies: its force, stiffness and
 * friction's spring. For the law itself see touch/law.h. */
#ifndef SW_TOUCH_KEEP_H
#define SW_TOUCH_KEEP_H

#include <stdint.h>

#include "base/vec.h"

struct sw_press;

typedef struct sw_kept {
  double normal_force; /* 0: near, but without force [N] */
  double depth;        /* depth at that force [m] */
  double k;            /* stiffness at the next step's start [N/m] */
  double steady;  /* mean normal force of the last steps; when just kept, that at the end [N] */
  double grip;    /* stiffness of friction's spring [N/m] */
  double left;    /* rest of the depth when it was stiffened because it was squeezed; HUGE_VAL: the
                     line has got other edges, and all that the force does not explain is due to
                     them, below 0 where it is outside now [m] */
  sw_vec elastic; /* displacement of friction's spring, with that stiffness [m] */
  int sliding;
  int16_t edited; /* 1: `left` is due to other edges, and stays though the touch opens */
  int16_t curve;  /* 1: it is on a smooth curve, not on a chord */
} sw_kept;

#define SW_STIFFENED_MOST 10.0 /* largest stiffening of a touch at once [-] */

/* Makes the memory of a touch at a step's end. usual: stiffness of a new touch, stiffer: stiffness
 * from the next iterate on [N/m]. A touch keeps its stiffness, because a change would be a kick; a
 * stiffness higher than needed decreases slowly. share: the step over a full one; a decrease per
 * step would take the force away in a few microseconds of short steps, each of which would be a
 * kick, and the wire would sink in (spec/contact/eased_spec) [-]. */
sw_kept sw_press_keep(const struct sw_press *press, double usual, double stiffer, double deepest,
                      double share);
/* Adds to friction's spring what the anchor slid in this step, for searches that come to rest in
 * several steps: only the last one may forget the slide, so that friction opposes the whole way.
 * known: 1 if the touch pressed before this step; it may open and close again in the search. A new
 * touch has moved freely, and that is no slide. */
void sw_kept_hold_slide(sw_kept *kept, const struct sw_press *press, int known);
/* 1 if friction's spring was stiffer than its touch, by more than rounding. */
static inline int sw_kept_is_stiff(const sw_kept *kept) {
  return kept->grip * kept->depth > 1.01 * kept->normal_force;
}
/* Stiffness of a line touch's friction spring, from its memory; 0: that of the touch [N/m]. Cables
 * are a thousand times stiffer along themselves than touches in steps of 10 ms. The end of a cable
 * pressed on a rod swung without tension: for each micrometre of the spring the cable needs newtons
 * (spec/contact/stiff_friction_spec). So friction that holds with more than the `usual` force is
 * twice as stiff as the edge: the pull of a swinging cable is then 3 % off, as with 4 and 10
 * times, and 13 % with once. A touch as stiff as the edge itself keeps to once: otherwise a tenth
 * of the steps of a taut cable is refused (spec/contact/taut_spec). While it slides it stays so,
 * because a softer spring would store energy from nowhere. */
double sw_kept_grip(const sw_kept *kept, double edge, double usual);
/* Displacement of friction's spring from the memory [m]. The force stays, at any new stiffness,
 * because a cable moves less than a spring would lose. Only on obstacles: a tight pair of cables
 * would gain energy. gives_way: 1 if the force changes with the stiffness of the touch. */
sw_vec sw_press_stretch(const struct sw_press *press, const sw_kept *kept, int gives_way);
/* 1 if the stiffness decreases in this step. */
int sw_press_eases(const struct sw_press *press, double usual, double stiffer, double deepest);
/* Stiffens a squeezed touch. A squeezed wire cannot come out: letting it out would make energy, and
 * the step would be refused. So a touch that is too deep keeps its force, gets stiffer from the
 * next step on, and keeps the rest of its depth (left). axial: stiffness of the wire's edge, the
 * upper limit, because between rigid bodies no force could be set [N/m]. */
void sw_kept_harden(sw_kept *kept, double axial, double deepest);
/* Raises the stiffness of a touch to at least k [N/m]. Its force stays. */
void sw_kept_firm(sw_kept *kept, double k);
/* Energy that a touch gains if its stiffness rises to k [J]. A mesh keeps its depth, so its spring
 * stores more. A line is light: it comes out, at constant force, to the depth for k. */
double sw_kept_hardened(const sw_kept *kept, double k, int mesh);
/* Sets stiffness = force over depth, for a look at an accepted state. sw_press_felt returns a touch
 * made from such a memory. */
void sw_kept_as_felt(sw_kept *kept);
struct sw_press sw_press_felt(const sw_kept *kept);

#endif
