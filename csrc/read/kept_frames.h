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
  int closing; /* 1: of the end of a run, see sw_scene_close_frames */
} sw_frame;

/* Finds the size of the frame's block. Returns 0 if the block is larger than room, or its counts
 * are invalid. */
int sw_scene_frame_walk(const sw_frame *frame, size_t room, size_t *size);

/* Returns the memory that a frame takes [B]. */
double sw_frame_bytes(const sw_frame *frame);

/* Copies a frame; returns SW_ENOMEM if that fails, and then the copy has no data. */
sw_status sw_frame_copy(const sw_frame *from, sw_frame *to);
/* Copies all frames to an empty list. Returns SW_ENOMEM if that fails; then the list stays empty.
 */
sw_status sw_frames_copy(const sw_frames *from, sw_frames *to);
void sw_frames_free(sw_frames *frames);

/* Kinetic, elastic, gravity energy of the state [J]. */
void sw_scene_frame_energies(sw_scene *scene, double out[SW_FRAME_ENERGIES]);
sw_status sw_scene_store_frame(sw_scene *scene, sw_error *err);
/* Returns 1 if the last frame is that of a run's end, beside the equidistant ones. */
int sw_frames_closed(const sw_frames *frames);
/* Drops that frame: what follows has the frames of a run that did not end there. */
void sw_scene_reopen_frames(sw_scene *scene);
/* Adds a copy of such a frame. Returns SW_ENOMEM if that fails. */
sw_status sw_scene_reclose_frames(sw_scene *scene, const sw_frame *end);
/* Drops later frames when a snapshot is restored that had `count` frames, one in `stride`. */
void sw_scene_frames_back_to(sw_scene *scene, size_t count, size_t stride);
/* Fills in the values of n nodes of the wire, SW_FRAME_VALUES numbers each. */
void sw_scene_node_values(sw_scene *scene, size_t wire, size_t n, float *out);

/* Forces of obstacles on the particles of a body: across the surface (particles) and, unless NULL,
 * in total (particles x 3) [N]. */
void sw_strand_pressed(const sw_scene *scene, const sw_body *body, double *normal, double *force);

#endif
