/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mechanical system of the integrators: all wires' nodes in flat arrays, the forces on them,
 * the holds, and couplings to the outside (contact). It has two forms: an implicit stage M (y -
 * yhat)/hbar^2 = f(y, (y - xhat)/hbar, t), solved by the mixed Newton, and accelerations with
 * lumped masses for explicit methods. */
#ifndef SW_SYSTEM_SYSTEM_H
#define SW_SYSTEM_SYSTEM_H

#include <stddef.h>

#include "base/status.h"
#include "state/first_stage.h"
#include "system/body.h"
#include "system/coupling.h"
#include "system/stage.h"

typedef struct sw_counters {
  size_t newton;      /* matrix solves since start [-] */
  size_t solves;      /* the same, counted for each body */
  size_t evaluations; /* force evaluations since start [-] */
  size_t looks;       /* obstacles and list entries checked by contact's searches [-] */
} sw_counters;

/* Further values of sw_system.rough, in statics. The first: the update is too large and is not
 * made, but touches learn from it. The second: it is made if touches agree. */
enum { SW_NOT_MADE = 2, SW_MAY_BE_MADE };

struct sw_system {
  size_t nodes, edges;
  size_t slices;            /* of all meshes, each between two rings */
  size_t rolls, rail_count; /* edges of wires that roll; rails */
  size_t freedoms;          /* values in each of x, v, a: 3 x nodes + rolls + rails */
  sw_body *bodies;
  size_t body_count;
  size_t part, part_end; /* range of the bodies of the present part (system/part.h), */
  int group;             /* 1: of these only the coupled ones */
  int waiting, awake; /* 1: some body waits; none may before a step is accepted (system/wait.h) */
  sw_held_node *held;
  size_t held_count;
  double *directors;             /* (holds x 2 x 3) in hold coordinates: arriving, leaving */
  double *directors_now;         /* the same in world coordinates at the stage */
  double *turns;                 /* (holds x 3) angular velocities [rad/s] */
  double *flows;                 /* (holds) see sw_hold_state [m/s] */
  double *normals, *normals_now; /* the same for the wire's normals at the holds */
  double fastest_turn;           /* of any hold in this step so far [rad/s] */
  double from, to;               /* to > from: see sw_stage [s] */
  double inner;                  /* while a stage is solved: see sw_stage [s] */
  int still;                     /* 1: holds count as standing even if they move (statics) */
  int poses; /* 1: a pose of a quasi-static run is solved; 0: equilibrium for its own sake */
  int tight; /* 1: taut wires may be in each other only a little; see mutual/meet.c */
  int rough; /* 1: the last update turned edges too far to be the stage's last; see above */
  sw_hold_state *hold_states; /* (hold_count) at the last stage */
  sw_hold_load *loads;        /* (hold_count) of the last stage about the holds' places, */
  int loads_kept;             /* 1: these are read out (sw_system_keep_loads) */
  int stays;                  /* 1: in this inner stage some holds keep to their paths */
  sw_standing *standing;      /* (hold_count) set by the coupling's owner when a step begins */
  size_t hold_count;
  double gravity[3];  /* [m/s2] */
  const double *dead; /* (nodes x 3) further forces on nodes, e.g. inertia; or NULL [N] */
  sw_coupling coupling;
  struct sw_bridges *bridges; /* between bodies; NULL if there never were any */
  struct sw_rail *rails;      /* of held nodes that stay on curves (system/rail.h), or NULL */
  double *rail_room;
  struct sw_joins *joins; /* joins between wires (system/join.h), or NULL */
  struct sw_parted {
    uint32_t i, j;
  } * parted; /* nodes that released joins kept together */
  size_t parted_count, parted_capacity;
  sw_counters counters;
  double factor_hbar;   /* hbar of the bodies' factors, made in this step; 0: none [s] */
  int factor_solves;    /* solves in a row with old factors in this stage [-] */
  int goes_on;          /* 1: the present iterate takes old factors */
  double factor_first;  /* relative change of edges by the first of these solves [-] */
  double factor_update; /* relative change of edges by the last one [-] */

  /* the state, one block: x v a (each: nodes x 3, then turns of edges that roll, then rails' arc
   * lengths), tension (edges), twist (spans) [rad], turn (holds x 4: the holds' orientations for
   * the twist), frames of each body that has them (3 components of all edges, then twist of hinges
   * and clamps [rad]), strain and strain_rate, even, between and turning, forces' histories */
  double *state;
  size_t state_size; /* in doubles */
  double *x, *v, *a, *tension, *twist, *turn, *frames;
  /* (strains) axial strain of edges; then for each body's kept clamps the edge's direction in the
   * hold's coordinates; then places of held nodes. Then the rates of all these by the method's
   * formula. NULL if no force has dashpots [-], [m], [1/s], [m/s] */
  double *strain, *strain_rate;
  size_t strains, first_kept; /* their number; index of the first held node's place */
  /* (edges) axial forces of read-outs, where they differ from the state's; and the mix of both
   * stages, before its extrapolation to the step's end [N] */
  double *even, *between;
  double *borne;        /* axial forces beside the springs' (system/borne.h), or NULL [N] */
  double *excess;       /* (edges) the last stage's axial forces minus those of read-outs [N] */
  sw_first_stage first; /* its x is set, until the next stage, if they differ */
  double *turning;      /* (SW_TURN_SIZE) */
  size_t span_count;
  size_t follow_size;    /* size of twist, turn and frames if there is twist or a frame, else 0 */
  double *aside;         /* (follow_size) to save them */
  double *trial_history; /* for the longest history of a force; NULL: no histories */

  /* Positions of the trial accepted last, until sw_system_refresh: the fields of the accepted trial
   * were measured there and need no new measurement. NULL at any other time. */
  const double *judged;

  /* work space of a stage (freedoms) */
  double *yhat, *delta, *velocity;
  double *tension_new; /* (edges) */
  /* for axial dashpots. Strains: the base of the stage's rates, NULL outside a stage with rates; of
   * the iterate; after an update. Axial forces of the state with those of dashpots (edges) [-],
   * [-], [-], [N] */
  const double *strain_past;
  double *strain_now, *strain_new, *pull;
  double *clamps_now; /* (first_kept - edges) of kept clamps, in world coordinates: past directions
                         of a stage, or rates of a state [-], [1/s] */
  void *pull_block;
  double *factor_at; /* (freedoms) positions at which reusable factors were made [m] */
  void *work;
};

/* Makes arrays for bodies with these plans (retains each plan). The caller fills x, v and terms.
 * SW_ENOMEM leaves nothing behind. */
sw_status sw_system_new(sw_system *system, sw_plan *const *plans, size_t body_count,
                        size_t hold_count, size_t rail_count);
void sw_system_free(sw_system *system);

/* Returns the body that owns a node of the system's arrays. */
size_t sw_system_body_of(const sw_system *system, size_t node);

/* Adds a force to a body. id: -1 for inner terms. SW_ENOMEM. */
sw_status sw_system_add_term(sw_system *system, size_t body, const sw_force_class *cls,
                             const void *args, size_t args_size, int id);
/* After the last term: adds the histories to the state, all zero. SW_ENOMEM. */
sw_status sw_system_add_histories(sw_system *system);

/* While the coupling evaluates: adds stiffness between nodes i != j that are not neighbours; k has
 * i's rows, row by row [N/m]. The nodes' own blocks go to their bodies' rows. SW_ENOMEM. */
sw_status sw_system_add_bridge(sw_system *system, size_t i, size_t j, const double k[9]);

/* Before a step: begin_plan starts a new list of pairs of nodes that may have bridges in the step;
 * plan_bridge adds a pair. The matrix depends on these pairs only, so its order does not depend on
 * earlier steps. */
sw_status sw_system_begin_plan(sw_system *system);
sw_status sw_system_plan_bridge(sw_system *system, size_t i, size_t j);

/* The state is accepted at this time, with fresh fields (sw_system_refresh): updates the
 * histories. */
void sw_system_commit(sw_system *system, double time);

/* Returns the dissipation by forces with a history [J]; *any: 1 if there are such forces. */
double sw_system_dissipated(const sw_system *system, int *any);

/* A step begins at the state; frames start from there. */
void sw_system_begin_step(sw_system *system);

/* The state's frames were given: fits them to its tangents and measures their twist. */
void sw_system_measure_frames(sw_system *system, size_t body);

/* Sets a body's twist or frames to its field's tangents. */
void sw_system_measure(sw_system *system, sw_body *body);

/* Adds a force at a held node (system's number): its hold bears it. */
void sw_system_push_held(sw_system *system, size_t node, sw_vec force);

/* Solves an implicit stage. Reads and updates system->tension. Statuses: SW_OK, SW_ENOCONV,
 * SW_ESINGULAR, SW_EDIVERGED, SW_ECALLBACK. */
sw_status sw_system_stage(sw_system *system, const sw_stage *stage, const sw_newton *newton,
                          sw_stage_report *report, sw_error *err);

/* Sets the input of a body's evaluation: nodes at x with velocities v (nodes x 3), the holds as
 * last placed, and gravity. Strain rates follow from v. */
void sw_body_aim(const sw_system *system, sw_body *body, const double *x, const double *v);
/* Computes accelerations with lumped masses at (t, x, v). Held nodes get their hold's
 * acceleration. */
sw_status sw_system_acceleration(sw_system *system, double t, const double *x, const double *v,
                                 double *a, sw_error *err);

/* Places the holds at time t: overwrites held nodes' entries of x, v, a (each may be NULL) and sets
 * directors. */
sw_status sw_system_place_holds(sw_system *system, double t, double *x, double *v, double *a,
                                sw_error *err);

/* Computes the velocity of a held node from its hold's state at the last stage [m/s]. */
void sw_system_held_velocity(const sw_system *system, const sw_held_node *held, double *v);

/* Computes by what angle each edge of a wire turns about itself between the state and positions x
 * (of the system), beyond being carried along with its tangent: turn (edges) [rad]. The holds are
 * where they were last placed. 0: nothing keeps the wire from turning; turn is
 * not filled. */
int sw_system_turns(const sw_system *system, const sw_body *body, const double *x, double *turn);

/* Returns the change of a span's twist on the straight path from the state to positions x (of the
 * system), with the holds as last placed [rad]. */
double sw_system_twist_change(const sw_system *system, const sw_body *body, size_t span,
                              const double *x);
/* Makes work space for a body whose wire resists twist. SW_ENOMEM. */
sw_status sw_system_enable_twist(sw_system *system, size_t body);

/* Before x is copied to the state: updates twist and frames to positions x, with the holds as last
 * placed. */
void sw_system_follow(sw_system *system, const double *x);

/* Sets every field's geometry to the state (system->x). */
void sw_system_refresh(sw_system *system);

/* Computes force and moment about point of hold k on its wire [N], [N m], from the last solved
 * stage. */
void sw_system_reaction(const sw_system *system, int hold, sw_vec point, sw_vec *force,
                        sw_vec *moment);
/* Computes this for all holds about their places; out: (holds). */
void sw_system_hold_loads(const sw_system *system, sw_hold_load *out);
/* The state will lie beyond the last solved stage, where wire and holds are not in balance. Keeps
 * the stage's loads for read-outs. */
void sw_system_keep_loads(sw_system *system);

/* Kinetic energy of the state, with lumped (explicit methods) or consistent masses [J]. */
double sw_system_kinetic(const sw_system *system, int lumped);
double sw_body_kinetic(const sw_system *system, size_t body, int lumped);

/* Sets a body's field to the state, with all that energies need. */
void sw_system_show(sw_system *system, size_t body);

/* Returns the energy of one term of a body, after sw_system_show; *bending is the part that
 * corrects the wire's own bending [J]. */
double sw_system_term_energy(sw_system *system, size_t body, size_t term, double *bending);

/* Smallest stable leapfrog step over all bodies and forces [s]. */
double sw_system_stable_dt(const sw_system *system);

#endif
