/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The scene's inside, shared by the files of this room only. */
#ifndef SW_SCENE_WORLD_H
#define SW_SCENE_WORLD_H

#include "contact/contact.h"
#include "contact/crowd.h"
#include "contact/grains.h"
#include "contact/pairs.h"
#include "scene/events.h"
#include "scene/ledger.h"
#include "scene/log.h"
#include "scene/objects.h"
#include "scene/scene.h"
#include "scene/section.h"
#include "scene/strand.h"
#include "scene/tool.h"
#include "scene/watch.h"
#include "scene/window.h"
#include "state/mesh.h"
#include "system/system.h"

/* A twisted stretch of wire while the scene is not built. */
typedef struct sw_twisted {
  double s1, s2; /* [m] */
  double twist;  /* total [rad] */
} sw_twisted;

/* What a wire was drawn along, to be meshed again as if it were made now. */
typedef struct sw_drawing {
  double *points; /* (count x 3) [m] */
  size_t count;
  double length;        /* of the first mesh [m] */
  sw_vec normal;        /* of the section; NAN = not given [-] */
  int rest;             /* SW_REST_STRAIGHT, SW_REST_PATH */
  int rolls;            /* 1: it turns about itself with inertia */
  double rest_twist;    /* [rad/m] */
  double breaking_load; /* NAN = not known [N] */
  int breaking_flag;    /* see sw_wire_args */
} sw_drawing;

typedef struct sw_scene_wire {
  uint32_t generation;
  char name[SW_NAME_SIZE];
  const sw_wire_class *cls;
  sw_beam beam;
  sw_mesh mesh;     /* authoritative while the scene is not built */
  sw_strand strand; /* of a model that is a mesh of particles; else without a web */
  sw_drawing drawing;
  sw_wire_extremes extremes;
  sw_window window; /* of the tension */
  sw_twisted *twisted;
  size_t twisted_count;
  int untwisted; /* 1: lies as it was drawn, without the twist it has unloaded; nothing has moved */
} sw_scene_wire;

/* 1: an object of particles in no order along a wire. It has no arc length, and its mesh is a
 * straight line of its size. */
static inline int sw_scene_is_loose(const sw_scene_wire *wire) {
  return wire->strand.web && !wire->strand.web->per_ring;
}

/* SW_EINVAL when the wire is a mesh of particles, which does not go with what. */
sw_status sw_scene_check_line(const sw_scene_wire *wire, const char *what, sw_error *err);
/* May it touch others? Wires that are lines and objects of particles do, sections of meshes do not.
 */
sw_status sw_scene_check_touching(const sw_scene_wire *wire, sw_error *err);

/* Rings between the arc lengths s1 and s2, at least the nearest one to their middle, as those
 * of its first and last [m]. */
void sw_strand_rings(const sw_mesh *mesh, double *s1, double *s2);
/* 1: a hold of this class holds the particle. */
static inline int sw_strand_holds(const sw_web *web, const sw_hold_class *cls, size_t particle) {
  const size_t ring = sw_web_ring_of(web, particle);
  return cls->clamped || !sw_web_is_ring(web, ring) || particle - web->first[ring] == web->axis;
}
/* The system's state to the strand and the middles of its rings. SW_ENOMEM. */
sw_status sw_strand_take(sw_scene_wire *wire, const sw_system *system, const sw_body *body);
/* Read-outs at arc length s; extremes. */
void sw_strand_at(const sw_scene *scene, const sw_scene_wire *wire, const sw_body *body, double s,
                  sw_point_state *out);
/* Bending moment in the slice of a mesh that has a place [m], [N m]. */
double sw_strand_moment(const sw_plan *plan, const double *x, double place);
/* Tells of a wire whose largest tension is above its breaking load. */
void sw_scene_watch_breaking(sw_scene *scene, size_t wire, const sw_wire_extremes *now);
/* The same at the end of a run, of runs that were shorter than the window. */
void sw_scene_end_breaking(sw_scene *scene);
/* And as the end of a sentence, or nothing. */
void sw_scene_tell_broken(const sw_scene *scene, char *out, size_t size);
/* And of the obstacle that presses a wire hardest, if that is hard. */
void sw_scene_tell_pressed(const sw_scene *scene, char *out, size_t size);
/* Tells of a tube that is folded at one place. */
void sw_scene_watch_kink(sw_scene *scene, size_t wire, const sw_wire_extremes *now);
/* tension (rings - 1), or NULL: what is carried between two rings [N]. */
void sw_strand_extremes(const sw_scene *scene, size_t wire, double *tension, sw_wire_extremes *now);

/* Middle of ring number r of particles at x, and the direction across the area that its surface
 * encloses [m], [-]. */
sw_vec sw_strand_middle(const sw_web *web, const double *x, size_t ring);
sw_vec sw_strand_facing(const sw_web *web, const double *x, size_t ring);
/* How wide an outline (count x 3) is across the tangent. */
typedef struct sw_widths {
  double least, largest;         /* [m] */
  sw_vec least_way, largest_way; /* [-] */
} sw_widths;
enum { SW_OUTLINE = SW_CELL_PARTICLES }; /* most points of an outline [-] */
sw_widths sw_outline_widths(const double *outline, size_t count, sw_vec tangent);
/* See sw_section_shape; and for all rings at once, of the one that is out of round most [-]. */
double sw_outline_ovalisation(const sw_web *web, const double *outline, sw_vec tangent);
sw_extreme sw_strand_ovalisation(const sw_web *web, const double *x);
/* Of a hollow section of one layer at s: how far walls that face each other are apart, 0 when they
 * cross; others: infinite [m]. */
double sw_strand_walls_apart(const sw_web *web, const double *x, double s);
/* How far the worst face of a section of springs is turned over: minus its area over that at rest,
 * above 0 when it is [-]. */
sw_extreme sw_strand_folding(const sw_web *web, const double *x);
/* Points of the outline (count x 3) moved outwards by skin. */
void sw_outline_widen(const double *outline, size_t count, sw_vec tangent, double skin,
                      double *out);
/* The outline of ring number r [m]. */
void sw_strand_outline(const sw_web *web, const double *x, size_t ring, double *out);
/* Forces of obstacles on the particles of a body: across the surface (particles) and, unless
 * NULL, in all (particles x 3) [N]. */
void sw_strand_pressed(const sw_scene *scene, const sw_body *body, double *normal, double *force);

/* The wire of a handle, in a scene that is built, readable and refreshed. */
sw_status sw_scene_open_wire(sw_scene *scene, sw_handle h, sw_scene_wire **wire, sw_error *err);
/* SW_EINVAL when place is no arc length of the wire. */
sw_status sw_scene_check_place(const sw_scene_wire *wire, double place, sw_error *err);

/* What a mesh of this class for the wire is to be of. */
sw_strand_plan sw_scene_strand_plan(const sw_scene_wire *wire, const sw_wire_class *cls,
                                    const sw_wire_mesh_args *mesh);

/* The wire is as drawn: not twisted anywhere. SW_ENOMEM. */
sw_status sw_scene_draw_untwisted(sw_scene_wire *wire);

/* Where something driven is: at rest at a pose or following a motion. */
typedef struct sw_drive {
  sw_pose pose;      /* at rest */
  sw_motion *motion; /* NULL = at rest */
  double start;      /* scene time of the motion's zero [s] */
  size_t tool;       /* 1 + slot of the tool that carries it, in whose frame pose is; 0 = none */
  sw_vec opens;      /* how it moves in that frame with the jaws' opening [m/m] */
} sw_drive;

/* The jaws of a tool. Their opening at time t is opening + speed (t - since). */
typedef struct sw_jaw {
  int mode;         /* SW_JAW_STILL, ... */
  int status;       /* SW_JAW_RESTS, ... */
  double opening;   /* [m] */
  double since;     /* [s] */
  double step;      /* the present one [s] */
  double speed;     /* of this step; below 0 they close [m/s] */
  double most;      /* highest speed [m/s] */
  double goal;      /* opening to go to [m] */
  double force;     /* per finger: wanted, or at which they stop [N] */
  double now;       /* force per finger of the accepted state [N] */
  double stiffness; /* of what they hold, last found; 0 = not known [N/m] */
  double tried[2];  /* speeds with too little force and with too much [m/s] */
  double off[2];    /* how far their forces were off; NAN = not tried [N] */
  int last_side, trials, guessed;
} sw_jaw;

typedef struct sw_tool_pad {
  size_t obstacle; /* slot */
  int finger;      /* [-] */
} sw_tool_pad;

typedef struct sw_crash {
  double time, depth;    /* when a part ran into an obstacle, how far then [s], [m] */
  size_t part, obstacle; /* slots */
} sw_crash;

typedef struct sw_frozen sw_frozen; /* what pads held, see frozen_inner.h; shared and immutable */
void sw_frozen_retain(sw_frozen *frozen);
void sw_frozen_release(sw_frozen *frozen);
/* What a force on the wire and its moment about the tool's centre, in the tool's axes, are of what
 * the pads could bear in place of the rigid grip [-]. */
double sw_frozen_margin(const sw_frozen *frozen, sw_vec force, sw_vec moment);

/* What a gripper is to the core: a frame that moves, with jaws and pads in it. */
typedef struct sw_tool {
  uint32_t generation;
  int alive;
  char name[SW_NAME_SIZE];
  sw_drive drive;
  sw_jaw jaw;
  sw_tool_pad pad[SW_TOOL_PADS];
  size_t pads;
  int fingers;
  sw_frozen *frozen; /* or NULL */
  double limit;      /* margin at which a frozen grip is lost [-] */
  sw_tool_state now; /* of the accepted state */
  double tolerance;  /* slip that is an event [m] */
  int stops;         /* 1: a run ends with the step in which the wire slips */
  sw_crash crash;    /* the last one */
  int crashing;      /* 1: it goes on */
  sw_log log;
} sw_tool;

/* A hold through which the wire slides. The length paid out at time t is fed + speed
 * (t - since) + motion's x at t - start + slip + slip_speed u + slip_growth u^2 / 2, with
 * u = t - slip_since. */
typedef struct sw_feed {
  int outward;         /* where paid-out wire goes: +1 along the arc length, -1 against it [-] */
  double label;        /* the mesh's arc length at the guide when nothing was fed [m] */
  double fed, since;   /* [m], [s] */
  double speed;        /* [m/s] */
  sw_motion *motion;   /* a given length to be fed, or NULL */
  double start;        /* [s] */
  double slip;         /* beyond what was asked for [m] */
  double slip_since;   /* [s] */
  double slip_speed;   /* [m/s] */
  double slip_growth;  /* of this step; between steps that of the last one [m/s2] */
  double slip_before;  /* slip_growth of the step before [m/s2] */
  double push, limit;  /* force on the wire, the largest one; NAN = none [N] */
  double slip_way;     /* sign of the force against which it slips; 0 = it does not [-] */
  double way_before;   /* that of the step before [-] */
  double tried[2];     /* slip_growths with too little force and with too much [m/s2] */
  double off[2];       /* how far their forces were off; NAN = not tried yet [N] */
  int last_side;       /* which of both was tried last [-] */
  double slope;        /* of the force over slip_growth, last found; 0 = not known [kg] */
  double spare[2];     /* length given to the edge before and after the guide when nodes came
                          and went, so that no axial force jumps [m] */
  double spare_fed[2]; /* fed at that time; the spare goes back to 0 over one edge's length [m] */
  double size;         /* edges beside the guide are made this long [m] */
  double drive;        /* force that moves the wire, outwards, last [N] */
  size_t node, number; /* in the wire's plan; among the system's holds; while built */
  sw_mesh shape;       /* the wire with its unloaded shape, if it has frames */
} sw_feed;

/* Is it driven into an obstacle? */
typedef struct sw_hold_watch {
  int looking;    /* 1: it has been looked at */
  int crashing;   /* 1: it is driven into one now */
  double looked;  /* when last [s] */
  double given;   /* how deep it was in one to begin with [m] */
  sw_crash crash; /* the last one, of no part; depth 0: none */
} sw_hold_watch;

typedef struct sw_scene_hold {
  uint32_t generation;
  int alive;
  char name[SW_NAME_SIZE];
  const sw_hold_class *cls;
  size_t wire;
  sw_hold_args args; /* as asked for */
  double scale;      /* of the wire's mesh when it was asked for [-] */
  uint32_t shape;    /* another number when s1 .. frame are others */
  int formed;        /* 1: between its ends the wire is as long without force as it lies */
  double s1, s2;     /* held interval, nodes of the mesh [m] */
  sw_drive drive;
  size_t count;           /* held places */
  double *s;              /* (count) arc lengths when taken hold of [m] */
  double *local;          /* (count x 3) in the hold's frame [m] */
  uint32_t *particle;     /* (count) which ones of a mesh; NULL on other wires */
  sw_vec director[2];     /* arriving, leaving; in the hold's frame [-] */
  sw_mesh_frame frame[2]; /* the wire's there, with directions as held; if it has frames */
  sw_clamp_give give[2];  /* likewise */
  sw_quat turn;           /* orientation that goes with the wire's twist, while not built */
  sw_feed feed;           /* of a class that feeds */
  sw_vec force, moment;   /* last, kept after release [N], [N m] */
  sw_hold_watch watch;
  sw_pose last_pose;
  sw_log log;
} sw_scene_hold;

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

/* Wires joined at a point. */
typedef struct sw_scene_join {
  uint32_t generation;
  int alive, rigid;
  char name[SW_NAME_SIZE];
  double slack, stiffness, strength; /* of a tie, see sw_join_args; slack NAN: it is none */
  int broken;
  double broken_time, broken_force, peak; /* [s], [N], [N] */
  size_t spring;                          /* of a tie: its number in the system, while built */
  size_t count;
  struct sw_scene_join_end {
    size_t wire;
    double s;      /* a node of its mesh [m] */
    double asked;  /* where that was asked for, [m] */
    double scale;  /* of the mesh then [-] */
    sw_vec offset; /* of its node from that of the first end [m] */
    sw_vec rest;   /* where the wire went there, see arm_of [-] */
  } ends[SW_JOIN_ENDS];
} sw_scene_join;

/* Which wires touch each other, as stated. */
typedef struct sw_scene_rule {
  uint32_t *wires; /* (count) slots; count 0 = all */
  size_t count;
  int self; /* each with itself too */
  sw_pair_rule rule;
} sw_scene_rule;

typedef struct sw_frame {
  double time;
  double *data; /* one block */
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

/* The system is a new one, but its accelerations are those of its forces. */
enum { SW_GOES_ON = -1 };

struct sw_scene {
  char name[SW_NAME_SIZE];
  uint32_t serial;              /* generation of the object made last */
  sw_snapshot *snapshots;       /* the living ones, a list */
  const sw_snapshot *restoring; /* being restored now, or NULL */
  sw_vec gravity;
  double time;
  sw_scene_wire *wires;
  size_t wire_count, wire_capacity;
  sw_scene_hold *holds;
  size_t hold_count, hold_capacity;
  sw_scene_obstacle *obstacles;
  size_t obstacle_count, obstacle_capacity;
  sw_log contact_steps; /* time and span of those observed so far [s] */
  sw_tool *tools;
  size_t tool_count, tool_capacity;
  sw_scene_force *forces;
  size_t force_count, force_capacity;
  sw_scene_join *joins;
  size_t join_count, join_capacity;

  const sw_pose *part_from; /* settling: where the holds come from, or NULL */
  double part;              /* share of their way [-] */

  int built;      /* system is valid and holds the state */
  size_t parts;   /* of steps of the run, since it was last asked whether they have collapsed [-] */
  double covered; /* steps that these make together [-] */
  int running;    /* above 0 inside a step or a user's function: edits are refused */
  sw_system system;
  int *hold_slot;       /* (system.hold_count) scene slot of each system hold */
  sw_contact *contact;  /* with obstacles, or NULL */
  sw_pairs *pairs;      /* between wires, or NULL */
  sw_grains *grains;    /* between objects of particles and what else touches them, or NULL */
  sw_crowd *crowd;      /* between particles that repel each other, or NULL */
  sw_scene_rule *rules; /* that pairs are made by */
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
  const sw_integrator *method; /* of stepper */
  sw_stepper stepper;
  int has_stepper;
  int discontinuous; /* the acceleration is stale: restart the integrator; or SW_GOES_ON */
  double window;     /* of the present or last run, see sw_run_args [s] */
  double span;       /* of the step that led here; 0: the state is an equilibrium [s] */
  /* a blow that began at blow_since is followed in parts of blow_part until blow_until [s] */
  double blow_part, blow_since, blow_until;
  double next_dt;    /* of an adaptive run; 0 = not known [s] */

  int diverged;
  sw_error why;
  sw_extreme deepest; /* penetration */
  sw_frame *frames;
  size_t frame_count, frame_capacity;
  double next_frame; /* [s] */
  sw_events events;  /* of the last run */
  sw_watches watches;
  sw_books books; /* of the energy in it */
};

/* What a built scene has besides its objects: a copy of it, put back into a scene that is built
 * of the same objects (and fits). SW_ENOMEM leaves *out to be freed. */
typedef struct sw_live {
  double *state; /* x v a tension and so on of the built system */
  size_t state_size;
  const sw_integrator *method; /* NULL: before the first run */
  double last_h;               /* [s] */
  int restart;
  double *history; /* xp, vp of a method with history, or NULL */
  size_t history_size;
  void *memory; /* contact anchors */
  size_t memory_size;
  int fresh;
  void *pairs; /* the same between wires */
  size_t pairs_size;
  void *grains; /* the same of objects of particles */
  size_t grains_size;
  void *seen[3]; /* for read-outs: what touches obstacles, wires that may touch, and do */
  size_t seen_size[3];
} sw_live;
sw_status sw_live_take(const sw_scene *scene, sw_live *out);
sw_status sw_live_put(sw_scene *scene, const sw_live *live, sw_error *err);
int sw_live_fits(const sw_scene *scene, const sw_live *live);
void sw_live_free(sw_live *live);

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

/* Where the drive is at time t. The scene refuses to be changed meanwhile, for
 * the motion may be a user's function. */
sw_status sw_drive_eval(sw_scene *scene, const sw_drive *drive, double t, sw_motion_state *out,
                        sw_error *err);
/* Follow the motion from the scene's time on. */
sw_status sw_drive_follow(sw_scene *scene, sw_drive *drive, const char *object, sw_motion *motion,
                          int relative, sw_error *err);
void sw_drive_free(sw_drive *drive);
/* 1: it may be elsewhere later without anyone changing it. */
static inline int sw_drive_moves(const sw_drive *drive) { return drive->motion || drive->tool; }

/* --- tools ------------------------------------------------------------------- */

void sw_scene_clear_tool(sw_tool *tool);
sw_tool *sw_scene_find_tool(const sw_scene *scene, sw_handle h, sw_error *err);
/* Their jaws at the start of a step of size h; 1: a trial may have to be corrected. After a
 * trial: 1 = the forces are as wanted, or cannot be. After an accepted one, or one given up. */
int sw_jaw_begin(sw_scene *scene, double h);
int sw_jaw_correct(sw_scene *scene, int rests); /* rests: trials are equilibria */
/* How far the forces of a trial are off, the worst over what is wanted [-]. */
double sw_jaw_off(sw_scene *scene);
/* After an equilibrium that is taken: 1 = its force is not as wanted, for that jumped, and the jaws
 * have begun to look for it from there on. */
int sw_jaw_again(sw_scene *scene);
void sw_jaw_follow(sw_scene *scene);
/* The same of an equilibrium at the scene's time: jaws that hold with a force open or close at
 * once, by a small part of the wires' thickness. After it: 1 = they have to go further. */
int sw_jaw_begin_rest(sw_scene *scene);
int sw_jaw_end_rest(sw_scene *scene, int went_well);
/* The largest pose step up to h in which jaws that close with a force go no further than a small
 * part of the wires' thickness [s]. */
double sw_jaw_step(const sw_scene *scene, double h);
/* How far they are open at time t, and how fast that changes [m], [m/s]. */
double sw_jaw_at(const sw_jaw *jaw, double t);
/* 1: the obstacle of this number is one of its pads. */
int sw_tool_is_pad(const sw_tool *tool, int obstacle);
/* Force per finger as of the last trial, which ended at time t [N]. */
double sw_tool_squeeze(sw_scene *scene, const sw_tool *tool, double t);
/* What tools hold at the accepted state; their logs. */
sw_status sw_tool_observe(sw_scene *scene, sw_error *err);
/* Does the tool run into obstacles? */
sw_status sw_tool_look_out(sw_scene *scene, size_t tool, sw_error *err);
/* 1: one slipped in the last step that ends a run with it. */
int sw_tool_slipped(const sw_scene *scene);

/* Looks at a hold of the accepted state: is it driven into obstacles, does it push too hard? */
sw_status sw_hold_look_out(sw_scene *scene, sw_scene_hold *hold, sw_error *err);
/* 1: one was driven into an obstacle in the last step. */
int sw_hold_crashed(const sw_scene *scene);

/* --- joins ------------------------------------------------------------------- */

/* The living join that has the wire, or NULL. */
const sw_scene_join *sw_scene_joined(const sw_scene *scene, size_t wire);
/* The arc lengths of a wire's living joins into out (may be NULL); their number. */
size_t sw_scene_join_places(const sw_scene *scene, size_t wire, double *out);
/* Make their nodes anew in a wire that was drawn again and has its holds. SW_ENOMEM. */
sw_status sw_scene_retake_joins(sw_scene *scene, size_t wire);
/* Meshes are others: joins of wires that lie as drawn keep what these have now. */
void sw_scene_measure_joins(sw_scene *scene);
/* Springs and hinges of the living joins for the new system. SW_ENOMEM. */
sw_status sw_scene_add_joins(sw_scene *scene);
sw_status sw_scene_add_tie(sw_scene *scene, size_t join);
/* 1: there is a tie that has a strength, and is not broken. */
int sw_scene_may_break(const sw_scene *scene);
/* SW_ENOCONV when a tie is pulled far beyond its strength with nodes at x: it breaks earlier. */
sw_status sw_scene_check_ties(const sw_scene *scene, const double *x, sw_error *err);
/* After a step, before histories follow: ties that were pulled too hard break. */
void sw_scene_watch_ties(sw_scene *scene);
/* NULL: the scene does not know it. */
sw_scene_join *sw_scene_find_join(const sw_scene *scene, sw_handle join, sw_error *err);
/* Node of an end in the system. */
uint32_t sw_scene_join_node(const sw_scene *scene, const struct sw_scene_join_end *end);

/* --- feeds ------------------------------------------------------------------- */

/* Which way wire goes that is paid out at arc length s of the mesh: see sw_feed. */
int sw_feed_outward(const sw_mesh *mesh, double s);
/* A new hold, its nodes in place, begins to feed. SW_ENOMEM. */
sw_status sw_feed_begin(sw_scene *scene, sw_scene_hold *hold, const sw_hold_args *args);
/* Length paid out at a time, its speed and acceleration. */
typedef struct sw_feed_now {
  double fed, speed, acceleration; /* [m], [m/s], [m/s2] */
} sw_feed_now;
sw_feed_now sw_feed_at(const sw_scene_hold *hold, double t);
/* What is left of the spare lengths when so much is fed [m]. */
void sw_feed_spare(const sw_feed *feed, double fed, double spare[2]);
/* Slide the wire to where it is at time t; adds its velocity to the hold's state. */
void sw_feed_place(sw_scene *scene, sw_scene_hold *hold, double t, sw_hold_state *state);
/* The scene's time is that of an accepted state: meshes and holds follow. */
void sw_feed_follow(sw_scene *scene);
/* Plans back to the meshes, before these are read. */
void sw_feed_undo(sw_scene *scene);
/* Unloaded place and frame of the node at the guide, for its present arc length. */
void sw_feed_shape(sw_scene *scene, sw_scene_hold *hold);
/* What the hold knows of the unloaded frame at arc length s of the mesh. */
void sw_feed_rest(sw_scene_hold *hold, double s);
/* The largest step up to h that nodes can follow [s]. */
double sw_feed_step(const sw_scene *scene, double h);
/* SW_ENOCONV: which feed goes faster than steps can follow, and why longer ones were refused. */
sw_status sw_feed_too_fast(const sw_scene *scene, const char *refused, sw_error *err);
/* Insert and remove nodes beside guides as a step to time t needs. changed: the system was
 * made anew. SW_EEMPTY: no wire left to draw in. */
sw_status sw_feed_make_room(sw_scene *scene, double t, int *changed, sw_error *err);
/* Force that moves the wire outwards, with nodes at x and the last reaction [N]. */
double sw_feed_drive(const sw_scene *scene, const sw_scene_hold *hold, const double *x);

/* Steps of feeds that yield to a force: begin one (0: there are none), correct the slips
 * after a trial (1: they were right), or put them back. */
int sw_slip_any(const sw_scene *scene);
int sw_slip_begin(sw_scene *scene);
int sw_slip_correct(sw_scene *scene, double h, int first);
void sw_slip_give_up(sw_scene *scene);

/* The object of a handle, or NULL with err set. A body is a wire or an object of particles. */
sw_scene_wire *sw_scene_find_body(const sw_scene *scene, sw_handle h, sw_error *err);
sw_scene_wire *sw_scene_find_wire(const sw_scene *scene, sw_handle h, sw_error *err);
sw_scene_hold *sw_scene_find_hold(const sw_scene *scene, sw_handle h, sw_error *err);
/* The same of a hold that has not been released. */
sw_scene_hold *sw_scene_living_hold(const sw_scene *s, sw_handle hold, sw_error *err);
sw_scene_obstacle *sw_scene_find_obstacle(const sw_scene *scene, sw_handle h, sw_error *err);

/* A wire's mesh as drawn, of some segments; frames too. SW_ENOMEM. */
sw_status sw_scene_draw(sw_scene_wire *wire, size_t segments, sw_mesh *out, sw_error *err);
/* Take hold of the redrawn mesh anew. The hold is not alive; those that are were there
 * before it. What drives it stays. SW_ENOMEM. */
sw_status sw_scene_retake_hold(sw_scene *scene, sw_scene_hold *hold);
/* Nodes for the wire's living holds in another mesh of the same length. SW_ENOMEM. */
sw_status sw_scene_make_places(const sw_scene *scene, size_t wire, sw_mesh *mesh);
/* Where and how a hold holds, into another slot that owns nothing. SW_ENOMEM. */
sw_status sw_scene_copy_shape(const sw_scene_hold *from, sw_scene_hold *to);

/* Take hold of a wire that has other nodes but lies as before; the hold's pose is known. It is
 * not alive; those that are have done so. SW_EINVAL when one of them is in the way; SW_ENOMEM. */
sw_status sw_scene_rehold(sw_scene *scene, sw_scene_hold *hold, sw_pose pose, sw_error *err);

/* SW_EINVAL, naming the hold that is in the way, when one between s1 and s2, rings of a mesh, is
 * on another living hold of the wire or too near it; what: who asks [m]. */
sw_status sw_scene_check_clear(const sw_scene *scene, size_t wire, const sw_scene_hold *self,
                               const char *what, double s1, double s2, sw_error *err);
/* SW_EINVAL, naming both, when two living holds hold the same node or particle. */
sw_status sw_scene_check_holds(const sw_scene *scene, sw_error *err);
/* The built system's stiffness at its state, with contact as it presses now: of these obstacles
 * (count), or NULL: of all. */
sw_status sw_scene_linearise(sw_scene *scene, const size_t *only, size_t count, sw_error *err);

/* May the wire, as it is given, be in the scene with its forces and rules? */
sw_status sw_scene_check_rules(const sw_scene *scene, size_t wire, const sw_scene_wire *as,
                               sw_error *err);
/* The body of a handle, in a scene that is built, readable and refreshed. */
sw_status sw_scene_open_body(sw_scene *scene, sw_handle h, sw_scene_wire **body, sw_error *err);
/* The given name, or kind and a number. */
void sw_scene_give_name(char *out, const char *wanted, const char *kind, size_t number);

/* Free what these slots own. */
void sw_scene_clear_body(sw_scene_wire *body);
void sw_scene_clear_force(sw_scene_force *force);
void sw_scene_clear_hold(sw_scene_hold *hold);
void sw_scene_clear_obstacle(sw_scene_obstacle *obstacle);
/* The scene goes away: its snapshots live on, good for nothing. */
void sw_scene_orphan_snapshots(sw_scene *scene);

/* Equilibrium of the built scene at its time, obstacles having moved since a time before;
 * nothing is observed. On failure the state is as before. too_far (may be NULL) is set when
 * it failed because obstacles drag wires along that a shorter way might show how. */
sw_status sw_scene_rest(sw_scene *scene, double since, int *too_far, const sw_settle_args *args,
                        int (*interrupted)(void), sw_settle_report *report, sw_error *why);
/* The same with the jaws that have begun a step as open as their forces want. On failure contact's
 * memory is as before too. */
sw_status sw_scene_squeezed_rest(sw_scene *scene, double since, int *too_far,
                                 const sw_settle_args *args, int (*interrupted)(void),
                                 sw_settle_report *report, sw_error *why);
/* Make a pose at t1 an earlier one (cut: 1) where wires between pads could not follow these. */
sw_status sw_scene_cut_pose(sw_scene *scene, double *t1, int *cut, sw_error *err);
typedef struct sw_pose_args {
  int (*interrupted)(void);
  double shortest; /* poses are not made shorter to find where a tie breaks [s] */
} sw_pose_args;
/* Equilibrium at time t1, which becomes the scene's, in smaller parts where needed; or earlier, to
 * be observed there, where a tie may break. Nothing is observed. On failure the scene is at the
 * last pose that went well. */
sw_status sw_scene_pose(sw_scene *scene, double t1, const sw_pose_args *how, sw_run_report *report,
                        sw_error *err);

/* What frames tell of each node of the wire, SW_FRAME_VALUES numbers; n nodes. */
void sw_scene_node_values(sw_scene *scene, size_t wire, size_t n, double *out);
/* SW_EDIVERGED when the stepper's trial is no believable state, SW_ENOCONV when a smaller step may
 * mend it. */
sw_status sw_scene_check_trial(const sw_scene *scene, sw_error *err);
/* Tells that the run's method is not meant for contact, once, when there is some. */
void sw_scene_remark_contact(sw_scene *scene);
/* Tells of wires that are perfectly straight, and pushed beyond buckling. SW_ENOMEM, SW_ECALLBACK.
 */
sw_status sw_scene_look_for_buckling(sw_scene *scene, sw_error *err);
/* SW_EINVAL when an explicit method would take steps above its limit on the way to a time. */
sw_status sw_scene_check_step(const sw_scene *scene, const sw_run_args *args, double until,
                              sw_error *err);
/* How many doubles the frame's block has; 0: more than room, or its counts make no sense. */
int sw_scene_frame_walk(const sw_frame *frame, size_t room, size_t *size);
/* The class of a wire or of objects of particles; NULL: there is none of this name. */
const sw_wire_class *sw_scene_body_class(const char *name);

#include "scene/observe.h"

#endif
