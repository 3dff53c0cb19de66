/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A wire of the scene, or an object of particles. */
#ifndef SW_SCENE_WIRE_H
#define SW_SCENE_WIRE_H

#include "link/hold.h"
#include "record/spun.h"
#include "record/wear.h"
#include "record/window.h"
#include "record/zone.h"
#include "scene/scene.h"
#include "scene/values.h"
#include "state/mesh.h"
#include "strand/strand.h"
#include "system/system.h"
#include "wire/wire.h"

/* A twisted stretch of wire while the scene is not built. */
typedef struct sw_twisted {
  double s1, s2; /* [m] */
  double twist;  /* total [rad] */
} sw_twisted;

/* The path a wire was drawn along, from which it can be meshed anew. */
typedef struct sw_drawing {
  double *points; /* (count x 3) [m] */
  size_t count;
  double length;        /* of the first mesh [m] */
  size_t segments;      /* of its last mesh */
  sw_vec normal;        /* of the section; NAN = not given [-] */
  int rest;             /* SW_REST_STRAIGHT, SW_REST_PATH */
  int rolls;            /* 1: it turns about itself with inertia */
  double rest_twist;    /* [rad/m] */
  double breaking_load; /* NAN = not known [N] */
  int breaking_flag;    /* see sw_wire_args */
} sw_drawing;

/* An end of a wire that an obstacle is pushed with, at the last accepted state. */
typedef struct sw_poke {
  int count, slid; /* states of this touch so far; 1: it slid in one of them [-] */
  int hard;        /* 1: this touch is a hard blow */
  double struck;   /* when the last hard blow began; 0: none [s] */
  double time;     /* [s] */
  double share;    /* its friction over the largest that it can bear [-] */
  double rate;     /* how fast that grew [1/s] */
  double bend;     /* and how fast this changed [1/s2] */
} sw_poke;

/* Tension that a wire loses because it is in another one, where its tension is largest. */
typedef struct sw_sunk {
  double most;           /* what it would have without this [N] */
  double bound;          /* largest upper bound of this so far [N] */
  double tension, taken; /* what it has and what it loses [N] */
  double depth;          /* [m] */
  double s, time;        /* where and when [m], [s] */
  size_t with;           /* the other wire's slot */
  int counts;            /* 1: it loses enough to be reported */
} sw_sunk;

typedef struct sw_scene_wire {
  uint32_t generation;
  size_t number; /* number in frames: bodies made before it [-] */
  char name[SW_NAME_SIZE];
  const sw_wire_class *cls;
  sw_beam beam;
  sw_mesh mesh;     /* authoritative while the scene is not built */
  sw_strand strand; /* mesh of particles, for models that are one; else without a web */
  sw_drawing drawing;
  sw_wire_extremes extremes;
  sw_window window; /* of the tension */
  sw_wear wear;     /* recorded while the scene records wear */
  sw_spun spun;     /* turns about its axis where it touches obstacles */
  sw_zone_watch zones;
  sw_poke pokes[2]; /* by its start and by its end */
  sw_twisted *twisted;
  size_t twisted_count;
  double blow;   /* its hardest blow of this run that was followed in parts [N] */
  double grown;  /* growth of its bend while it is pushed, as a logarithm, see step/buckle.c [-] */
  sw_sunk sunk;  /* of this run; not in files */
  int untwisted; /* 1: lies as drawn, without its unloaded twist; nothing has moved */
  int remade;    /* 1: has just become a mesh; nothing has moved since */
} sw_scene_wire;

/* Data kept of a body that was taken away. */
typedef struct sw_gone {
  uint32_t generation;
  int loose;     /* 1: it was an object of particles */
  size_t number; /* number in frames [-] */
  double radius; /* radius for drawing frames [m] */
  double time;   /* when it was taken away [s] */
  char name[SW_NAME_SIZE];
} sw_gone;

/* 1 if the body is an object of particles, in no order along a wire. It has no arc length, and its
 * mesh is a straight line of its size. */
static inline int sw_scene_is_loose(const sw_scene_wire *wire) {
  return wire->strand.web && !wire->strand.web->per_ring;
}

/* 1 if the wire is a mesh of particles, with sections along it. */
static inline int sw_scene_has_sections(const sw_scene_wire *wire) {
  return wire->strand.web && wire->strand.web->per_ring;
}

#endif
