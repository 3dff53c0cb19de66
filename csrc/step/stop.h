/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How drives come to rest. Shared by stop.c and lead.c only. */
#ifndef SW_STEP_STOP_H
#define SW_STEP_STOP_H

#include "motion/motion.h"
#include "scene/parts.h"

/* Length of parts near a stop [s]. A drive slower than SW_CREEPS does not throw wires [m/s],
 * [rad/s]. */
#define SW_STOPS 5e-4
#define SW_CREEPS 1e-3

/* Evaluates a motion just after t. For a function the velocity is a difference over times before
 * and after. */
sw_status sw_stop_eval(const sw_motion *motion, double t, sw_motion_state *out, sw_error *err);
double sw_stop_speed(const sw_motion_state *state); /* [m/s] and [rad/s] together */

/* The last time at which a motion still moves and the first at which it rests, after t [s]. */
typedef struct sw_rest {
  double moves, rests;
} sw_rest;
/* *yes: 1 if the motion comes to rest from t to t + h + near [s]. */
sw_status sw_stop_rests(const sw_motion *motion, double t, double h, double near, sw_rest *out,
                        int *yes, sw_error *err);
/* A stop later than this in a part of h counts as at its end [s]. */
double sw_stop_before_end(double h);

/* Sets *at to a time after t, up to h, if there is one [s]. */
typedef sw_status (*sw_when)(const sw_motion *motion, double t, double h, double *at,
                             sw_error *err);
/* Sets *at to 0. For the question whether there is any such drive. */
sw_status sw_stop_any(const sw_motion *motion, double t, double h, double *at, sw_error *err);
/* Which drives are searched. Functions of a script are slow; they are searched only while wires
 * slide. */
typedef enum sw_asked { SW_LAWS, SW_FUNCTIONS, SW_ALL_DRIVES } sw_asked;
/* Sets *at to the earliest time of all drives; HUGE_VAL: there is none [s]. */
sw_status sw_drives_first(const sw_scene *scene, double h, sw_asked which, sw_when of, double *at,
                          sw_error *err);
/* 1 if a touch slides. way: only touches that have slid less than this on an obstacle since they
 * began to press; HUGE_VAL: also wires on wires [m]. travel: only lines along which waves travel in
 * less time; HUGE_VAL: all wires [s]. */
int sw_drives_slide(const sw_scene *scene, double travel, double way);
/* sw_stop_note, when a drive stops at once: notes the stiff lines that slide along themselves.
 * sw_stop_tell, before each part: reports those that do not keep their friction (step/left.c). */
void sw_stop_note(sw_scene *scene);
void sw_stop_tell(sw_scene *scene);

#endif
