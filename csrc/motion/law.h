/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Internals of csrc/motion: the interface of a law, and the input of its plan. */
#ifndef SW_MOTION_LAW_H
#define SW_MOTION_LAW_H

#include "motion/motion.h"

/* The way between two neighbouring way-points. */
typedef struct sw_leg {
  double length; /* [m] */
  double angle;  /* of the turn [rad] */
  sw_vec w;      /* the turn, in the axes at the leg's start [rad] */
  double time;   /* given, or needed at the highest speeds [s] */
} sw_leg;

/* A plan's way-points, with all orientations found and all legs measured. */
typedef struct sw_route {
  const char *name; /* for messages */
  size_t count;     /* way-points [-] */
  sw_vec *p;        /* positions [m] */
  sw_quat *q;       /* orientations [-] */
  double *t;        /* times; NAN = not given [s] */
  sw_leg *legs;     /* count - 1 */
  int timed;        /* 1: every way-point has a time [-] */
  double length;    /* sum over the legs [m] */
  double angle;     /* sum over the legs [rad] */
} sw_route;

sw_status sw_route_build(const sw_motion_plan *plan, sw_route *route, sw_error *err);
void sw_route_free(sw_route *route);

/* Sets the legs' times: the given ones, or those at the plan's highest speeds; for a given duration
 * those at 1 m/s (at 1 rad/s if there are only turns). */
sw_status sw_route_time(const sw_motion_plan *plan, sw_route *route, sw_error *err);

/* Returns the highest rate of change of the rate of progress (1 = at the legs' times) over count
 * legs that keeps both accelerations; INFINITY without a limit [1/s]. */
double sw_route_growth(const sw_motion_plan *plan, const sw_leg *legs, size_t count);

/* A stretch from rest to rest, or the whole path of a law that never rests. Progress is measured in
 * seconds at the highest speed. */
typedef struct sw_run {
  double t;     /* begin [s] */
  double time;  /* duration [s] */
  double span;  /* progress over the whole run [s] */
  double ramp;  /* duration of the acceleration, for laws that have one [s] */
  size_t first; /* segment [-] */
  size_t count; /* segments [-] */
} sw_run;

/* How progress grows with time in a run. */
typedef struct sw_profile {
  int rests; /* 1: at rest at both ends of a run [-] */
  /* Returns the shortest time for a span at a rate of at most 1 that changes by at most growth. */
  double (*least_time)(double span, double growth);
  /* Prepares a run with known span and time. Returns 0 if time is too short for growth. */
  int (*fit)(sw_run *run, double growth);
  /* Progress and its first two derivatives at t in [0, run->time]. */
  void (*progress)(const sw_run *run, double t, double s[3]);
} sw_profile;

typedef struct sw_motion_law {
  const char *name;
  const sw_profile *profile; /* NULL: the law has no progress along legs */
  /* Fills in the motion's body, duration and length. NULL: not for way-points. */
  sw_status (*plan)(const struct sw_motion_law *law, const sw_motion_plan *plan, sw_route *route,
                    sw_motion *motion, sw_error *err);
  /* State at t in [0, duration]; at 0 and duration with the one-sided derivatives of the motion. */
  sw_status (*eval)(const sw_motion *motion, double t, sw_motion_state *out, sw_error *err);
  void (*destroy)(void *body);
} sw_motion_law;

/* The input from which a motion was planned, kept to plan it again from a file. */
typedef struct sw_motion_given {
  char name[SW_NAME_SIZE];
  sw_motion_plan plan; /* law's name is static; points are those below */
  sw_waypoint *points;
} sw_motion_given;

/* Returns a view that so far equals the motion. NULL: out of memory. */
sw_motion *sw_motion_view(sw_motion *motion);

struct sw_motion {
  const sw_motion_law *law;
  long references;
  double start;    /* [s] */
  double duration; /* [s] */
  double length;   /* [m] */
  size_t count;    /* way-points [-] */
  int relative;
  int about;              /* 1: turns go about `centre` [-] */
  sw_vec centre;          /* at the start, see sw_motion_plan [m] */
  void *body;             /* the law's data */
  sw_motion_given *given; /* input of a law for way-points; NULL for views and callbacks */
  sw_motion *inner;       /* of a view: the motion behind it, else NULL */
  sw_pose base;           /* of a view: the displaced pose */
};

/* Shared by all laws with progress along legs (path_plan.c, path.c). */
sw_status sw_path_plan(const sw_motion_law *law, const sw_motion_plan *plan, sw_route *route,
                       sw_motion *motion, sw_error *err);
sw_status sw_path_eval(const sw_motion *motion, double t, sw_motion_state *out, sw_error *err);
void sw_path_destroy(void *body);

/* Pose of a user's function at time t, at rest before and after its time [s]. Of a view that of the
 * motion behind it. */
sw_status sw_callback_pose(const sw_motion *motion, double t, sw_pose *out, sw_error *err);
/* Moves the centre of three poses, a step apart, to the side of t if the velocity jumps between
 * them [s]. A jump at t counts as after it. */
sw_status sw_callback_beside(const sw_motion *motion, double t, double step, const sw_pose *three,
                             double *centre, sw_error *err);

#define X(name) extern const sw_motion_law sw_motion_law_##name;
#include "motion/list.def"
#undef X

#endif
