/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Links of wires as the user makes and changes them: joins and holds; also obstacles. */
#ifndef SW_EDIT_LINKS_H
#define SW_EDIT_LINKS_H

#include "link/link.h"
#include "motion/motion.h"
#include "scene/scene.h"
#include "shape/shape.h"

/* --- joins ------------------------------------------------------------------ */

typedef struct sw_join_end {
  sw_handle wire;
  double s; /* [m] */
} sw_join_end;

/* Joins wires where they meet, at these arc lengths, from now on. */
sw_status sw_scene_add_join(sw_scene *scene, const sw_join_args *args, const sw_join_end *ends,
                            size_t count, sw_handle *out, sw_error *err);
sw_status sw_scene_release_join(sw_scene *scene, sw_handle join, sw_error *err);
/* Returns how many wires it joins [-]. */
size_t sw_scene_join_ends(const sw_scene *scene, sw_handle join);
/* Returns force and moment (about its place) of a living join on its end number k [N], [N m]. */
sw_status sw_scene_join_force(sw_scene *scene, sw_handle join, size_t k, sw_vec *force,
                              sw_vec *moment, sw_error *err);
/* Reads the outputs of the join's class, see link/joint.h. SW_EINVAL when it has none. */
sw_status sw_scene_read_join(sw_scene *scene, sw_handle join, const char *const **names,
                             double out[SW_LINK_OUTPUTS], sw_error *err);

/* --- holds ------------------------------------------------------------------ */

sw_status sw_scene_add_hold(sw_scene *scene, const sw_link_class *cls, sw_handle wire,
                            const sw_hold_args *args, sw_handle *out, sw_error *err);
sw_status sw_scene_release_hold(sw_scene *scene, sw_handle hold, sw_error *err);

/* Returns force and moment on the wire about the held point, or about *about [N, N m]. */
sw_status sw_scene_hold_force(sw_scene *scene, sw_handle hold, const sw_vec *about, sw_vec *force,
                              sw_vec *moment, sw_error *err);

/* Gets the present arguments and the rows of the class; SW_EDEAD once the hold is released. */
sw_status sw_scene_hold_args(const sw_scene *scene, sw_handle hold, const sw_params **rows,
                             sw_hold_args *out, sw_error *err);
/* Sets those arguments that may change, from now on. */
sw_status sw_scene_set_hold(sw_scene *scene, sw_handle hold, const sw_hold_args *args,
                            sw_error *err);
/* Names of the outputs of the hold's class, NULL-terminated, or NULL: it has none. */
sw_status sw_scene_hold_outputs(const sw_scene *scene, sw_handle hold, const char *const **names,
                                sw_error *err);
/* Reads one output of the hold's class; gives it one of its orders (retains the motion), see
 * link/hold.h. SW_EINVAL when the class has none of that name. */
sw_status sw_scene_read_hold(sw_scene *scene, sw_handle hold, const char *name, double *out,
                             sw_error *err);
sw_status sw_scene_order_hold(sw_scene *scene, sw_handle hold, const char *name, double value,
                              sw_motion *motion, sw_error *err);

/* --- obstacles -------------------------------------------------------------- */

typedef struct sw_obstacle_args {
  char name[SW_NAME_SIZE];
  sw_vec at;          /* [m] */
  sw_quat rotation;   /* [-] */
  double friction;    /* Coulomb coefficient [-] */
  double kinetic;     /* kinetic friction; NAN = as friction [-] */
  double restitution; /* share of the approach speed kept in an impact [-] */
} sw_obstacle_args;
extern const sw_params sw_obstacle_params;

/* Retains the shape. */
sw_status sw_scene_add_obstacle(sw_scene *scene, sw_shape *shape, const sw_obstacle_args *args,
                                sw_handle *out, sw_error *err);
/* Gets the present arguments. */
sw_status sw_scene_obstacle_args(sw_scene *scene, sw_handle obstacle, sw_obstacle_args *out,
                                 sw_error *err);
/* Sets friction and restitution from now on; touches keep their memory. */
sw_status sw_scene_obstacle_set_surface(sw_scene *scene, sw_handle obstacle,
                                        const sw_obstacle_args *args, sw_error *err);
/* Returns the total contact force on the obstacle and its moment about a point [N, N m]. */
sw_status sw_scene_obstacle_force(sw_scene *scene, sw_handle obstacle, sw_vec about, sw_vec *force,
                                  sw_vec *moment, sw_error *err);
sw_status sw_scene_remove_obstacle(sw_scene *scene, sw_handle obstacle, sw_error *err);
/* Returns the shape; the scene owns it: retain it to keep it. */
sw_status sw_scene_obstacle_shape(sw_scene *scene, sw_handle obstacle, sw_shape **out,
                                  sw_error *err);

#endif
