/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A bending hinge that slips or yields: a spring between the hinge's angle
 * vector and one that follows when the moment reaches a limit. Shared by plastic
 * and stick_slip. */
#ifndef SW_FORCE_SLIP_H
#define SW_FORCE_SLIP_H

#include "base/vec.h"
#include "force/force.h"

/* Values of one hinge. */
typedef struct sw_slip_law {
  double k;      /* spring [N m] */
  double own;    /* k when the spring itself is meant; 0 when another force gives
                    1/2 k phi^2 and only the difference is [N m] */
  double harden; /* moment per slipped angle, kinematic [N m] */
  double limit;  /* moment at which it slips [N m] */
} sw_slip_law;

/* What the hinge remembers: the slipped angle vector, perpendicular to the
 * tangent it had then (the unit vector along t1 + t2; 0 = never seen). */
typedef struct sw_slip_memory {
  sw_vec slipped; /* [rad] */
  sw_vec along;   /* [-] */
} sw_slip_memory;

/* Two edges (or a director and an edge) that meet in the hinge. */
typedef struct sw_slip_hinge {
  sw_vec t[2]; /* unit tangents [-] */
  double r[2]; /* 1 / edge length; 0 for a director [1/m] */
} sw_slip_hinge;

/* Potential of the step from the memory, its derivatives with respect to the
 * edge vectors: all zero-filled first. */
typedef struct sw_slip_answer {
  double energy;      /* [J] */
  double elastic;     /* part of it that corrects the other force's [J] */
  sw_vec gradient[2]; /* [N] */
  double own[2][6];   /* upper half xx xy xz yy yz zz [N/m] */
  double next[9];     /* edge 0 with edge 1, row by row [N/m] */
} sw_slip_answer;

/* share below 1: the stiffness counts slipping by that much only, which keeps
 * iterations from going to and fro between slipping and not. */
void sw_slip_eval(const sw_slip_law *law, const sw_slip_memory *memory, const sw_slip_hinge *hinge,
                  unsigned want, double share, sw_slip_answer *out);

/* The memory after the step to this hinge; returns the work dissipated [J].
 * law NULL: nothing slips, the memory only turns with the wire. */
double sw_slip_commit(const sw_slip_law *law, const sw_slip_hinge *hinge, sw_slip_memory *memory);

/* v carried from tangent a to tangent b by the smallest rotation; a = 0: as it is. */
sw_vec sw_slip_carry(sw_vec v, sw_vec a, sw_vec b);

#endif
