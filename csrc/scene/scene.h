/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The scene owns everything: wires, holds, obstacles, forces, time. It is edited between runs,
 * built into a system when something moves, and read. Handles (slot and generation) name objects; a
 * stale handle is detected. Not thread-safe; scenes are independent. */
#ifndef SW_SCENE_SCENE_H
#define SW_SCENE_SCENE_H

#include <stddef.h>
#include <stdint.h>

#include "base/extreme.h"
#include "base/param.h"
#include "base/status.h"
#include "base/vec.h"
#include "force/force.h"

typedef struct sw_scene sw_scene;
typedef struct sw_snapshot sw_snapshot;

typedef struct sw_handle {
  uint32_t slot, generation; /* generation 0 = no object */
} sw_handle;

const char *sw_scene_name(const sw_scene *scene);
double sw_scene_time(const sw_scene *scene); /* [s] */
sw_vec sw_scene_gravity(const sw_scene *scene);
/* 1 inside a step or a user's function of the scene, 2 inside an observer: every change is refused
 * with SW_EBUSY, and the scene must not be freed. */
int sw_scene_busy(const sw_scene *scene);

/* SW_EDIVERGED with the reason when the last run diverged: nothing may be read
 * until a snapshot is restored. */
sw_status sw_scene_readable(const sw_scene *scene, sw_error *err);

/* --- names ------------------------------------------------------------------ */

/* Kinds of objects. A body is a wire or an object of particles. */
typedef enum sw_kind {
  SW_OF_NONE,
  SW_OF_BODY,
  SW_OF_HOLD,
  SW_OF_OBSTACLE,
  SW_OF_TOOL,
  SW_OF_FORCE,
  SW_OF_JOIN
} sw_kind;

typedef struct sw_identity {
  const char *name; /* NULL: the scene does not know the object any more */
  const char *kind; /* "clamp", "box", "rod", ...; NULL for a body that was taken away */
  int alive;        /* 0 once released or taken away */
} sw_identity;
sw_identity sw_scene_identify(const sw_scene *scene, sw_kind kind, sw_handle object);
/* NULL when the body is not in the scene any more. */
const char *sw_scene_wire_name(const sw_scene *scene, sw_handle wire);

/* --- forces ----------------------------------------------------------------- */

/* SW_EBUSY from inside a step, a user's function or an observer, and in a review (review.h): the
 * scene must not be changed now. */
sw_status sw_scene_editable(const sw_scene *scene, sw_error *err);
/* The same, and SW_EDIVERGED when the state is meaningless: for changes that go on from the
 * state. */
sw_status sw_scene_ready(const sw_scene *scene, sw_error *err);
/* SW_EBUSY from inside a step or a function of time, when the solver uses the scene's fields. */
sw_status sw_scene_still(const sw_scene *scene, sw_error *err);

/* --- running ---------------------------------------------------------------- */

/* Returns the window of the last run, or the default [s]. */
double sw_scene_window(const sw_scene *scene);

/* Returns the handle with the body's present slot; a handle of no object when the body is gone. */
sw_handle sw_scene_body_now(const sw_scene *scene, sw_handle body);
/* Returns the body's number in frames, also of one that is gone; SIZE_MAX: not known [-]. */
size_t sw_scene_body_number(const sw_scene *scene, sw_handle body);
/* Returns the name of a body that was taken away, and the time [s]; NULL: it was not. */
const char *sw_scene_gone_name(const sw_scene *scene, sw_handle body, double *time);

#endif
