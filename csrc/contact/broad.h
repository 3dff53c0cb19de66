/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The obstacles near a place, without a look at all of them. */
#ifndef SW_CONTACT_BROAD_H
#define SW_CONTACT_BROAD_H

#include "base/status.h"
#include "contact/contact.h"
#include "shape/tree.h"

typedef struct sw_contact_at {
  sw_pose pose;
  sw_vec v, omega; /* [m/s], [rad/s] */
  sw_vec pivot;    /* what moments are about, see sw_motion_state [m] */
} sw_contact_at;

/* Obstacles with a tree of their own. */
typedef struct sw_broad_group {
  sw_box_tree tree;
  int *member;      /* (count) their numbers, ascending */
  sw_bounds *boxes; /* (count) that the step may reach */
  size_t count;
  int refits; /* of the tree since it was made [-] */
} sw_broad_group;

typedef struct sw_broad {
  size_t count; /* of obstacles */
  int *numbers; /* room for the lists below */
  int *moves;   /* (count) 1: it may go elsewhere by itself */
  int *mover;   /* (mover_count) those that do */
  int *member;  /* (count) room of the groups */
  int *aside;   /* (aside_count) those that are always looked at */
  int *found;   /* (count) of the last search */
  size_t mover_count, aside_count;
  sw_bounds *boxes;        /* (count) room of the groups */
  sw_broad_group group[2]; /* of the obstacles that stand, of those that may move */
  int placed, sorted;      /* 1: standing obstacles are placed, and each is in its group */
  double factor, omega;    /* of what turns, see swept [-], [rad/s] */
  double turning_time;     /* the step [s] */
} sw_broad;

sw_status sw_broad_new(sw_broad *broad, size_t count); /* SW_ENOMEM */
void sw_broad_free(sw_broad *broad);

/* Any obstacle may have moved, and may move. */
void sw_broad_forget(sw_broad *broad);
/* Only these may move, by the owner's numbers; the others stand where they are. */
void sw_broad_know(sw_broad *broad, const sw_contact *c, sw_contact_moves_function moves);

/* Place obstacles at time t: all if the standing ones are not placed yet, else those that may move.
 */
sw_status sw_broad_place(sw_contact *c, double t, sw_contact_at *out, sw_error *err);

/* With obstacles at the step's start: the boxes that the step may reach. SW_ENOMEM, SW_EINTR. */
sw_status sw_broad_update(sw_contact *c);

/* Obstacles within reach of the box from low to high, besides their own way; in their order, valid
 * until the next search. Adds the boxes looked at to *looks. */
const int *sw_broad_near(sw_broad *broad, sw_vec low, sw_vec high, double reach, size_t *count,
                         size_t *looks);

#endif
