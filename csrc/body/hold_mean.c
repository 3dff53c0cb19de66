/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mean loads of holds over a step with a jerk, or after a jump of acceleration, whose start has
 * another force than the end of the step before. A hold that starts or stops abruptly gives its
 * wire an impulse. The stages' forces add up to this impulse as the stages add up to the velocity.
 * Each of these forces grows without bound as steps get shorter, and the force at the step's end
 * does not give the impulse. */
#include <math.h>

#include "body/hold.h"
#include "link/hold.h"
#include "scene/course.h"
#include "scene/parts.h"
#include "system/axial.h"
#include "system/system.h"

static sw_vec booked(const sw_booking *b, sw_vec now, sw_vec before, sw_vec first) {
  return sw_madd(sw_madd(sw_scale(now, b->own), before, b->start), first, b->first);
}

/* Impulses stay unknown for methods that use the step before: they would need its sums. */
void sw_hold_book(sw_scene *s, const sw_booking *b) {
  sw_system *system = sw_scene_system(s);
  sw_system_hold_loads(system, sw_scene_hold_loads(s));
  for (size_t k = 0; k < system->hold_count; k++) {
    sw_hold *h = sw_scene_held_by(s, k);
    sw_hold_sums *sums = &h->sums;
    const sw_hold_load *now = &sw_scene_hold_loads(s)[k];
    sums->force[b->stage] = booked(b, now->force, h->end_force, sums->force[0]);
    sums->moment[b->stage] = booked(b, now->moment, h->end_moment, sums->moment[0]);
    sums->last = b->stage;
    sums->known = b->before == 0;
  }
}

/* A step has a jerk if the force at its end differs from the mean over it by more than JERK of the
 * larger of both, and by more than SHARP of the wire's usual force [-]. */
static const double JERK = 0.05, SHARP = 0.1;

static double usual_force(const sw_scene *s, size_t wire) {
  sw_system *system = sw_scene_system(s);
  const sw_plan *p = system->bodies[wire].plan;
  const double weight = p->beam.mass * p->length * sw_norm(sw_load(system->gravity));
  return fmax(weight, p->beam.EI / (p->length * p->length));
}

/* A method whose only stage lies within the step rings after a jerk. Its forces count as values at
 * the steps' ends, whose mean over two steps is right. */
double sw_hold_span(const sw_scene *s, int mean) {
  sw_course *c = sw_scene_course(s);
  const int rings = c->has_stepper && (c->method->flags & SW_INTEGRATOR_ONWARDS);
  return mean && !rings ? c->span : -c->span;
}

/* 1 if a step `span` that ends with the force `end` had a jerk [s], [N]. Sets the means. */
static int jerked(const sw_scene *s, const sw_hold *h, double span, sw_vec end, sw_vec *force,
                  sw_vec *moment) {
  const sw_hold_sums *sums = &h->sums;
  if (!sums->known || !(span > 0)) return 0;
  const sw_vec mean = sw_scale(sums->force[sums->last], 1.0 / span);
  const double off = sw_norm(sw_sub(end, mean));
  const int sharp =
      off > JERK * fmax(sw_norm(end), sw_norm(mean)) && off > SHARP * usual_force(s, h->wire);
  if (!sharp && !sw_scene_course(s)->jerks) return 0;
  *force = mean;
  *moment = sw_scale(sums->moment[sums->last], 1.0 / span);
  return 1;
}

int sw_hold_jerked(const sw_scene *s, const sw_hold *h, sw_vec *force, sw_vec *moment) {
  return jerked(s, h, sw_scene_course(s)->span, h->force, force, moment);
}

void sw_hold_coming_load(const sw_scene *s, const sw_hold *h, double span, sw_vec *force,
                         sw_vec *moment) {
  const sw_system *system = sw_scene_system((sw_scene *)s);
  const int k = (int)h->number;
  const sw_vec point = system->hold_states[k].pose.p;
  const double *x = span > 0 ? sw_scene_course(s)->stepper.trial_x : system->x;
  sw_vec plain, plain_moment;
  sw_system_bears(system, k, x, point, force, moment);
  if (!(span > 0)) return;
  sw_system_reaction(system, k, point, &plain, &plain_moment);
  sw_system_hold_loads(system, sw_scene_hold_loads(s)); /* their arms are those of the trial */
  *force = sw_add(sw_scene_hold_loads(s)[k].force, sw_sub(*force, plain));
  *moment = sw_add(sw_scene_hold_loads(s)[k].moment, sw_sub(*moment, plain_moment));
  (void)jerked(s, h, span, *force, force, moment);
}
