/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The energy referee: finds steps that gain more energy than the method's errors explain. */
#include <math.h>
#include <stdio.h>

#include "body/hold.h"
#include "body/touching.h"
#include "link/hold.h"
#include "read/reading.h"
#include "scene/course.h"
#include "scene/gripper.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "step/energy.h"
#include "step/restart.h"
#include "system/join.h"
#include "system/system.h"

/* Allowances for the errors of the method and of the quadrature of work. A step of FULL_STEP [s]
 * may make these shares of the kinetic energy, of the weight times the radius and of the work
 * [-]. */
static const double FULL_STEP = 0.01, OF_KINETIC = 1e-3, OF_WEIGHT = 1e-3, OF_WORK = 0.01;
/* Share of the losses of histories that a step may make. These losses are known more exactly than
 * the forces at the ends of the step, whose work balances them [-]. */
static const double OF_LOST = 0.1;
/* Further allowance, over EI / L: axial forces and bends are known only to rounding [-]. */
static const double OF_BENDING = 1e-9;
/* Energies are sums of large terms, exact to this share of them [-]. */
static const double ROUNDING = 1e-13;
/* The referee stops after it has accepted this many steps that made energy: it would demand the
 * smallest steps and improve nothing. The end of the run reports the energy made [-]. */
enum { MOST_ACCEPTED = 16 };
/* Once the steps' gains exceed ENOUGH of the energy in play, a step may gain only LITTLE of it;
 * above PLENTY, only rounding. The aim is a run that gains less than 0.5 %
 * (spec/physics/ledger_gain_spec) [-]. */
static const double ENOUGH = 0.00125, PLENTY = 0.0025, LITTLE = 1e-5;
/* Wires that begin inside obstacles, or in each other where a join was released, are pushed out.
 * They get at most the speed THROWN and rise at about LET_OUT [m/s]. */
static const double THROWN = 0.02, LET_OUT = 0.01;
/* Where nothing touches, the method may make IN_FLIGHT of the energy in play, and each whole step
 * EACH_IN_FLIGHT beyond that; without an allowance steps would collapse. After a blow cables ring
 * faster than steps resolve, and gained up to 1.7 % of their energy: then only AFTER_BLOWS of this
 * is allowed, which costs no time. A method with a history keeps the full allowance: it computes a
 * halved step by another method, which gives worse forces of holds
 * (spec/physics/turned_damped_spec, bdf2) [-]. */
static const double IN_FLIGHT = 0.01, EACH_IN_FLIGHT = 2e-4, AFTER_BLOWS = 0.25;

/* Energy stored between bodies and obstacles. */
double sw_ledger_contact(sw_scene *s) {
  sw_crowd *crowd = sw_scene_crowd(s);
  sw_system *system = sw_scene_system(s);
  double sum = sw_scene_has_contact(s) ? sw_scene_contact_energy(s) : 0.0;
  if (crowd) sum += sw_crowd_energy(crowd, system);
  if (system->joins) sum += sw_joins_energy(system);
  return sum;
}

double sw_ledger_over_step(double before, double after, double h) {
  const int dies = before > 4.0 * after || after > 4.0 * before;
  return h * (dies && before > 0 && after > 0 ? sqrt(before * after) : 0.5 * (before + after));
}

static void judge_outer_forces(sw_books *b, double h, double *most) {
  sw_step_energy *step = &b->step;
  const double before = b->powers.given;
  const double dead = b->now.loads - step->to.loads;
  step->dead = fabs(dead);
  step->forces = dead + sw_ledger_over_step(before, step->powers.given, h);
  *most += dead + h * fmax(before, step->powers.given);
  step->damping = sw_ledger_over_step(b->powers.damping, step->powers.damping, h);
}

static double pushed_out(const sw_scene *s, double h) {
  return sw_scene_books(s)->mass * (THROWN * THROWN + LET_OUT * h * sw_norm(sw_scene_gravity(s)));
}

static void judge_touches(sw_scene *s, double h, sw_step_energy *step) {
  sw_mutual *const mutual[] = {sw_scene_pairs(s), sw_scene_grains(s)};
  sw_contact *contact = sw_scene_contact(s);
  size_t impacts = 0;
  step->touching = sw_scene_touches(s) > 0;
  step->friction += sw_scene_rubbed(s);
  if (contact) {
    impacts += sw_contact_impacts(contact);
    step->steady &= sw_contact_steady(contact);
    step->obstacles += sw_contact_struck(contact);
    step->let_out = sw_contact_hardened(contact) + sw_contact_unbent(contact);
    if (sw_contact_emerges(contact))
      step->let_out += sw_contact_emerged(contact) + pushed_out(s, h);
  }
  for (int k = 0; k < 2; k++) {
    if (!mutual[k]) continue;
    impacts += sw_mutual_impacts(mutual[k]);
    step->let_out += sw_presses_emerged(sw_mutual_presses(mutual[k]));
    if (sw_mutual_parts(mutual[k], sw_scene_system(s))) step->let_out += pushed_out(s, h);
    step->steady &= sw_mutual_steady(mutual[k]);
  }
  if (impacts) /* impacts changed the velocities at the step's start */
    step->impact = sw_scene_books(s)->now.kinetic + step->obstacles -
                   sw_system_kinetic(sw_scene_system(s), sw_course_lumps(sw_scene_course(s)));
}

/* Returns the largest energy that moving drives may give to wires in a step after a change of the
 * scene, or in a step at whose end a drive jumps [J]. Such a drive may start abruptly: forces
 * within the step and the impulse at its end are unknown. */
static double jolt(const sw_scene *s, const sw_step_energy *step) {
  sw_books *b = sw_scene_books(s);
  sw_system *system = sw_scene_system(s);
  double fastest = 0;
  for (size_t k = 0; k < system->hold_count; k++) {
    const sw_hold *h = sw_scene_held_by(s, k);
    const double fed =
        sw_hold_passes(h) ? fabs(sw_hold_way_of(s, h, sw_scene_time(s), NULL).speed) : 0.0;
    const sw_hold_state *at = &system->hold_states[k];
    fastest = fmax(fastest, sw_norm(at->v) + fed + sw_norm(at->omega) * b->longest);
  }
  if (step->obstacles != 0) fastest = fmax(fastest, sw_contact_fastest(sw_scene_contact(s)));
  if (b->put) return HUGE_VAL;
  return fastest > 0 ? b->mass * fastest * fastest + step->work : 0.0;
}

/* 1 if there are pads. Pads are as soft as the wire and share their force among the touching
 * places. Their stored energy jumps when a touch begins or ends, even if the wire does not move. */
static int has_pads(const sw_scene *s) {
  SW_EACH(tool, t, s)
    if (t->alive && t->pads && !t->frozen) return 1;
  return 0;
}

/* Evaluates contact at the step's end. Explicit methods last did so earlier in the step. */
static sw_status look_at_end(sw_scene *s, double t1, sw_error *err) {
  sw_system *y = sw_scene_system(s);
  SW_TRY(sw_system_place_holds(y, t1, NULL, NULL, NULL, err));
  if (!y->coupling.eval) return SW_OK;
  return y->coupling.eval(y->coupling.user, y, t1, HUGE_VAL, sw_scene_course(s)->stepper.trial_x,
                          SW_WANT_FORCE, err);
}

sw_status sw_ledger_judge(sw_scene *s, double t1, double h, int changed, sw_error *err) {
  sw_course *c = sw_scene_course(s);
  sw_system *system = sw_scene_system(s);
  sw_books *b = sw_scene_books(s);
  sw_step_energy *step = &b->step;
  sw_glance glance;
  sw_status status = SW_OK;
  int jerks = 0;
  *step = (sw_step_energy){.steady = 1, .changed = changed};
  if (sw_course_lumps(sw_scene_course(s))) SW_TRY(look_at_end(s, t1, err));
  if (sw_scene_has_contact(s)) judge_touches(s, h, step);
  double most = step->obstacles;
  sw_system_look_at(system, &glance, c->stepper.trial_x, c->stepper.trial_v,
                    c->stepper.strain_rate);
  sw_committed committed = {.time = t1};
  sw_system_energies(system, sw_course_lumps(sw_scene_course(s)), &committed, &step->to);
  step->contact = sw_ledger_contact(s);
  step->touching |= b->contact != 0 || step->contact != 0; /* taut ties count as touching too */
  most += sw_ledger_work(s, t1, changed);
  if (b->has_powers) status = sw_system_powers(system, t1, &step->powers, err);
  sw_system_look_back(system, &glance);
  judge_outer_forces(b, h, &most);
  step->work = sw_ledger_effort(step);
  const double before = b->now.kinetic + sw_ledger_potential(&b->now, b->contact);
  if (status == SW_OK && !changed) status = sw_restart_jerks(s, t1, h, &jerks, err);
  if (changed || jerks) step->let_out += jolt(s, step);
  if (has_pads(s)) step->let_out += fmax(0.0, step->contact - b->contact);
  most += step->let_out;
  const double after = step->to.kinetic + sw_ledger_potential(&step->to, step->contact);
  most += OF_LOST * committed.lost;
  step->gain = after + committed.lost - before - most;
  return status;
}

int sw_ledger_referees(const sw_scene *s) {
  return !sw_course_lumps(sw_scene_course(s)) &&
         !(sw_scene_course(s)->method->flags & SW_INTEGRATOR_NO_CONTACT);
}

/* Returns the further allowance of a full step; it is smaller after steps have made energy [J]. */
static double usual_gain(const sw_books *b) {
  const double play = b->sums.play;
  if (b->sums.gained > PLENTY * play) return 0.0;
  if (b->sums.gained > ENOUGH * play) return LITTLE * play;
  return OF_KINETIC * b->now.kinetic + OF_WEIGHT * b->weight;
}

double sw_ledger_excess(const sw_scene *s, double h, double whole) {
  const sw_books *b = sw_scene_books(s);
  const sw_step_energy *step = &b->step;
  if (!sw_ledger_referees(s) || b->sums.accepted.count >= MOST_ACCEPTED) return 0.0;
  const double share = fmin(1.0, h / FULL_STEP);
  const double size = fabs(b->now.kinetic) + fabs(b->now.gravity) + fabs(b->now.stored) +
                      fabs(step->to.kinetic) + fabs(step->to.gravity) + fabs(step->to.stored);
  const double rounding = ROUNDING * size + OF_BENDING * b->bending * share;
  /* energy that impacts at several places give at the step's start; smaller steps do not avoid
   * it */
  const double struck = fmin(fmax(0.0, -step->impact), usual_gain(b));
  const double allowed = rounding + OF_WORK * step->work + share * usual_gain(b) + struck;
  if (!isfinite(step->gain)) return step->gain < 0 ? 0.0 : HUGE_VAL;
  const double rise = b->rise + step->gain - b->lowest;
  if (step->touching) return step->gain > allowed ? step->gain : 0.0;
  const int history = sw_scene_course(s)->method->flags & SW_INTEGRATOR_HISTORY;
  const int struck_before = b->sums.impact + b->sums.contact > 0;
  const double play = (struck_before && !history ? AFTER_BLOWS : 1.0) * b->sums.play;
  const double little = EACH_IN_FLIGHT * fmin(1.0, h / whole) * play;
  if (rise <= IN_FLIGHT * play || step->gain <= little) return 0.0;
  return step->gain > allowed ? step->gain : 0.0;
}

/* Returns the node whose kinetic energy grew most in the trial. */
static size_t fastest_gain(const sw_scene *s) {
  sw_system *system = sw_scene_system(s);
  const double *v0 = system->v, *v1 = sw_scene_course(s)->stepper.trial_v;
  double largest = -HUGE_VAL;
  size_t node = 0;
  SW_ITEMS(const sw_body, body, system->bodies, system->body_count) {
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
  sw_system *system = sw_scene_system(s);
  r->count++;
  if (!(excess > r->largest)) return;
  const size_t node = fastest_gain(s), body = sw_system_body_of(system, node);
  const sw_body *b = &system->bodies[body];
  r->largest = excess, r->time = time;
  r->s = sw_plan_place(b->plan, node - b->first_node);
  snprintf(r->object, sizeof r->object, "%s", sw_scene_wire_in(s, body)->name);
}
