/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frames: what pictures and players show, stored at even times of a run, in 32-bit floats. When
 * they would take more memory than they may, every second one goes, and from then on they are
 * stored half as often. */
#ifndef SW_READ_FRAMES_H
#define SW_READ_FRAMES_H

#include "scene/scene.h"

size_t sw_scene_frames(const sw_scene *scene);
double sw_scene_frame_time(const sw_scene *scene, size_t frame);
sw_status sw_scene_clear_frames(sw_scene *scene, sw_error *err);

/* Memory that they may take from now on, all together; three always stay [B]. */
extern const double SW_FRAME_MEMORY;
sw_status sw_scene_keep_frames(sw_scene *scene, double memory, sw_error *err);
/* One of how many is still there: 1, or a power of 2 once they were thinned [-]. */
size_t sw_scene_frames_thinned(const sw_scene *scene);

/* A frame of the state as it is, after all others, for who drops it at once: the memory of frames
 * is as it was then. From inside a step SW_EBUSY. */
sw_status sw_scene_frame_now(sw_scene *scene, sw_error *err);
void sw_scene_drop_last_frame(sw_scene *scene);

/* Node positions of wire number w in that frame [m]; count = nodes, 0 when it had been taken away.
 * NULL when the wire did not exist. */
const float *sw_scene_frame_wire(const sw_scene *scene, size_t frame, size_t w, size_t *count);
/* What a frame tells of each node. NULL: of an object of particles, or none. */
enum {
  SW_FRAME_TENSION,   /* [N] */
  SW_FRAME_CURVATURE, /* [1/m] */
  SW_FRAME_CONTACT,   /* forces of obstacles and other wires across it, sum of sizes [N] */
  SW_FRAME_TWIST,     /* moment about its axis [N m] */
  SW_FRAME_STRESS,    /* of the outermost fibre; NAN: E is not known [Pa] */
  SW_FRAME_FORCE,     /* of obstacles and other wires on it, with friction: x, y, z [N] */
  SW_FRAME_ARC = SW_FRAME_FORCE + 3, /* from the wire's start [m] */
  SW_FRAME_VALUES
};
const float *sw_scene_frame_values(const sw_scene *scene, size_t frame, size_t w, size_t *count);
/* The surface of wire number w in that frame: around points for each section, x y z and the
 * force of obstacles across it [m], [N] each. NULL: it is no mesh of particles. */
enum { SW_FRAME_SURFACE = 4 };
const float *sw_scene_frame_surface(const sw_scene *scene, size_t frame, size_t w, size_t *count,
                                    size_t *around);
/* How many wires and objects of particles were made, gone ones too; the radius of one, 0: it has
 * none [m]. */
size_t sw_scene_frame_wires(const sw_scene *scene);
double sw_scene_frame_radius(const sw_scene *scene, size_t w);
/* 1: number w of the scene is an object of particles, which the frame then lists. */
int sw_scene_frame_is_loose(const sw_scene *scene, size_t w);

/* What a frame tells of an obstacle, a hold or a gripper's tool: x y z [m], qw qx qy qz, force: of
 * wires on an obstacle, of a hold or tool on wires [N]; of the first two at last 1 while it is
 * there, or holds. NULL: it did not exist. */
enum { SW_FRAME_POSE = 7, SW_FRAME_BODY = SW_FRAME_POSE + 3 };
const float *sw_scene_frame_obstacle(const sw_scene *scene, size_t frame, size_t o, int *there);
const float *sw_scene_frame_hold(const sw_scene *scene, size_t frame, size_t h, int *held);
const float *sw_scene_frame_tool(const sw_scene *scene, size_t frame, size_t k);
enum { SW_FRAME_ENERGIES = 3 }; /* kinetic, elastic, gravity [J] */
const double *sw_scene_frame_energy(const sw_scene *scene, size_t frame);

/* --- how wires moved, by the frames from a time [s] on ------------------------------------ */

/* What a wire sweeps: the box, how far a node moves between two frames [m]; by how much it turns
 * along its length at most [rad]. */
typedef struct sw_swept {
  double low[3], high[3], step, turning;
} sw_swept;
void sw_scene_frames_sweep(const sw_scene *scene, double start, size_t w, sw_swept *out);
/* Largest acceleration of a node, by second differences over so many frames each [m/s2]; -1: there
 * are not as many. The frame at the start is left out: of poses it is not yet at rest on its mesh.
 */
double sw_scene_frames_acceleration(const sw_scene *scene, double start, size_t w, size_t stride);
/* What is no more than enough is not searched for better, nor what is more than most [m]. */
typedef struct sw_apart_request {
  double enough, most;
} sw_apart_request;
/* How near the axes of wires w and v come at least, or one to itself where it turns by more than
 * half a turn between two places: less what one moves against the other between frames, and what
 * bows beside the edges; not where they are joined [m]. Most: they come no nearer. */
sw_status sw_scene_frames_apart(const sw_scene *scene, double start, size_t w, size_t v,
                                const sw_apart_request *request, double *out, sw_error *err);
/* 1: wire w stays in one plane, all forces on it are in that, it has no twist, and no hold or tool
 * turns but about the plane's normal: friction does not twist it. */
int sw_scene_frames_flat(const sw_scene *scene, double start, size_t w);

/* --- how lines are pressed ---------------------------------------------------------------- */

/* Places that do not count: middle and half length, with an edge and a half beside [m]. place: of
 * the frame's largest load, from there a node is pressed [-]. */
typedef struct sw_press_request {
  double (*span)[2];
  size_t spans;
  double place;
} sw_press_request;
/* Of a frame: the largest load, and the largest from both sides [N/m]; the nodes between which the
 * line is pressed, of how many. */
typedef struct sw_press {
  double load, squeeze;
  size_t first, last, count;
} sw_press;
/* 0: nothing presses on wire w in that frame. */
int sw_scene_frame_press(const sw_scene *scene, size_t frame, size_t w,
                         const sw_press_request *request, sw_press *out);

#endif
