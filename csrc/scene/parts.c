/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/parts.h"

#include "scene/gripper.h"
#include "scene/obstacle.h"
#include "scene/wire.h"
#include "scene/world.h"

size_t sw_scene_wire_slots(const sw_scene *s) { return s->wire_count; }
sw_scene_wire *sw_scene_wire_in(const sw_scene *s, size_t slot) { return &s->wires[slot]; }
size_t sw_scene_hold_slots(const sw_scene *s) { return s->hold_count; }
sw_hold *sw_scene_hold_in(const sw_scene *s, size_t slot) { return &s->holds[slot]; }
size_t sw_scene_tool_slots(const sw_scene *s) { return s->tool_count; }
sw_tool *sw_scene_tool_in(const sw_scene *s, size_t slot) { return &s->tools[slot]; }
size_t sw_scene_obstacle_slots(const sw_scene *s) { return s->obstacle_count; }
sw_scene_obstacle *sw_scene_obstacle_in(const sw_scene *s, size_t slot) {
  return &s->obstacles[slot];
}
size_t sw_scene_force_slots(const sw_scene *s) { return s->force_count; }
size_t sw_scene_join_slots(const sw_scene *s) { return s->join_count; }
size_t sw_scene_bodies_made(const sw_scene *s) { return s->wire_count + s->gone_count; }

sw_contact *sw_scene_contact(const sw_scene *s) { return s->contact; }
sw_pairs *sw_scene_pairs(const sw_scene *s) { return s->pairs; }
sw_grains *sw_scene_grains(const sw_scene *s) { return s->grains; }

/* What hangs on a scene may be changed by those that only look at the scene, as the lists may. */
sw_system *sw_scene_system(const sw_scene *s) { return (sw_system *)&s->system; }
sw_course *sw_scene_course(const sw_scene *s) { return (sw_course *)&s->course; }
sw_books *sw_scene_books(const sw_scene *s) { return (sw_books *)&s->books; }
sw_events *sw_scene_events_of(const sw_scene *s) { return (sw_events *)&s->events; }

void sw_scene_enter(sw_scene *s, int more) { s->running += more; }
