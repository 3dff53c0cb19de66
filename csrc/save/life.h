/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Creation and deletion of a scene, and its snapshots. */
#ifndef SW_SAVE_LIFE_H
#define SW_SAVE_LIFE_H

#include "scene/scene.h"

typedef struct sw_scene_args {
  char name[SW_NAME_SIZE];
  sw_vec gravity; /* [m/s2] */
} sw_scene_args;

extern const sw_params sw_scene_params;
sw_status sw_scene_new(const sw_scene_args *args, sw_scene **out, sw_error *err);
void sw_scene_free(sw_scene *scene); /* NULL is allowed */
sw_status sw_scene_set_gravity(sw_scene *scene, sw_vec gravity, sw_error *err);

/* --- snapshots -------------------------------------------------------------- */

/* 0 if neither the scene nor a living snapshot of it will use the force again. */
int sw_scene_force_needed(const sw_scene *scene, sw_handle force);
/* Restoring removes objects made after the snapshot. Their handles are stale from then on, unless
 * another living snapshot still knows them. */
sw_status sw_scene_snapshot(sw_scene *scene, sw_snapshot **out, sw_error *err);
/* The snapshot keeps the scene's present frames, too. Else restoring it only drops later ones. */
sw_status sw_snapshot_keep_frames(sw_snapshot *snapshot, sw_error *err);
sw_status sw_scene_restore(sw_scene *scene, const sw_snapshot *snapshot, sw_error *err);
void sw_snapshot_free(sw_snapshot *snapshot);         /* NULL is allowed */
double sw_snapshot_time(const sw_snapshot *snapshot); /* [s] */
int sw_snapshot_busy(const sw_snapshot *snapshot);    /* being restored: do not free it */

#endif
