/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Joins of wires: springs, which keep nodes together, and hubs, which keep directions of edges. */
#ifndef SW_SYSTEM_JOIN_H
#define SW_SYSTEM_JOIN_H

#include <stdint.h>

#include "system/system.h"

/* Keeps x_i - x_j at offset. Or a tie, with energy 1/2 k (|x_i - x_j| - slack)^2: pulls x_i and x_j
 * together if their distance exceeds slack. */
typedef struct sw_join_spring {
  uint32_t i, j; /* nodes */
  double k;      /* [N/m] */
  sw_vec offset; /* [m] */
  int tie;       /* 1: a tie */
  double slack;  /* [m] */
} sw_join_spring;

enum { SW_HUB_ARMS = 8 };

/* A rigid piece with wires fixed in it. Its arms have directions p and rest directions d; with the
 * best fitting rotation R its energy is sum k (1 - p . R d). */
typedef struct sw_join_hub {
  size_t count;
  struct sw_join_arm {
    uint32_t from, to;  /* nodes at the ends of the arm */
    uint32_t node;      /* the node at the join: one of them, or the one between them */
    double k;           /* [N m] */
    sw_vec rest;        /* d [-] */
    size_t stop;        /* of the wire's plan, which ends spans there: its hold, plus 1; or 0 */
    int along;          /* 1, or -1 for an arm against the first one */
    sw_vec before, now; /* director there at the state and at the last places [-] */
  } arms[SW_HUB_ARMS];
  int line;            /* 1: all arms are nearly in line */
  sw_quat before, now; /* its turn since it was made, at the state and at the last places; */
  sw_vec edge[2][SW_HUB_ARMS];               /* for these vectors of its arms [m] */
  size_t links[2 * SW_HUB_ARMS], link_count; /* the ends of spans there */
} sw_join_hub;

/* Returns the vector of an arm with nodes at x [m]. */
static inline sw_vec sw_join_edge(const struct sw_join_arm *arm, const double *x) {
  return sw_sub(sw_vec_at(x, arm->to), sw_vec_at(x, arm->from));
}

/* A span of twist that ends at one or two hubs. */
typedef struct sw_join_span {
  size_t body, span;
  size_t links[2], link_count;
  double compliance; /* of the wire [rad/N m] */
  size_t row;        /* in the equations of all bridged spans */
} sw_join_span;

/* One of these ends. */
typedef struct sw_join_link {
  size_t hub, arm;            /* the hub's arm of the span's own wire */
  size_t number;              /* of the span */
  const sw_clamp_hinge *end;  /* in the plan */
  double sign;                /* 1: the span ends there, -1: it begins there */
  sw_vec slope[SW_HUB_ARMS];  /* of its twist by the vectors of the hub's arms [rad/m] */
  size_t row[2][SW_HUB_ARMS]; /* of the arms' nodes in the bridges' matrix, see row_of */
} sw_join_link;

typedef struct sw_join_place {
  size_t hub, arm;
} sw_join_place;

struct sw_joins {
  sw_join_spring *springs;
  size_t spring_count, spring_capacity;
  sw_join_hub *hubs;
  size_t hub_count, hub_capacity;
  /* twist (system/join_twist.h) */
  sw_join_place *places; /* of the plans' stops */
  sw_join_link *links;
  size_t link_count, link_capacity;
  sw_join_span *twisted;
  size_t twisted_count, twisted_capacity; /* m */
  size_t *number;                         /* (spans) of all bodies: which of these, or SIZE_MAX */
  double *give;      /* (m x m) turn of the hubs against the arms by the spans' torques [rad/N m] */
  double *stiffness; /* (m x m) inverse of the spans' compliance and the give [N m] */
  double *change;    /* (2 x m) work space */
};

/* Adds a spring or hub and plans its bridges. SW_ENOMEM. */
sw_status sw_system_add_spring(sw_system *system, const sw_join_spring *spring);
sw_status sw_system_add_hub(sw_system *system, const sw_join_hub *hub);

/* After the last hub: lists the spans that end at hubs. SW_ENOMEM. */
sw_status sw_joins_link(sw_system *system);

/* Plans the bridges of all joins again. SW_ENOMEM. */
sw_status sw_joins_plan(sw_system *system);

/* Marks the bodies of all joins as coupled (system/part.h), except waiting ones. */
void sw_joins_mark(sw_system *system);
/* Wakes waiting bodies that are joined to awake ones (system/wait.h). Returns 1 if there were
 * any. */
int sw_joins_wake(sw_system *system);

/* Adds forces and stiffness at y to the bodies' fields and to the bridges. SW_ENOMEM. */
sw_status sw_joins_eval(sw_system *system, const double *y);

/* Returns the force of a spring on its node i at x [N]. */
sw_vec sw_join_spring_force(const sw_join_spring *spring, const double *x);

/* Returns the force of a tie on its node i at x, linearised about the places before the last update
 * [m], [N]. */
sw_vec sw_join_tie_expected(const sw_join_spring *tie, const double *x, const double *update);

/* Computes the moment of a hub on its arm at x, about any point: what bends the wire, and what
 * twists it, with the state's twist [N m]. */
void sw_join_hub_moment(const sw_system *system, const sw_join_hub *hub, size_t arm,
                        const double *x, sw_vec *bending, sw_vec *twisting);
/* Returns the rotation of a hub at x since it was made. */
sw_quat sw_join_hub_turn(const sw_join_hub *hub, const double *x);
/* Returns the director of an arm of a hub with this turn, at x. */
sw_vec sw_join_director(const sw_join_hub *hub, const struct sw_join_arm *arm, sw_quat turn,
                        const double *x);
/* Returns the arm at a stop of a plan, with its hub. */
const struct sw_join_arm *sw_join_arm_at(const sw_system *system, const sw_clamp_hinge *stop,
                                         const sw_join_hub **hub);
/* Returns the mean direction of a hub's arms that are in line. */
sw_vec sw_join_hub_mean(const sw_join_hub *hub, const double *x);
/* Returns the energy of the arms that are nodes from .. to - 1 of the system, at the state [J]. */
double sw_joins_bend_energy(const sw_system *system, size_t from, size_t to);

double sw_joins_energy(const sw_system *system); /* at the state [J] */

/* 1 if the edges from nodes one and two are, each along its wire, too near a join of their wires
 * for contact between them. */
int sw_joins_near(const sw_system *system, uint32_t one, uint32_t two);

/* Two nodes that a released join kept together. The wires lie in each other there until they have
 * come out. SW_ENOMEM. */
sw_status sw_system_add_parted(sw_system *system, uint32_t i, uint32_t j);
/* Number of pairs of nodes that released joins kept together and that are still in each other. */
size_t sw_joins_still_in(const sw_system *system);
/* The same as sw_joins_near for joins that were released. */
int sw_joins_were_near(const sw_system *system, uint32_t one, uint32_t two);

void sw_joins_free(sw_system *system);

#endif
