/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The scene owns everything: wires, holds, obstacles, forces, time. It is
 * edited between runs, made into a system when something moves, and read.
 * Objects are named by handles (slot and generation), so that a stale handle is
 * found out, not followed. Not thread-safe; scenes are independent. */
#ifndef SW_SCENE_SCENE_H
#define SW_SCENE_SCENE_H

#include <stddef.h>
#include <stdint.h>

#include "base/param.h"
#include "base/status.h"
#include "base/vec.h"
#include "calibrate/calibrate.h"
#include "force/force.h"
#include "integrate/integrate.h"
#include "link/link.h"
#include "motion/motion.h"
#include "shape/shape.h"
#include "wire/wire.h"

typedef struct sw_scene sw_scene;
typedef struct sw_snapshot sw_snapshot;

typedef struct sw_handle {
  uint32_t slot, generation; /* generation 0 = no object */
} sw_handle;

typedef struct sw_scene_args {
  char name[SW_NAME_SIZE];
  sw_vec gravity; /* [m/s2] */
} sw_scene_args;
extern const sw_params sw_scene_params;

sw_status sw_scene_new(const sw_scene_args *args, sw_scene **out, sw_error *err);
void sw_scene_free(sw_scene *scene); /* NULL is allowed */

const char *sw_scene_name(const sw_scene *scene);
double sw_scene_time(const sw_scene *scene); /* [s] */
sw_vec sw_scene_gravity(const sw_scene *scene);
sw_status sw_scene_set_gravity(sw_scene *scene, sw_vec gravity, sw_error *err);
/* 1 inside a step or a user's function of the scene: every change is refused with
 * SW_EBUSY, and the scene must not be freed. */
int sw_scene_busy(const sw_scene *scene);

/* SW_EDIVERGED with the reason when the last run diverged: nothing may be read
 * until a snapshot is restored. */
sw_status sw_scene_readable(const sw_scene *scene, sw_error *err);

/* --- joins ------------------------------------------------------------------ */

typedef struct sw_join_end {
  sw_handle wire;
  double s; /* [m] */
} sw_join_end;

/* Join wires where they meet, at arc lengths of theirs, from now on. */
sw_status sw_scene_add_join(sw_scene *scene, const sw_join_args *args, const sw_join_end *ends,
                            size_t count, sw_handle *out, sw_error *err);
sw_status sw_scene_release_join(sw_scene *scene, sw_handle join, sw_error *err);
/* Force and moment about its place that a living join puts on its end number k [N], [N m]. */
sw_status sw_scene_join_force(sw_scene *scene, sw_handle join, size_t k, sw_vec *force,
                              sw_vec *moment, sw_error *err);
/* What a tie bears, and what became of it. */
typedef struct sw_tie_state {
  double distance;                  /* of both places [m] */
  double tension, peak;             /* now, largest so far [N] */
  int broken;                       /* 1: it broke */
  double broken_time, broken_force; /* [s], [N] */
} sw_tie_state;
/* SW_EINVAL when the join is none. */
sw_status sw_scene_tie_state(sw_scene *scene, sw_handle join, sw_tie_state *out, sw_error *err);
/* NULL when the scene does not know it any more; held: 0 once released. */
const char *sw_scene_join_name(const sw_scene *scene, sw_handle join, int *held, size_t *ends);

/* --- names ------------------------------------------------------------------ */

/* NULL when the scene does not know the object any more. kind: "clamp", "box", ...;
 * held, present: 0 once released or removed. */
const char *sw_scene_wire_name(const sw_scene *scene, sw_handle wire);
const char *sw_scene_hold_name(const sw_scene *scene, sw_handle hold, const char **kind, int *held);
const char *sw_scene_obstacle_name(const sw_scene *scene, sw_handle obstacle, const char **kind,
                                   int *present);
/* 0 when neither the scene nor a living snapshot of it will use the force again. */
int sw_scene_force_needed(const sw_scene *scene, sw_handle force);
/* The class of a force, released or not; NULL as above. */
const sw_force_class *sw_scene_force_class(const sw_scene *scene, sw_handle force);
/* What its events call it. */
sw_status sw_scene_name_force(sw_scene *scene, sw_handle force, const char *name, sw_error *err);
/* 0 once released, or when the scene does not know it. */
int sw_scene_force_acts(const sw_scene *scene, sw_handle force);

/* --- wires ------------------------------------------------------------------ */

typedef struct sw_wire_args {
  char name[SW_NAME_SIZE];
  int model;            /* index into sw_wire_all() */
  sw_vec from, to;      /* straight wire; NAN = not given [m] */
  long segments;        /* 0 = chosen [-] */
  int rest;             /* shape without load: SW_REST_STRAIGHT, SW_REST_PATH */
  sw_vec normal;        /* first axis of the section; NAN = not given [-] */
  double rest_twist;    /* without load [rad/m] */
  int rolls;            /* 1: spins about its axis, with inertia, under friction */
  double breaking_load; /* NAN = not known [N] */
  int breaking_flag;    /* where that is from: index into sw_breaking_flags */
} sw_wire_args;
enum { SW_BREAKING_FLAGS = 4 };
extern const char *const sw_breaking_flags[];
enum { SW_REST_STRAIGHT = 0, SW_REST_PATH = 1 };
extern const sw_params sw_wire_params; /* model, path, segments, ... */

/* Of a wire whose model is a mesh of particles. */
typedef struct sw_wire_mesh_args {
  double spacing; /* of slices; NAN = chosen [m] */
  double squeeze; /* see sw_calibrate_args [Pa] */
  int body;       /* SW_BODY_SPRINGS, SW_BODY_SOLID */
  double wall;    /* bending stiffness of a tube's wall, per length; NAN = none [N m] */
  sw_lattice_args lattice;
  sw_section section; /* as given */
} sw_wire_mesh_args;
extern const sw_params sw_wire_mesh_params; /* without those of the lattice and the section */

/* points (count x 3): the polyline the wire lies along; NULL takes from and to. mesh: with a
 * model that is one, else NULL. SW_EINVAL for fewer than two different points. */
sw_status sw_scene_add_wire(sw_scene *scene, const sw_wire_args *args, const sw_beam *beam,
                            const sw_wire_mesh_args *mesh, const double *points, size_t count,
                            sw_handle *out, sw_error *err);

/* Take a wire or an object of particles away. What holds it lets go, its joins, ties and forces
 * end, tools that hold it rigidly have their pads again. Slots of others may change: see body_now.
 * What it leaves in frames, series and snapshots stays. SW_ECALLBACK from a motion of what holds
 * it; nothing is changed then. */
sw_status sw_scene_remove_body(sw_scene *scene, sw_handle body, sw_error *err);
/* The handle of a body with the slot that it has now; one that names none when it is gone. */
sw_handle sw_scene_body_now(const sw_scene *scene, sw_handle body);
/* Its number in frames, also of one that is gone; SIZE_MAX: the scene does not know it [-]. */
size_t sw_scene_body_number(const sw_scene *scene, sw_handle body);
/* Name of a body that was taken away, and when [s]; NULL: it was not. */
const char *sw_scene_gone_name(const sw_scene *scene, sw_handle body, double *time);

/* Give every wire a mesh of so many even segments (count: one number per wire), with
 * the nodes its holds need. A wire that has not moved since it was drawn is drawn anew;
 * any other keeps its length, shape, motion, strains and twist. After SW_ENOMEM some
 * wires may have the new mesh. */
sw_status sw_scene_remesh(sw_scene *scene, const size_t *segments, size_t count, sw_error *err);
/* Even segments that a wire's mesh stands for, holds' own nodes left out. */
sw_status sw_scene_wire_segments(sw_scene *scene, sw_handle wire, size_t *segments, sw_error *err);

typedef struct sw_remodel_report {
  double energy_before, energy_after; /* of the scene [J] */
  sw_vec about;                       /* the wire's centre of mass before [m] */
  double before[6], after[6];         /* its momentum and the moment of that [N s], [N m s] */
} sw_remodel_report;

/* Another model for the wire from now on: of args model and segments are read. mesh: as for a new
 * wire, its section that of the wire. region: from and to [m]; only there, and beside clamps, the
 * wire is the mesh, elsewhere a line of as many segments as a rod; NULL: all of it. */
sw_status sw_scene_remodel(sw_scene *scene, sw_handle wire, const sw_wire_args *args,
                           const sw_wire_mesh_args *mesh, const double *region,
                           sw_remodel_report *out, sw_error *err);
extern const sw_params sw_remodel_params;

/* What the springs of a wire that is a mesh were fitted to; NULL: it is none, or is gone. */
const sw_calibration *sw_scene_wire_calibration(const sw_scene *scene, sw_handle wire);
/* Name of its model; NULL: it is gone. */
const char *sw_scene_wire_model(const sw_scene *scene, sw_handle wire);

/* --- holds ------------------------------------------------------------------ */

sw_status sw_scene_add_hold(sw_scene *scene, const sw_link_class *cls, sw_handle wire,
                            const sw_hold_args *args, sw_handle *out, sw_error *err);
sw_status sw_scene_release_hold(sw_scene *scene, sw_handle hold, sw_error *err);

/* Let the hold follow a motion from now on (retains it); relative: on top of
 * its present pose. An absolute motion that does not start at the present pose
 * is refused. NULL stops it where it is. */
sw_status sw_scene_follow(sw_scene *scene, sw_handle hold, sw_motion *motion, int relative,
                          sw_error *err);
sw_status sw_scene_set_pose(sw_scene *scene, sw_handle hold, sw_pose pose, sw_error *err);
sw_status sw_scene_hold_pose(sw_scene *scene, sw_handle hold, sw_pose *out, sw_error *err);
/* When what it holds was last driven into an obstacle, how far then, and into which one: NAN, 0
 * and "" when it never was [s], [m]. */
sw_status sw_scene_hold_crash(const sw_scene *scene, sw_handle hold, double *time, double *depth,
                              const char **obstacle, sw_error *err);

/* Force and moment on the wire about the held point, or about *about [N, N m]. */
sw_status sw_scene_hold_force(sw_scene *scene, sw_handle hold, const sw_vec *about, sw_vec *force,
                              sw_vec *moment, sw_error *err);

/* What it is like now, by its class's rows; SW_EDEAD once it is released. */
sw_status sw_scene_hold_args(const sw_scene *scene, sw_handle hold, const sw_params **rows,
                             sw_hold_args *out, sw_error *err);
/* What may be changed of the arguments from now on. */
sw_status sw_scene_set_hold(sw_scene *scene, sw_handle hold, const sw_hold_args *args,
                            sw_error *err);
/* Of a hold along which the wire slides; SW_EINVAL: it does not. */
typedef struct sw_slide_state {
  double place, speed; /* along the rail [m], [m/s] */
  double force;        /* of friction and ends on the wire, along it [N] */
} sw_slide_state;
sw_status sw_scene_slide_state(sw_scene *scene, sw_handle hold, sw_slide_state *out, sw_error *err);

/* --- feeds ------------------------------------------------------------------- */

/* From now on the wire is paid out at this speed; negative: drawn in [m/s]. */
sw_status sw_scene_feed_speed(sw_scene *scene, sw_handle hold, double speed, sw_error *err);
/* From now on it is pushed out with this force [N]. */
sw_status sw_scene_feed_push(sw_scene *scene, sw_handle hold, double force, sw_error *err);
/* It slips where more force than this would be needed; NAN: never [N]. */
sw_status sw_scene_feed_limit(sw_scene *scene, sw_handle hold, double force, sw_error *err);
/* Stop, and pay out a length: its motion is the motion's x (retains it). Negative lengths that
 * are not there are refused. */
sw_status sw_scene_feed_length(sw_scene *scene, sw_handle hold, sw_motion *motion, double length,
                               sw_error *err);
typedef struct sw_feed_state {
  double fed;   /* paid out so far [m] */
  double speed; /* now [m/s] */
  double drive; /* force that moves the wire, outwards; not that of the guide's walls [N] */
  double limit; /* NAN = none [N] */
} sw_feed_state;
sw_status sw_scene_feed_state(sw_scene *scene, sw_handle hold, sw_feed_state *out, sw_error *err);

/* --- obstacles -------------------------------------------------------------- */

typedef struct sw_obstacle_args {
  char name[SW_NAME_SIZE];
  sw_vec at;          /* [m] */
  sw_quat rotation;   /* [-] */
  double friction;    /* Coulomb coefficient [-] */
  double kinetic;     /* the same of what slides; NAN = as friction [-] */
  double restitution; /* share of the approach speed kept in an impact [-] */
} sw_obstacle_args;
extern const sw_params sw_obstacle_params;

/* Retains the shape. */
sw_status sw_scene_add_obstacle(sw_scene *scene, sw_shape *shape, const sw_obstacle_args *args,
                                sw_handle *out, sw_error *err);
sw_status sw_scene_obstacle_follow(sw_scene *scene, sw_handle obstacle, sw_motion *motion,
                                   int relative, sw_error *err);
sw_status sw_scene_obstacle_pose(sw_scene *scene, sw_handle obstacle, sw_pose *out, sw_error *err);
sw_status sw_scene_obstacle_set_pose(sw_scene *scene, sw_handle obstacle, sw_pose pose,
                                     sw_error *err);
/* What it is like now, by its rows. */
sw_status sw_scene_obstacle_args(sw_scene *scene, sw_handle obstacle, sw_obstacle_args *out,
                                 sw_error *err);
/* Friction and restitution of the arguments from now on; touches keep what they remember. */
sw_status sw_scene_obstacle_set_surface(sw_scene *scene, sw_handle obstacle,
                                        const sw_obstacle_args *args, sw_error *err);
/* Total contact force and its moment about a point, on the obstacle [N, N m]. */
sw_status sw_scene_obstacle_force(sw_scene *scene, sw_handle obstacle, sw_vec about, sw_vec *force,
                                  sw_vec *moment, sw_error *err);
sw_status sw_scene_remove_obstacle(sw_scene *scene, sw_handle obstacle, sw_error *err);
/* The shape, still the scene's: retain it to keep it. */
sw_status sw_scene_obstacle_shape(sw_scene *scene, sw_handle obstacle, sw_shape **out,
                                  sw_error *err);

/* --- wires that touch each other ------------------------------------------------ */

typedef struct sw_wire_contact_args {
  double friction; /* [-] */
  int self, on;
} sw_wire_contact_args;
extern const sw_params sw_wire_contact_params;

/* From now on these wires (none = all, later ones too) touch each other. */
sw_status sw_scene_wire_contact(sw_scene *scene, const sw_wire_contact_args *args,
                                const sw_handle *wires, size_t count, sw_error *err);

/* A place where two wires press on each other. */
typedef struct sw_wire_touch {
  char wire[2][SW_NAME_SIZE];
  double s[2];          /* arc lengths [m] */
  sw_vec point, normal; /* between the surfaces [m]; towards the first wire [-] */
  sw_vec force;         /* on the first wire [N] */
  sw_vec friction;      /* part of it across the normal [N] */
  double normal_force;  /* [N] */
} sw_wire_touch;

/* How many such places the accepted state has; number k of them. */
sw_status sw_scene_wire_touch_count(sw_scene *scene, size_t *count, sw_error *err);
void sw_scene_wire_touch(sw_scene *scene, size_t k, sw_wire_touch *out);

/* --- forces ----------------------------------------------------------------- */

/* A force on one wire, or on all (handle of generation 0). args: the class's
 * argument struct. */
sw_status sw_scene_add_force(sw_scene *scene, const sw_force_class *cls, sw_handle wire,
                             const void *args, size_t args_size, sw_handle *out, sw_error *err);
sw_status sw_scene_remove_force(sw_scene *scene, sw_handle force, sw_error *err);
/* Its arguments as they were given or set last, SW_FORCE_ARGS_MAX bytes; other ones from now on. A
 * place on the wire stays what it is. */
sw_status sw_scene_force_args(const sw_scene *scene, sw_handle force, void *args, sw_error *err);
sw_status sw_scene_set_force(sw_scene *scene, sw_handle force, const void *args, sw_error *err);
/* Values of its class' outputs on one wire, SW_FORCE_OUTPUTS_MAX at most. */
sw_status sw_scene_read_force(sw_scene *scene, sw_handle force, sw_handle wire, double *out,
                              sw_error *err);

/* SW_EBUSY from inside a step, a user's function or an observer: the scene must not be changed
 * now. */
sw_status sw_scene_editable(const sw_scene *scene, sw_error *err);
/* SW_EBUSY from inside a step or a function of time, where its fields are the solver's. */
sw_status sw_scene_still(const sw_scene *scene, sw_error *err);

/* --- running ---------------------------------------------------------------- */

/* The window of the last run, or that of runs that say nothing [s]. */
double sw_scene_window(const sw_scene *scene);

/* --- energy ------------------------------------------------------------------- */

/* How often something had to be done because a step made energy, and the worst of it. */
typedef struct sw_retries {
  size_t count;
  double largest;            /* energy made by such a step [J] */
  double time, s;            /* when, and where nodes gained most [s], [m] */
  char object[SW_NAME_SIZE]; /* the wire there */
} sw_retries;

/* Where the energy of a run came from and went. The remainder of each step,
 *   change of energy - work + losses,
 * is booked by itself: below 0 as lost by the integrator (or by contact, in steps in which touches
 * began or ended), above 0 as gap. */
typedef struct sw_ledger {
  double kinetic, stored, gravity;                                   /* now [J] */
  double at_start;                                                   /* their sum then [J] */
  double by_holds, by_obstacles, by_feeds, by_forces;                /* work [J] */
  double by_changes;                                                 /* of the scene itself [J] */
  double damping, friction, plasticity, impact, contact, integrator; /* lost [J] */
  double jumps;                  /* lost by equilibria that jumped, of quasi-static runs [J] */
  double gap;                    /* from nowhere [J] */
  double gained;                 /* sum of what steps gained beyond the work [J] */
  double most_gained, most_time; /* by one step, and when [J], [s] */
  double play;         /* energy that was in play: largest kinetic energy, work, energy released;
                          at least the wires' weight times their radius [J] */
  sw_retries redone;   /* steps redone with implicit Euler */
  sw_retries halved;   /* and then halved */
  sw_retries accepted; /* and taken all the same, for they could not be smaller */
  size_t steps;        /* accepted ones [-] */
} sw_ledger;

/* Of the last run, or the one under way. */
sw_status sw_scene_ledger(sw_scene *scene, sw_ledger *out, sw_error *err);
/* Rows (their number) of time [s], kinetic, stored and gravity energy, gap and all losses so
 * far [J], one a step. */
const double *sw_scene_energy_log(const sw_scene *scene, size_t *rows);
enum { SW_LOG_ENERGY_SIZE = 6 };
/* --- events ------------------------------------------------------------------- */

/* Something that happened, once or again and again. */
typedef struct sw_event {
  char kind[SW_NAME_SIZE], object[SW_NAME_SIZE];
  char text[224];           /* one sentence, for people */
  double time, first, last; /* of the largest value; of the first and the last time [s] */
  double s;                 /* arc length; NAN = none [m] */
  double value;             /* in the text's unit; NAN = none */
  size_t count;             /* how often it happened, one soon after the other [-] */
} sw_event;
size_t sw_scene_events(const sw_scene *scene);         /* of the last run [-] */
size_t sw_scene_events_dropped(const sw_scene *scene); /* for want of room [-] */
const sw_event *sw_scene_event(const sw_scene *scene, size_t k);
/* Book one at the scene's time; value and arc may be NAN. */
sw_status sw_scene_book_event(sw_scene *scene, const char *kind, const char *object, double arc,
                              double value, const char *text, sw_error *err);

/* --- reading ---------------------------------------------------------------- */

typedef struct sw_point_state {
  sw_vec position, tangent, velocity; /* [m], [-], [m/s] */
  double curvature;                   /* [1/m] */
  double tension, elastic;            /* axial force; without that of dashpots [N] */
  double twist_moment;                /* [N m] */
  double spin;                        /* about the tangent, of a wire that rolls [rad/s] */
  double strain, least_strain;        /* of the fibres outside and inside the bend [-] */
} sw_point_state;

typedef struct sw_extreme {
  double value; /* [its unit] */
  double s;     /* where [m] */
  double time;  /* when [s] */
} sw_extreme;

sw_status sw_scene_wire_length(sw_scene *scene, sw_handle wire, double *length, sw_error *err);
sw_status sw_scene_wire_nodes(sw_scene *scene, sw_handle wire, size_t *nodes, sw_error *err);
sw_status sw_scene_wire_beam(sw_scene *scene, sw_handle wire, sw_beam *out, sw_error *err);
sw_status sw_scene_wire_at(sw_scene *scene, sw_handle wire, double s, sw_point_state *out,
                           sw_error *err);
/* Node positions (n x 3) and arc lengths (n); each may be NULL. */
sw_status sw_scene_wire_copy(sw_scene *scene, sw_handle wire, double *positions, double *s,
                             double *velocities, sw_error *err);
/* All particles of a wire that is a mesh, ring by ring; of any other its nodes. */
sw_status sw_scene_wire_particles(sw_scene *scene, sw_handle wire, size_t *particles,
                                  sw_error *err);
sw_status sw_scene_wire_particle_copy(sw_scene *scene, sw_handle wire, double *positions, double *s,
                                      sw_error *err);
/* Give every node a velocity: linear field v + omega x (x - about). */
sw_status sw_scene_wire_set_velocity(sw_scene *scene, sw_handle wire, sw_vec v, sw_vec omega,
                                     sw_vec about, sw_error *err);
/* The wire's largest values: now, and since the last run or settle began. */
typedef struct sw_wire_extremes {
  sw_extreme curvature, tension, strain; /* [1/m], [N], outermost fibre [-] */
  sw_extreme folding;     /* of a section of springs; above 0: it has folded through itself [-] */
  sw_extreme ovalisation; /* of a mesh of particles; see sw_section_shape [-] */
  sw_extreme torsion;     /* of a line, M_t / GJ [rad/m] */
  sw_extreme raw;         /* tension of a single step; tension is of means over the window [N] */
  double raw_span;        /* how long that step was; 0: it was an equilibrium [s] */
} sw_wire_extremes;
sw_status sw_scene_wire_extremes(sw_scene *scene, sw_handle wire, sw_wire_extremes *now,
                                 sw_wire_extremes *run, sw_error *err);

/* --- what else may be asked ---------------------------------------------------------- */

typedef struct sw_modes_args {
  long modes;       /* how many [-] */
  double tolerance; /* how far from rest the wire may be, of its length [-] */
  int shapes;       /* wanted? */
} sw_modes_args;
extern const sw_params sw_modes_params;

typedef struct sw_modes_result {
  size_t count;        /* frequencies found [-] */
  size_t unstable;     /* motions that grow instead [-] */
  double growth;       /* of the fastest of those [1/s] */
  double *frequencies; /* (modes), the caller's [Hz] */
  double *shapes;      /* (modes x nodes x 3), the caller's, or NULL [1/sqrt(kg)] */
} sw_modes_result;

/* Lowest natural frequencies of one wire about the present equilibrium, all else
 * held as it is. Changes nothing. SW_EINVAL when the wire is not at rest. */
sw_status sw_scene_wire_modes(sw_scene *scene, sw_handle wire, const sw_modes_args *args,
                              int (*interrupted)(void), sw_modes_result *out, sw_error *err);

/* Kinetic, contact, repel, join, and of each class of force its own and what it corrects. */
enum { SW_ENERGY_KINDS = 4 + 2 * SW_FORCE_CLASSES };
typedef struct sw_energy {
  size_t count;
  const char *kind[SW_ENERGY_KINDS];
  double value[SW_ENERGY_KINDS]; /* [J] */
  double dissipated;             /* by forces with a history so far, not stored [J] */
  int has_dissipated;            /* there are such forces */
} sw_energy;
sw_status sw_scene_energy(sw_scene *scene, sw_energy *out, sw_error *err);
/* The same of one wire or object of particles alone. */
sw_status sw_scene_body_energy(sw_scene *scene, sw_handle body, sw_energy *out, sw_error *err);

/* Deepest penetration of a wire's surface into an obstacle now and since the
 * last run began [m]. */
sw_status sw_scene_penetration(sw_scene *scene, double *now, sw_extreme *deepest, sw_error *err);
/* Number of contact points with a force now. */
size_t sw_scene_touches(sw_scene *scene);

/* Where a force is asked; NULL = the scene's own state. Arrays are (nodes x 3). */
typedef struct sw_probe {
  const double *positions;  /* [m] */
  const double *velocities; /* [m/s] */
  const double *direction;  /* to be multiplied by the stiffness; NULL = no product [m] */
  double rate; /* adds rate times the damping to the stiffness, as a step of 1/rate does [1/s] */
  int statics; /* 0: leave out the geometric stiffness of edges under pressure, as steps do */
} sw_probe;

typedef struct sw_probe_result {
  size_t terms;    /* forces of this kind on the wire */
  double energy;   /* [J] */
  double *force;   /* (nodes x 3), the caller's; or NULL [N] */
  double *product; /* (nodes x 3), the caller's; or NULL: stiffness times direction [N] */
} sw_probe_result;

/* What all forces of one class do to a wire. Changes nothing. */
sw_status sw_scene_probe(sw_scene *scene, sw_handle wire, const sw_force_class *cls,
                         const sw_probe *at, sw_probe_result *out, sw_error *err);

/* One recorded row per step of a hold: time, force, moment, held point. */
enum {
  SW_LOG_TIME = 0,
  SW_LOG_FORCE = 1,
  SW_LOG_MOMENT = 4,
  SW_LOG_POINT = 7,
  SW_LOG_SPAN = 10,
  SW_LOG_SIZE
};
sw_status sw_scene_hold_log(sw_scene *scene, sw_handle hold, const double **rows, size_t *count,
                            sw_error *err);
/* One recorded row per step of an obstacle: time, force on it. */
enum { SW_LOG_OBSTACLE_SIZE = 5 };
sw_status sw_scene_obstacle_log(sw_scene *scene, sw_handle obstacle, const double **rows,
                                size_t *count, sw_error *err);

/* Of a wire: time, largest tension [N], largest curvature [1/m]. Of a force that tells what it does
 * to wires (clip, tether): time, force on them [N]. count is 0 where nothing was recorded. */
enum { SW_LOG_WIRE_SIZE = 3, SW_LOG_FORCE_SIZE = 4 };
sw_status sw_scene_wire_log(sw_scene *scene, sw_handle wire, const double **rows, size_t *count,
                            sw_error *err);
/* The same of a tie between wires: on the first one. */
sw_status sw_scene_tie_log(sw_scene *scene, sw_handle join, const double **rows, size_t *count,
                           sw_error *err);
sw_status sw_scene_force_log(sw_scene *scene, sw_handle force, const double **rows, size_t *count,
                             sw_error *err);

/* --- snapshots -------------------------------------------------------------- */

/* Restoring takes back what was made after the snapshot: its handles are stale
 * from then on, unless another living snapshot still knows it. */
sw_status sw_scene_snapshot(sw_scene *scene, sw_snapshot **out, sw_error *err);
sw_status sw_scene_restore(sw_scene *scene, const sw_snapshot *snapshot, sw_error *err);
void sw_snapshot_free(sw_snapshot *snapshot);         /* NULL is allowed */
double sw_snapshot_time(const sw_snapshot *snapshot); /* [s] */
int sw_snapshot_busy(const sw_snapshot *snapshot);    /* being restored: do not free it */

#endif
