/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces on the wires of a scene. */
#ifndef SW_EDIT_FORCES_H
#define SW_EDIT_FORCES_H

#include "scene/scene.h"

/* Adds a force on one wire, or on all (handle of generation 0). args: the class's argument
 * struct. */
sw_status sw_scene_add_force(sw_scene *scene, const sw_force_class *cls, sw_handle wire,
                             const void *args, size_t args_size, sw_handle *out, sw_error *err);
sw_status sw_scene_remove_force(sw_scene *scene, sw_handle force, sw_error *err);
/* Gets the arguments as given or last set, SW_FORCE_ARGS_MAX bytes; sets others from now on. A
 * place on the wire stays as it is. */
sw_status sw_scene_force_args(const sw_scene *scene, sw_handle force, void *args, sw_error *err);
sw_status sw_scene_set_force(sw_scene *scene, sw_handle force, const void *args, sw_error *err);
/* Reads the outputs of the force's class on one wire, SW_FORCE_OUTPUTS_MAX at most. */
sw_status sw_scene_read_force(sw_scene *scene, sw_handle force, sw_handle wire, double *out,
                              sw_error *err);

/* Returns the class of a force, released or not; NULL when the scene does not know the force any
 * more. */
const sw_force_class *sw_scene_force_class(const sw_scene *scene, sw_handle force);
/* Sets the name that the force's events use. */
sw_status sw_scene_name_force(sw_scene *scene, sw_handle force, const char *name, sw_error *err);

#endif
