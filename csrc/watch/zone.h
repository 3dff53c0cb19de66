/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Zones of space that wires are watched in: nothing touches them. How near each wire comes is kept
 * of every step, and how near it may have come between two. */
#ifndef SW_WATCH_ZONE_H
#define SW_WATCH_ZONE_H

#include "record/zone.h"
#include "scene/scene.h"
#include "shape/shape.h"

typedef struct sw_zone_args {
  char name[SW_NAME_SIZE];
  sw_vec at;          /* [m] */
  sw_quat rotation;   /* [-] */
  double temperature; /* NAN = it is a zone to be kept out of [degC] */
  sw_handle on;       /* the obstacle that it goes with; generation 0: none */
} sw_zone_args;
extern const sw_params sw_zone_params;

typedef struct sw_zone {
  char name[SW_NAME_SIZE];
  sw_shape *shape;
  sw_pose pose;
  double temperature; /* [degC] */
  sw_handle on;       /* an obstacle; generation 0: it stands still */
  sw_pose carrier;    /* of that */
  sw_pose local;      /* of the zone in its axes */
} sw_zone;

/* Retains the shape. */
sw_status sw_scene_add_zone(sw_scene *scene, sw_shape *shape, const sw_zone_args *args,
                            sw_error *err);
size_t sw_scene_zones(const sw_scene *scene);
/* Number k of them. */
const sw_zone *sw_scene_zone(const sw_scene *scene, size_t k);
/* The past of a wire and zone number k; NULL: no step was watched. */
const sw_zone_past *sw_scene_zone_past(const sw_scene *scene, sw_handle wire, size_t k);

/* The state of wire w is one of the run. SW_ENOMEM. */
sw_status sw_zones_note(sw_scene *scene, size_t w, sw_error *err);
void sw_scene_clear_zone(sw_zone *zone);
void sw_tape_zone(sw_tape *tape, sw_zone *zone);

#endif
