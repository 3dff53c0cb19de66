/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes as the bytes of a file, and fingerprints of a scene's objects. */
#ifndef SW_SAVE_FILE_H
#define SW_SAVE_FILE_H

#include "scene/scene.h"

/* Writes the whole scene, with a note of the caller's, as bytes. The caller writes them to a file
 * and frees them with sw_free. The scene does not change. SW_EINVAL when a user's function moves
 * something at present or is a force: a function cannot leave the process. */
sw_status sw_scene_save(sw_scene *scene, const void *note, size_t note_size, unsigned char **out,
                        size_t *size, sw_error *err);
/* Finds the note within the bytes. SW_EFORMAT: the bytes are not a scene, damaged, cut off, or of
 * another version; err says which, as "it is ...". */
sw_status sw_saved_note(const void *bytes, size_t size, const void **note, size_t *note_size,
                        sw_error *err);
/* Makes a new scene from the bytes; on the same kind of machine it goes on with the same bits. */
sw_status sw_scene_load(const void *bytes, size_t size, sw_scene **out, sw_error *err);
/* Loads the bytes into an existing scene: objects that are in both keep their handles. The scene's
 * snapshots can no longer be restored. On failure nothing changes. */
sw_status sw_scene_resume(sw_scene *scene, const void *bytes, size_t size, sw_error *err);

/* Fingerprints of the scene's objects. Objects that were made alike have the same sum, wherever
 * they are at present. */
typedef struct sw_scene_item {
  char kind[SW_NAME_SIZE], name[SW_NAME_SIZE]; /* "wire", "box", "force", ... */
  uint64_t sum;
} sw_scene_item;
size_t sw_scene_items(const sw_scene *scene);
sw_scene_item sw_scene_item_at(sw_scene *scene, size_t k);

#endif
