/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Holds: clamps, pins, grips, feeds. Shared by the files of this room only. */
#ifndef SW_SCENE_HOLD_H
#define SW_SCENE_HOLD_H

#include "scene/feed.h"
#include "scene/jaws.h"
#include "scene/log.h"
#include "scene/objects.h"

/* Is it driven into an obstacle? */
typedef struct sw_hold_watch {
  int looking;    /* 1: it has been looked at */
  int crashing;   /* 1: it is driven into one now */
  double looked;  /* when last [s] */
  double given;   /* how deep it was in one to begin with [m] */
  sw_crash crash; /* the last one, of no part; depth 0: none */
} sw_hold_watch;

/* What a hold bears up to each stage of a trial step, as its momentum adds up [N s], [N m s]. */
typedef struct sw_hold_sums {
  sw_vec force[SW_BOOK_STAGES], moment[SW_BOOK_STAGES];
  int last;  /* stage booked last */
  int known; /* 1: they are those of the step that led here */
} sw_hold_sums;

struct sw_scene_hold {
  uint32_t generation;
  int alive;
  char name[SW_NAME_SIZE];
  const sw_hold_class *cls;
  size_t wire;
  sw_hold_args args; /* as asked for */
  double scale;      /* of the wire's mesh when it was asked for [-] */
  uint32_t shape;    /* another number when s1 .. frame are others */
  int formed;        /* 1: between its ends the wire is as long without force as it lies */
  double s1, s2;     /* held interval, nodes of the mesh [m] */
  sw_drive drive;
  size_t count;           /* held places */
  double *s;              /* (count) arc lengths when taken hold of [m] */
  double *local;          /* (count x 3) in the hold's frame [m] */
  uint32_t *particle;     /* (count) which ones of a mesh; NULL on other wires */
  sw_vec director[2];     /* arriving, leaving; in the hold's frame [-] */
  sw_mesh_frame frame[2]; /* the wire's there, with directions as held; if it has frames */
  sw_clamp_give give[2];  /* likewise */
  sw_quat turn;           /* orientation that goes with the wire's twist, while not built */
  sw_feed feed;           /* of a class that feeds */
  sw_vec force, moment;   /* last, kept after release [N], [N m] */
  sw_hold_watch watch;
  sw_hold_sums sums; /* of the present step */
  sw_pose last_pose;
  sw_log log;
};

/* A stage was solved, see sw_coupling. */
void sw_hold_book(sw_scene *scene, const sw_booking *booking);
/* The step that led here had a jerk: what the hold bore in it is not what it bears at its end.
 * Means over it, about its place [N], [N m]. */
int sw_hold_jerked(const sw_scene *scene, const sw_scene_hold *hold, sw_vec *force, sw_vec *moment);
/* What is written beside a force: above 0 the time that it is the mean of, below 0 the step at whose
 * end it is the force [s]. */
double sw_hold_span(const sw_scene *scene, int mean);
/* Looks at a hold of the accepted state: is it driven into obstacles, does it push too hard? */
sw_status sw_hold_look_out(sw_scene *scene, sw_scene_hold *hold, sw_error *err);
/* 1: one was driven into an obstacle in the last step. */
int sw_hold_crashed(const sw_scene *scene);

sw_scene_hold *sw_scene_find_hold(const sw_scene *scene, sw_handle h, sw_error *err);
/* The same of a hold that has not been released. */
sw_scene_hold *sw_scene_living_hold(const sw_scene *s, sw_handle hold, sw_error *err);
/* Take hold of the redrawn mesh anew. The hold is not alive; those that are were there
 * before it. What drives it stays. SW_ENOMEM. */
sw_status sw_scene_retake_hold(sw_scene *scene, sw_scene_hold *hold);
/* Nodes for the wire's living holds in another mesh of the same length. SW_ENOMEM. */
sw_status sw_scene_make_places(const sw_scene *scene, size_t wire, sw_mesh *mesh);
/* Where and how a hold holds, into another slot that owns nothing. SW_ENOMEM. */
sw_status sw_scene_copy_shape(const sw_scene_hold *from, sw_scene_hold *to);

/* Take hold of a wire that has other nodes but lies as before; the hold's pose is known. It is
 * not alive; those that are have done so. SW_EINVAL when one of them is in the way; SW_ENOMEM. */
sw_status sw_scene_rehold(sw_scene *scene, sw_scene_hold *hold, sw_pose pose, sw_error *err);

/* SW_EINVAL, naming the hold that is in the way, when one between s1 and s2, rings of a mesh, is
 * on another living hold of the wire or too near it; what: who asks [m]. */
sw_status sw_scene_check_clear(const sw_scene *scene, size_t wire, const sw_scene_hold *self,
                               const char *what, double s1, double s2, sw_error *err);
/* SW_EINVAL, naming both, when two living holds hold the same node or particle. */
sw_status sw_scene_check_holds(const sw_scene *scene, sw_error *err);
void sw_scene_clear_hold(sw_scene_hold *hold);

#endif
