/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The scene's inside, shared by the files of this room only. */
#ifndef SW_SCENE_WORLD_H
#define SW_SCENE_WORLD_H

#include "base/log.h"
#include "contact/contact.h"
#include "contact/crowd.h"
#include "contact/grains.h"
#include "contact/pairs.h"
#include "scene/course.h"
#include "scene/events.h"
#include "scene/feed.h"
#include "scene/frames.h"
#include "scene/hold.h"
#include "scene/jaws.h"
#include "scene/join.h"
#include "scene/ledger.h"
#include "scene/line.h"
#include "scene/objects.h"
#include "scene/scene.h"
#include "scene/section.h"
#include "scene/strand.h"
#include "scene/tool.h"
#include "scene/watch.h"
#include "scene/window.h"
#include "state/mesh.h"
#include "system/system.h"

typedef struct sw_scene_obstacle {
  uint32_t generation;
  int alive;
  char name[SW_NAME_SIZE];
  sw_shape *shape;
  sw_drive drive;
  double friction, kinetic, restitution;
  int off; /* 1: wires pass through it for the time being */
  sw_contact_past past;
  sw_log log;
  size_t
      logged; /* of the scene's steps with contact: those that its log has, or was not there for */
} sw_scene_obstacle;

typedef struct sw_scene_force {
  uint32_t generation;
  int alive;
  char name[SW_NAME_SIZE]; /* for events, or "" */
  const sw_force_class *cls;
  long wire;    /* -1 = all */
  double scale; /* of the wire's mesh when it was made [-] */
  double args[SW_FORCE_ARGS_MAX / sizeof(double)];
  uint32_t *particle; /* of a force on some particles: its list, which args name; or NULL */
} sw_scene_force;

/* Which wires touch each other, as stated. */
typedef struct sw_scene_rule {
  uint32_t *wires; /* (count) slots; count 0 = all */
  size_t count;
  int self; /* each with itself too */
  sw_pair_rule rule;
} sw_scene_rule;

typedef struct sw_frame {
  double time;                      /* [s] */
  double energy[SW_FRAME_ENERGIES]; /* [J] */
  float *data;                      /* one block, see frames.c */
  size_t size;                      /* of the block [-] */
  size_t wires, obstacles, holds, tools;
} sw_frame;

/* What a force on a wire remembers between two systems. */
typedef struct sw_kept_history {
  size_t force, wire;
  const sw_force_class *inner; /* of a wire's recipe, or NULL: one of the scene's forces */
  uint32_t generation;         /* of the force */
  sw_plan *plan;               /* retained */
  double *data;
} sw_kept_history;

struct sw_scene {
  char name[SW_NAME_SIZE];
  uint32_t serial;              /* generation of the object made last */
  sw_snapshot *snapshots;       /* the living ones, a list */
  const sw_snapshot *restoring; /* being restored now, or NULL */
  sw_vec gravity;
  double time;
  sw_scene_wire *wires;
  size_t wire_count, wire_capacity;
  sw_hold *holds;
  size_t hold_count, hold_capacity;
  sw_scene_obstacle *obstacles;
  size_t obstacle_count, obstacle_capacity;
  sw_log contact_steps; /* time and span of those observed so far [s] */
  sw_tool *tools;
  size_t tool_count, tool_capacity;
  sw_scene_force *forces;
  size_t force_count, force_capacity;
  sw_joint *joins;
  size_t join_count, join_capacity;

  const sw_pose *part_from; /* settling: where the holds come from, or NULL */
  double part;              /* share of their way [-] */

  int built;     /* system is valid and holds the state */
  size_t build;  /* number of the system: one made alike has the same */
  size_t builds; /* numbers given */
  int running;   /* above 0 inside a step or a user's function: edits are refused */
  int looking;   /* 1: an observer looks at it: the same, but it can be read */
  sw_system system;
  int *hold_slot;           /* (system.hold_count) scene slot of each system hold */
  sw_hold_load *hold_loads; /* (system.hold_count) of the stage that was solved last */
  sw_contact *contact;      /* with obstacles, or NULL */
  sw_pairs *pairs;          /* between wires, or NULL */
  sw_grains *grains;        /* between objects of particles and what else touches them, or NULL */
  sw_crowd *crowd;          /* between particles that repel each other, or NULL */
  sw_scene_rule *rules;     /* that pairs are made by */
  size_t rule_count, rule_capacity;
  struct {        /* contact memory of the last built system, for the next one */
    void *memory; /* copy, or NULL */
    size_t bytes;
    void *pairs; /* the same of contact between wires */
    size_t pair_bytes;
    void *grains; /* the same of objects of particles */
    size_t grain_bytes;
    double *s;     /* (nodes) arc lengths then [m] */
    size_t *first; /* (wires + 1) first node of each wire then */
    size_t wires;
    int fresh;
    size_t changed; /* a wire that has other nodes since, from 1; 0: none */
  } kept;
  sw_kept_history *kept_histories; /* of the last built system, for the next one */
  size_t kept_history_count;
  sw_course course; /* of its steps */

  int diverged;
  sw_error why;
  sw_extreme deepest; /* penetration */
  sw_frame *frames;
  size_t frame_count, frame_capacity;
  double next_frame;   /* [s] */
  size_t frame_stride; /* one of so many is kept: 1, 2, 4 ... [-] */
  double frame_bytes;  /* that they take [B] */
  double frame_memory; /* that they may take [B] */
  sw_events events;    /* of the last run */
  sw_watches watches;
  sw_books books; /* of the energy in it */
};

/* What a built scene has besides its objects, where it lies: in the scene, to be put on a tape, or
 * on the tape, on any address, to be copied into a scene that is built of the same objects. */
typedef struct sw_live {
  const void *state;           /* x v a tension and so on of the built system */
  size_t state_size;           /* in doubles */
  const sw_integrator *method; /* NULL: before the first run */
  double last_h;               /* [s] */
  int restart;
  const void *history; /* xp, vp of a method with history, or NULL */
  size_t history_size; /* in doubles */
  const void *memory;  /* contact anchors */
  size_t memory_size;  /* [B] */
  int fresh;
  const void *pairs; /* the same between wires */
  size_t pairs_size;
  const void *grains; /* the same of objects of particles */
  size_t grains_size;
  const void *seen[3]; /* for read-outs: what touches obstacles, wires that may touch, and do */
  size_t seen_size[3];
} sw_live;
sw_live sw_live_of(const sw_scene *scene);
size_t sw_live_size(const sw_live *live); /* of its blocks [B] */
sw_status sw_live_put(sw_scene *scene, const sw_live *live, sw_error *err);
/* The same by way of a tape of one's own, for as long as the system stays. SW_ENOMEM leaves *out to
 * be freed. */
sw_status sw_live_take(const sw_scene *scene, sw_tape *out);
sw_status sw_live_back(sw_scene *scene, const sw_tape *taken, sw_error *err);
int sw_live_fits(const sw_scene *scene, const sw_live *live);
/* Particles of meshes to where they are in it, before the scene is built. SW_ENOMEM; SW_EINVAL: it
 * has not so many. */
sw_status sw_live_place(sw_scene *scene, const sw_live *live);

/* Leave the built state: the meshes become authoritative again. */
sw_status sw_scene_thaw(sw_scene *scene);
/* Drop the contact memory kept for the next system. */
void sw_scene_forget_contact(sw_scene *scene);
/* What the wires touch: obstacles and wires in one (see sw_contact and sw_pairs). */
sw_status sw_scene_new_pairs(sw_scene *scene);
void sw_scene_drop_rules(sw_scene *scene, size_t keep);
void sw_scene_couple(sw_scene *scene);
int sw_scene_has_contact(const sw_scene *scene);
/* Contact is to know what obstacles remember and which may move. */
void sw_scene_inform_contact(sw_scene *scene);
/* An obstacle's series begins now. The state is observed. Rows that are missing, of one or of all.
 * SW_ENOMEM. */
void sw_obstacle_log_begin(const sw_scene *scene, sw_scene_obstacle *obstacle);
sw_status sw_obstacle_log_state(sw_scene *scene);
sw_status sw_obstacle_log_fill(sw_scene *scene, sw_scene_obstacle *obstacle);
sw_status sw_obstacle_log_fill_all(sw_scene *scene);
sw_status sw_scene_begin_contact(sw_scene *scene, sw_contact_regime regime, double t, double h,
                                 double nominal, sw_error *err);
sw_contact_verdict sw_scene_review_contact(sw_scene *scene, const double *x1, const double *v1,
                                           double h);
int sw_scene_review_static(sw_scene *scene, const double *x1);
void sw_scene_commit_contact(sw_scene *scene);
double sw_scene_deepest(const sw_scene *scene, size_t *node); /* [m] */
double sw_scene_contact_energy(const sw_scene *scene);        /* [J] */
/* Put the forces' histories aside, give them to the new system, forget them. */
sw_status sw_scene_keep_histories(sw_scene *scene);
void sw_scene_inherit_histories(sw_scene *scene);
void sw_scene_forget_histories(sw_scene *scene);
/* What the frames of wires are when unloaded, into the plan; their present ones into
 * the system's state and back into the meshes. */
sw_status sw_scene_unloaded(const sw_scene *scene, size_t wire, sw_plan *plan);
/* The same for what depends on the edges beside one node. */
void sw_scene_unloaded_near(const sw_scene *scene, size_t wire, sw_plan *plan, size_t node);
void sw_scene_frame_in(sw_scene *scene);
void sw_scene_frame_out(sw_scene *scene, size_t wire);
/* Bend of a hinge beyond that at rest, over its length [1/m]; number: of the plan's
 * list with clamps after nodes. For refreshed bodies with frames. */
double sw_scene_flexure(const sw_system *system, const sw_body *body, size_t number);
/* Make the system from the meshes and holds, if it is not. */
sw_status sw_scene_build(sw_scene *scene, sw_error *err);

/* The obstacle that presses a wire hard, as the end of a sentence, or nothing. */
void sw_scene_tell_pressed(const sw_scene *scene, char *out, size_t size);
sw_scene_obstacle *sw_scene_find_obstacle(const sw_scene *scene, sw_handle h, sw_error *err);

/* The built system's stiffness at its state, with contact as it presses now: of these obstacles
 * (count), or NULL: of all. */
sw_status sw_scene_linearise(sw_scene *scene, const size_t *only, size_t count, sw_error *err);

/* The given name, or kind and a number. */
void sw_scene_give_name(char *out, const char *wanted, const char *kind, size_t number);

void sw_scene_clear_force(sw_scene_force *force);
void sw_scene_clear_obstacle(sw_scene_obstacle *obstacle);
/* The scene goes away: its snapshots live on, good for nothing. */
void sw_scene_orphan_snapshots(sw_scene *scene);

/* Tells of wires that are perfectly straight, and pushed beyond buckling. SW_ENOMEM, SW_ECALLBACK.
 */
sw_status sw_scene_look_for_buckling(sw_scene *scene, sw_error *err);
/* How many numbers the frame's block has; 0: more than room, or its counts make no sense. */
int sw_scene_frame_walk(const sw_frame *frame, size_t room, size_t *size);

#include "scene/observe.h"

#endif
