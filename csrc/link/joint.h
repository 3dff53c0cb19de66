/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Joints: links that keep places of wires together. */
#ifndef SW_LINK_JOINT_H
#define SW_LINK_JOINT_H

#include "link/hold.h"
#include "link/link.h"
#include "state/tie.h"
#include "system/join.h"

typedef struct sw_joint_end {
  size_t wire;
  double s;      /* a node of its mesh [m] */
  double asked;  /* where it was asked for [m] */
  double scale;  /* the mesh's scale at that time [-] */
  sw_vec offset; /* from the first end's node to its own [m] */
  sw_vec rest;   /* the wire's direction there when made, see link/join.c [-] */
  /* The hold that keeps the wire from rolling there: its slot + 1, 0: none; its generation; the
   * joint's angle about the wire when that hold took it (watch/joint_roll.c) [rad]. */
  size_t kept_by;
  uint32_t kept_of;
  double roll;
  size_t stop; /* while built: number of the hold in the wire's plan that ends spans of twist there,
                  plus 1; 0: none */
} sw_joint_end;

typedef struct sw_joint {
  uint32_t generation;
  int alive, rigid;
  char name[SW_NAME_SIZE];
  const sw_link_class *cls;
  double slack, stiffness, strength; /* of a tie, see sw_join_args */
  double fate[SW_TIE_FATE];          /* see state/tie.h */
  size_t spring;                     /* of a tie: its number in the system while built */
  size_t count;
  sw_joint_end ends[SW_JOIN_ENDS];
  int evened;                 /* 1: the ends bear `bears`, not the forces of the state */
  sw_vec bears[SW_JOIN_ENDS]; /* last forces on the ends; kept for ties and while evened [N] */
} sw_joint;

/* Functions of a joint class. wires: the wires of its ends, in order. */
typedef struct sw_joint_acts {
  int apart;                  /* 1: its ends need not meet */
  const char *const *outputs; /* names of read's results, NULL-terminated, or NULL */
  /* wires is NULL when one of them is gone. */
  void (*read)(const sw_joint *joint, const sw_link_wire *wires, double *out);
  /* Measures the ends when the joint is made or a mesh has changed. */
  void (*measure)(sw_joint *joint, const sw_link_wire *wires);
  /* Adds the joint to the new system. SW_ENOMEM. */
  sw_status (*add)(sw_joint *joint, const sw_link_wire *wires);
  /* Force on end number k with nodes at x, and moment about the end's place [N], [N m]. */
  void (*force)(const sw_joint *joint, const sw_link_wire *wires, const double *x, size_t k,
                sw_vec *force, sw_vec *moment);
  /* Returns the pull with nodes at x; bears: the strength, 0 when broken, infinite when it cannot
   * break [N]. NULL: joints of this class do not break. */
  double (*pull)(const sw_joint *joint, const sw_system *system, const double *x, double *bears);
  /* With pull: how the joint swings while it is taut, with nodes at x and their velocities v. */
  sw_tie_swing (*swing)(const sw_joint *joint, const sw_system *system, const double *x,
                        const double *v);
  void (*breaks)(sw_joint *joint, sw_system *system);
} sw_joint_acts;

/* Returns the class for these arguments: a join when slack is NAN, else a tie. */
const sw_link_class *sw_joint_class(double slack);
/* Returns the node of an end in the system. */
uint32_t sw_joint_node(const sw_joint_end *end, const sw_link_wire *wire);

#endif
