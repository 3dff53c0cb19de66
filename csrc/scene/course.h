/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The course of a scene: what it remembers of its last steps for the next one. Steps write it (see
 * step/stages.def); the scene only says that it was changed. Of the scene's inside. */
#ifndef SW_SCENE_COURSE_H
#define SW_SCENE_COURSE_H

#include "integrate/integrate.h"

/* How the next step begins: with the state's accelerations; anew, because the scene was changed and
 * they are stale; anew from an equilibrium that was found and not changed since; or with them
 * although the system is new, because they fit its forces. */
enum { SW_GOES_ON = -1, SW_AS_BEFORE = 0, SW_ANEW = 1, SW_FROM_REST = 2 };

typedef struct sw_course {
  int next;        /* SW_AS_BEFORE, ...: how the next step begins */
  int has_stepper; /* 1: there is one, of the method */
  int jerks; /* the present step begins where a hold starts or stops at once, see step/restart.h */
  const sw_integrator *method; /* of stepper */
  sw_stepper stepper;
  double window; /* of the present or last run, see sw_run_args [s] */
  double span;   /* of the step that led here; 0: the state is an equilibrium [s] */
  /* a blow that began at blow_since, or a bundle that converges badly, is followed in parts of
   * blow_part until blow_until [s] */
  double blow_part, blow_since, blow_until;
  double snap; /* hardest pull of ties that went taut and were followed so [N] */
  double slap; /* the same of wires that struck each other [N] */
  double part; /* that a step of fixed size begins with; 0: it is tried whole [s] */
  double next_dt; /* of an adaptive run; 0 = not known [s] */
  size_t parts;   /* of steps of the run, since it was last asked whether they have collapsed [-] */
  double covered; /* steps that these make together [-] */
} sw_course;

/* 1: its method is explicit and has lumped masses. */
static inline int sw_course_lumps(const sw_course *course) {
  return course->has_stepper && !(course->method->flags & SW_INTEGRATOR_IMPLICIT);
}
/* The scene was changed, or its state jumped. */
static inline void sw_course_jump(sw_course *course) { course->next = SW_ANEW; }
/* It came to rest. */
static inline void sw_course_rest(sw_course *course) { course->next = SW_FROM_REST; }
static inline int sw_course_rests(const sw_course *course) { return course->next == SW_FROM_REST; }
/* It was changed, but goes on as if it were not. */
static inline void sw_course_go_on(sw_course *course) { course->next = SW_GOES_ON; }

#endif
