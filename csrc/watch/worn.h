/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run did to a wire, place by place, where it was asked to keep that; see wear.h. */
#ifndef SW_WATCH_WORN_H
#define SW_WATCH_WORN_H

#include "read/reading.h"
#include "record/wear.h"
#include "scene/scene.h"
#include "scene/values.h"

typedef struct sw_worn {
  double s;      /* [m] */
  double rubbed; /* work of friction per length [J/m] */
  double slid;   /* normal force per length times the way that slid [N] */
  int side;      /* -1, 1: where the wire enters or leaves what holds its direction; else 0 */
} sw_worn;

/* How many places there are: 0 where nothing is kept. */
sw_status sw_scene_worn(const sw_scene *scene, sw_handle wire, size_t *places, sw_error *err);
/* The largest pressure T/R of its surface where it touched something [N/m]. */
sw_extreme sw_scene_worn_sidewall(const sw_scene *scene, sw_handle wire);
/* Place number k of them, and its cycles of a signal (SW_CYCLES_KEPT + SW_CYCLES_OPEN at most),
 * whose number is returned. */
sw_worn sw_scene_worn_place(const sw_scene *scene, sw_handle wire, size_t k);
size_t sw_scene_worn_cycles(const sw_scene *scene, sw_handle wire, size_t k, int signal,
                            sw_cycle *out);
/* Values of the reversals among these that still wait for their cycle (SW_CYCLES_OPEN at most);
 * gives how many. */
size_t sw_scene_worn_open(const sw_scene *scene, sw_handle wire, size_t k, int signal, double *out);

#endif
