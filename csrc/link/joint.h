/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Joints: links that keep places of wires at each other. */
#ifndef SW_LINK_JOINT_H
#define SW_LINK_JOINT_H

#include "link/hold.h"
#include "link/link.h"
#include "state/tie.h"
#include "system/join.h"

typedef struct sw_joint_end {
  size_t wire;
  double s;      /* a node of its mesh [m] */
  double asked;  /* where that was asked for [m] */
  double scale;  /* of the mesh then [-] */
  sw_vec offset; /* of its node from that of the first end [m] */
  sw_vec rest;   /* where the wire went there, see link/join.c [-] */
} sw_joint_end;

typedef struct sw_joint {
  uint32_t generation;
  int alive, rigid;
  char name[SW_NAME_SIZE];
  const sw_link_class *cls;
  double slack, stiffness, strength; /* of a tie, see sw_join_args */
  double fate[SW_TIE_FATE];          /* what became of it */
  size_t spring;                     /* of a tie: its number in the system, while built */
  size_t count;
  sw_joint_end ends[SW_JOIN_ENDS];
  int evened;                 /* 1: its ends bear these forces, not those of the state */
  sw_vec bears[SW_JOIN_ENDS]; /* last, of a tie or if they are others than those of the state [N] */
} sw_joint;

/* What a joint does; wires: those of its ends. */
typedef struct sw_joint_acts {
  int apart;                  /* 1: its ends need not meet */
  const char *const *outputs; /* names of what read gives, NULL-terminated, or NULL */
  /* wires: NULL when one of them is gone. */
  void (*read)(const sw_joint *joint, const sw_link_wire *wires, double *out);
  /* It begins, or meshes are others. */
  void (*measure)(sw_joint *joint, const sw_link_wire *wires);
  /* Into the new system. SW_ENOMEM. */
  sw_status (*add)(sw_joint *joint, const sw_link_wire *wires);
  /* Force on end number k with nodes at x and moment about its place [N], [N m]. */
  void (*force)(const sw_joint *joint, const sw_link_wire *wires, const double *x, size_t k,
                sw_vec *force, sw_vec *moment);
  /* Pull with nodes at x, what it bears: 0 when it is broken, infinite when it never is; NULL:
   * joints of this class do not break [N]. */
  double (*pull)(const sw_joint *joint, const sw_system *system, const double *x, double *bears);
  void (*breaks)(sw_joint *joint, sw_system *system);
} sw_joint_acts;

/* The class of joints with these arguments. */
const sw_link_class *sw_joint_class(double slack);
/* Node of an end in the system. */
uint32_t sw_joint_node(const sw_joint_end *end, const sw_link_wire *wire);

#endif
