/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Corners of drives: moments at which their acceleration jumps. */
#ifndef SW_STEP_CORNER_H
#define SW_STEP_CORNER_H

#include "step/stop.h"

/* *at: time after now of the first corner of a drive, up to h; HUGE_VAL: there is none [s]. */
sw_status sw_corner_first(const sw_scene *scene, double h, double *at, sw_error *err);
/* *yes: 1 if a drive has a corner now. */
sw_status sw_corner_now(const sw_scene *scene, int *yes, sw_error *err);

#endif
