/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Zones of space in which wires are watched; nothing touches them. For each wire the smallest
 * distance at all steps is kept, and a lower bound of the distance between steps. */
#ifndef SW_WATCH_ZONE_H
#define SW_WATCH_ZONE_H

#include "record/zone.h"
#include "scene/scene.h"
#include "shape/shape.h"

typedef struct sw_zone_args {
  char name[SW_NAME_SIZE];
  sw_vec at;          /* [m] */
  sw_quat rotation;   /* [-] */
  double temperature; /* NAN = a forbidden zone [degC] */
  sw_handle on;       /* obstacle that the zone moves with; generation 0: none */
} sw_zone_args;
extern const sw_params sw_zone_params;

typedef struct sw_zone {
  char name[SW_NAME_SIZE];
  sw_shape *shape;
  sw_pose pose;
  double temperature; /* [degC] */
  sw_handle on;       /* obstacle that it moves with; generation 0: it stands still */
  sw_pose carrier;    /* pose of that obstacle */
  sw_pose local;      /* the zone's pose in the obstacle's axes */
} sw_zone;

/* Adds a zone; retains the shape. */
sw_status sw_scene_add_zone(sw_scene *scene, sw_shape *shape, const sw_zone_args *args,
                            sw_error *err);
size_t sw_scene_zones(const sw_scene *scene);
/* Returns zone number k. */
const sw_zone *sw_scene_zone(const sw_scene *scene, size_t k);
/* Returns the history of a wire and zone number k; NULL: no step was watched. */
const sw_zone_past *sw_scene_zone_past(const sw_scene *scene, sw_handle wire, size_t k);

/* Notes the present state of wire w. SW_ENOMEM. */
sw_status sw_zones_note(sw_scene *scene, size_t w, sw_error *err);
void sw_scene_clear_zone(sw_zone *zone);
void sw_tape_zone(sw_tape *tape, sw_zone *zone);

#endif
