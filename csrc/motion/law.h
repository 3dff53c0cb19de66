/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inside the motion room: a law of motion and the input of its plan. */
#ifndef SW_MOTION_LAW_H
#define SW_MOTION_LAW_H

#include "motion/motion.h"

/* Between two neighbouring way-points. */
typedef struct sw_leg {
  double length; /* [m] */
  double angle;  /* of the turn [rad] */
  sw_vec w;      /* the turn, in the axes of the leg's start [rad] */
  double time;   /* given, or needed at the highest speeds [s] */
} sw_leg;

/* A plan's way-points with orientations worked out and legs measured. */
typedef struct sw_route {
  const char *name; /* for messages */
  size_t count;     /* way-points [-] */
  sw_vec *p;        /* positions [m] */
  sw_quat *q;       /* orientations [-] */
  double *t;        /* times; NAN = not given [s] */
  sw_leg *legs;     /* count - 1 */
  int timed;        /* every way-point has a time [-] */
  double length;    /* sum over the legs [m] */
  double angle;     /* sum over the legs [rad] */
} sw_route;

sw_status sw_route_build(const sw_motion_plan *plan, sw_route *route, sw_error *err);
void sw_route_free(sw_route *route);

/* Fill the legs' times: the given ones, or those at the plan's highest speeds;
 * for a duration those at 1 m/s (1 rad/s when nothing but turns is there). */
sw_status sw_route_time(const sw_motion_plan *plan, sw_route *route, sw_error *err);

/* Highest growth of the rate of progress (1 = at the legs' times) over count
 * legs that keeps both accelerations; INFINITY without a limit [1/s]. */
double sw_route_growth(const sw_motion_plan *plan, const sw_leg *legs, size_t count);

/* A stretch from rest to rest (or the whole path of a law that never rests).
 * Progress is counted in seconds at the highest speed. */
typedef struct sw_run {
  double t;     /* begin [s] */
  double time;  /* duration [s] */
  double span;  /* progress made [s] */
  double ramp;  /* time of speeding up, for laws that have one [s] */
  size_t first; /* segment [-] */
  size_t count; /* segments [-] */
} sw_run;

/* How progress grows over a run. */
typedef struct sw_profile {
  int rests; /* at both ends of a run [-] */
  /* Shortest time for span at a rate of at most 1 and a growth of at most growth. */
  double (*least_time)(double span, double growth);
  /* Prepare a run whose span and time are known; 0 when time is too short for growth. */
  int (*fit)(sw_run *run, double growth);
  /* Progress, its rate and the rate's growth at t in [0, run->time]. */
  void (*progress)(const sw_run *run, double t, double s[3]);
} sw_profile;

typedef struct sw_motion_law {
  const char *name;
  const sw_profile *profile; /* NULL: not a law of progress along legs */
  /* Fill motion's body, duration, length and start; NULL: not for way-points. */
  sw_status (*plan)(const struct sw_motion_law *law, const sw_motion_plan *plan, sw_route *route,
                    sw_motion *motion, sw_error *err);
  /* State at t in [0, duration], derivatives as seen from inside. */
  sw_status (*eval)(const sw_motion *motion, double t, sw_motion_state *out, sw_error *err);
  void (*destroy)(void *body);
} sw_motion_law;

/* What a motion was planned from, to be planned again from a file. */
typedef struct sw_motion_given {
  char name[SW_NAME_SIZE];
  sw_motion_plan plan; /* its law's name static, its points those below */
  sw_waypoint *points;
} sw_motion_given;

/* A view of the motion that still looks the same. NULL: out of memory. */
sw_motion *sw_motion_view(sw_motion *motion);

struct sw_motion {
  const sw_motion_law *law;
  long references;
  double start;    /* [s] */
  double duration; /* [s] */
  double length;   /* [m] */
  size_t count;    /* way-points [-] */
  int relative;
  void *body;             /* the law's own */
  sw_motion_given *given; /* of a law for way-points that is no view, else NULL */
  sw_motion *inner;       /* of a view: what is looked at, else NULL */
  sw_pose base;           /* of a view: what is displaced */
};

/* Shared by the laws of progress along legs (path.c). */
sw_status sw_path_plan(const sw_motion_law *law, const sw_motion_plan *plan, sw_route *route,
                       sw_motion *motion, sw_error *err);
sw_status sw_path_eval(const sw_motion *motion, double t, sw_motion_state *out, sw_error *err);
void sw_path_destroy(void *body);

#define X(name) extern const sw_motion_law sw_motion_law_##name;
#include "motion/list.def"
#undef X

#endif
