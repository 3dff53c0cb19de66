/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Access to the single parts of a scene, for files that need not see all of it (world.h). For the
 * rooms of the scene only. */
#ifndef SW_SCENE_PARTS_H
#define SW_SCENE_PARTS_H

#include "base/each.h"
#include "scene/scene.h"

/* Types, each with its own header. */
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
typedef struct sw_through sw_through;
typedef struct sw_hold_load sw_hold_load;
typedef struct sw_log sw_log;

/* Number of slots of each kind [-], and the object in a slot; it may be dead. */
size_t sw_scene_wire_slots(const sw_scene *scene);
sw_scene_wire *sw_scene_wire_in(const sw_scene *scene, size_t slot);
size_t sw_scene_hold_slots(const sw_scene *scene);
/* Number of living holds [-]. Room for them must not grow with the slots: each block would be
 * larger than the last one freed, and the heap would keep them all. */
size_t sw_scene_living_holds(const sw_scene *scene);
sw_hold *sw_scene_hold_in(const sw_scene *scene, size_t slot);
size_t sw_scene_tool_slots(const sw_scene *scene);
sw_tool *sw_scene_tool_in(const sw_scene *scene, size_t slot);
size_t sw_scene_obstacle_slots(const sw_scene *scene);
sw_scene_obstacle *sw_scene_obstacle_in(const sw_scene *scene, size_t slot);
size_t sw_scene_force_slots(const sw_scene *scene);
sw_scene_force *sw_scene_force_in(const sw_scene *scene, size_t slot);
size_t sw_scene_join_slots(const sw_scene *scene);
sw_joint *sw_scene_join_in(const sw_scene *scene, size_t slot);
/* Returns the hold that is number k of the system, while the scene is built. */
sw_hold *sw_scene_held_by(const sw_scene *scene, size_t k);
/* Loops over all objects of a list, including dead ones: SW_EACH(hold, h, scene) with an sw_hold
 * *h. */
#define SW_EACH(kind, object, scene)                                                            \
  SW_ITEMS(__typeof__(*sw_scene_##kind##_in(scene, 0)), object, sw_scene_##kind##_in(scene, 0), \
           sw_scene_##kind##_slots(scene))
/* Loops over the obstacles that have or had a motion of their own: SW_EACH_DRIVEN(o, scene).
 * Scenes may have thousands of obstacles that stand. */
#define SW_EACH_DRIVEN(o, scene) \
  for (sw_scene_obstacle * (o) = sw_scene_driven(scene, NULL); (o); (o) = sw_scene_driven(scene, o))
/* Returns the first of them, or the one after `last`; NULL: no more. */
sw_scene_obstacle *sw_scene_driven(const sw_scene *scene, const sw_scene_obstacle *last);
/* Puts the obstacle in that list, unless it is there or has no motion. Call when it gets one. */
void sw_scene_note_driven(sw_scene *scene, size_t slot);
/* Makes the list anew from the obstacles. */
void sw_scene_find_driven(sw_scene *scene);
/* Returns the number of bodies made so far, including those that are gone: frames number them
 * all. */
size_t sw_scene_bodies_made(const sw_scene *scene);

/* The system that the objects are built into. Each kind of contact may be NULL. */
sw_system *sw_scene_system(const sw_scene *scene);
sw_contact *sw_scene_contact(const sw_scene *scene);
sw_mutual *sw_scene_pairs(const sw_scene *scene);
sw_mutual *sw_scene_grains(const sw_scene *scene);
sw_crowd *sw_scene_crowd(const sw_scene *scene);
sw_through *sw_scene_through(const sw_scene *scene); /* passes of lines; NULL before it is built */
int sw_scene_is_built(const sw_scene *scene); /* 1: the system is valid and holds the state */
/* The same, but forces may be missing in it: nodes are where they are. */
int sw_scene_is_placed(const sw_scene *scene);

/* The scene's steps, energy, events, and the lists of lists.h. */
sw_course *sw_scene_course(const sw_scene *scene);
sw_books *sw_scene_books(const sw_scene *scene);
sw_events *sw_scene_events_of(const sw_scene *scene);
sw_zones *sw_scene_zones_of(const sw_scene *scene);
sw_watches *sw_scene_watches_of(const sw_scene *scene);
sw_frames *sw_scene_frames_of(const sw_scene *scene);
sw_rules *sw_scene_rules_of(const sw_scene *scene);
sw_kept_contact *sw_scene_kept(const sw_scene *scene);
sw_histories *sw_scene_histories_of(const sw_scene *scene);
sw_hold_load *sw_scene_hold_loads(const sw_scene *scene); /* (holds) loads of the stage solved
                                                             last */
sw_log *sw_scene_contact_steps(const sw_scene *scene);    /* time and span of the observed steps
                                                             [s] */
sw_extreme *sw_scene_penetrated(const sw_scene *scene);   /* deepest penetration of the run */
int sw_scene_wears(const sw_scene *scene);                /* 1: wear of wires is recorded */

/* Writes the wanted name, or, if it is empty, the kind and a number. */
void sw_scene_give_name(char *out, const char *wanted, const char *kind, size_t number);

/* Marks the scene as diverged: reads are refused until another state is restored. */
void sw_scene_diverge(sw_scene *scene, const sw_error *why);
void sw_scene_set_wears(sw_scene *scene, int wears);
void sw_scene_set_time(sw_scene *scene, double time); /* [s] */
/* Begins the look of an observer: the run pauses, and changes are refused. Returns the value that
 * sw_scene_end_look takes. */
int sw_scene_begin_look(sw_scene *scene);
void sw_scene_end_look(sw_scene *scene, int running);
/* Puts holds at this share of their way from the poses `from`; NULL: at its end. */
void sw_scene_go_part(sw_scene *scene, const sw_pose *from, double share);
const sw_pose *sw_scene_part(const sw_scene *scene, double *share); /* returns both */
/* Gives the built system a new number, as if it were built anew. */
void sw_scene_renumber(sw_scene *scene);
/* Call when the wire has other nodes: contact forgets it, and its velocities jump. */
void sw_scene_forget_mesh(sw_scene *scene, size_t wire);
/* Call when only feeding makes and removes nodes until the scene is built. */
void sw_scene_feed_nodes(sw_scene *scene);
/* Drops the last body from the list without freeing its memory. */
void sw_scene_unmake_body(sw_scene *scene);
/* Returns a new number, for a generation or a shape of a hold. */
uint32_t sw_scene_number(sw_scene *scene);
/* Copies a new object into the list of its kind, with a new generation. SW_ENOMEM. */
sw_status sw_scene_add(sw_scene *scene, sw_kind kind, const void *object, sw_handle *out);

/* more = 1: enters a step or a user's function, so that edits are refused; -1: leaves it. */
void sw_scene_enter(sw_scene *scene, int more);

#endif
