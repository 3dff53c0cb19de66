/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Motion laws: the pose of a moving frame (grip, clamp, obstacle) at time t, with its exact first
 * and second derivatives. Motions are immutable and reference-counted, so one motion may drive
 * several things.
 *
 * Legs join the way-points by straight lines and shortest turns. How they are travelled depends on
 * the law and on what is given:
 *
 *                  speed or duration                 a time per way-point
 *   linear         constant speed, corners jump      passes every way-point
 *   trapezoidal    at rest at both ends only         at rest at every one
 *   minimum-jerk   at rest at both ends only         at rest at every one
 *   spline         smooth curve, at rest at the ends, through every way-point
 *
 * Given speeds and accelerations are never exceeded along the path. The sideways acceleration in a
 * blended corner follows from speed and blend. */
#ifndef SW_MOTION_MOTION_H
#define SW_MOTION_MOTION_H

#include <stddef.h>

#include "base/status.h"
#include "base/tape.h"
#include "base/vec.h"

typedef struct sw_motion sw_motion;

typedef struct sw_motion_state {
  sw_pose pose; /* position [m] and orientation [-] */
  sw_vec v;     /* velocity of the frame's origin [m/s] */
  sw_vec a;     /* its acceleration [m/s2] */
  sw_vec omega; /* angular velocity, world axes [rad/s] */
  sw_vec alpha; /* angular acceleration, world axes [rad/s2] */
  sw_vec pivot; /* point of a step's moments: the origin; of a tool's parts its centre [m] */
} sw_motion_state;

typedef enum sw_facing {
  SW_FACING_KEPT,  /* as at the previous way-point; the first: unrotated */
  SW_FACING_GIVEN, /* to q by the shortest turn */
  SW_FACING_TURNED /* by turn from the previous way-point, any number of revolutions */
} sw_facing;

typedef struct sw_waypoint {
  sw_vec p;         /* position [m] */
  sw_facing facing; /* which of q and turn counts */
  sw_quat q;        /* orientation [-] */
  sw_vec turn;      /* axis times angle, world axes [rad] */
  double t;         /* time; NAN = not given [s] */
} sw_waypoint;

/* Input of a motion through way-points. NAN = not given. */
typedef struct sw_motion_plan {
  const char *name; /* for messages; NULL = "trajectory" */
  const char *law;  /* NULL: "spline" for three or more timed way-points, else "minimum-jerk" */
  const sw_waypoint *points;
  size_t count;         /* way-points [-] */
  sw_vec turn;          /* of the whole path, world axes; 0 = none [rad] */
  int about;            /* 1: relative; the moving object goes round `centre` as it turns [-] */
  sw_vec centre;        /* at the start; the way-points displace it, world axes [m] */
  double speed;         /* highest [m/s] */
  double angular_speed; /* highest [rad/s] */
  double acceleration;  /* highest along the path [m/s2] */
  double angular_acceleration; /* highest along the path [rad/s2] */
  double duration;             /* of the whole path, instead of speeds [s] */
  double blend;                /* distance from a corner at which its blend starts; NAN: a tenth of
                                * the shorter leg (linear: 0) [m] */
  int stop;                    /* rest at every way-point: 1 yes, 0 no, -1 where the path turns back
                                * by more than 120 deg and no blend is given [-] */
  double start;                /* start of the motion; added to the way-points' times [s] */
  int relative;                /* way-points are displacements; begins at displacement 0 [-] */
} sw_motion_plan;

/* Returns a plan with nothing given. */
sw_motion_plan sw_motion_plan_empty(void);

/* Plans a motion. SW_EINVAL with a text naming way-point, parameter, value and unit. */
sw_status sw_motion_create(const sw_motion_plan *plan, sw_motion **out, sw_error *err);

/* Pose at time t [s] after the start. */
typedef sw_status (*sw_motion_function)(void *user, double t, sw_pose *out, sw_error *err);

/* A motion given by a function, which is called for times in [0, duration] only (duration may be
 * INFINITY). Derivatives are symmetric differences over +-step [s]; near the ends, the parabola
 * through the three nearest times is used. release (NULL is allowed) is called with user when the
 * motion is freed, but not when its creation fails. */
typedef struct sw_motion_callback {
  sw_motion_function function;
  void *user;
  void (*release)(void *user);
  double step;     /* of the differences [s] */
  double duration; /* [s] */
  double start;    /* [s] */
  int relative;    /* poses are displacements [-] */
} sw_motion_callback;
sw_status sw_motion_create_callback(const sw_motion_callback *callback, sw_motion **out,
                                    sw_error *err);

/* The motion applied as a displacement of base, in world axes: position base.p +
 * p(t), orientation q(t) * base.q. Shares the way-points of motion. */
sw_status sw_motion_relative(sw_motion *motion, sw_pose base, sw_motion **out);

/* The same motion later by delay [s]. Shares the way-points of motion. */
sw_status sw_motion_shifted(sw_motion *motion, double delay, sw_motion **out);

/* Evaluates at time t [s]. Before the start and from the end on, the motion rests at its first and
 * last pose. Fails only when a user callback fails, when t is not a number, or for the end of an
 * endless motion. */
sw_status sw_motion_eval(const sw_motion *motion, double t, sw_motion_state *out, sw_error *err);

double sw_motion_start(const sw_motion *motion);         /* [s] */
double sw_motion_end(const sw_motion *motion);           /* start + duration [s] */
double sw_motion_duration(const sw_motion *motion);      /* [s]; INFINITY for an endless callback */
double sw_motion_length(const sw_motion *motion);        /* of the path; NAN for a callback [m] */
size_t sw_motion_count(const sw_motion *motion);         /* way-points; 0 for a callback [-] */
const char *sw_motion_law_name(const sw_motion *motion); /* "minimum-jerk", ... */
int sw_motion_is_relative(const sw_motion *motion); /* 1: sw_motion_relative must still place it */

/* Returns the name of law number i for way-points, NULL after the last. */
const char *sw_motion_law_at(size_t i);

int sw_motion_is_function(const sw_motion *motion); /* a user's function: cannot go on a tape */
/* Of a user's function, whose velocities are differences and do not jump. sw_motion_jump sets *at
 * to the first time after t, up to t + h, at which the velocity jumps (shortly before the jump);
 * HUGE_VAL: none [s]. sw_motion_jumps: 1 if it jumps at t, or nearer to it than h/128, where
 * sw_motion_jump leaves jumps out. */
sw_status sw_motion_smooth(const sw_motion *motion, double t, double h, int *smooth, sw_error *err);
sw_status sw_motion_jump(const sw_motion *motion, double t, double h, double *at, sw_error *err);
sw_status sw_motion_jumps(const sw_motion *motion, double t, double h, int *jumps, sw_error *err);
/* Of a user's function: sw_motion_corner sets *at to the time after t, up to h, at which its
 * acceleration jumps; left alone if there is none [s]. sw_motion_corners: *yes = 1 if it jumps at
 * t, within a difference step. */
sw_status sw_motion_corner(const sw_motion *motion, double t, double h, double *at, sw_error *err);
sw_status sw_motion_corners(const sw_motion *motion, double t, int *yes, sw_error *err);
double sw_motion_step(const sw_motion *motion); /* of a function's differences; else 0 [s] */
/* Writes or reads a motion or NULL. Reading plans it anew, which gives the same bits. */
void sw_tape_motion(sw_tape *tape, sw_motion **motion);

sw_motion *sw_motion_retain(sw_motion *motion); /* NULL gives NULL */
void sw_motion_release(sw_motion *motion);      /* NULL is allowed */

#endif
