/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mechanical system that integrators advance: all wires' nodes in flat
 * arrays, the forces on them, the holds, and whatever couples them to the
 * outside (contact). It offers two views: an implicit stage
 * M (y - yhat)/hbar^2 = f(y, (y - xhat)/hbar, t), solved by the mixed Newton,
 * and plain accelerations with lumped masses for explicit schemes. */
#ifndef SW_SYSTEM_SYSTEM_H
#define SW_SYSTEM_SYSTEM_H

#include <stddef.h>

#include "base/status.h"
#include "state/first_stage.h"
#include "system/body.h"
#include "system/coupling.h"

typedef struct sw_counters {
  size_t newton;      /* matrix solves since start [-] */
  size_t solves;      /* the same, each body's own [-] */
  size_t evaluations; /* force evaluations since start [-] */
  size_t looks;       /* at obstacles and lists, by contact that looks for something in them [-] */
} sw_counters;

/* Of sw_system.rough: in statics, an update so large that it is not made, touches learn from it;
 * and one that is made if they agree to it. */
enum { SW_NOT_MADE = 2, SW_MAY_BE_MADE };

struct sw_system {
  size_t nodes, edges;
  size_t rolls; /* edges of wires that roll */
  size_t rail_count;
  size_t freedoms; /* values in each of x, v, a: 3 x nodes + rolls + rails */
  sw_body *bodies;
  size_t body_count;
  size_t part, part_end; /* the bodies that are solved now: all, or one after another */
  sw_held_node *held;
  size_t held_count;
  double *directors;             /* (holds x 2 x 3) in hold coordinates: arriving, leaving */
  double *directors_now;         /* the same in world coordinates at the stage */
  double *turns;                 /* (holds x 3) how fast they turn [rad/s] */
  double *normals, *normals_now; /* the same: the wire's normals at the holds */
  double fastest_turn;           /* of a hold in this step so far [rad/s] */
  double from, to;               /* to > from: see sw_stage [s] */
  int still;                     /* 1: holds count as standing, whatever they follow (statics) */
  int rough;                  /* 1: the last update turned edges too far to be the stage's last */
  sw_hold_state *hold_states; /* (hold_count) at the last stage */
  struct sw_hold_load *loads; /* (hold_count) of the last stage about the holds' places, if */
  int loads_kept;             /* 1: the state is not that stage's but goes on from it */
  size_t hold_count;
  double gravity[3];  /* [m/s2] */
  const double *dead; /* (nodes x 3) forces on nodes besides, as those of inertia; or NULL [N] */
  sw_coupling coupling;
  struct sw_bridges *bridges; /* between bodies, or NULL while there never were any */
  struct sw_rail *rails;      /* of held nodes that keep on curves (see system/rail.h), or NULL */
  double *rail_room;
  struct sw_joins *joins; /* what holds wires together (see system/join.h), or NULL */
  sw_counters counters;
  double factor_hbar;   /* bodies' factors are of this step, made for it; 0: there are none [s] */
  int factor_solves;    /* with factors of before, one after another in this stage [-] */
  int goes_on;          /* 1: the iterate that is being solved goes on with them */
  double factor_first;  /* change of edges by the first of these, of their length [-] */
  double factor_update; /* and by the last one [-] */

  /* the state, one block: x v a (nodes x 3, then turns of edges that roll, each), tension (edges),
   * twist (spans) [rad], turn (holds x 4: the holds' orientations that go with it), frames of each
   * body that has them (3 components of all edges, then hinges' and clamps' twist [rad]), strain
   * and strain_rate, even and turning, forces' histories */
  double *state;
  size_t state_size; /* in doubles */
  double *x, *v, *a, *tension, *twist, *turn, *frames;
  /* (strains) axial strain of edges, then of each body's kept clamps where the edge points to, in
   * the hold's coordinates, then places of held nodes; and the rates of all, by the method; NULL
   * when no force has dashpots [-], [m], [1/s], [m/s] */
  double *strain, *strain_rate;
  size_t strains, first_kept; /* their number; where held nodes begin */
  /* (edges) axial forces as read out, where they are not those of the state, and between stages,
   * before they go on to the step's end [N] */
  double *even, *between;
  double *excess;       /* (edges) of the last stage's axial forces over those read out, and [N] */
  sw_first_stage first; /* with x till the next stage: they differ */
  double *turning;      /* (SW_TURN_SIZE) */
  size_t span_count;
  size_t follow_size;    /* of twist, turn and frames, if there is twist or a frame: else 0 */
  double *aside;         /* (follow_size) room for them */
  double *trial_history; /* room for the longest history of a force, NULL without any */

  /* The trial that was accepted last, until sw_system_refresh: fields that are judged are of it and
   * need no measuring. NULL at any other time. */
  const double *judged;

  /* work space of a stage (freedoms) */
  double *yhat, *delta, *velocity;
  double *tension_new; /* (edges) */
  /* of axial dashpots (edges): the stage's, while one is solved that has rates, else NULL; after
   * an update; axial forces of the state with the dashpots' [-], [-], [N] */
  const double *strain_past;
  double *strain_now, *strain_new, *pull;
  double *clamps_now; /* (first_kept - edges) of kept clamps, in world coordinates: the stage's past
                         directions, or a state's rates [-], [1/s] */
  void *pull_block;
  double *factor_at; /* (freedoms) positions for which the factors were made, where they may
                        serve again [m] */
  void *work;
};

/* Newton controls, all [-] unless said. */
typedef struct sw_newton {
  int max_iterations;
  double accept_rotation; /* largest edge rotation of the last update [rad] */
  double limit_rotation;  /* larger updates are shortened to this [rad] */
  int statics;            /* 1: no inertia */
  int most_far;           /* statics: updates beyond limit_rotation, made or not, after which wires
                             that touch something are given up; 0: as many as it takes [-] */
  double accept_shift;    /* statics: largest node shift of the last update [m] */
} sw_newton;

typedef struct sw_stage {
  double time; /* at the stage's end [s] */
  /* to > from: the state goes on from the stage, as from `from` to it, to `to`. Holds are then
   * placed on the straight way between their poses at both, and wires come out where these are: had
   * a hold that gathers speed its pose of the stage's time, a stiff wire would be bent [s]. */
  double from, to;
  double hbar;        /* [s] */
  double inertia;     /* mass acts as so many times itself: of methods that take forces and
                         accelerations at different times; 0 is as 1 [-] */
  double first;       /* share of the step's first stage in xhat [-] */
  const double *xhat; /* (freedoms): velocity = (y - xhat)/hbar [m], [rad] */
  const double *vhat; /* (nodes x 3): acceleration = inertia (velocity - vhat)/hbar [m/s] */
  double *y;          /* out: positions [m] */
  double *v;          /* out: velocities [m/s] */
  double *a;          /* out: accelerations, or NULL [m/s2] */
  /* where there are dashpots (strains): strain rate = (strain - strain_past)/hbar; without
   * them, and in statics, NULL [-] */
  const double *strain_past;
  double *strain; /* in: a guess, out: of the solved stage [-] */
} sw_stage;

typedef struct sw_stage_report {
  int iterations;
  double rotation; /* of the last update [rad] */
  double share;    /* of it that the coupling lets be made [-] */
  size_t negative; /* negative pivots of the last matrix */
} sw_stage_report;

/* Make arrays for bodies whose plans are set (takes over a retained plan each).
 * The caller fills x, v and terms. SW_ENOMEM leaves nothing behind. */
sw_status sw_system_new(sw_system *system, sw_plan *const *plans, size_t body_count,
                        size_t hold_count, size_t rail_count);
void sw_system_free(sw_system *system);

/* The body that has a node of the system's arrays. */
size_t sw_system_body_of(const sw_system *system, size_t node);

/* Add a force to a body. inner terms: id -1. SW_ENOMEM. */
sw_status sw_system_add_term(sw_system *system, size_t body, const sw_force_class *cls,
                             const void *args, size_t args_size, int id);

/* After the last term: make room in the state for the histories, all zero.
 * SW_ENOMEM. */
sw_status sw_system_add_histories(sw_system *system);

/* While the coupling evaluates: stiffness between nodes i and j that are not neighbours,
 * i != j, row by row with i's rows [N/m]; the nodes' own parts go to their bodies' rows.
 * SW_ENOMEM. */
sw_status sw_system_add_bridge(sw_system *system, size_t i, size_t j, const double k[9]);

/* Before a step: between which nodes there may be bridges in it, anew from begin_plan on, so
 * that the matrix is made for them and that its order does not depend on earlier steps. */
sw_status sw_system_begin_plan(sw_system *system);
sw_status sw_system_plan_bridge(sw_system *system, size_t i, size_t j);

/* The state is accepted at this time and the fields are fresh (sw_system_refresh): bring the
 * histories up to it. */
void sw_system_commit(sw_system *system, double time);

/* Work dissipated by the forces with a history [J]; *any: there are such. */
double sw_system_dissipated(const sw_system *system, int *any);

/* A step begins at the state: frames start from there. */
void sw_system_begin_step(sw_system *system);

/* The state's frames were given: make them fit its tangents and measure their twist. */
void sw_system_measure_frames(sw_system *system, size_t body);

/* Bring a body's twist or frames up to its field's tangents. */
void sw_system_measure(sw_system *system, sw_body *body);

/* A force is added at a held node of the system's: its hold bears it. */
void sw_system_push_held(sw_system *system, size_t node, sw_vec force);

/* Solve an implicit stage. system->tension is read and updated. Statuses:
 * SW_OK, SW_ENOCONV, SW_ESINGULAR, SW_EDIVERGED, SW_ECALLBACK. */
sw_status sw_system_stage(sw_system *system, const sw_stage *stage, const sw_newton *newton,
                          sw_stage_report *report, sw_error *err);

/* What a body's evaluation sees: itself at places x with velocities v (nodes x 3), the holds as
 * placed last, gravity; rates of strain are those of v. */
void sw_body_aim(const sw_system *system, sw_body *body, const double *x, const double *v);
/* Accelerations with lumped masses at (t, x, v); held nodes get their hold's. */
sw_status sw_system_acceleration(sw_system *system, double t, const double *x, const double *v,
                                 double *a, sw_error *err);

/* Place the holds at time t: overwrite held nodes' entries of x, v, a (each may
 * be NULL) and set directors. */
sw_status sw_system_place_holds(sw_system *system, double t, double *x, double *v, double *a,
                                sw_error *err);

/* Velocity of a held node from its hold's state at the last stage [m/s]. */
void sw_system_held_velocity(const sw_system *system, const sw_held_node *held, double *v);

/* Let the wires of body b resist twist: makes work space. SW_ENOMEM. */
sw_status sw_system_enable_twist(sw_system *system, size_t body);

/* The state is about to become positions x, with the holds as last placed: take
 * over what has to be followed from step to step (twist, frames). Call before copying x
 * to the state. */
void sw_system_follow(sw_system *system, const double *x);

/* Bring every field's geometry up to the state (system->x). */
void sw_system_refresh(sw_system *system);

/* Force and moment about point that hold k puts on its wire, from the last
 * solved stage [N], [N m]. */
void sw_system_reaction(const sw_system *system, int hold, sw_vec point, sw_vec *force,
                        sw_vec *moment);
/* The same of all holds about their places, from the stage that was solved last; out: (holds). */
typedef struct sw_hold_load {
  sw_vec force, moment; /* [N], [N m] */
} sw_hold_load;
void sw_system_hold_loads(const sw_system *system, sw_hold_load *out);
/* The state will be further on than the stage that was solved last, where wire and holds are not
 * in balance: the stage's loads go on to be told. */
void sw_system_keep_loads(sw_system *system);

/* Kinetic energy of the state with consistent (implicit) masses [J]. */
double sw_system_kinetic(const sw_system *system, int lumped);
double sw_body_kinetic(const sw_system *system, size_t body, int lumped);

/* Bring the field of a body up to the state, with what energies need. */
void sw_system_show(sw_system *system, size_t body);

/* Energy of one term of one body, after sw_system_show; *bending is the part of it that
 * corrects the wire's own bending [J]. */
double sw_system_term_energy(sw_system *system, size_t body, size_t term, double *bending);

/* Smallest stable leapfrog step over all bodies and forces [s]. */
double sw_system_stable_dt(const sw_system *system);

#endif
