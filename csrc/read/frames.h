/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frames: data for pictures and players, stored at equidistant times of a run in 32-bit floats.
 * When all frames would exceed their memory, every second one is dropped, and further ones are
 * stored half as often. */
#ifndef SW_READ_FRAMES_H
#define SW_READ_FRAMES_H

#include "scene/scene.h"

size_t sw_scene_frames(const sw_scene *scene);
double sw_scene_frame_time(const sw_scene *scene, size_t frame);
sw_status sw_scene_clear_frames(sw_scene *scene, sw_error *err);

/* Sets the memory for all frames together from now on [B]. Three frames always stay. */
extern const double SW_FRAME_MEMORY;
sw_status sw_scene_keep_frames(sw_scene *scene, double memory, sw_error *err);
/* Returns the stride of the kept frames: 1, or a power of 2 after thinning [-]. */
size_t sw_scene_frames_thinned(const sw_scene *scene);

/* Adds a frame of a run's end, unless there are no frames or the last one is of this time. A run
 * that goes on drops it, and files do not keep it. SW_EBUSY inside a step. */
sw_status sw_scene_close_frames(sw_scene *scene, sw_error *err);
/* 1 if the last frame is such a one. */
int sw_scene_frames_closed(const sw_scene *scene);

/* Adds a frame of the present state after all others, for callers that drop it at once: dropping it
 * restores the frames as they were. SW_EBUSY inside a step. */
sw_status sw_scene_frame_now(sw_scene *scene, sw_error *err);
void sw_scene_drop_last_frame(sw_scene *scene);
/* Adds, for such callers too, a frame at time t [s] between two frames. added = 0: no frames are
 * before and after t, or a wire has another mesh in the later one. */
sw_status sw_scene_add_between(sw_scene *scene, double t, int *added, sw_error *err);

/* Returns the node positions of wire number w in that frame [m]; count = nodes, 0 if the wire had
 * been removed. NULL if it did not exist. */
const float *sw_scene_frame_wire(const sw_scene *scene, size_t frame, size_t w, size_t *count);
/* Values of each node in a frame. NULL for an object of particles, or if there are none. */
enum {
  SW_FRAME_TENSION,   /* [N] */
  SW_FRAME_CURVATURE, /* [1/m] */
  SW_FRAME_CONTACT,   /* sum of the sizes of normal forces of obstacles and other wires [N] */
  SW_FRAME_TWIST,     /* moment about the wire's axis [N m] */
  SW_FRAME_STRESS,    /* of the outermost fibre; NAN: E is unknown [Pa] */
  SW_FRAME_FORCE,     /* x, y, z of obstacles and other wires on it, with friction [N] */
  SW_FRAME_ARC = SW_FRAME_FORCE + 3, /* from the wire's start [m] */
  SW_FRAME_VALUES
};
const float *sw_scene_frame_values(const sw_scene *scene, size_t frame, size_t w, size_t *count);
/* Returns the surface of wire number w in that frame: `around` points for each section, with x y z
 * [m] and the force of obstacles across the surface [N]. NULL: it is no mesh of particles. */
enum { SW_FRAME_SURFACE = 4 };
const float *sw_scene_frame_surface(const sw_scene *scene, size_t frame, size_t w, size_t *count,
                                    size_t *around);
/* Number of wires and objects of particles ever made, removed ones included; radius of one, 0: it
 * has none [m]. */
size_t sw_scene_frame_wires(const sw_scene *scene);
double sw_scene_frame_radius(const sw_scene *scene, size_t w);
/* 1 if number w of the scene is an object of particles. */
int sw_scene_frame_is_loose(const sw_scene *scene, size_t w);

/* Data of obstacle, hold or gripper's tool number k in a frame: x y z [m], qw qx qy qz, force [N]
 * (of wires on an obstacle; of a hold or tool on wires). *there: 1 while the obstacle exists or the
 * hold holds. NULL: it did not exist. */
enum { SW_FRAME_POSE = 7, SW_FRAME_BODY = SW_FRAME_POSE + 3 };
typedef enum sw_frame_kind { SW_FRAME_OBSTACLES, SW_FRAME_HOLDS, SW_FRAME_TOOLS } sw_frame_kind;
const float *sw_scene_frame_body(const sw_scene *scene, size_t frame, sw_frame_kind kind, size_t k,
                                 int *there);
enum { SW_FRAME_ENERGIES = 3 }; /* kinetic, elastic, gravity [J] */
const double *sw_scene_frame_energy(const sw_scene *scene, size_t frame);

/* --- motion of wires, from the frames at or after a time [s] ---------------------------------- */

/* Motion of a wire: bounding box [m], largest shift of a node between two frames [m], largest sum
 * of its turns along its length [rad]. */
typedef struct sw_swept {
  double low[3], high[3], step, turning;
} sw_swept;
void sw_scene_frames_sweep(const sw_scene *scene, double start, size_t w, sw_swept *out);
/* Returns the largest acceleration of a node, from second differences with a stride of frames
 * [m/s2]; -1: there are too few frames. The frame at `start` is left out: its pose is not yet at
 * rest on the mesh. */
double sw_scene_frames_acceleration(const sw_scene *scene, double start, size_t w, size_t stride);
/* Limits of a search: it stops at a distance of `enough` or less, and ignores distances above
 * `most` [m]. straight: 1 if the wire does not bow beside its edges, as touches see it. */
typedef struct sw_apart_request {
  double enough, most;
  int straight;
} sw_apart_request;
/* Finds a lower bound of the distance between the axes of wires w and v [m]; out = most: they come
 * no nearer. If w = v: between places of the wire between which it turns by half a turn or more.
 * The bound allows for relative motion between frames and for the bow of the wire beside edges.
 * Places where the wires are joined are left out. */
sw_status sw_scene_frames_apart(const sw_scene *scene, double start, size_t w, size_t v,
                                const sw_apart_request *request, double *out, sw_error *err);
/* 1 if wire w stays in one plane, all forces on it lie in the plane, it has no twist, and holds and
 * tools turn only about the plane's normal. Friction does not twist such a wire. */
int sw_scene_frames_flat(const sw_scene *scene, double start, size_t w);

/* Largest change of wire w's tension in a frame by the lever of friction along it: 0 to 1 [-]. */
double sw_scene_frames_lever(const sw_scene *scene, double start, size_t w);

/* --- pressure on lines -------------------------------------------------------------------- */

/* span: places to leave out, middle and half length; 1.5 edges beside them are left out, too [m].
 * place: a node counts as pressed from this share of the frame's largest load [-]. */
typedef struct sw_press_request {
  double (*span)[2];
  size_t spans;
  double place;
} sw_press_request;
/* Pressure in a frame: the largest load, the largest load from both sides [N/m]; first and last
 * pressed node, number of nodes. */
typedef struct sw_press {
  double load, squeeze;
  size_t first, last, count;
} sw_press;
/* 0 if nothing presses on wire w in that frame. */
int sw_scene_frame_press(const sw_scene *scene, size_t frame, size_t w,
                         const sw_press_request *request, sw_press *out);

#endif
