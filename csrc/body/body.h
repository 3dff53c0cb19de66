/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The class of a body: a line of nodes along an arc, or a web of particles. Its functions are the
 * differences between the two in building, holding and reading back. */
#ifndef SW_BODY_BODY_H
#define SW_BODY_BODY_H

#include "link/hold.h"
#include "scene/parts.h"
#include "scene/values.h"
#include "scene/wire.h"
#include "state/plan.h"
#include "system/system.h"

/* A body's state while the scene is not built; arrays of the body. */
typedef struct sw_body_state {
  size_t points;       /* nodes or particles [-] */
  const double *x, *v; /* (points x 3) [m], [m/s] */
  const double *a;     /* (points x 3) [m/s2] */
  const double *axial; /* (edges or springs) [N] */
  const double *rate;  /* (the same) rates of their strains, or NULL: not known [1/s] */
} sw_body_state;

typedef struct sw_body_class {
  const char *held; /* what holds grasp, for messages */
  double apart;     /* least wire between two holds, over the whole length [-] */

  /* Place. state: returns the body's arrays. plan: makes its plan, with the parts that holds make
   * rigid, held at places (count). take: takes its state out of the built system. SW_ENOMEM. */
  sw_body_state (*state)(const sw_scene_wire *wire);
  sw_status (*plan)(const sw_scene *scene, size_t wire, const sw_hold_place *places, size_t count,
                    sw_plan **out);
  sw_status (*take)(sw_scene *scene, size_t wire);

  /* Hold. widen: extends an interval to one that can be held [m]. */
  void (*widen)(const sw_mesh *mesh, double *s1, double *s2);
  /* place: finds a new hold's interval; nodes may move for it. fresh: 0 if it held the wire before
   * the wire's model changed, and stays where it is; a line then waits for sw_line_refine. grasp:
   * finds the nodes of the hold, and its pose. refine: makes enough edges between the hold and
   * others; NULL: place has done so. SW_ENOMEM. */
  sw_status (*place)(sw_scene *scene, sw_hold *hold, const sw_hold_args *args, int fresh);
  sw_status (*grasp)(const sw_scene_wire *wire, sw_hold *hold, const sw_hold_args *args);
  /* let_go: the hold ends, and the wire keeps its bends. NULL: nothing to do. SW_ENOMEM. */
  sw_status (*let_go)(sw_scene *scene, sw_hold *hold);
  sw_status (*refine)(const sw_scene *scene, const sw_hold *hold, sw_mesh *mesh);
  /* Adds the hold's nodes to the system's held nodes, each like `node`. */
  void (*add_held)(const sw_body *body, const sw_hold *hold, sw_held_node node, sw_system *system);

  /* Check: SW_EINVAL, naming both, when two holds hold the same node or particle. */
  sw_status (*check_holds)(const sw_scene *scene, size_t wire, sw_error *err);

  /* Carry over: finds the present nodes of the nodes at arc lengths s (count) of the previous
   * system, and the present segments, by their first nodes. Entries of nodes that are gone stay as
   * they are. */
  void (*carry_over)(const sw_body *body, const double *s, size_t count, size_t *new_node,
                     size_t *new_edge);

  /* Read, in the built scene. at: state at a place of the wire. middles: from all particles' values
   * (points x 3) those of the middle line's nodes (n x 3). arc: arc length of such a node [m]. */
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

/* The interval of a new hold, in the mesh's arc lengths. */
static inline void sw_body_interval(const sw_mesh *m, const sw_hold_args *a, double *s1,
                                    double *s2) {
  *s1 = sw_mesh_snap(m, a->s - 0.5 * a->width);
  *s2 = sw_mesh_snap(m, a->s + 0.5 * a->width);
}

/* State at a place of a line (line_at.c); see `at` above. */
void sw_line_at(const sw_scene *scene, const sw_scene_wire *wire, const sw_body *body, double s,
                sw_point_state *out);

/* Interpolates values of edges at a place, linearly between their middles, and beyond the first and
 * the last one. */
double sw_line_between_middles(const sw_plan *plan, const double *values, double s);

/* Makes enough edges between all holds of a line, which stay where they are (line.c). SW_ENOMEM. */
sw_status sw_line_refine(sw_scene *scene, size_t wire);

/* Puts the nodes of a hold at this pose to their held places, in a mesh with other nodes. */
void sw_line_put_held(const sw_hold *hold, sw_pose pose, sw_mesh *mesh);

/* Fails with SW_EINVAL: both hold the same. */
sw_status sw_scene_held_twice(const sw_scene *scene, const sw_hold *a, const sw_hold *b,
                              sw_error *err);

#endif
