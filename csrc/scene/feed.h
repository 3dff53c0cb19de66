/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Holds through which the wire slides. Shared by the files of this room only. */
#ifndef SW_SCENE_FEED_H
#define SW_SCENE_FEED_H

#include "scene/objects.h"
#include "scene/scene.h"
#include "state/mesh.h"
#include "system/system.h"

typedef struct sw_scene_hold sw_scene_hold;

/* A hold through which the wire slides. The length paid out at time t is fed + speed
 * (t - since) + motion's x at t - start + slip + slip_speed u + slip_growth u^2 / 2, with
 * u = t - slip_since. */
typedef struct sw_feed {
  int outward;         /* where paid-out wire goes: +1 along the arc length, -1 against it [-] */
  double label;        /* the mesh's arc length at the guide when nothing was fed [m] */
  double fed, since;   /* [m], [s] */
  double speed;        /* [m/s] */
  sw_motion *motion;   /* a given length to be fed, or NULL */
  double start;        /* [s] */
  double slip;         /* beyond what was asked for [m] */
  double slip_since;   /* [s] */
  double slip_speed;   /* [m/s] */
  double slip_growth;  /* of this step; between steps that of the last one [m/s2] */
  double slip_before;  /* slip_growth of the step before [m/s2] */
  double push, limit;  /* force on the wire, the largest one; NAN = none [N] */
  double slip_way;     /* sign of the force against which it slips; 0 = it does not [-] */
  double way_before;   /* that of the step before [-] */
  double tried[2];     /* slip_growths with too little force and with too much [m/s2] */
  double off[2];       /* how far their forces were off; NAN = not tried yet [N] */
  int last_side;       /* which of both was tried last [-] */
  double slope;        /* of the force over slip_growth, last found; 0 = not known [kg] */
  double spare[2];     /* length given to the edge before and after the guide when nodes came
                          and went, so that no axial force jumps [m] */
  double spare_fed[2]; /* fed at that time; the spare goes back to 0 over one edge's length [m] */
  double size;         /* edges beside the guide are made this long [m] */
  double drive;        /* force that moves the wire, outwards, last [N] */
  size_t node, number; /* in the wire's plan; among the system's holds; while built */
  sw_mesh shape;       /* the wire with its unloaded shape, if it has frames */
} sw_feed;

/* Which way wire goes that is paid out at arc length s of the mesh: see sw_feed. */
int sw_feed_outward(const sw_mesh *mesh, double s);
/* A new hold, its nodes in place, begins to feed. SW_ENOMEM. */
sw_status sw_feed_begin(sw_scene *scene, sw_scene_hold *hold, const sw_hold_args *args);
/* Length paid out at a time, its speed and acceleration. */
typedef struct sw_feed_now {
  double fed, speed, acceleration; /* [m], [m/s], [m/s2] */
} sw_feed_now;
sw_feed_now sw_feed_at(const sw_scene_hold *hold, double t);
/* What is left of the spare lengths when so much is fed [m]. */
void sw_feed_spare(const sw_feed *feed, double fed, double spare[2]);
/* Slide the wire to where it is at time t; adds its velocity to the hold's state. */
void sw_feed_place(sw_scene *scene, sw_scene_hold *hold, double t, sw_hold_state *state);
/* The scene's time is that of an accepted state: meshes and holds follow. */
void sw_feed_follow(sw_scene *scene);
/* Plans back to the meshes, before these are read. */
void sw_feed_undo(sw_scene *scene);
/* Unloaded place and frame of the node at the guide, for its present arc length. */
void sw_feed_shape(sw_scene *scene, sw_scene_hold *hold);
/* What the hold knows of the unloaded frame at arc length s of the mesh. */
void sw_feed_rest(sw_scene_hold *hold, double s);
/* The largest step up to h that nodes can follow [s]. */
double sw_feed_step(const sw_scene *scene, double h);
/* SW_ENOCONV: which feed goes faster than steps can follow, and why longer ones were refused. */
sw_status sw_feed_too_fast(const sw_scene *scene, const char *refused, sw_error *err);
/* Insert and remove nodes beside guides as a step to time t needs. changed: the system was
 * made anew. SW_EEMPTY: no wire left to draw in. */
sw_status sw_feed_make_room(sw_scene *scene, double t, int *changed, sw_error *err);
/* Force that moves the wire outwards, with nodes at x and the last reaction [N]. */
double sw_feed_drive(const sw_scene *scene, const sw_scene_hold *hold, const double *x);

/* Steps of feeds that yield to a force: begin one (0: there are none), correct the slips
 * after a trial (1: they were right), or put them back. */
int sw_slip_any(const sw_scene *scene);
int sw_slip_begin(sw_scene *scene);
int sw_slip_correct(sw_scene *scene, double h, int first);
void sw_slip_give_up(sw_scene *scene);

#endif
