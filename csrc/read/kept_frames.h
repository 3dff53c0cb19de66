/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Internals of frames: a frame of a run as the scene stores it. */
#ifndef SW_READ_KEPT_FRAMES_H
#define SW_READ_KEPT_FRAMES_H

#include "read/frames.h"
#include "scene/lists.h"
#include "system/system.h"

/* Size of a tool's block, and of a hold's or obstacle's [-]. */
enum { SW_FRAME_TOOL = SW_FRAME_BODY, SW_FRAME_HOLD = SW_FRAME_BODY + 1 };

typedef struct sw_frame {
  double time;                      /* [s] */
  double energy[SW_FRAME_ENERGIES]; /* [J] */
  float *data;                      /* one block, see frames.c */
  size_t size;                      /* of the block [-] */
  size_t wires, obstacles, holds, tools;
} sw_frame;

/* Finds the size of the frame's block. Returns 0 if the block is larger than room, or its counts
 * are invalid. */
int sw_scene_frame_walk(const sw_frame *frame, size_t room, size_t *size);

/* Copies all frames to an empty list. Returns SW_ENOMEM if that fails; then the list stays empty.
 */
sw_status sw_frames_copy(const sw_frames *from, sw_frames *to);
void sw_frames_free(sw_frames *frames);

/* Kinetic, elastic, gravity energy of the state [J]. */
void sw_scene_frame_energies(sw_scene *scene, double out[SW_FRAME_ENERGIES]);
sw_status sw_scene_store_frame(sw_scene *scene, sw_error *err);
/* Drops later frames when a snapshot is restored that had `count` frames, one in `stride`. */
void sw_scene_frames_back_to(sw_scene *scene, size_t count, size_t stride);
/* Fills in the values of n nodes of the wire, SW_FRAME_VALUES numbers each. */
void sw_scene_node_values(sw_scene *scene, size_t wire, size_t n, float *out);

/* Forces of obstacles on the particles of a body: across the surface (particles) and, unless NULL,
 * in total (particles x 3) [N]. */
void sw_strand_pressed(const sw_scene *scene, const sw_body *body, double *normal, double *force);

#endif
