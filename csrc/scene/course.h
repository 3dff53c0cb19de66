/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The course of a scene: values of its last steps for the next one. Steps write it (see
 * step/stages.def); the scene only reports its changes. */
#ifndef SW_SCENE_COURSE_H
#define SW_SCENE_COURSE_H

#include "integrate/integrate.h"

/* How the next step begins. SW_AS_BEFORE: with the state's accelerations. SW_ANEW: without, because
 * the scene was changed and they are stale. SW_FROM_REST: anew, from an equilibrium that was found
 * and not changed since. SW_SET_OFF: the same, but drives have got motions that begin now.
 * SW_GOES_ON: with the accelerations although the system is new, because they fit its forces. */
enum { SW_GOES_ON = -1, SW_AS_BEFORE = 0, SW_ANEW = 1, SW_FROM_REST = 2, SW_SET_OFF = 3 };

typedef struct sw_course {
  int next;        /* SW_AS_BEFORE, ...: how the next step begins */
  int has_stepper; /* 1: the stepper exists */
  int jerks;       /* 1: a drive starts or stops abruptly at the present step's start, see
                      step/restart.h; 2: its acceleration jumps there, see step/corner.h */
  int smooth;      /* 1: no velocity of a script's function jumps within the present step */
  const sw_integrator *method; /* of the stepper */
  sw_stepper stepper;
  double window; /* of the present or last run, see sw_run_args [s] */
  double span;   /* size of the last step; 0: the state is an equilibrium [s] */
  int means;     /* 1: the last step gave its mean tensions, which the raw peaks count */
  /* A blow that began at blow_since, or a bundle that converges badly, is followed in parts
   * (substeps) of blow_part until blow_until [s]. */
  double blow_part, blow_since, blow_until;
  double stop_until; /* parts are short until then, because a drive stopped at once [s] */
  double part;       /* part that a step of fixed size begins with; 0: it is tried whole [s] */
  double next_dt;    /* next step of an adaptive run; 0 = not known [s] */
  size_t parts;      /* parts taken since the last check for collapsed steps [-] */
  double covered;    /* steps covered by these parts [-] */
} sw_course;

/* 1 if the method is explicit and uses lumped masses. */
static inline int sw_course_lumps(const sw_course *course) {
  return course->has_stepper && !(course->method->flags & SW_INTEGRATOR_IMPLICIT);
}
/* Call when the scene was changed, or its state jumped. */
static inline void sw_course_jump(sw_course *course) { course->next = SW_ANEW; }
/* Call when the scene came to rest. */
static inline void sw_course_rest(sw_course *course) { course->next = SW_FROM_REST; }
static inline int sw_course_rests(const sw_course *course) { return course->next == SW_FROM_REST; }
/* 1 if the state is an equilibrium that was found, and only motions were changed since. */
static inline int sw_course_is_still(const sw_course *course) {
  return course->next == SW_FROM_REST || course->next == SW_SET_OFF;
}
/* Call when a drive has got another motion. */
static inline void sw_course_set_off(sw_course *course) {
  course->next = sw_course_is_still(course) ? SW_SET_OFF : SW_ANEW;
}
/* Call when the scene was changed, but the next step goes on as if it were not. */
static inline void sw_course_go_on(sw_course *course) { course->next = SW_GOES_ON; }

#endif
