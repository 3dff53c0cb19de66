/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Breaks ties that are pulled beyond their strength: joints between wires, and forces with a
 * pull. */
#include <math.h>
#include <string.h>

#include "body/join.h"
#include "contact/contact.h"
#include "link/joint.h"
#include "scene/course.h"
#include "scene/events.h"
#include "scene/lookup.h"
#include "scene/parts.h"
#include "system/system.h"
#include "watch/observe.h"

/* Returns the pull of a tie to a point with nodes at x; bears: its strength, 0 once it is broken
 * [N]. last = 1: x is the last stage's result, and the pull is evened with the first stage's. The
 * body's own field may still point to the places of an abandoned trial. */
static double pull_of(const sw_system *s, const sw_body *b, const sw_term *term, const double *x,
                      int last, double *bears) {
  sw_field at = b->field;
  at.x = x + 3 * b->first_node;
  at.first = s->first;
  at.first.x = last && s->first.x ? s->first.x + 3 * b->first_node : NULL;
  return term->cls->pull(term->args, &at, term->history, bears);
}

static int breakable(const sw_scene *s, size_t joint) {
  return sw_scene_join_in(s, joint)->alive && sw_scene_join_in(s, joint)->cls->joint->pull;
}

static double pull_of_joint(const sw_scene *s, size_t joint, const double *x, double *bears) {
  return sw_scene_join_in(s, joint)->cls->joint->pull(sw_scene_join_in(s, joint),
                                                      sw_scene_system(s), x, bears);
}

/* The same for a tie between wires, after the last stage. Some methods find pulls that balance a
 * rotation too large or too small (integrate/turning.h); this function corrects them. */
static double pull_now(const sw_scene *s, size_t joint, const double *x, double *bears) {
  const sw_system *system = sw_scene_system(s);
  const sw_vec now = {pull_of_joint(s, joint, x, bears), 0, 0};
  if (!system->first.x) return now.x;
  const sw_vec first = {pull_of_joint(s, joint, system->first.x, bears), 0, 0};
  return sw_even_force(&system->first, NULL, first, now).x;
}

/* Keeps the forces on the joint's ends; those of a tie at every step. */
static void keep_borne(const sw_scene *s, sw_joint *j) {
  const sw_system *system = sw_scene_system(s);
  const int tie = j->cls->joint->pull != NULL;
  sw_link_wire wires[SW_JOIN_ENDS];
  j->evened = system->first.x != NULL;
  if (!j->evened && !tie) {
    memset(j->bears, 0, sizeof j->bears);
    return;
  }
  sw_scene_joint_wires(s, j, wires);
  for (size_t k = 0; k < j->count; k++) {
    sw_vec moment = {0, 0, 0}, first = moment, now = moment;
    j->cls->joint->force(j, wires, system->x, k, &now, &moment);
    if (j->evened) j->cls->joint->force(j, wires, system->first.x, k, &first, &moment);
    j->bears[k] = sw_even_force(&system->first, NULL, first, now);
  }
}

static sw_status check_terms(const sw_system *s, const sw_body *b, const double *x, sw_error *err) {
  SW_ITEMS(const sw_term, term, b->terms, b->term_count) {
    if (!term->cls->pull) continue;
    double bears;
    const double pull = pull_of(s, b, term, x, 1, &bears);
    if (bears > 0 && sw_tie_breaks_early(pull, bears))
      return sw_fail(err, SW_ENOCONV, "a tie breaks within the step");
  }
  return SW_OK;
}

int sw_scene_may_break(const sw_scene *s) {
  sw_system *system = sw_scene_system(s);
  double bears = 0;
  for (size_t k = 0; k < sw_scene_join_slots(s); k++) {
    if (breakable(s, k)) pull_of_joint(s, k, system->x, &bears);
    if (bears > 0 && isfinite(bears)) return 1;
    bears = 0;
  }
  for (size_t b = 0; sw_scene_force_slots(s) && b < system->body_count; b++) {
    const sw_body *body = &system->bodies[b];
    SW_ITEMS(const sw_term, term, body->terms, body->term_count) {
      bears = 0;
      if (term->cls->pull) pull_of(system, body, term, system->x, 0, &bears);
      if (bears > 0 && isfinite(bears)) return 1;
    }
  }
  return 0;
}

sw_status sw_scene_check_ties(const sw_scene *s, const double *x, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  for (size_t k = 0; k < sw_scene_join_slots(s); k++) {
    double bears;
    if (!breakable(s, k)) continue;
    const double pull = pull_now(s, k, x, &bears);
    if (bears > 0 && sw_tie_breaks_early(pull, bears))
      return sw_fail(err, SW_ENOCONV, "tie '%s' breaks within the step",
                     sw_scene_join_in(s, k)->name);
  }
  for (size_t b = 0; sw_scene_force_slots(s) && b < system->body_count; b++)
    SW_TRY(check_terms(system, &system->bodies[b], x, err));
  return SW_OK;
}

/* Notes a tie that is slack at the scene's state and taut in a trial. before, now: its pulls [N];
 * wires: those at its ends. */
static int note_snap(const sw_scene *s, double before, double now, const size_t wires[2],
                     sw_snap *snap) {
  const sw_system *system = sw_scene_system(s);
  if (before > 0 || !(now > 0)) return 0;
  const int hardest = now > snap->pull;
  if (hardest) snap->pull = now;
  for (size_t k = 0; k < 2; k++) {
    if (hardest) snap->wires[k] = wires[k];
    const sw_plan *p = system->bodies[wires[k]].plan;
    if (!p->web) snap->jolt = fmax(snap->jolt, now / sw_contact_usual_force(system, p));
  }
  return 1;
}

static int joint_snaps(const sw_scene *s, size_t joint, const double *x, sw_snap *snap) {
  const sw_system *system = sw_scene_system(s);
  const sw_joint *j = sw_scene_join_in(s, joint);
  double bears;
  const double before = pull_of_joint(s, joint, system->x, &bears);
  const size_t wires[2] = {j->ends[0].wire, j->ends[1].wire};
  return note_snap(s, before, pull_of_joint(s, joint, x, &bears), wires, snap);
}

static int snap_at(const sw_scene *s, const double *x, sw_snap *snap) {
  const sw_system *system = sw_scene_system(s);
  int any = 0;
  double bears;
  for (size_t k = 0; k < sw_scene_join_slots(s); k++)
    if (breakable(s, k)) any |= joint_snaps(s, k, x, snap);
  for (size_t b = 0; sw_scene_force_slots(s) && b < system->body_count; b++) {
    const sw_body *body = &system->bodies[b];
    const size_t wires[2] = {b, b};
    SW_ITEMS(const sw_term, term, body->terms, body->term_count) {
      if (!term->cls->pull) continue;
      const double before = pull_of(system, body, term, system->x, 0, &bears);
      any |= note_snap(s, before, pull_of(system, body, term, x, 0, &bears), wires, snap);
    }
  }
  return any;
}

int sw_scene_ties_snap(const sw_scene *s, sw_snap *snap) {
  const sw_stepper *stepper = &sw_scene_course(s)->stepper;
  const size_t stages = stepper->used ? stepper->used->stages : 0;
  int any = 0;
  *snap = (sw_snap){.pull = 0};
  for (size_t k = 0; k < stages; k++) any |= snap_at(s, stepper->y[k], snap);
  return any;
}

/* Reports ties to points. They break when they follow the accepted state. */
static void tell_of_terms(sw_scene *s, size_t body) {
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[body];
  SW_ITEMS(const sw_term, term, b->terms, b->term_count) {
    double bears;
    if (!term->cls->pull) continue;
    const double pull = pull_of(system, b, term, system->x, 1, &bears);
    if (!(bears > 0 && pull > bears)) continue;
    sw_course_jump(sw_scene_course(s)); /* the accelerations still have its force */
    sw_scene_tell(s, "tie", sw_scene_wire_in(s, body)->name, NAN, pull,
                  "a tie of wire '%s' breaks at %.4g N; it bears %.4g N",
                  sw_scene_wire_in(s, body)->name, pull, bears);
  }
}

void sw_scene_watch_ties(sw_scene *s) {
  sw_system *system = sw_scene_system(s);
  for (size_t b = 0; sw_scene_force_slots(s) && b < system->body_count; b++) tell_of_terms(s, b);
  for (size_t k = 0; k < sw_scene_join_slots(s); k++) {
    sw_joint *j = sw_scene_join_in(s, k);
    double bears = 0;
    const double pull = breakable(s, k) ? pull_now(s, k, system->x, &bears) : 0.0;
    if (j->alive) keep_borne(s, j);
    if (!breakable(s, k)) continue;
    if (!sw_tie_suffers(pull, bears, sw_scene_time(s), j->fate)) continue;
    j->cls->joint->breaks(j, system);
    memset(j->bears, 0, sizeof j->bears);
    sw_course_jump(sw_scene_course(s));
    sw_scene_renumber(s);
    sw_scene_tell(s, "tie", j->name, NAN, pull, "tie '%s' breaks at %.4g N; it bears %.4g N",
                  j->name, pull, j->strength);
  }
}
