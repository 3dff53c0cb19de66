/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Accessors of a scene's parts. */
#include "scene/parts.h"

#include "base/alloc.h"
#include "link/joint.h"
#include "scene/forces.h"
#include "scene/gripper.h"
#include "scene/obstacle.h"
#include "scene/wire.h"
#include "scene/world.h"

size_t sw_scene_wire_slots(const sw_scene *s) { return s->wire_count; }
sw_scene_wire *sw_scene_wire_in(const sw_scene *s, size_t slot) { return &s->wires[slot]; }
size_t sw_scene_hold_slots(const sw_scene *s) { return s->hold_count; }
size_t sw_scene_living_holds(const sw_scene *s) {
  size_t n = 0;
  for (size_t k = 0; k < s->hold_count; k++) n += s->holds[k].alive != 0;
  return n;
}
sw_hold *sw_scene_hold_in(const sw_scene *s, size_t slot) { return &s->holds[slot]; }
size_t sw_scene_tool_slots(const sw_scene *s) { return s->tool_count; }
sw_tool *sw_scene_tool_in(const sw_scene *s, size_t slot) { return &s->tools[slot]; }
size_t sw_scene_obstacle_slots(const sw_scene *s) { return s->obstacle_count; }
sw_scene_obstacle *sw_scene_obstacle_in(const sw_scene *s, size_t slot) {
  return &s->obstacles[slot];
}
size_t sw_scene_force_slots(const sw_scene *s) { return s->force_count; }
size_t sw_scene_join_slots(const sw_scene *s) { return s->join_count; }
sw_scene_force *sw_scene_force_in(const sw_scene *s, size_t slot) { return &s->forces[slot]; }
sw_joint *sw_scene_join_in(const sw_scene *s, size_t slot) { return &s->joins[slot]; }
sw_hold *sw_scene_held_by(const sw_scene *s, size_t k) { return &s->holds[s->hold_slot[k]]; }
size_t sw_scene_bodies_made(const sw_scene *s) { return s->wire_count + s->gone_count; }

sw_contact *sw_scene_contact(const sw_scene *s) { return s->contact; }
sw_mutual *sw_scene_pairs(const sw_scene *s) { return s->pairs; }
sw_mutual *sw_scene_grains(const sw_scene *s) { return s->grains; }
sw_crowd *sw_scene_crowd(const sw_scene *s) { return s->crowd; }
sw_through *sw_scene_through(const sw_scene *s) { return s->through; }
int sw_scene_is_built(const sw_scene *s) { return s->built && !s->waiting; }
int sw_scene_is_placed(const sw_scene *s) { return s->built; }
int sw_scene_wears(const sw_scene *s) { return s->wears; }

/* Functions that take a const scene may change these parts, as they may change the objects in
 * lists. */
sw_system *sw_scene_system(const sw_scene *s) { return (sw_system *)&s->system; }
sw_course *sw_scene_course(const sw_scene *s) { return (sw_course *)&s->course; }
sw_books *sw_scene_books(const sw_scene *s) { return (sw_books *)&s->books; }
sw_events *sw_scene_events_of(const sw_scene *s) { return (sw_events *)&s->events; }
sw_zones *sw_scene_zones_of(const sw_scene *s) { return (sw_zones *)&s->zones; }
sw_watches *sw_scene_watches_of(const sw_scene *s) { return (sw_watches *)&s->watches; }
sw_frames *sw_scene_frames_of(const sw_scene *s) { return (sw_frames *)&s->frames; }
sw_rules *sw_scene_rules_of(const sw_scene *s) { return (sw_rules *)&s->rules; }
sw_histories *sw_scene_histories_of(const sw_scene *s) { return (sw_histories *)&s->histories; }
sw_kept_contact *sw_scene_kept(const sw_scene *s) { return (sw_kept_contact *)&s->kept; }
sw_hold_load *sw_scene_hold_loads(const sw_scene *s) { return s->hold_loads; }
sw_log *sw_scene_contact_steps(const sw_scene *s) { return (sw_log *)&s->contact_steps; }
sw_extreme *sw_scene_penetrated(const sw_scene *s) { return (sw_extreme *)&s->deepest; }
sw_review **sw_scene_review(const sw_scene *s) { return (sw_review **)&s->review; }

void sw_scene_diverge(sw_scene *s, const sw_error *why) { s->diverged = 1, s->why = *why; }
void sw_scene_set_wears(sw_scene *s, int wears) { s->wears = wears; }
void sw_scene_set_time(sw_scene *s, double time) { s->time = time; }
int sw_scene_begin_look(sw_scene *s) {
  const int running = s->running;
  s->running = 0, s->looking = 1;
  return running;
}
void sw_scene_end_look(sw_scene *s, int running) { s->running = running, s->looking = 0; }
void sw_scene_go_part(sw_scene *s, const sw_pose *from, double share) {
  s->part_from = from, s->part = share;
}

const sw_pose *sw_scene_part(const sw_scene *s, double *share) {
  *share = s->part;
  return s->part_from;
}
void sw_scene_renumber(sw_scene *s) { s->build = ++s->builds; }
void sw_scene_forget_mesh(sw_scene *s, size_t wire) {
  s->kept.changed = wire + 1;
  sw_course_jump(&s->course);
}
void sw_scene_feed_nodes(sw_scene *s) { s->kept.fed = 1; }
void sw_scene_unmake_body(sw_scene *s) { s->wire_count--; }
uint32_t sw_scene_number(sw_scene *s) { return ++s->serial; }

#define ADD(type, list, count, capacity)                \
  do {                                                  \
    SW_TRY(SW_GROW((list), (capacity), (count) + 1));   \
    (list)[count] = *(const type *)object;              \
    (list)[count].generation = ++s->serial;             \
    *out = (sw_handle){(uint32_t)(count)++, s->serial}; \
  } while (0)

sw_status sw_scene_add(sw_scene *s, sw_kind kind, const void *object, sw_handle *out) {
  switch (kind) {
    case SW_OF_BODY: ADD(sw_scene_wire, s->wires, s->wire_count, s->wire_capacity); break;
    case SW_OF_HOLD: ADD(sw_hold, s->holds, s->hold_count, s->hold_capacity); break;
    case SW_OF_OBSTACLE:
      ADD(sw_scene_obstacle, s->obstacles, s->obstacle_count, s->obstacle_capacity);
      break;
    case SW_OF_TOOL: ADD(sw_tool, s->tools, s->tool_count, s->tool_capacity); break;
    case SW_OF_FORCE: ADD(sw_scene_force, s->forces, s->force_count, s->force_capacity); break;
    case SW_OF_JOIN: ADD(sw_joint, s->joins, s->join_count, s->join_capacity); break;
    case SW_OF_NONE: return SW_EINVAL;
  }
  return SW_OK;
}

sw_scene_obstacle *sw_scene_driven(const sw_scene *s, const sw_scene_obstacle *last) {
  const uint32_t next = last ? last->next_driven : s->first_driven;
  return next > 1 ? &s->obstacles[next - 2] : NULL;
}

void sw_scene_note_driven(sw_scene *s, size_t slot) {
  sw_scene_obstacle *o = &s->obstacles[slot];
  if (!o->drive.motion || o->next_driven) return;
  o->next_driven = s->first_driven ? s->first_driven : 1;
  s->first_driven = (uint32_t)slot + 2;
}

void sw_scene_find_driven(sw_scene *s) {
  s->first_driven = 0;
  for (size_t k = 0; k < s->obstacle_count; k++) {
    s->obstacles[k].next_driven = 0;
    sw_scene_note_driven(s, k);
  }
}

void sw_scene_enter(sw_scene *s, int more) { s->running += more; }
