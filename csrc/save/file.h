/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes as bytes of a file, and what a scene is made of. */
#ifndef SW_SAVE_FILE_H
#define SW_SAVE_FILE_H

#include "scene/scene.h"

/* The whole scene as bytes, which the caller writes to a file and frees with sw_free, with a note
 * of the caller's in it. Nothing changes. SW_EINVAL when a user's function moves something now or
 * is a force: it cannot leave the process. */
sw_status sw_scene_save(sw_scene *scene, const void *note, size_t note_size, unsigned char **out,
                        size_t *size, sw_error *err);
/* The note, within the bytes. SW_EFORMAT: they are not of a scene, damaged, cut off, of another
 * version; err tells which, as "it is ...". */
sw_status sw_saved_note(const void *bytes, size_t size, const void **note, size_t *note_size,
                        sw_error *err);
/* A new scene of them; on the same kind of machine it goes on with the same bits. */
sw_status sw_scene_load(const void *bytes, size_t size, sw_scene **out, sw_error *err);
/* Load it into an existing scene: objects that are in both keep their handles. The scene's
 * snapshots cannot be restored any more. On failure nothing changes. */
sw_status sw_scene_resume(sw_scene *scene, const void *bytes, size_t size, sw_error *err);

/* What the scene is made of, object by object: two that were made alike have the same sum,
 * wherever they are by now. */
typedef struct sw_scene_item {
  char kind[SW_NAME_SIZE], name[SW_NAME_SIZE]; /* "wire", "box", "force", ... */
  uint64_t sum;
} sw_scene_item;
size_t sw_scene_items(const sw_scene *scene);
sw_scene_item sw_scene_item_at(sw_scene *scene, size_t k);

#endif
