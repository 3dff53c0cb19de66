/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A body of the scene is a line of nodes along an arc or a web of particles, and all that building,
 * holding and taking it back do otherwise for one than for the other is a member of this class.
 * Of the scene's inside. */
#ifndef SW_BODY_BODY_H
#define SW_BODY_BODY_H

#include "scene/parts.h"
#include "scene/values.h"
#include "scene/wire.h"
#include "state/plan.h"
#include "system/system.h"

/* Where a body is while the scene is not built; its own arrays. */
typedef struct sw_body_state {
  size_t points;       /* nodes or particles [-] */
  const double *x, *v; /* (points x 3) [m], [m/s] */
  const double *a;     /* (points x 3) [m/s2] */
  const double *axial; /* (edges or springs) [N] */
  const double *rate;  /* (the same) of their strains, or NULL: not known [1/s] */
} sw_body_state;

typedef struct sw_body_class {
  const char *held; /* what holds hold of it, for messages */
  double apart;     /* least wire between two holds, of the whole [-] */

  /* Place: its state; its plan with what holds form, held at places (count); after the system was
   * built, its state from there. SW_ENOMEM. */
  sw_body_state (*state)(const sw_scene_wire *wire);
  sw_status (*plan)(const sw_scene *scene, size_t wire, const sw_hold_place *places, size_t count,
                    sw_plan **out);
  sw_status (*take)(sw_scene *scene, size_t wire);

  /* Hold. An interval becomes one that can be held [m]. */
  void (*widen)(const sw_mesh *mesh, double *s1, double *s2);
  /* A new hold gets its interval, for which nodes may move; then what it holds and its pose; then
   * there is enough wire between it and others. SW_ENOMEM. */
  sw_status (*place)(sw_scene *scene, sw_hold *hold, const sw_hold_args *args);
  sw_status (*grasp)(const sw_scene_wire *wire, sw_hold *hold, const sw_hold_args *args);
  sw_status (*refine)(const sw_scene *scene, const sw_hold *hold, sw_mesh *mesh);
  /* What it holds joins the system's held nodes, each like this one. */
  void (*add_held)(const sw_body *body, const sw_hold *hold, sw_held_node node, sw_system *system);

  /* Check: SW_EINVAL, naming both, when two holds hold the same. */
  sw_status (*check_holds)(const sw_scene *scene, size_t wire, sw_error *err);

  /* Carry over: which nodes of the system those at arc lengths s (count) of the one before are now,
   * and segments, by their first nodes. What is no more is left as it is. */
  void (*carry_over)(const sw_body *body, const double *s, size_t count, size_t *new_node,
                     size_t *new_edge);

  /* Read, of the built scene: what a place on the wire is like; of all particles' values
   * (points x 3) those of the middle line's nodes (n x 3), and their arc lengths [m]. */
  void (*at)(const sw_scene *scene, const sw_scene_wire *wire, const sw_body *body, double s,
             sw_point_state *out);
  void (*middles)(const sw_plan *plan, const double *values, double *out);
  double (*arc)(const sw_scene_wire *wire, const sw_plan *plan, size_t node);
} sw_body_class;

extern const sw_body_class sw_body_line, sw_body_web;

static inline const sw_body_class *sw_body_class_of(const sw_scene_wire *wire) {
  return wire->strand.web ? &sw_body_web : &sw_body_line;
}

static inline sw_body_state sw_body_state_of(const sw_scene_wire *wire) {
  return sw_body_class_of(wire)->state(wire);
}

/* The interval that a hold wants, in the mesh's arc lengths. */
static inline void sw_body_interval(const sw_mesh *m, const sw_hold_args *a, double *s1,
                                    double *s2) {
  *s1 = sw_mesh_snap(m, a->s - 0.5 * a->width);
  *s2 = sw_mesh_snap(m, a->s + 0.5 * a->width);
}

/* What a place on a line is like: see at (measure.c). */
void sw_line_at(const sw_scene *scene, const sw_scene_wire *wire, const sw_body *body, double s,
                sw_point_state *out);

/* Both hold the same: SW_EINVAL. */
sw_status sw_scene_held_twice(const sw_scene *scene, const sw_hold *a, const sw_hold *b,
                              sw_error *err);

#endif
