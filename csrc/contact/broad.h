/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the obstacles near a place without checking all of them. */
#ifndef SW_CONTACT_BROAD_H
#define SW_CONTACT_BROAD_H

#include "base/status.h"
#include "contact/contact.h"
#include "shape/tree.h"

typedef struct sw_contact_at {
  sw_pose pose;
  sw_vec v, omega; /* [m/s], [rad/s] */
  sw_vec pivot;    /* point that moments refer to, see sw_motion_state [m] */
} sw_contact_at;

/* A group of obstacles with one tree. */
typedef struct sw_broad_group {
  sw_box_tree tree;
  int *member;      /* (count) their numbers, ascending */
  sw_bounds *boxes; /* (count) box that each may reach in the step */
  size_t count;
  int refits; /* refits of the tree since it was built [-] */
} sw_broad_group;

typedef struct sw_broad {
  size_t count; /* of obstacles */
  int *numbers; /* work space for the lists below */
  int *moves;   /* (count) 1: the obstacle may move by itself */
  int *mover;   /* (mover_count) numbers of the obstacles that may move */
  int *member;  /* (count) work space for the groups' members */
  int *aside;   /* (aside_count) obstacles in no tree, always checked */
  int *found;   /* (count) result of the last search */
  size_t mover_count, aside_count;
  sw_bounds *boxes;        /* (count) work space for the groups' boxes */
  sw_broad_group group[2]; /* 0: obstacles that stand still; 1: those that may move */
  int placed, sorted;      /* 1: standing obstacles are placed; every obstacle is in its group */
  double factor, omega; /* largest factor and speed of turning obstacles, see swept [-], [rad/s] */
  double turning_time;  /* step size for which these two hold [s] */
} sw_broad;

sw_status sw_broad_new(sw_broad *broad, size_t count); /* SW_ENOMEM */
void sw_broad_free(sw_broad *broad);

/* Call if any obstacle may have moved, or may move from now on. */
void sw_broad_forget(sw_broad *broad);
/* Sorts obstacles: moves() returns 1 for those that may move; the others stand still. */
void sw_broad_know(sw_broad *broad, const sw_contact *c, sw_contact_moves_function moves);

/* Places obstacles at time t: all of them if the standing ones are not placed yet, else only those
 * that may move. */
sw_status sw_broad_place(sw_contact *c, double t, sw_contact_at *out, sw_error *err);

/* Updates the boxes that obstacles may reach in the step. Obstacles must be placed at the step's
 * start. Returns SW_ENOMEM or SW_EINTR on failure. */
sw_status sw_broad_update(sw_contact *c);

/* Returns the obstacles within reach of the box, with their motion in the step added to the reach.
 * The list is in the order of obstacles and valid until the next search. Adds the number of checked
 * boxes to *looks. */
const int *sw_broad_near(sw_broad *broad, const sw_bounds *box, double reach, size_t *count,
                         size_t *looks);

/* Updates the boxes of obstacles that may move, as placed at the step's start. */
void sw_broad_bound_movers(sw_contact *c);
/* 1 if an obstacle has moved since the step's start. */
int sw_broad_moves(const sw_contact *c);
/* 1 if the obstacle may come within reach of the box in the step. */
int sw_broad_disturbs(const sw_contact *c, size_t o, const sw_bounds *box, double reach);

#endif
