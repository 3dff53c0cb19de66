/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One body of the system: a wire or an object of particles with the forces on it, and where its
 * values are in the system's arrays. */
#ifndef SW_SYSTEM_BODY_H
#define SW_SYSTEM_BODY_H

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
  size_t first_clamp, kept_clamps; /* of those with dashpots, in the system's strains; how many */
  double viscosity; /* dashpots in bending: their moment per rate of curvature [N m2 s] */
  sw_term *terms;
  size_t term_count;
  sw_field field;
  void *field_block;
  size_t first_span;  /* place of the plan's spans in the system's twist */
  int has_twist;      /* the wire resists twist and is held against it somewhere */
  double *twist_now;  /* (spans) at this evaluation [rad] */
  double *twist_rank; /* (nodes x 3) slope of the twist, held nodes included [rad/m]; both are work
                         space while the twist is measured */
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
  size_t web_couples; /* pairs of its particles in the matrix of the bridges */
  int web_replanned;  /* 1: it has other pairs than those listed */
  double *web_room;   /* (particles x 15) of a large one, for iterations; or NULL */
  int web_factored;   /* 1: this step has a factor that preconditions iterations */
  int web_slow;       /* 1: it did so too slowly in this step */
  int bridged;        /* its matrix is part of the bridges' (see system/bridge.h) */
  double pushed;      /* largest push for which buckling was checked [N] */
} sw_body;

/* Axial force of an edge or spring over its strain [N]. */
static inline double sw_body_axial(const sw_body *b, size_t e) {
  if (!b->plan->web) return b->EA;
  return b->plan->web->link[e].k * b->plan->web->link[e].rest;
}

/* Add a term to its body's field. */
static inline sw_status sw_term_eval(const sw_term *term, sw_field *field, sw_error *err) {
  field->history = term->history;
  return term->cls->eval(term->args, field, err);
}

/* News of a body's term after commit; 1: there are some. */
static inline int sw_term_news(const sw_term *term, sw_force_news *out) {
  return term->cls->news && term->history && term->cls->news(term->args, term->history, out);
}

/* An evaluation of the body's terms begins: the field is zero, edges are measured. */
void sw_body_begin(sw_body *body);

/* out = stiffness that they added times d, held nodes like all others; both (nodes x 3). */
void sw_body_stiffness_times(sw_body *body, const double *d, double *out);

/* While the coupling evaluates: stiffness between nodes i and j of a body with a web, in the body's
 * own numbers, i != j, row by row with i's rows [N/m]. They form an edge of its surface. */
void sw_body_couple(sw_body *body, size_t i, size_t j, const double K[9]);

/* Before a step: the pairs of the body's own particles (count x 2) that may get stiffness in it
 * besides the web's. The matrix depends on these alone, not on earlier steps. SW_ENOMEM leaves the
 * old ones. */
sw_status sw_body_plan_pairs(sw_body *body, const uint32_t *pairs, size_t count);

/* --- while the coupling refines a solution ----------------------------------- */

/* Change of the solution by added forces, of the body's nodes (nodes x 3), zero where held; in
 * place. */
void sw_body_solve_again(const sw_body *body, double *more);
/* delta (nodes x 3) becomes the last solution. */
void sw_body_take_solution(sw_body *body, const double *delta);

#endif
