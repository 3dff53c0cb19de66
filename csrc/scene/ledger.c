/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/ledger.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "scene/world.h"
#include "system/join.h"

const double SW_LEDGER_REMARK = 0.02, SW_LEDGER_FAILURE = 0.05;

/* A step of this size may make so much of the kinetic energy, of the weight times the radius and of
 * the work, by the errors of the method and of the work's quadrature [s], [-]. */
static const double FULL_STEP = 0.01, OF_KINETIC = 1e-3, OF_WEIGHT = 1e-3, OF_WORK = 0.01;
/* And of EI / L, as axial forces and bends are only known to rounding [-]. */
static const double OF_BENDING = 1e-9;
/* Energies are sums of large terms, known to this share of these [-]. */
static const double ROUNDING = 1e-13;
/* After so many steps that were taken although they made energy the referee rests: it would
 * cost the smallest steps, and mend nothing. The run's end tells the energy made [-]. */
enum { MOST_ACCEPTED = 16 };
/* Once the gains of steps pass the first share of the energy in play, a step may gain only
 * `LITTLE` of it; beyond the second share, only rounding [-]. */
static const double ENOUGH = 0.005, PLENTY = 0.01, LITTLE = 1e-5;
/* Wires that begin inside of obstacles are let out, which gives them at most this speed and lifts
 * them about as fast as this [m/s]. */
static const double THROWN = 0.02, LET_OUT = 0.01;
/* A held point is off its hold by more than rounding [m]. */
static const double JUMP = 1e-9;
/* Where nothing touches, the method may make this share of the energy in play [-]. */
static const double IN_FLIGHT = 0.01;
/* And then to this share in each whole step: asked for nothing at all, steps would collapse [-]. */
static const double EACH_IN_FLIGHT = 2e-4;
/* The least that is in play: the weight times the radius, or this share of EI / L [-]. */
static const double LEAST_BENDING = 1e-6;
static const double LEAST = 1e-12; /* and this [J] */

/* --- life ---------------------------------------------------------------------- */

void sw_ledger_begin_run(sw_scene *s) {
  sw_books *b = &s->books;
  sw_log log = b->log;
  log.count = 0;
  *b = (sw_books){.holds = b->holds,
                  .obstacles = b->obstacles,
                  .log = log,
                  .hold_room = b->hold_room,
                  .obstacle_room = b->obstacle_room};
}

void sw_ledger_free(sw_books *b) {
  sw_free(b->holds);
  sw_free(b->obstacles);
  sw_log_free(&b->log);
  *b = (sw_books){0};
}

void sw_ledger_forget(sw_scene *s) { s->books.known = 0; }

/* --- measuring ----------------------------------------------------------------- */

static int lumped(const sw_scene *s) {
  return s->has_stepper && !(s->method->flags & SW_INTEGRATOR_IMPLICIT);
}

/* Stored between bodies and obstacles. */
static double contact_energy(sw_scene *s) {
  double sum = sw_scene_has_contact(s) ? sw_scene_contact_energy(s) : 0.0;
  if (s->crowd) sum += sw_crowd_energy(s->crowd, &s->system);
  if (s->system.joins) sum += sw_joins_energy(&s->system);
  return sum;
}

static double potential(const sw_energies *e, double contact) {
  return e->gravity + e->stored + contact;
}

static void weigh(sw_scene *s) {
  sw_books *b = &s->books;
  b->weight = b->bending = b->mass = b->longest = 0;
  for (size_t k = 0; k < s->system.body_count; k++) {
    const sw_plan *p = s->system.bodies[k].plan;
    const double mg = p->beam.mass * p->length * sw_norm(s->gravity);
    b->longest = fmax(b->longest, p->length);
    if (isfinite(p->beam.mass * p->length)) b->mass += p->beam.mass * p->length;
    if (isfinite(mg * p->beam.radius)) b->weight += mg * p->beam.radius;
    if (p->length > 0 && isfinite(p->beam.EI)) b->bending += p->beam.EI / p->length;
  }
}

static void take_as_now(sw_books *b, const sw_energies *e, double contact) {
  b->now = *e;
  b->contact = contact;
  const double pot = potential(e, contact);
  b->highest = fmax(b->highest, pot);
  b->released = fmax(b->released, b->highest - pot);
  b->most_kinetic = fmax(b->most_kinetic, e->kinetic);
  b->sums.kinetic = e->kinetic, b->sums.gravity = e->gravity;
  b->sums.stored = e->stored + contact;
  const double least = LEAST + fmax(b->weight, LEAST_BENDING * b->bending);
  b->sums.play = fmax(least, b->most_kinetic + b->work + b->released);
}

/* 1: a hold was put elsewhere between two steps, away from the wire's held point. */
static int was_put(sw_scene *s, sw_error *err) {
  sw_system *y = &s->system;
  for (size_t i = 3 * y->nodes; i < y->freedoms; i++) y->delta[i] = y->x[i];
  if (sw_system_place_holds(y, s->time, y->delta, NULL, NULL, err) != SW_OK) return 0;
  for (size_t k = 0; k < y->held_count; k++) {
    const size_t at = 3 * y->held[k].node;
    if (sw_dist(sw_load(y->delta + at), sw_load(y->x + at)) > JUMP) return 1;
  }
  return 0;
}

sw_status sw_ledger_open(sw_scene *s, sw_error *err) {
  sw_books *b = &s->books;
  int any;
  if (b->known) return SW_OK;
  sw_energies e;
  weigh(s);
  sw_system_energies(&s->system, lumped(s), &e);
  b->has_powers = sw_system_has_powers(&s->system);
  if (b->has_powers) SW_TRY(sw_system_powers(&s->system, s->time, &b->powers, err));
  const double contact = contact_energy(s), now = e.kinetic + potential(&e, contact);
  const double last = b->now.kinetic + potential(&b->now, b->contact);
  if (!b->begun) b->sums.at_start = now, b->highest = potential(&e, contact);
  if (b->begun) b->sums.by_changes += now - last, b->highest += fmax(0.0, now - last);
  b->begun = 1;
  take_as_now(b, &e, contact);
  b->put = was_put(s, err);
  b->dissipated = sw_system_dissipated(&s->system, &any);
  b->rubbed_off = sw_system_rubbed(&s->system);
  if (sw_ledger_note_workers(s, 1) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "scene '%s': out of memory", s->name);
  b->known = 1;
  return SW_OK;
}

/* Energy over a step by the powers at its ends: the trapezoid, but where what is damped dies out
 * within the step. */
static double over_step(double before, double after, double h) {
  const int dies = before > 4.0 * after || after > 4.0 * before;
  return h * (dies && before > 0 && after > 0 ? sqrt(before * after) : 0.5 * (before + after));
}

static void judge_outer_forces(sw_books *b, double h, double *most) {
  sw_step_energy *step = &b->step;
  const double before = b->powers.given;
  const double dead = b->now.loads - step->to.loads;
  step->forces = dead + over_step(before, step->powers.given, h);
  *most += dead + h * fmax(before, step->powers.given);
  step->damping = over_step(b->powers.damping, step->powers.damping, h);
}

static void judge_touches(sw_scene *s, double h, sw_step_energy *step) {
  const sw_books *b = &s->books;
  size_t impacts = 0;
  step->touching = sw_scene_touches(s) > 0;
  if (s->contact) {
    impacts += sw_contact_impacts(s->contact);
    step->friction += sw_contact_rubbed(s->contact);
    step->steady &= sw_contact_steady(s->contact);
    step->obstacles += sw_contact_struck(s->contact);
    step->let_out = sw_contact_hardened(s->contact);
    if (sw_contact_emerges(s->contact))
      step->let_out += b->mass * (THROWN * THROWN + LET_OUT * h * sw_norm(s->gravity));
  }
  if (s->pairs) {
    impacts += sw_pairs_impacts(s->pairs);
    step->friction += sw_pairs_rubbed(s->pairs);
    step->steady &= sw_pairs_steady(s->pairs);
  }
  if (s->grains) {
    impacts += sw_grains_impacts(s->grains);
    step->friction += sw_grains_rubbed(s->grains);
    step->steady &= sw_grains_steady(s->grains);
  }
  if (impacts) /* these changed the velocities at the step's start */
    step->impact =
        s->books.now.kinetic + step->obstacles - sw_system_kinetic(&s->system, lumped(s));
}

/* Where the scene was changed, what moves may have begun to do so at once. Its forces within the
 * step are not known then; the most that they may give to wires. */
static double jolt(const sw_scene *s, const sw_step_energy *step) {
  double fastest = 0;
  for (size_t k = 0; k < s->system.hold_count; k++) {
    const sw_hold *h = &s->holds[s->hold_slot[k]];
    const double fed = sw_hold_passes(h) ? fabs(sw_hold_way_of(s, h, s->time, NULL).speed) : 0.0;
    const sw_hold_state *at = &s->system.hold_states[k];
    fastest = fmax(fastest, sw_norm(at->v) + fed + sw_norm(at->omega) * s->books.longest);
  }
  if (step->obstacles != 0) fastest = fmax(fastest, sw_contact_fastest(s->contact));
  if (s->books.put) return HUGE_VAL;
  return fastest > 0 ? s->books.mass * fastest * fastest + step->work : 0.0;
}

/* Pads are as soft as the wire, and share their force out among the places that touch. The
 * energy stored there jumps when a place comes or goes, though the wire does nothing. */
static int has_pads(const sw_scene *s) {
  for (size_t k = 0; k < s->tool_count; k++)
    if (s->tools[k].alive && s->tools[k].pads && !s->tools[k].frozen) return 1;
  return 0;
}

/* Explicit methods have last looked at what touches before or within the step. */
static sw_status look_at_end(sw_scene *s, double t1, sw_error *err) {
  sw_system *y = &s->system;
  SW_TRY(sw_system_place_holds(y, t1, NULL, NULL, NULL, err));
  if (!y->coupling.eval) return SW_OK;
  return y->coupling.eval(y->coupling.user, y, t1, HUGE_VAL, s->stepper.trial_x, SW_WANT_FORCE,
                          err);
}

sw_status sw_ledger_judge(sw_scene *s, double t1, double h, int changed, sw_error *err) {
  sw_books *b = &s->books;
  sw_step_energy *step = &b->step;
  sw_glance glance;
  sw_status status = SW_OK;
  *step = (sw_step_energy){.steady = 1, .changed = changed};
  if (lumped(s)) SW_TRY(look_at_end(s, t1, err));
  if (sw_scene_has_contact(s)) judge_touches(s, h, step);
  double most = step->obstacles;
  sw_system_look_at(&s->system, &glance, s->stepper.trial_x, s->stepper.trial_v,
                    s->stepper.strain_rate);
  sw_system_energies(&s->system, lumped(s), &step->to);
  step->contact = contact_energy(s);
  step->touching |= b->contact != 0 || step->contact != 0; /* ties that are taut too */
  most += sw_ledger_work(s, t1, changed);
  if (b->has_powers) status = sw_system_powers(&s->system, t1, &step->powers, err);
  sw_system_look_back(&s->system, &glance);
  judge_outer_forces(b, h, &most);
  step->work = fabs(step->holds) + fabs(step->obstacles) + fabs(step->feeds) + fabs(step->forces);
  const double before = b->now.kinetic + potential(&b->now, b->contact);
  if (changed) step->let_out += jolt(s, step);
  if (has_pads(s)) step->let_out += fmax(0.0, step->contact - b->contact);
  most += step->let_out;
  step->gain = step->to.kinetic + potential(&step->to, step->contact) - before - most;
  return status;
}

int sw_ledger_referees(const sw_scene *s) {
  return !lumped(s) && !(s->method->flags & SW_INTEGRATOR_NO_CONTACT);
}

/* What a full step may make besides: less once steps have made more [J]. */
static double usual_gain(const sw_books *b) {
  const double play = b->sums.play;
  if (b->sums.gained > PLENTY * play) return 0.0;
  if (b->sums.gained > ENOUGH * play) return LITTLE * play;
  return OF_KINETIC * b->now.kinetic + OF_WEIGHT * b->weight;
}

double sw_ledger_excess(const sw_scene *s, double h, double whole) {
  const sw_books *b = &s->books;
  const sw_step_energy *step = &b->step;
  if (!sw_ledger_referees(s) || b->sums.accepted.count >= MOST_ACCEPTED) return 0.0;
  const double share = fmin(1.0, h / FULL_STEP);
  const double size = fabs(b->now.kinetic) + fabs(b->now.gravity) + fabs(b->now.stored) +
                      fabs(step->to.kinetic) + fabs(step->to.gravity) + fabs(step->to.stored);
  const double rounding = ROUNDING * size + OF_BENDING * b->bending * share;
  /* what impacts at its start give, of several places at once, no smaller step mends */
  const double struck = fmin(fmax(0.0, -step->impact), usual_gain(b));
  const double allowed = rounding + OF_WORK * step->work + share * usual_gain(b) + struck;
  if (!isfinite(step->gain)) return step->gain < 0 ? 0.0 : HUGE_VAL;
  const double rise = b->rise + step->gain - b->lowest;
  if (step->touching) return step->gain > allowed ? step->gain : 0.0;
  const double little = EACH_IN_FLIGHT * fmin(1.0, h / whole) * b->sums.play;
  if (rise <= IN_FLIGHT * b->sums.play || step->gain <= little) return 0.0;
  return step->gain > allowed ? step->gain : 0.0;
}

/* --- booking ------------------------------------------------------------------- */

static sw_status log_row(sw_scene *s) {
  const sw_ledger *l = &s->books.sums;
  const double lost =
      l->damping + l->friction + l->plasticity + l->impact + l->contact + l->integrator + l->jumps;
  const double row[SW_LOG_ENERGY_SIZE] = {s->time, l->kinetic, l->stored, l->gravity, l->gap, lost};
  return sw_log_add(&s->books.log, row, SW_LOG_ENERGY_SIZE);
}

/* The energy that a method makes by itself goes to and fro, also where energy oscillates
 * between kinds. So it counts by its rise above its least value. Energy made by touches stays. */
static void book_gain(sw_scene *s, double gain) {
  sw_books *b = &s->books;
  if (!isfinite(gain)) return; /* not judged */
  if (sw_ledger_referees(s) && b->step.touching) {
    b->made += fmax(0.0, gain);
    b->lowest = b->rise;
  } else {
    b->rise += gain;
    b->lowest = b->step.changed ? b->rise : fmin(b->lowest, b->rise);
    b->highest_rise = fmax(b->highest_rise, b->rise - b->lowest);
  }
  b->sums.gained = b->made + b->highest_rise;
}

static void book_left(sw_ledger *l, double left, int steady) {
  if (left > 0)
    l->gap += left;
  else if (steady)
    l->integrator -= left;
  else
    l->contact -= left;
}

/* Losses that histories count, since the last step. */
static double book_histories(sw_scene *s) {
  sw_books *b = &s->books;
  int any;
  const double all = sw_system_dissipated(&s->system, &any), before = b->dissipated;
  const double rubbed = sw_system_rubbed(&s->system);
  b->sums.friction += rubbed - b->rubbed_off;
  b->sums.plasticity += all - before - (rubbed - b->rubbed_off);
  b->dissipated = all, b->rubbed_off = rubbed;
  return all - before;
}

static void book_step(sw_scene *s) {
  sw_books *b = &s->books;
  const sw_step_energy *step = &b->step;
  sw_ledger *l = &b->sums;
  const double work = step->holds + step->obstacles + step->feeds + step->forces;
  const double change = step->to.kinetic - b->now.kinetic + potential(&step->to, step->contact) -
                        potential(&b->now, b->contact);
  l->by_holds += step->holds, l->by_obstacles += step->obstacles;
  l->by_feeds += step->feeds, l->by_forces += step->forces;
  l->damping += step->damping, l->friction += step->friction, l->impact += step->impact;
  const double lost = step->damping + step->friction + step->impact + book_histories(s);
  b->work += step->work;
  l->steps++;
  const double given = fmin(fmax(0.0, change - work + lost), step->let_out);
  l->by_changes += given;
  book_left(l, change - work + lost - given, step->steady);
  book_gain(s, step->gain);
  if (step->gain > l->most_gained) l->most_gained = step->gain, l->most_time = s->time;
  take_as_now(b, &step->to, step->contact);
  b->powers = step->powers;
}

sw_status sw_ledger_close(sw_scene *s) {
  book_step(s);
  SW_TRY(sw_ledger_note_workers(s, 1));
  return log_row(s);
}

sw_status sw_ledger_pose(sw_scene *s, int jumped, sw_error *err) {
  sw_books *b = &s->books;
  sw_step_energy *step = &b->step;
  *step = (sw_step_energy){.steady = 1};
  sw_system_energies(&s->system, 0, &step->to);
  step->to.kinetic = 0;
  step->contact = contact_energy(s);
  if (s->contact) step->friction += sw_contact_rubbed(s->contact);
  if (s->pairs) step->friction += sw_pairs_rubbed(s->pairs);
  if (s->grains) step->friction += sw_grains_rubbed(s->grains);
  sw_ledger_work(s, s->time, 0);
  step->forces = b->now.loads - step->to.loads;
  step->work = fabs(step->holds) + fabs(step->obstacles) + fabs(step->feeds) + fabs(step->forces);
  const double before = b->sums.integrator;
  step->gain = 0; /* poses are not judged */
  book_step(s);
  if (jumped) b->sums.jumps += b->sums.integrator - before, b->sums.integrator = before;
  if (sw_ledger_note_workers(s, 0) != SW_OK || log_row(s) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "scene '%s': out of memory", s->name);
  return SW_OK;
}

/* --- what the referee did -------------------------------------------------------- */

/* The node whose kinetic energy grew most in the trial. */
static size_t fastest_gain(const sw_scene *s) {
  const double *v0 = s->system.v, *v1 = s->stepper.trial_v;
  double largest = -HUGE_VAL;
  size_t node = 0;
  for (size_t b = 0; b < s->system.body_count; b++) {
    const sw_body *body = &s->system.bodies[b];
    for (size_t i = 0; i < body->plan->nodes; i++) {
      const size_t at = body->first_node + i;
      const double more =
          body->plan->lumped[i] * (sw_norm2(sw_load(v1 + 3 * at)) - sw_norm2(sw_load(v0 + 3 * at)));
      if (!(more > largest)) continue;
      largest = more;
      node = at;
    }
  }
  return node;
}

void sw_ledger_retry(const sw_scene *s, sw_retries *r, double time, double excess) {
  r->count++;
  if (!(excess > r->largest)) return;
  const size_t node = fastest_gain(s), body = sw_system_body_of(&s->system, node);
  const sw_body *b = &s->system.bodies[body];
  const sw_plan *p = b->plan;
  const double *arc = p->web ? p->web->s : p->s;
  r->largest = excess, r->time = time;
  r->s = arc[node - b->first_node] - (p->web ? 0.0 : arc[0]);
  snprintf(r->object, sizeof r->object, "%s", s->wires[body].name);
}

/* --- what there is to read -------------------------------------------------------- */

sw_status sw_scene_ledger(sw_scene *s, sw_ledger *out, sw_error *err) {
  (void)err;
  *out = s->books.sums;
  return SW_OK;
}

const double *sw_scene_energy_log(const sw_scene *s, size_t *rows) {
  *rows = s->books.log.count / SW_LOG_ENERGY_SIZE;
  return s->books.log.rows;
}

static void tell_retries(sw_scene *s, const char *what, const sw_retries *r) {
  if (!r->count) return;
  sw_scene_tell(s, "energy", r->object, r->s, r->largest,
                "%zu steps were %s, the worst at t = %.6g s", r->count, what, r->time);
}

enum { FEW = 2 }; /* steps redone that are not worth a word */

sw_status sw_scene_end_run(sw_scene *s, sw_error *why) {
  const sw_ledger *l = &s->books.sums;
  const double share = l->play > 0 ? l->gained / l->play : 0.0;
  sw_scene_end_breaking(s);
  tell_retries(s, "taken though they made energy, for smaller ones did too", &l->accepted);
  if (l->redone.count > FEW && (double)l->redone.count > 0.01 * (double)l->steps)
    tell_retries(s, "redone, more than 1 % of all, for they made energy", &l->redone);
  if (!(share > SW_LEDGER_REMARK)) return SW_OK;
  if (!(share > SW_LEDGER_FAILURE)) {
    sw_scene_tell(s, "energy", "", NAN, share,
                  "steps made %.3g J from nowhere, %.2g %% of what was in play; smaller steps show "
                  "what that changes",
                  l->gained, 100.0 * share);
    return SW_OK;
  }
  char pressed[2 * SW_NAME_SIZE + 100]; /* what is wedged makes energy with steps of any size */
  s->diverged = 1;
  sw_scene_tell_pressed(s, pressed, sizeof pressed);
  sw_fail(
      &s->why, SW_EDIVERGED,
      "steps made %.3g J from nowhere, %.3g %% of the %.3g J in play, most of it at t = %.6g s%s; "
      "take smaller steps%s",
      l->gained, 100.0 * share, l->play, l->most_time, pressed,
      lumped(s) ? ", or an implicit integrator such as tr-bdf2" : "");
  *why = s->why;
  return SW_EDIVERGED;
}

/* --- on tape ------------------------------------------------------------------------ */

void sw_tape_ledger(sw_tape *t, sw_books *b) {
  SW_TAPE_STRUCT(t, sw_books, 856);
  SW_TAPE_STRUCT(t, sw_ledger, 464);
  sw_tape_raw(t, &b->sums, sizeof b->sums);
  sw_tape_raw(t, &b->now, sizeof b->now);
  sw_tape_double(t, &b->contact), sw_tape_double(t, &b->highest);
  sw_tape_double(t, &b->most_kinetic), sw_tape_double(t, &b->work);
  sw_tape_double(t, &b->released), sw_tape_double(t, &b->made);
  sw_tape_double(t, &b->rise), sw_tape_double(t, &b->lowest), sw_tape_double(t, &b->highest_rise);
  sw_tape_int(t, &b->begun), sw_tape_int(t, &b->put);
  sw_tape_log(t, &b->log);
  b->known = sw_tape_reads(t) ? 0 : b->known;
}
