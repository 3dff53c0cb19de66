/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Links of wires as the user makes and changes them: joins, holds; and obstacles. */
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

/* Join wires where they meet, at arc lengths of theirs, from now on. */
sw_status sw_scene_add_join(sw_scene *scene, const sw_join_args *args, const sw_join_end *ends,
                            size_t count, sw_handle *out, sw_error *err);
sw_status sw_scene_release_join(sw_scene *scene, sw_handle join, sw_error *err);
/* How many wires it joins [-]. */
size_t sw_scene_join_ends(const sw_scene *scene, sw_handle join);
/* Force and moment about its place that a living join puts on its end number k [N], [N m]. */
sw_status sw_scene_join_force(sw_scene *scene, sw_handle join, size_t k, sw_vec *force,
                              sw_vec *moment, sw_error *err);
/* The read-outs of its class, see link/joint.h. SW_EINVAL when it has none. */
sw_status sw_scene_read_join(sw_scene *scene, sw_handle join, const char *const **names,
                             double out[SW_LINK_OUTPUTS], sw_error *err);

/* --- holds ------------------------------------------------------------------ */

sw_status sw_scene_add_hold(sw_scene *scene, const sw_link_class *cls, sw_handle wire,
                            const sw_hold_args *args, sw_handle *out, sw_error *err);
sw_status sw_scene_release_hold(sw_scene *scene, sw_handle hold, sw_error *err);

/* Force and moment on the wire about the held point, or about *about [N, N m]. */
sw_status sw_scene_hold_force(sw_scene *scene, sw_handle hold, const sw_vec *about, sw_vec *force,
                              sw_vec *moment, sw_error *err);

/* What it is like now, by its class's rows; SW_EDEAD once it is released. */
sw_status sw_scene_hold_args(const sw_scene *scene, sw_handle hold, const sw_params **rows,
                             sw_hold_args *out, sw_error *err);
/* What may be changed of the arguments from now on. */
sw_status sw_scene_set_hold(sw_scene *scene, sw_handle hold, const sw_hold_args *args,
                            sw_error *err);
/* Names of the read-outs of its class, NULL-terminated, or NULL: it has none. */
sw_status sw_scene_hold_outputs(const sw_scene *scene, sw_handle hold, const char *const **names,
                                sw_error *err);
/* Read one read-out of its class; give it one of its orders (retains the motion), see link/hold.h.
 * SW_EINVAL when its class has none of that name. */
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
/* What it is like now, by its rows. */
sw_status sw_scene_obstacle_args(sw_scene *scene, sw_handle obstacle, sw_obstacle_args *out,
                                 sw_error *err);
/* Friction and restitution of the arguments from now on; touches keep what they remember. */
sw_status sw_scene_obstacle_set_surface(sw_scene *scene, sw_handle obstacle,
                                        const sw_obstacle_args *args, sw_error *err);
/* Total contact force and its moment about a point, on the obstacle [N, N m]. */
sw_status sw_scene_obstacle_force(sw_scene *scene, sw_handle obstacle, sw_vec about, sw_vec *force,
                                  sw_vec *moment, sw_error *err);
sw_status sw_scene_remove_obstacle(sw_scene *scene, sw_handle obstacle, sw_error *err);
/* The shape, still the scene's: retain it to keep it. */
sw_status sw_scene_obstacle_shape(sw_scene *scene, sw_handle obstacle, sw_shape **out,
                                  sw_error *err);

#endif
