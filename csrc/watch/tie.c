/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Breaks ties that are pulled beyond their strength: joints between wires, and forces with a
 * pull. */
#include <math.h>
#include <string.h>

#include "body/join.h"
#include "contact/contact.h"
#include "contact/jolt.h"
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

/* A tie at the scene's state. */
typedef struct tie {
  size_t joint;        /* its number, or */
  const sw_term *term; /* its force, on body number wires[0] */
  size_t wires[2];     /* those at its ends */
  double pull, bears;  /* its strength, above 0 [N] */
} tie;

/* Calls `visit` for each unbroken tie. */
static void each_tie(const sw_scene *s, void (*visit)(const sw_scene *, const tie *, void *),
                     void *user) {
  const sw_system *system = sw_scene_system(s);
  for (size_t k = 0; k < sw_scene_join_slots(s); k++) {
    if (!breakable(s, k)) continue;
    const sw_joint *j = sw_scene_join_in(s, k);
    tie t = {.joint = k, .wires = {j->ends[0].wire, j->ends[1].wire}};
    t.pull = pull_of_joint(s, k, system->x, &t.bears);
    if (t.bears > 0) visit(s, &t, user);
  }
  for (size_t b = 0; sw_scene_force_slots(s) && b < system->body_count; b++) {
    const sw_body *body = &system->bodies[b];
    SW_ITEMS(const sw_term, term, body->terms, body->term_count) {
      if (!term->cls->pull) continue;
      tie t = {.term = term, .wires = {b, b}};
      t.pull = pull_of(system, body, term, system->x, 0, &t.bears);
      if (t.bears > 0) visit(s, &t, user);
    }
  }
}

static void note_strength(const sw_scene *s SW_UNUSED, const tie *t, void *any) {
  if (isfinite(t->bears)) *(int *)any = 1;
}

int sw_scene_may_break(const sw_scene *s) {
  int any = 0;
  each_tie(s, note_strength, &any);
  return any;
}

static double pull_at(const sw_scene *s, const tie *t, const double *x) {
  const sw_system *system = sw_scene_system(s);
  double bears;
  return t->term ? pull_of(system, &system->bodies[t->wires[0]], t->term, x, 0, &bears)
                 : pull_of_joint(s, t->joint, x, &bears);
}

/* How a tie swings at the scene's state. */
static sw_tie_swing swing_of(const sw_scene *s, const tie *t) {
  const sw_system *system = sw_scene_system(s);
  if (!t->term) {
    const sw_joint *j = sw_scene_join_in(s, t->joint);
    return j->cls->joint->swing(j, system, system->x, system->v);
  }
  const sw_body *b = &system->bodies[t->wires[0]];
  sw_field at = b->field;
  at.x = system->x + 3 * b->first_node, at.v = system->v + 3 * b->first_node;
  return t->term->cls->swing(t->term->args, &at, t->term->history);
}

/* The smallest usual force of the wires that it pulls at [N]. */
static double usual_force(const sw_scene *s, const tie *t) {
  const sw_system *system = sw_scene_system(s);
  double usual = HUGE_VAL;
  for (size_t k = 0; k < 2; k++)
    usual = fmin(usual, sw_contact_usual_force(system, system->bodies[t->wires[k]].plan));
  return usual;
}

/* The pull at which a tie stops places that lengthen it at this rate: v sqrt(k m) [m/s], [N]. */
static double stop_of(const sw_tie_swing *w, double rate) {
  return isfinite(w->mass) ? fabs(rate) * sqrt(w->stiffness * w->mass) : 0.0;
}

/* A tie swings hard if this pull is above so many usual forces of a wire at it [-]. */
static const double HARD_SWING = 1.0;

static void find_swing(const sw_scene *s, const tie *t, void *time) {
  double *least = time;
  if (!(t->pull > 0)) return;
  const sw_tie_swing w = swing_of(s, t);
  if (stop_of(&w, w.rate) > HARD_SWING * usual_force(s, t))
    *least = fmin(*least, sqrt(w.mass / w.stiffness));
}

double sw_scene_ties_swing(const sw_scene *s) {
  double time = HUGE_VAL;
  each_tie(s, find_swing, &time);
  return time;
}

/* Notes a tie that is slack at the scene's state and taut in a stage of the last trial. Its blow
 * is compared with its own hardest pull so far: the hardest blow of the wire depends on the step,
 * and may be one on an obstacle or of another tie. */
static void note_snap(const sw_scene *s, const tie *t, void *found) {
  const sw_system *system = sw_scene_system(s);
  const sw_stepper *stepper = &sw_scene_course(s)->stepper;
  sw_snap *snap = found;
  double now = 0;
  for (size_t k = 0; k < stepper->used->stages && !(t->pull > 0); k++)
    now = fmax(now, pull_at(s, t, stepper->y[k]));
  if (!(now > 0)) return;
  const sw_tie_swing w = swing_of(s, t);
  const double usual = usual_force(s, t),
               fell = sw_norm(sw_load(system->gravity)) * stepper->trial_h;
  const double stop = stop_of(&w, fabs(w.rate) + fell);
  snap->any = 1;
  if (stop > HARD_SWING * usual) snap->time = fmin(snap->time, sqrt(w.mass / w.stiffness));
  /* a tie that goes taut late in the trial pulls little now */
  if (fmax(now, stop) > sw_contact_least_blow(usual, w.peak, snap->followed))
    snap->jolt = fmax(snap->jolt, now / usual);
}

int sw_scene_ties_snap(const sw_scene *s, int followed, sw_snap *snap) {
  *snap = (sw_snap){.followed = followed, .time = HUGE_VAL};
  if (sw_scene_course(s)->stepper.used) each_tie(s, note_snap, snap);
  return snap->any;
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
