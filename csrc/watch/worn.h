/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Read-outs of a wire's recorded wear, place by place; see wear.h. */
#ifndef SW_WATCH_WORN_H
#define SW_WATCH_WORN_H

#include "read/reading.h"
#include "record/wear.h"
#include "scene/scene.h"
#include "scene/values.h"

typedef struct sw_worn {
  double s;      /* [m] */
  double rubbed; /* work of friction per length [J/m] */
  double slid;   /* normal force per length times slid distance [N] */
  int side;      /* -1, 1: where the wire arrives at or leaves a clamp; else 0 */
} sw_worn;

/* Number of places; 0 where nothing is recorded. */
sw_status sw_scene_worn(const sw_scene *scene, sw_handle wire, size_t *places, sw_error *err);
/* Returns the largest pressure T/R of the wire on touched objects [N/m]. */
sw_extreme sw_scene_worn_sidewall(const sw_scene *scene, sw_handle wire);
/* Returns place number k. cycles: fills in its cycles of a signal (SW_CYCLES_KEPT + SW_CYCLES_OPEN
 * at most) and returns their number. */
sw_worn sw_scene_worn_place(const sw_scene *scene, sw_handle wire, size_t k);
size_t sw_scene_worn_cycles(const sw_scene *scene, sw_handle wire, size_t k, int signal,
                            sw_cycle *out);
/* Fills in the reversals that close cycles if the load is repeated (2 SW_CYCLES_OPEN at most), and
 * returns their number. */
size_t sw_scene_worn_residue(const sw_scene *scene, sw_handle wire, size_t k, int signal,
                             double *out);

#endif
