/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The time in which a script's function reads a run that has ended. What it changed in the scene
 * would be read as part of that run, so sw_scene_editable refuses all changes meanwhile. */
#ifndef SW_SCENE_REVIEW_H
#define SW_SCENE_REVIEW_H

#include "scene/scene.h"

typedef struct sw_review sw_review;

/* The review that is under way, or NULL. */
sw_review **sw_scene_review(const sw_scene *scene);

/* what: whose function `of` it is; instead: what to read instead. Both are for the error. Reviews
 * may be one inside the other. */
sw_status sw_scene_begin_review(sw_scene *scene, const char *what, const char *instead,
                                sw_error *err);
/* Returns SW_EBUSY, with the error, if a change was refused since the review began. unlike: 1 if
 * something was asked for that only another model of a wire has. */
sw_status sw_scene_end_review(sw_scene *scene, int *unlike, sw_error *err);
/* For errors of read-outs that only another model of a wire has, such as widths of a rod's section.
 */
void sw_scene_asks_other_model(const sw_scene *scene);
/* For sw_scene_editable: SW_EBUSY while the scene is read. */
sw_status sw_scene_not_reviewed(const sw_scene *scene, sw_error *err);
/* As sw_scene_ready, for what leaves the state as it is: a review does not forbid it. */
sw_status sw_scene_measurable(const sw_scene *scene, sw_error *err);

#endif
