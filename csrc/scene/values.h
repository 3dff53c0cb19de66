/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values of a wire: at a place, largest values, rows of series. */
#ifndef SW_SCENE_VALUES_H
#define SW_SCENE_VALUES_H

#include "base/extreme.h"
#include "base/vec.h"

typedef struct sw_point_state {
  sw_vec position, tangent, velocity; /* [m], [-], [m/s] */
  sw_vec chord;     /* place on the chord of its edge, where ties and forces at points act [m] */
  double curvature; /* [1/m] */
  double tension, elastic;     /* axial force; the same without dashpots [N] */
  double twist_moment;         /* [N m] */
  double spin;                 /* about the tangent, of a wire that rolls [rad/s] */
  sw_vec across;               /* first material axis of the edge; 0 without frames [-] */
  double strain, least_strain; /* of the outermost fibres outside and inside the bend [-] */
} sw_point_state;

/* How sharp a bend is for the wire's edges. All are shares of its curvature [-]. */
typedef struct sw_sharpness {
  double uneven;     /* second difference of the curvature from node to node */
  double swings;     /* what the acceleration of nodes there makes of it */
  double more, less; /* how much more, or less, a wire at rest may be bent between its nodes */
  double round;      /* bend around the round obstacle that presses on it there; 0: none does */
} sw_sharpness;

/* The wire's largest values: at present, or since the last run or settle began. */
typedef struct sw_wire_extremes {
  sw_extreme curvature, tension, strain; /* [1/m], [N], outermost fibre [-] */
  sw_extreme folding;     /* of a section of springs; above 0 it has folded through itself [-] */
  sw_extreme ovalisation; /* of a mesh of particles; see sw_section_shape [-] */
  sw_extreme torsion;     /* M_t / GJ [rad/m] */
  sw_extreme raw;         /* tension of a single step; `tension` is that of means over the window
                             [N] */
  double raw_span;        /* size of that step; 0: it was an equilibrium [s] */
  sw_sharpness sharp;     /* where and when the curvature is largest */
} sw_wire_extremes;

/* One recorded row per step of a hold: time, force, moment, held point. */
enum {
  SW_LOG_TIME = 0,
  SW_LOG_FORCE = 1,
  SW_LOG_MOMENT = 4,
  SW_LOG_POINT = 7,
  SW_LOG_SPAN = 10,
  SW_LOG_SIZE
};

/* One recorded row per step of an obstacle: time, force on it. */
enum { SW_LOG_OBSTACLE_SIZE = 5 };

#endif
