/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces on the wires of a scene. */
#ifndef SW_EDIT_FORCES_H
#define SW_EDIT_FORCES_H

#include "scene/scene.h"

/* A force on one wire, or on all (handle of generation 0). args: the class's
 * argument struct. */
sw_status sw_scene_add_force(sw_scene *scene, const sw_force_class *cls, sw_handle wire,
                             const void *args, size_t args_size, sw_handle *out, sw_error *err);
sw_status sw_scene_remove_force(sw_scene *scene, sw_handle force, sw_error *err);
/* Its arguments as they were given or set last, SW_FORCE_ARGS_MAX bytes; other ones from now on. A
 * place on the wire stays what it is. */
sw_status sw_scene_force_args(const sw_scene *scene, sw_handle force, void *args, sw_error *err);
sw_status sw_scene_set_force(sw_scene *scene, sw_handle force, const void *args, sw_error *err);
/* Values of its class' outputs on one wire, SW_FORCE_OUTPUTS_MAX at most. */
sw_status sw_scene_read_force(sw_scene *scene, sw_handle force, sw_handle wire, double *out,
                              sw_error *err);

/* The class of a force, released or not; NULL when the scene does not know it any more. */
const sw_force_class *sw_scene_force_class(const sw_scene *scene, sw_handle force);
/* What its events call it. */
sw_status sw_scene_name_force(sw_scene *scene, sw_handle force, const char *name, sw_error *err);

#endif
