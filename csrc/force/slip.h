/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A bending hinge that slips or yields: a spring between the hinge's angle vector and the slipped
 * angle vector, which follows once the moment reaches a limit. Shared by plastic and stick_slip. */
#ifndef SW_FORCE_SLIP_H
#define SW_FORCE_SLIP_H

#include "base/vec.h"
#include "force/force.h"

/* The law of one hinge. */
typedef struct sw_slip_law {
  double k;      /* spring [N m] */
  double own;    /* k if this force is the whole spring; 0 if another force gives
                    1/2 k phi^2 and only the difference is added [N m] */
  double harden; /* kinematic hardening: moment per slipped angle [N m] */
  double limit;  /* moment at which it slips [N m] */
} sw_slip_law;

/* Memory of the hinge: the slipped angle vector, perpendicular to the tangent at that time (the
 * unit vector along t1 + t2; 0 = no state yet). */
typedef struct sw_slip_memory {
  sw_vec slipped; /* [rad] */
  sw_vec along;   /* [-] */
} sw_slip_memory;

/* Two edges (or a director and an edge) that meet at the hinge. */
typedef struct sw_slip_hinge {
  sw_vec t[2]; /* unit tangents [-] */
  double r[2]; /* 1 / edge length; 0 for a director [1/m] */
} sw_slip_hinge;

/* Potential of the step that starts at the memory, and its derivatives with respect to the edge
 * vectors. All members are set to zero first. */
typedef struct sw_slip_answer {
  double energy;      /* [J] */
  double elastic;     /* part that corrects the other force's energy [J] */
  sw_vec gradient[2]; /* [N] */
  double own[2][6];   /* upper half xx xy xz yy yz zz [N/m] */
  double next[9];     /* coupling of edge 0 and edge 1, row by row [N/m] */
} sw_slip_answer;

/* Evaluates one hinge. share below 1: slipping reduces the stiffness by this share only, which
 * keeps iterations from alternating between slipping and sticking. */
void sw_slip_eval(const sw_slip_law *law, const sw_slip_memory *memory, const sw_slip_hinge *hinge,
                  unsigned want, double share, sw_slip_answer *out);

/* Updates the memory after a step to this hinge; returns the work dissipated [J]. law NULL: nothing
 * slips, the memory only turns with the wire. */
double sw_slip_commit(const sw_slip_law *law, const sw_slip_hinge *hinge, sw_slip_memory *memory);

/* Returns v carried from tangent a to tangent b by the smallest rotation; a = 0: v as it is. */
sw_vec sw_slip_carry(sw_vec v, sw_vec a, sw_vec b);

#endif
