/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keeps the ledger of a run's energy. A step is opened before it is tried and closed once it is
 * accepted. */
#include <math.h>
#include <string.h>

#include "body/touching.h"
#include "read/extremes.h"
#include "scene/course.h"
#include "scene/events.h"
#include "scene/ledger.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "step/energy.h"
#include "step/outer.h"
#include "step/step.h"
#include "system/join.h"
#include "system/system.h"
#include "system/wait.h"
#include "watch/observe.h"

/* Energy gained by steps over the energy in play: above REMARK an event, above FAILURE the run
 * fails [-]. */
static const double REMARK = 0.02, FAILURE = 0.05;
/* Energy that appeared outside steps, over the energy in play: above this an event [-]. */
static const double UNKNOWN = 0.05;

/* Work below this share of an excess of losses cannot explain it; nor can work that is known
 * exactly
 * [-]. */
static const double LITTLE_WORK = 0.01;

/* A held point further than this from its hold was moved by the script; less is rounding [m]. */
static const double JUMP = 1e-9;
/* Least energy in play: the weight times the radius, or this share of EI / L [-], plus LEAST. */
static const double LEAST_BENDING = 1e-6;
static const double LEAST = 1e-12; /* [J] */

void sw_ledger_begin_run(sw_scene *s) {
  sw_books *b = sw_scene_books(s);
  sw_log log = b->log;
  log.count = 0;
  *b = (sw_books){.holds = b->holds,
                  .obstacles = b->obstacles,
                  .log = log,
                  .hold_room = b->hold_room,
                  .obstacle_room = b->obstacle_room};
}

void sw_ledger_forget(sw_scene *s) { sw_scene_books(s)->known = 0; }

static void weigh(sw_scene *s) {
  sw_system *system = sw_scene_system(s);
  sw_books *b = sw_scene_books(s);
  b->weight = b->bending = b->mass = b->longest = 0;
  for (size_t k = 0; k < system->body_count; k++) {
    const sw_plan *p = system->bodies[k].plan;
    const double mg = p->beam.mass * p->length * sw_norm(sw_scene_gravity(s));
    b->longest = fmax(b->longest, p->length);
    if (isfinite(p->beam.mass * p->length)) b->mass += p->beam.mass * p->length;
    if (isfinite(mg * p->beam.radius)) b->weight += mg * p->beam.radius;
    if (p->length > 0 && isfinite(p->beam.EI)) b->bending += p->beam.EI / p->length;
  }
}

static void take_as_now(sw_books *b, const sw_energies *e, double contact) {
  b->now = *e;
  b->contact = contact;
  const double pot = sw_ledger_potential(e, contact);
  b->highest = fmax(b->highest, pot);
  b->released = fmax(b->released, b->highest - pot);
  b->most_kinetic = fmax(b->most_kinetic, e->kinetic);
  b->sums.kinetic = e->kinetic, b->sums.gravity = e->gravity;
  b->sums.stored = e->stored + contact;
  const double least = LEAST + fmax(b->weight, LEAST_BENDING * b->bending);
  b->sums.play = fmax(least, b->most_kinetic + b->work + b->released);
}

/* 1 if a script moved a hold between two steps, away from the wire's held point. */
static int was_put(sw_scene *s, sw_error *err) {
  sw_system *y = sw_scene_system(s);
  for (size_t i = 3 * y->nodes; i < y->freedoms; i++) y->delta[i] = y->x[i];
  if (sw_system_place_holds(y, sw_scene_time(s), y->delta, NULL, NULL, err) != SW_OK) return 0;
  for (size_t k = 0; k < y->held_count; k++) {
    const size_t at = 3 * y->held[k].node;
    if (sw_dist(sw_load(y->delta + at), sw_load(y->x + at)) > JUMP) return 1;
  }
  return 0;
}

sw_status sw_ledger_open(sw_scene *s, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  sw_books *b = sw_scene_books(s);
  int any;
  if (b->known) return SW_OK;
  sw_energies e;
  /* looks ahead leave holds where they will be: a clamp that a function turns stored energy */
  SW_TRY(sw_system_place_holds(system, sw_scene_time(s), NULL, NULL, NULL, err));
  sw_waits_find(system, 0);
  weigh(s);
  sw_system_energies(system, sw_course_lumps(sw_scene_course(s)), NULL, &e);
  b->has_powers = sw_system_has_powers(system);
  b->powers = (sw_powers){0}; /* also of forces that are gone */
  if (b->has_powers) SW_TRY(sw_system_powers(system, sw_scene_time(s), &b->powers, err));
  const double contact = sw_ledger_contact(s), now = e.kinetic + sw_ledger_potential(&e, contact);
  const double last = b->now.kinetic + sw_ledger_potential(&b->now, b->contact);
  if (!b->begun) b->sums.at_start = now, b->highest = sw_ledger_potential(&e, contact);
  if (b->begun) b->sums.by_changes += now - last, b->highest += fmax(0.0, now - last);
  b->begun = 1;
  take_as_now(b, &e, contact);
  b->put = was_put(s, err);
  b->in_each_other = sw_joins_still_in(system);
  b->dissipated = sw_system_dissipated(system, &any);
  b->rubbed_off = sw_system_rubbed(system);
  if (sw_ledger_note_workers(s, 1) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "scene '%s': out of memory", sw_scene_name(s));
  b->known = 1;
  return SW_OK;
}

/* --- booking ------------------------------------------------------------------- */

static sw_status log_row(sw_scene *s) {
  sw_books *books = sw_scene_books(s);
  const sw_ledger *l = &books->sums;
  const double lost =
      l->damping + l->friction + l->plasticity + l->impact + l->contact + l->integrator + l->jumps;
  const double row[SW_LOG_ENERGY_SIZE] = {sw_scene_time(s), l->kinetic, l->stored,
                                          l->gravity,       l->gap,     lost};
  return sw_log_add(&books->log, row, SW_LOG_ENERGY_SIZE);
}

/* Books the gain of a step; returns the increase of the sum of gains [J]. Energy that a method
 * makes by itself oscillates, also between kinds of energy: it counts by its rise above its
 * smallest value so far. Energy made by touches is never subtracted. */
static double book_gain(sw_scene *s, double gain) {
  sw_books *b = sw_scene_books(s);
  const double before = b->sums.gained;
  if (!isfinite(gain)) return 0.0; /* not judged */
  if (sw_ledger_referees(s) && b->step.touching) {
    b->made += fmax(0.0, gain);
    b->lowest = b->rise;
  } else {
    b->rise += gain;
    b->lowest = b->step.changed ? b->rise : fmin(b->lowest, b->rise);
    b->highest_rise = fmax(b->highest_rise, b->rise - b->lowest);
  }
  b->sums.gained = b->made + b->highest_rise;
  return b->sums.gained - before;
}

/* Lowers losses that were booked too high; returns by how much [J]. The losses of a step are
 * computed from its ends. They may be too high: damping, if its power changed within the step;
 * friction, if its force began in the step; impact, if the step gave part of it back. Friction and
 * impact matter only where something touches. There, if hardly any work is done, all of the excess
 * must come from these errors: a blow changes the damping's power too, a taut wire damps faster
 * than steps resolve, and the normal force of a wire that strikes fast along a surface changes
 * between the stages of a step. excess: the booked losses minus the step's loss [J]. */
static double booked_too_high(const sw_books *b, sw_step_energy *step, double excess) {
  const double before = b->powers.damping, after = step->powers.damping;
  const double mean = sw_ledger_over_step(before, after, 1.0);
  const double least = mean > 0 ? step->damping * fmin(1.0, fmin(before, after) / mean) : 0.0;
  const double rest = step->work - step->dead > LITTLE_WORK * excess ? 0.0 : 1.0;
  double left = fmax(0.0, excess);
  const double touching = step->touching ? 1.0 : 0.0;
  struct {
    double *lost, most;
  } parts[] = {{&step->damping, step->damping - least},
               {&step->impact, touching * step->impact},
               {&step->friction, touching * 0.5 * step->friction},
               {&step->damping, rest * least},
               {&step->friction, touching * rest * 0.5 * step->friction}};
  for (size_t k = 0; k < sizeof parts / sizeof *parts; k++) {
    const double part = fmin(left, fmax(0.0, parts[k].most));
    *parts[k].lost -= part, left -= part;
  }
  return fmax(0.0, excess) - left;
}

/* Books the remainder `left` of a step, of which `gained` is a gain. Where nothing touches, the
 * energy that a method makes oscillates; its sum counts as lost. */
static void book_left(sw_ledger *l, const sw_step_energy *step, double left, double gained) {
  double *lost = step->steady ? &l->integrator : &l->contact;
  l->gap += gained;
  left -= gained;
  if (step->touching && left > 0)
    l->gap += left;
  else
    *lost -= left;
  if (*lost >= 0) return;
  l->gap -= *lost;
  *lost = 0;
}

/* Books the remainder of an equilibrium; there nothing oscillates. */
static void book_left_at_rest(sw_ledger *l, double left) {
  if (left > 0)
    l->gap += left;
  else
    l->integrator -= left;
}

/* Books and returns the losses that histories counted since the last step [J]. */
static double book_histories(sw_scene *s) {
  sw_system *system = sw_scene_system(s);
  sw_books *b = sw_scene_books(s);
  int any;
  const double all = sw_system_dissipated(system, &any), before = b->dissipated;
  const double rubbed = sw_system_rubbed(system);
  b->sums.friction += rubbed - b->rubbed_off;
  b->sums.plasticity += all - before - (rubbed - b->rubbed_off);
  b->dissipated = all, b->rubbed_off = rubbed;
  return all - before;
}

/* Returns what is left over of the energy: below 0, it is lost [J]. */
static double book_step(sw_scene *s, int at_rest) {
  sw_books *b = sw_scene_books(s);
  sw_step_energy *step = &b->step;
  sw_ledger *l = &b->sums;
  const double work = step->holds + step->obstacles + step->feeds + step->forces;
  const double change = step->to.kinetic - b->now.kinetic +
                        sw_ledger_potential(&step->to, step->contact) -
                        sw_ledger_potential(&b->now, b->contact);
  l->by_holds += step->holds, l->by_obstacles += step->obstacles;
  l->by_feeds += step->feeds, l->by_forces += step->forces;
  const double histories = book_histories(s);
  const double losses = step->damping + step->friction + step->impact + histories;
  const double given = fmin(fmax(0.0, change - work + losses), step->let_out);
  const double gained = book_gain(s, step->gain);
  double left = change - work + losses - given;
  if (!at_rest) left -= booked_too_high(b, step, left - gained);
  l->damping += step->damping, l->friction += step->friction, l->impact += step->impact;
  b->work += step->work;
  l->steps++;
  l->by_changes += given;
  if (at_rest)
    book_left_at_rest(l, left);
  else
    book_left(l, step, left, gained);
  if (step->gain > l->most_gained) l->most_gained = step->gain, l->most_time = sw_scene_time(s);
  b->highest += step->let_in;
  take_as_now(b, &step->to, step->contact);
  b->powers = step->powers;
  return left;
}

sw_status sw_ledger_close(sw_scene *s) {
  (void)book_step(s, 0);
  SW_TRY(sw_ledger_note_workers(s, 1));
  return log_row(s);
}

/* Wires that follow their holds give the energy by which their potential falls to these and to
 * friction. In a jump it goes nowhere. FALLEN: smallest such fall, of the energy in play or stored.
 * LOST: smallest lost part; of cables that poses laid over walls it was up to 0.05 of a fall, of
 * cables drawn round pegs with friction up to 0.64, in jumps 1 and more (spec/physics/leapt_spec)
 * [-]. */
static const double FALLEN = 0.01, LOST = 0.9;

static double potential_of(const sw_books *b) { return sw_ledger_potential(&b->now, b->contact); }

/* 1 if a fall of the potential leaves so much over that the wires have jumped. */
static int has_jumped(const sw_books *b, double fall, double left) {
  return fall > FALLEN * fmax(b->sums.play, b->now.stored) && -left > LOST * fall;
}

sw_status sw_ledger_pose(sw_scene *s, double t0, int far, int *jumped, double rubbed, double outer,
                         sw_error *err) {
  sw_books *b = sw_scene_books(s);
  sw_step_energy *step = &b->step;
  *step = (sw_step_energy){.steady = 1};
  sw_system_energies(sw_scene_system(s), 0, NULL, &step->to);
  step->to.kinetic = 0;
  step->contact = sw_ledger_contact(s);
  step->friction += rubbed + sw_scene_rubbed(s);
  if (sw_scene_contact(s)) SW_TRY(sw_contact_began(sw_scene_contact(s), t0, err));
  sw_ledger_work(s, sw_scene_time(s), 0);
  step->forces = b->now.loads - step->to.loads + outer;
  step->work = sw_ledger_effort(step);
  const double before = b->sums.integrator, high = potential_of(b);
  step->gain = 0; /* poses have no referee */
  const size_t still_in = sw_joins_still_in(sw_scene_system(s));
  if (still_in < b->in_each_other) step->let_out = HUGE_VAL; /* they come apart at once */
  b->in_each_other = still_in;
  const double left = book_step(s, 1), fall = high - potential_of(b);
  *jumped |= far && has_jumped(b, fall, left);
  if (*jumped) b->sums.jumps += b->sums.integrator - before, b->sums.integrator = before;
  if (sw_ledger_note_workers(s, 0) != SW_OK || log_row(s) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "scene '%s': out of memory", sw_scene_name(s));
  return SW_OK;
}

static void tell_retries(sw_scene *s, const char *one, const char *more, const sw_retries *r) {
  if (!r->count) return;
  sw_scene_tell(s, "energy", r->object, r->s, r->largest, "%zu %s, the worst at t = %.6g s",
                r->count, r->count == 1 ? one : more, r->time);
}

/* Logs energy that appeared outside steps: work or losses unknown to the steps. */
static void tell_unknown(sw_scene *s) {
  const sw_ledger *l = &sw_scene_books(s)->sums;
  const double share = l->play > 0 ? l->gap / l->play : 0.0;
  if (!(share > UNKNOWN)) return;
  sw_scene_tell(
      s, "energy", "", NAN, share,
      "%.3g J come from nowhere, %.2g %% of the energy in play: work, forces and moments of "
      "holds may be off by this share; take smaller steps",
      l->gap, 100.0 * share);
}

/* Returns advice for another method. With stages of first order (sdirk2), turning wires have up to
 * five times their axial force at the end of each step. If this strain is damped, every step of any
 * size makes its energy anew. */
static const char *other_method(const sw_scene *s) {
  const sw_course *c = sw_scene_course(s);
  if (sw_course_lumps(c)) return ", or an implicit integrator such as tr-bdf2";
  return strcmp(c->method->name, "tr-bdf2") != 0 ? ", or the integrator tr-bdf2" : "";
}

enum { FEW = 2 }; /* this many redone steps are not reported [-] */

sw_status sw_scene_end_run(sw_scene *s, sw_error *why) {
  const sw_ledger *l = &sw_scene_books(s)->sums;
  const double share = l->play > 0 ? l->gained / l->play : 0.0;
  sw_scene_end_breaking(s);
  sw_scene_end_wear(s);
  sw_outer_end_run(s);
  sw_scene_end_corners(s);
  sw_scene_end_bends(s);
  sw_scene_end_inside(s);
  sw_scene_end_sunk(s);
  sw_scene_end_joints(s);
  tell_retries(
      s, "step was accepted although it made energy, because smaller steps made energy too",
      "steps were accepted although they made energy, because smaller steps made energy too",
      &l->accepted);
  if (l->redone.count > FEW && (double)l->redone.count > 0.01 * (double)l->steps)
    tell_retries(s, "", "steps were redone, more than 1 % of all, because they made energy",
                 &l->redone);
  if (!(share > REMARK)) {
    tell_unknown(s);
    return SW_OK;
  }
  if (!(share > FAILURE)) {
    sw_scene_tell(s, "energy", "", NAN, share,
                  "steps made %.3g J from nowhere, %.2g %% of the energy in play; run again with "
                  "smaller steps to see how much results change",
                  l->gained, 100.0 * share);
    return SW_OK;
  }
  char pressed[2 * SW_NAME_SIZE + 150]; /* wedged wires make energy with steps of any size */
  sw_scene_tell_pressed(s, pressed, sizeof pressed);
  sw_fail(
      why, SW_EDIVERGED,
      "steps made %.3g J from nowhere, %.3g %% of the %.3g J in play, most of it at t = %.6g s%s; "
      "take smaller steps%s",
      l->gained, 100.0 * share, l->play, l->most_time, pressed, other_method(s));
  sw_scene_diverge(s, why);
  return SW_EDIVERGED;
}
