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
    uint32_t from, to; /* nodes at the ends of the arm */
    uint32_t node;     /* the node at the join: one of them, or the one between them */
    double k;          /* [N m] */
    sw_vec rest;       /* d [-] */
  } arms[SW_HUB_ARMS];
} sw_join_hub;

struct sw_joins {
  sw_join_spring *springs;
  size_t spring_count, spring_capacity;
  sw_join_hub *hubs;
  size_t hub_count, hub_capacity;
};

/* Adds a spring or hub and plans its bridges. SW_ENOMEM. */
sw_status sw_system_add_spring(sw_system *system, const sw_join_spring *spring);
sw_status sw_system_add_hub(sw_system *system, const sw_join_hub *hub);

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

/* Returns the moment of a hub on its arm at x, about any point [N m]. */
sw_vec sw_join_hub_moment(const sw_join_hub *hub, size_t arm, const double *x);
/* Returns the rotation of a hub at x since it was made. */
sw_quat sw_join_hub_turn(const sw_join_hub *hub, const double *x);
/* Returns the energy of the arms that are nodes from .. to - 1 of the system, at the state [J]. */
double sw_joins_bend_energy(const sw_system *system, size_t from, size_t to);

double sw_joins_energy(const sw_system *system); /* at the state [J] */

/* 1 if the edges from nodes one and two are, each along its wire, too near a join of their wires
 * for contact between them. */
int sw_joins_near(const sw_system *system, uint32_t one, uint32_t two);

void sw_joins_free(sw_system *system);

#endif
