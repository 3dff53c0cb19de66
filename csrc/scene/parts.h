/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The parts of a scene, one by one, for files that need not see all of it (world.h). For the rooms
 * of the scene only. */
#ifndef SW_SCENE_PARTS_H
#define SW_SCENE_PARTS_H

#include "base/each.h"
#include "scene/scene.h"

/* Each in a header of its own. */
typedef struct sw_scene_wire sw_scene_wire;         /* wire.h */
typedef struct sw_hold sw_hold;                     /* link/hold.h */
typedef struct sw_scene_obstacle sw_scene_obstacle; /* obstacle.h */
typedef struct sw_tool sw_tool;                     /* gripper.h */
typedef struct sw_gone sw_gone;                     /* wire.h */
typedef struct sw_scene_force sw_scene_force;       /* forces.h */
typedef struct sw_joint sw_joint;                   /* link/joint.h */
typedef struct sw_kept_history sw_kept_history;     /* body/history.h */
typedef struct sw_course sw_course;                 /* course.h */
typedef struct sw_books sw_books;                   /* ledger.h */
typedef struct sw_events sw_events;                 /* events.h */
typedef struct sw_zones sw_zones;                   /* lists.h, as are the next five */
typedef struct sw_watches sw_watches;
typedef struct sw_frames sw_frames;
typedef struct sw_rules sw_rules;
typedef struct sw_kept_contact sw_kept_contact;
typedef struct sw_histories sw_histories;
typedef struct sw_scene_rule sw_scene_rule; /* body/touching.h */
typedef struct sw_frame sw_frame;           /* read/kept_frames.h */
typedef struct sw_system sw_system;
typedef struct sw_contact sw_contact;
typedef struct sw_mutual sw_mutual;
typedef struct sw_crowd sw_crowd;
typedef struct sw_hold_load sw_hold_load;
typedef struct sw_log sw_log;

/* Slots of each kind [-], and what is in one; some may be empty. */
size_t sw_scene_wire_slots(const sw_scene *scene);
sw_scene_wire *sw_scene_wire_in(const sw_scene *scene, size_t slot);
size_t sw_scene_hold_slots(const sw_scene *scene);
sw_hold *sw_scene_hold_in(const sw_scene *scene, size_t slot);
size_t sw_scene_tool_slots(const sw_scene *scene);
sw_tool *sw_scene_tool_in(const sw_scene *scene, size_t slot);
size_t sw_scene_obstacle_slots(const sw_scene *scene);
sw_scene_obstacle *sw_scene_obstacle_in(const sw_scene *scene, size_t slot);
size_t sw_scene_force_slots(const sw_scene *scene);
sw_scene_force *sw_scene_force_in(const sw_scene *scene, size_t slot);
size_t sw_scene_join_slots(const sw_scene *scene);
sw_joint *sw_scene_join_in(const sw_scene *scene, size_t slot);
/* While it is built: the hold that is number k of the system. */
sw_hold *sw_scene_held_by(const sw_scene *scene, size_t k);
/* For each object of a list, those that are gone too: SW_EACH(hold, h, scene) with an sw_hold *h.
 */
#define SW_EACH(kind, object, scene)                                                            \
  SW_ITEMS(__typeof__(*sw_scene_##kind##_in(scene, 0)), object, sw_scene_##kind##_in(scene, 0), \
           sw_scene_##kind##_slots(scene))
/* How many bodies were made so far, those that are gone too: frames have a number for each. */
size_t sw_scene_bodies_made(const sw_scene *scene);

/* The system that they are built into; each kind of contact may be NULL. */
sw_system *sw_scene_system(const sw_scene *scene);
sw_contact *sw_scene_contact(const sw_scene *scene);
sw_mutual *sw_scene_pairs(const sw_scene *scene);
sw_mutual *sw_scene_grains(const sw_scene *scene);
sw_crowd *sw_scene_crowd(const sw_scene *scene);
int sw_scene_is_built(const sw_scene *scene); /* 1: the system is valid and holds the state */

/* Its steps, their energy, its events, and the lists of lists.h. */
sw_course *sw_scene_course(const sw_scene *scene);
sw_books *sw_scene_books(const sw_scene *scene);
sw_events *sw_scene_events_of(const sw_scene *scene);
sw_zones *sw_scene_zones_of(const sw_scene *scene);
sw_watches *sw_scene_watches_of(const sw_scene *scene);
sw_frames *sw_scene_frames_of(const sw_scene *scene);
sw_rules *sw_scene_rules_of(const sw_scene *scene);
sw_kept_contact *sw_scene_kept(const sw_scene *scene);
sw_histories *sw_scene_histories_of(const sw_scene *scene);
sw_hold_load *sw_scene_hold_loads(const sw_scene *scene); /* (holds) of the stage solved last */
sw_log *sw_scene_contact_steps(const sw_scene *scene);    /* time and span of those observed [s] */
sw_extreme *sw_scene_penetrated(const sw_scene *scene);   /* the deepest penetration of the run */
int sw_scene_wears(const sw_scene *scene);                /* 1: wear of wires is recorded */

/* The given name, or kind and a number. */
void sw_scene_give_name(char *out, const char *wanted, const char *kind, size_t number);

/* Nothing may be read until another state is restored, and why. */
void sw_scene_diverge(sw_scene *scene, const sw_error *why);
void sw_scene_set_wears(sw_scene *scene, int wears);
void sw_scene_set_time(sw_scene *scene, double time); /* [s] */
/* An observer looks: what runs stands still, and nothing may be changed. Returns what is to be
 * given back when it has. */
int sw_scene_begin_look(sw_scene *scene);
void sw_scene_end_look(sw_scene *scene, int running);
/* Holds are at this share of their way from these poses; NULL: at its end. */
void sw_scene_go_part(sw_scene *scene, const sw_pose *from, double share);
const sw_pose *sw_scene_part(const sw_scene *scene, double *share); /* both */
/* The built system is another one now, as if it were built anew. */
void sw_scene_renumber(sw_scene *scene);
/* The wire has other nodes: contact remembers nothing of it, and its velocities jump. */
void sw_scene_forget_mesh(sw_scene *scene, size_t wire);
/* Drop the body made last from the list; nothing of it is freed. */
void sw_scene_unmake_body(sw_scene *scene);
/* Another number than any that was given before: a generation, a shape of a hold. */
uint32_t sw_scene_number(sw_scene *scene);
/* A copy of a new object into the list of its kind, with a number of its own. SW_ENOMEM. */
sw_status sw_scene_add(sw_scene *scene, sw_kind kind, const void *object, sw_handle *out);

/* Inside a step or a user's function, until the same with -1: edits are refused. */
void sw_scene_enter(sw_scene *scene, int more);

#endif
