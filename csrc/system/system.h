/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mechanical system that integrators advance: all wires' nodes in flat
 * arrays, the forces on them, the holds, and whatever couples them to the
 * outside (contact). It offers two views: an implicit stage
 * M (y - yhat)/hbar^2 = f(y, (y - xhat)/hbar, t), solved by the mixed Newton,
 * and plain accelerations with lumped masses for explicit schemes. */
#ifndef SW_SYSTEM_SYSTEM_H
#define SW_SYSTEM_SYSTEM_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"
#include "force/force.h"
#include "state/field.h"
#include "state/plan.h"

/* One force acting on one wire. */
typedef struct sw_term {
  const sw_force_class *cls;
  double args[SW_FORCE_ARGS_MAX / sizeof(double)];
  int id;          /* for the owner; -1 for a recipe's own forces */
  double *history; /* its part of the system's state, or NULL */
} sw_term;

typedef struct sw_body {
  sw_plan *plan;
  size_t first_node, first_edge; /* place in the system's arrays */
  double EA, EA_push;            /* axial stiffness pulled and pushed [N] */
  double axial_time; /* axial dashpots: EA times this and the rate of strain is their force [s] */
  sw_term *terms;
  size_t term_count;
  sw_field field;
  void *field_block;
  size_t first_span;    /* place of the plan's spans in the system's twist */
  int has_twist;        /* the wire resists twist and is held against it somewhere */
  double *twist_now;    /* (spans) at this evaluation [rad] */
  double *twist_rank;   /* (nodes x 3) slope of the twist, held nodes included [rad/m]; both
                         * serve as room while the twist is measured */
  double *twist_solved; /* (nodes x 3) the matrix' inverse times it */
  double *twist_gain;   /* (spans) added to the torque by the last update [N m] */
  void *twist_block;
  size_t first_frame;                       /* place of its frames in the system's */
  double *spin_normal[3], *spin_tangent[3]; /* (edges) components at the iterate */
  double *spin_twist;                       /* (nodes + clamps) of the hinges there [rad] */
  double *spin_delta; /* (nodes x 4) last update: nodes and turns of edges [m], [rad] */
  double *spin_rows;  /* (nodes x SW_ROW4_SIZE) */
  void *spin_block;
  double spin_inertia;  /* of an edge per length over hbar^2, of a wire that rolls or where spins
                         * find no rest [N] */
  size_t first_roll;    /* a wire that rolls: place of its edges' turns in the system's, */
  double *roll_turn;    /* (edges) turn since the state, along the way straight from there [rad]; */
  double *roll_from[3]; /* (edges) the state's tangents; NULL for other wires [-] */
  void *roll_block;
  int needs_velocity;       /* some force depends on it */
  int is_explicit;          /* some force has no stiffness */
  int is_kinked;            /* some force has a history: its stiffness may jump in this step */
  size_t held;              /* number of its first held node + 1, or 0; as of a stage */
  struct sw_blocks *blocks; /* the matrix of a body whose plan has a web, or NULL */
  size_t *web_slots;        /* where its forces write into it */
  unsigned char *web_fixed; /* (particles) 1: held */
  uint32_t *web_pairs;      /* (web_pair_count x 2) that it has besides the web's */
  size_t web_pair_count;
  size_t web_couples; /* pairs of its particles in the matrix of what is bridged */
  int web_replanned;  /* 1: it has other pairs than these were listed for */
  double *web_room;   /* (particles x 15) of a large one, for iterations; or NULL */
  int web_factored;   /* 1: there is a factor of this step that leads iterations */
  int web_slow;       /* 1: it did not lead them fast enough in this step */
  int bridged;        /* its matrix is part of the bridges' (see system/bridge.h) */
  double pushed;      /* largest push for which the scene looked whether it buckles [N] */
} sw_body;

/* Where a hold is, for all nodes it holds. */
typedef struct sw_hold_state {
  sw_pose pose;              /* [m], [-] */
  sw_vec v, a, omega, alpha; /* [m/s], [m/s2], [rad/s], [rad/s2] */
} sw_hold_state;

/* A node that follows a hold: x = pose * local. */
typedef struct sw_held_node {
  size_t node; /* in the system's arrays */
  size_t body;
  int hold;
  size_t rail;      /* number of its rail + 1, or 0 (see system/rail.h) */
  int slides;       /* wire slides through: its velocity is not how the node moves */
  sw_vec local;     /* [m] */
  double saved[36]; /* its matrix couplings to the nodes -2 -1 +1 +2 [N/m] */
  sw_vec own_force; /* inertia minus forces before the last solve [N] */
  sw_vec reaction;  /* force on the wire needed to hold it [N] */
  size_t next;      /* number of its body's next one + 1, or 0; as of a stage */
} sw_held_node;

typedef struct sw_system sw_system;

enum { SW_BOOK_STAGES = 2 };

/* How the impulse from a step's start up to a stage, of what acts from outside, is made up of
 * forces and earlier impulses, as the stage's velocity is. */
typedef struct sw_booking {
  int stage;     /* number; what it had before is replaced [-] */
  double own;    /* share of the forces of the last evaluation [s] */
  double start;  /* of those at the step's start, which the last step ended with [s] */
  double first;  /* of the impulse up to stage 0, as it was [-] */
  double before; /* of that of the step before, backwards [-] */
} sw_booking;

/* What acts besides the wires' own forces. Every function may be NULL. All get
 * user first. */
typedef struct sw_coupling {
  void *user;
  /* Pose of hold number k at a time. */
  sw_status (*place)(void *user, int hold, double time, sw_hold_state *out, sw_error *err);
  /* A stage begins; first: share of the step's first stage in what it begins from [-]. */
  sw_status (*begin_stage)(void *user, sw_system *system, double time, double first, sw_error *err);
  /* It couples no bodies, and from now on acts on system->part alone; parts come in their order,
   * each once in a stage, and then all again. NULL: it acts on all together. */
  void (*part)(void *user, sw_system *system);
  /* Add forces and matrix rows at y to the bodies' fields. */
  sw_status (*eval)(void *user, sw_system *system, double time, double hbar, const double *y,
                    unsigned want, sw_error *err);
  /* Before eval at y: out = 1, its stiffness there is that of the last eval that was asked for it,
   * but for small turns. NULL: never. */
  sw_status (*keeps)(void *user, sw_system *system, const double *y, int *out, sw_error *err);
  /* The system's delta solves the last eval's linearisation. Make it fit forces that depend on it
   * in other ways, by solving again with the factors that there are. */
  void (*refine)(void *user, sw_system *system);
  /* After an update y was reached by the solved delta: 1 = converged. */
  int (*settled)(void *user, sw_system *system, const double *y, const double *delta);
  /* A stage was solved, or an explicit method has evaluated: book the impulse. */
  void (*book)(void *user, const sw_booking *booking);
} sw_coupling;

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
  double *directors_rate;        /* and how fast they turn [1/s] */
  double *normals, *normals_now; /* the same: the wire's normals at the holds */
  double fastest_turn;           /* of a hold in this step so far [rad/s] */
  int still;                     /* 1: holds count as standing, whatever they follow (statics) */
  int rough;                  /* 1: the last update turned edges too far to be the stage's last */
  sw_hold_state *hold_states; /* (hold_count) at the last stage */
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
  /* (edges) axial strain and its rate; NULL when no force has axial dashpots [-], [1/s] */
  double *strain, *strain_rate;
  /* (edges) axial forces as read out, where they are not those of the state, and between stages,
   * before they go on to the step's end [N] */
  double *even, *between;
  double *turning; /* (SW_TURN_SIZE) */
  size_t span_count;
  size_t follow_size; /* of twist, turn and frames, if there is twist or a frame: else 0 */
  double *aside;      /* (follow_size) room for them */

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
  double time;        /* at the stage's end [s] */
  double hbar;        /* [s] */
  double inertia;     /* mass acts as so many times itself: of methods that take forces and
                         accelerations at different times; 0 is as 1 [-] */
  double first;       /* share of the step's first stage in xhat [-] */
  const double *xhat; /* (freedoms): velocity = (y - xhat)/hbar [m], [rad] */
  const double *vhat; /* (nodes x 3): acceleration = inertia (velocity - vhat)/hbar [m/s] */
  double *y;          /* out: positions [m] */
  double *v;          /* out: velocities [m/s] */
  double *a;          /* out: accelerations, or NULL [m/s2] */
  /* where there are axial dashpots (edges): strain rate = (strain - strain_past)/hbar; without
   * them, and in statics, NULL [-] */
  const double *strain_past;
  double *strain; /* in: a guess, out: of the solved stage [-] */
} sw_stage;

typedef struct sw_stage_report {
  int iterations;
  double rotation; /* of the last update [rad] */
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

/* While the coupling evaluates: stiffness between nodes i and j of a body with a web, of the
 * body's own numbers, i != j, row by row with i's rows [N/m]. They are an edge of its surface. */
void sw_body_couple(sw_body *body, size_t i, size_t j, const double K[9]);

/* Before a step: between which pairs of the body's own particles (count x 2) there may be
 * stiffness besides its web's in it. The matrix depends on these alone, not on earlier steps.
 * SW_ENOMEM leaves the old ones. */
sw_status sw_body_plan_pairs(sw_body *body, const uint32_t *pairs, size_t count);

/* Before a step: between which nodes there may be bridges in it, anew from begin_plan on, so
 * that the matrix is made for them and that its order does not depend on earlier steps. */
sw_status sw_system_begin_plan(sw_system *system);
sw_status sw_system_plan_bridge(sw_system *system, size_t i, size_t j);

/* Add what a term gives to its body's field. */
static inline sw_status sw_term_eval(const sw_term *term, sw_field *field, sw_error *err) {
  field->history = term->history;
  return term->cls->eval(term->args, field, err);
}

/* The state is accepted at this time and the fields are fresh (sw_system_refresh): bring the
 * histories up to it. */
void sw_system_commit(sw_system *system, double time);

/* What commit has found in a body's term; 1: there is something to tell. */
static inline int sw_term_news(const sw_term *term, sw_force_news *out) {
  return term->cls->news && term->history && term->cls->news(term->args, term->history, out);
}

/* Work dissipated by the forces with a history [J]; *any: there are such. */
double sw_system_dissipated(const sw_system *system, int *any);

/* A step begins at the state: frames start from there. */
void sw_system_begin_step(sw_system *system);

/* The state's frames were given: make them fit its tangents and measure their twist. */
void sw_system_measure_frames(sw_system *system, size_t body);

/* Bring a body's twist or frames up to its field's tangents. */
void sw_system_measure(sw_system *system, sw_body *body);

/* --- while the coupling refines a solution ----------------------------------- */

/* 1: the body's equations can be solved again by the factors that there are. */
int sw_body_solves_again(const sw_body *body);
/* By how much forces that are added change the solution: of the body's nodes (nodes x 3), zero
 * where held; in place. */
void sw_body_solve_again(const sw_body *body, double *more);
/* The solution delta (nodes x 3) is the last one. */
void sw_body_take_solution(sw_body *body, const double *delta);
/* The same of the bodies that bridges tie together: 1, they can be solved again; by how much forces
 * (of the system's nodes x 3) change the solution, those of other bodies to zero; the system's
 * delta is the last one. */
int sw_bridges_solves_again(const sw_system *system);
void sw_bridges_solve_again(sw_system *system, double *more);
void sw_bridges_take_solution(sw_system *system);
/* A force is added at a held node of the system's: its hold bears it. */
void sw_system_push_held(sw_system *system, size_t node, sw_vec force);

/* Solve an implicit stage. system->tension is read and updated. Statuses:
 * SW_OK, SW_ENOCONV, SW_ESINGULAR, SW_EDIVERGED, SW_ECALLBACK. */
sw_status sw_system_stage(sw_system *system, const sw_stage *stage, const sw_newton *newton,
                          sw_stage_report *report, sw_error *err);

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

/* The holds' present orientations (as last placed) go with the state's twist. */
void sw_system_take_turns(sw_system *system);

/* Bring every field's geometry up to the state (system->x). */
void sw_system_refresh(sw_system *system);

/* Set the axial forces to what the state's edge lengths give: for explicit
 * methods, which do not solve for them. */
void sw_system_axial_from_state(sw_system *system);

/* Force and moment about point that hold k puts on its wire, from the last
 * solved stage [N], [N m]. */
void sw_system_reaction(const sw_system *system, int hold, sw_vec point, sw_vec *force,
                        sw_vec *moment);
/* The same of all holds about their places, from the stage that was solved last; out: (holds). */
typedef struct sw_hold_load {
  sw_vec force, moment; /* [N], [N m] */
} sw_hold_load;
void sw_system_hold_loads(const sw_system *system, sw_hold_load *out);

/* What is kept from step to step of how a method sees wires that turn, for a unit acceleration
 * towards the centre: how far the velocity is from that of steady turning, now and a step ago [s];
 * the axial force of the last stage over what it should be, less one [-]. And of read-outs: 1 if
 * they are of `even` [-], how far `between` is behind the state [s]. */
enum {
  SW_TURN_LAG,
  SW_TURN_LAG_BEFORE,
  SW_TURN_EXCESS,
  SW_TURN_EVEN,
  SW_TURN_BEHIND,
  SW_TURN_SIZE
};

/* Axial forces of a body's edges or springs at the refreshed state, those of dashpots included
 * (sw_plan_axial) [N]. */
const double *sw_system_pull(const sw_system *system, const sw_body *body);
/* The same without dashpots' [N]. */
const double *sw_system_elastic(const sw_system *system, const sw_body *body);
/* Axial forces of edges or springs, (edges): tension and what dashpots add at these rates (NULL
 * where there are none) [N], [1/s], [N]. */
void sw_system_sum_pull(const sw_system *system, const double *tension, const double *rate,
                        double *out);

/* Add share times these, of wires that are lines [-]. */
void sw_system_add_pull(const sw_system *system, const double *tension, const double *rate,
                        double share, double *sum);

/* Read-outs of the state, after a step h, are between the first stage's forces (edges) and those
 * of the state now, with this share of the latter, which is how it was `behind` ago, and go on
 * from there as they changed in the last step, if that was evened out too [s], [N], [-], [s]. */
void sw_system_even_out(sw_system *system, double h, const double *first, double share,
                        double behind);

/* Read-outs are those of the state. */
void sw_system_uneven(sw_system *system);
/* And velocities are what they are said to be, of no method. */
void sw_system_forget_turning(sw_system *system);

/* The state has just been filled, or has come to rest: strains as its axial forces and lengths
 * have them, and their rates, which are zero then. */
void sw_system_strain_from_state(sw_system *system);
/* The velocities were given and are exact: rates of strain of a body as they have them. */
void sw_system_rate_from_velocity(sw_system *system, size_t body);

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

/* --- small motions about the state ------------------------------------------- */

/* Forces and stiffness at the state, velocities taken as zero and axial forces as
 * stored. What follows is valid until the next evaluation of any kind. Motions are
 * (unknowns) values; in those given, held nodes must be zero. */
sw_status sw_system_linearise(sw_system *system, double time, sw_error *err);

/* Forces that the particles of a body that is a mesh exert on each other at the state, on each
 * (particles x 3) [N]. */
sw_status sw_system_inner_forces(sw_system *system, size_t body, double *out, sw_error *err);

/* Small motions of a body that is a mesh, in a system that was linearised, by those of some of its
 * particles, whose flags are 1 (particles). Once only; fails as sw_blocks_factor. */
sw_status sw_system_fix_particles(sw_system *system, size_t body, const unsigned char *fixed);
/* Then, for any number of them: motion (particles x 3) is given for these particles and 0 for the
 * others, which follow so that nothing pushes them; push receives what does push [m], [N]. */
void sw_system_carry(const sw_system *system, size_t body, const unsigned char *fixed,
                     double *motion, double *push);

size_t sw_system_unknowns(const sw_system *system, size_t body);
size_t sw_system_free_unknowns(const sw_system *system, size_t body);
size_t sw_system_factor_size(const sw_system *system, size_t body); /* in doubles */

/* Forces that are out of balance, zero where held; (unknowns) [N]. */
void sw_system_residual(const sw_system *system, size_t body, double *out);
/* How far the nodes go in a motion: (nodes x 3) [m]. */
void sw_system_shifts(const sw_system *system, size_t body, const double *motion, double *out);
/* How much the stored axial forces differ from those after the motion, of the largest of
 * them, the wire's weight and its buckling force [-]. */
double sw_system_axial_error(const sw_system *system, size_t body, const double *motion);
/* Zero a motion's held unknowns. */
void sw_system_fix_held(const sw_system *system, size_t body, double *motion);

/* Factorise K - shift M; below receives how many eigenvalues of K x = lambda M x
 * are below the shift. Fails as sw_band3_factor. shift [rad2/s2] */
sw_status sw_system_factor(const sw_system *system, size_t body, double shift, double *factor,
                           size_t *below);
void sw_system_factor_solve(const sw_system *system, size_t body, const double *factor, double *x);
/* The largest diagonal term of K over that of M; work has a factor's size [rad2/s2]. */
double sw_system_stiffest(const sw_system *system, size_t body, double *work);

/* out = K motion, out = M motion */
void sw_system_stiffness_times(const sw_system *system, size_t body, const double *motion,
                               double *out);
void sw_system_mass_times(const sw_system *system, size_t body, const double *motion, double *out);

/* An evaluation of the body's terms begins: what they add to is zero, edges are measured. */
void sw_body_begin(sw_body *body);
/* out = stiffness that they added times d, held nodes like all others; both (nodes x 3). */
void sw_body_stiffness_times(sw_body *body, const double *d, double *out);

/* out = stiffness of a body's field times d, held nodes like all others; both
 * (nodes x 3). */
void sw_field_stiffness_times(const sw_field *field, const double *d, double *out);

#endif
