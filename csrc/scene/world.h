/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The scene's inside: the lists of its objects, the system that they are built into, and its
 * memory. For files that change the scene as a whole; others use parts.h. */
#ifndef SW_SCENE_WORLD_H
#define SW_SCENE_WORLD_H

#include "base/log.h"
#include "scene/course.h"
#include "scene/events.h"
#include "scene/ledger.h"
#include "scene/lists.h"
#include "scene/parts.h"
#include "scene/review.h"
#include "system/system.h"

struct sw_scene {
  char name[SW_NAME_SIZE];
  uint32_t serial;              /* generation of the object made last */
  sw_snapshot *snapshots;       /* living snapshots, a list */
  const sw_snapshot *restoring; /* being restored now, or NULL */
  sw_vec gravity;
  double time;
  sw_scene_wire *wires;
  size_t wire_count, wire_capacity;
  sw_gone *gone; /* bodies that were taken away, in order of time */
  size_t gone_count, gone_capacity;
  sw_hold *holds;
  size_t hold_count, hold_capacity;
  sw_scene_obstacle *obstacles;
  size_t obstacle_count, obstacle_capacity;
  uint32_t first_driven; /* as next_driven of an obstacle before the first; 0, 1: none */
  sw_log contact_steps;  /* time and span of the observed steps so far [s] */
  sw_tool *tools;
  size_t tool_count, tool_capacity;
  sw_scene_force *forces;
  size_t force_count, force_capacity;
  sw_joint *joins;
  size_t join_count, join_capacity;

  const sw_pose *part_from; /* settling: start poses of the holds, or NULL */
  double part;              /* share of their way [-] */

  int built;         /* system is valid and holds the state */
  int waiting;       /* 1: built, but forces have been added that the system does not have */
  size_t build;      /* number of the system; a copy of it has the same */
  size_t builds;     /* numbers given so far */
  int running;       /* above 0 inside a step or a user's function: edits are refused */
  int looking;       /* 1: an observer looks at the scene: edits are refused, reads are not */
  sw_review *review; /* a script's function reads a run that has ended, or NULL */
  sw_system system;
  int *hold_slot;           /* (system.hold_count) scene slot of each system hold */
  sw_hold_load *hold_loads; /* (system.hold_count) loads of the stage solved last */
  sw_contact *contact;      /* with obstacles, or NULL */
  sw_mutual *pairs;         /* between wires, or NULL */
  sw_mutual *grains;        /* between objects of particles and their neighbours, or NULL */
  sw_crowd *crowd;          /* between particles that repel each other, or NULL */
  sw_through *through;      /* passes of lines that have no contact, or NULL */
  sw_rules rules;
  sw_kept_contact kept;
  sw_histories histories;
  sw_course course; /* of its steps */

  int diverged;
  sw_error why;
  sw_extreme deepest; /* deepest penetration */
  int wears;          /* 1: wear of wires is recorded in the run */
  sw_zones zones;
  sw_frames frames;
  sw_events events; /* of the last run */
  sw_watches watches;
  sw_books books; /* energy of its last run */
};

#endif
