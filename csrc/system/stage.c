/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solves one implicit stage by the mixed Newton: the axial force of each edge is an independent
 * unknown. The geometric stiffness has the stored force, the residual the force at the present
 * displacements. After each solve the linearised axial law advances the stored force. So a large
 * axial stiffness costs no iterations. */
#include <math.h>
#include <string.h>

#include "base/each.h"
#include "base/interrupt.h"
#include "base/simd.h"
#include "solve/band3.h"
#include "solve/blocks.h"
#include "system/assemble.h"
#include "system/bridge.h"
#include "system/factors.h"
#include "system/join_twist.h"
#include "system/part.h"
#include "system/rail.h"
#include "system/spin.h"
#include "system/stage_parts.h"
#include "system/strain.h"
#include "system/system.h"
#include "system/twist.h"
#include "system/wait.h"
#include "system/web.h"

/* Computes axial forces after delta by the linearised law. Returns the square of an edge's largest
 * rotation. */
SW_HOT
static double advance_tension(size_t m, const double *restrict delta, const double *restrict rest,
                              const double *restrict l, const double *restrict rl,
                              const double *restrict tx, const double *restrict ty,
                              const double *restrict tz, double EA, double EA_push,
                              double *restrict tension) {
  double largest = 0.0;
  for (size_t e = 0; e < m; e++) {
    const double dx = delta[3 * e + 3] - delta[3 * e];
    const double dy = delta[3 * e + 4] - delta[3 * e + 1];
    const double dz = delta[3 * e + 5] - delta[3 * e + 2];
    const double along = dx * tx[e] + dy * ty[e] + dz * tz[e];
    const double across2 = (dx * dx + dy * dy + dz * dz - along * along) * rl[e] * rl[e];
    const double strain = (l[e] + along) / rest[e] - 1.0;
    const double stiffness = strain >= 0 ? EA : EA_push;
    tension[e] = stiffness * strain;
    largest = largest > across2 ? largest : across2;
  }
  return largest;
}

static double inertia_of(const sw_stage *stage) {
  return stage->inertia > 0 ? stage->inertia : 1.0;
}

/* Factor of the mass [1/s2]. */
static double mass_rate(const sw_stage *stage) {
  return isfinite(stage->hbar) ? inertia_of(stage) * (1.0 / (stage->hbar * stage->hbar)) : 0.0;
}

/* Wire in a guide has the speed of the feed. In a search for rest it stands there as the others do,
 * or dashpots would pull at the first edge: by 400 N (spec/contact/pushed_hole_spec). */
static void stage_velocity(const sw_system *s, const sw_stage *stage, int statics) {
  const double rate = statics ? 0.0 : 1.0 / stage->hbar;
  SW_PART_EACH(s, b) {
    const size_t first = 3 * s->bodies[b].first_node, end = first + 3 * s->bodies[b].plan->nodes;
    for (size_t i = first; i < end; i++) s->velocity[i] = (stage->y[i] - stage->xhat[i]) * rate;
    for (size_t k = statics ? 0 : s->bodies[b].held; k; k = s->held[k - 1].next)
      if (s->held[k - 1].slides && !s->still)
        sw_system_held_velocity(s, &s->held[k - 1], s->velocity + 3 * s->held[k - 1].node);
  }
  if (!statics) sw_strain_show_held(s, stage->y, rate, s->velocity);
  if (!statics) sw_rails_velocity(s, stage, s->velocity);
}

/* Solves for the update of a body without bridges. */
static sw_status solve_body(const sw_system *s, sw_body *body, size_t *negative) {
  double *delta = s->delta + 3 * body->first_node;
  if (s->goes_on) {
    sw_blocks_solve(body->blocks, delta);
    return SW_OK;
  }
  if (body->spin_block) return sw_spin_solve(s, body, delta, negative);
  if (body->plan->web) return sw_web_solve(body, delta, negative);
  SW_TRY(sw_band3_factor(body->field.rows, body->plan->nodes, body->field.rows, negative));
  sw_band3_solve(body->field.rows, body->plan->nodes, delta);
  if (body->has_twist) *negative -= sw_twist_correct(body, delta);
  return SW_OK;
}

static sw_status assemble_and_solve(sw_system *s, const sw_stage *stage, const sw_newton *newton,
                                    sw_stage_report *report, sw_error *err) {
  const int statics = newton->statics;
  const double rate2 = mass_rate(stage);
  int velocity = 0;
  SW_PART_EACH(s, b) velocity |= s->bodies[b].needs_velocity;
  if (velocity) stage_velocity(s, stage, statics);
  if (!sw_part_is_single(s)) sw_joins_twist(s, stage->y);
  SW_PART_EACH(s, b)
  SW_TRY(sw_body_evaluate(s, &s->bodies[b], stage->time, stage->hbar, stage->y, s->velocity,
                          statics, report->iterations, err));
  sw_bridges_begin(s);
  if (s->coupling.eval)
    SW_TRY(s->coupling.eval(s->coupling.user, s, stage->time, stage->hbar, stage->y,
                            SW_WANT_FORCE | (s->goes_on ? 0u : SW_WANT_STIFFNESS), err));
  if (!sw_part_is_single(s)) SW_TRY(sw_joins_eval(s, stage->y));
  SW_PART_EACH(s, b) {
    sw_field *f = &s->bodies[b].field;
    const size_t at = 3 * s->bodies[b].first_node;
    if (!s->goes_on) sw_gather_rows(f, rate2, f->rows);
    sw_gather_residual(f, rate2, f->x, s->yhat + at, s->delta + at);
    if (f->plan->web && !s->goes_on) sw_web_gather(&s->bodies[b]);
  }
  SW_PART_EACH(s, b) sw_held_take_out(s, &s->bodies[b]);
  if (statics) sw_lead_rows(s, stage->y);
  report->negative = 0;
  if (sw_interrupted()) return SW_EINTR;
  if (sw_bridges_any(s)) SW_TRY(sw_bridges_solve(s, &report->negative));
  SW_PART_EACH(s, b) {
    sw_body *body = &s->bodies[b];
    if (body->bridged && sw_bridges_any(s)) continue;
    size_t negative = 0;
    SW_TRY(solve_body(s, body, &negative));
    report->negative += negative;
    s->counters.solves++;
  }
  sw_rails_solve(s, stage, &report->negative);
  report->share = s->coupling.refine && !s->goes_on ? s->coupling.refine(s->coupling.user, s) : 1.0;
  if (statics) sw_lead_update(s, stage->y);
  if (!s->goes_on) sw_factors_keep(s, stage, newton, report);
  s->counters.newton++;
  s->counters.evaluations++;
  return SW_OK;
}

/* Solves one iterate; delta is the full update. */
static sw_status solve_once(sw_system *s, const sw_stage *stage, const sw_newton *newton,
                            sw_stage_report *report, sw_error *err) {
  sw_rails_follow(s, stage, newton->statics);
  SW_TRY(sw_factors_serve(s, stage, newton, report, &s->goes_on, err));
  const sw_status status = assemble_and_solve(s, stage, newton, report, err);
  s->goes_on = 0;
  return status;
}

/* Computes a body's axial forces after the update. Returns the square of its largest rotation. */
static double advance_axial(sw_system *s, const sw_body *b) {
  const sw_field *f = &b->field;
  const double *delta = s->delta + 3 * b->first_node;
  double *axial = s->tension_new + b->first_edge;
  if (b->plan->web) return sw_web_advance(b, f->x, delta, axial);
  return advance_tension(b->plan->edges, delta, b->plan->rest, f->length, f->reciprocal,
                         f->tangent[0], f->tangent[1], f->tangent[2], b->EA, b->EA_push, axial);
}

/* Largest shift that a static solve may give an unheld mesh, over its radius [-]. */
static const double LOOSE = 0.1;

/* An unheld mesh has directions without stiffness. In these, rounding alone could throw it to where
 * nothing pulls at it any more. Returns 1 if the update is that large. Inertia, also that of
 * pseudo-transient steps, determines the motion. */
static int flies_off(const sw_body *b, const double *delta) {
  const double most = LOOSE * b->plan->beam.radius;
  double largest = 0;
  for (size_t i = 0; i < b->plan->nodes; i++) {
    if (b->plan->held[i] != SW_FREE) return 0;
    largest = fmax(largest, sw_norm(sw_load(delta + 3 * i)));
  }
  return largest > most;
}

/* Returns the largest share of a body's update that its forces can follow. */
static double followed(sw_body *body, const double *delta) {
  double share = 1.0;
  SW_ITEMS(const sw_term, term, body->terms, body->term_count) {
    if (!term->cls->largest_share) continue;
    body->field.history = term->history;
    share = fmin(share, term->cls->largest_share(term->args, &body->field, delta));
  }
  return share;
}

/* Returns the share of the update to make: less than 1 if the coupling, a force or an edge's
 * rotation limits it, 0 if an unheld mesh would fly off, -1 if the update is not finite. */
static double share_of(sw_system *s, const sw_newton *newton, sw_stage_report *report) {
  double largest = 0, share = report->share;
  int flying = 0;
  SW_PART_EACH(s, b) {
    sw_body *body = &s->bodies[b];
    const double turn2 = advance_axial(s, body);
    if (s->strain_past) sw_strain_advance(s, body);
    share = fmin(share, followed(body, s->delta + 3 * body->first_node));
    if (body->plan->web && newton->statics)
      flying |= flies_off(body, s->delta + 3 * body->first_node);
    if (!(turn2 <= largest)) largest = turn2;
    if (!body->spin_block) continue;
    const double spin = sw_spin_largest(body);
    if (!(spin * spin <= largest)) largest = spin * spin;
  }
  if (!isfinite(largest)) return -1;
  if (flying) return 0;
  report->rotation = sqrt(fmax(largest, 0.0));
  if (report->rotation > newton->limit_rotation)
    share = fmin(share, newton->limit_rotation / report->rotation);
  return share;
}

static void apply(sw_system *s, const sw_stage *stage, double share) {
  SW_PART_EACH(s, b) {
    sw_body *body = &s->bodies[b];
    const size_t first = 3 * body->first_node, end = first + 3 * body->plan->nodes;
    const size_t axial = sw_plan_axial(body->plan);
    double *T = s->tension + body->first_edge;
    const double *to = s->tension_new + body->first_edge;
    for (size_t i = first; i < end; i++) stage->y[i] += share * s->delta[i];
    if (body->spin_block) sw_spin_turn(body, share);
    if (share == 1.0)
      memcpy(T, to, axial * sizeof *T);
    else
      for (size_t e = 0; e < axial; e++) T[e] += share * (to[e] - T[e]);
  }
  if (s->strain_past) sw_strain_take(s, share);
  sw_rails_apply(s, stage, share);
}

static sw_status begin(sw_system *s, const sw_stage *stage, int statics, sw_error *err) {
  const double h = statics ? 0.0 : stage->hbar;
  sw_parts_begin(s);
  for (size_t i = 0; i < s->freedoms; i++)
    stage->y[i] = s->yhat[i] = stage->xhat[i] + h * stage->vhat[i];
  if (s->waiting) sw_waits_place(s, stage);
  s->from = stage->from, s->to = stage->to;
  const sw_status status = sw_system_place_holds(s, stage->time, stage->y, stage->v, stage->a, err);
  s->from = s->to = 0;
  SW_TRY(status);
  for (size_t k = 0; k < s->held_count; k++)
    for (size_t c = 0; c < 3; c++) {
      const size_t i = 3 * s->held[k].node + c;
      s->yhat[i] = stage->y[i] - h * h / inertia_of(stage) * (stage->a ? stage->a[i] : 0.0);
    }
  sw_strain_place(s);
  sw_rails_begin(s, stage, statics);
  if (statics) sw_lead_begin(s, stage);
  if (!statics) SW_TRY(sw_start_check(s, stage->y, err));
  sw_spin_begin_stage(s, mass_rate(stage));
  if (s->coupling.begin_stage)
    SW_TRY(s->coupling.begin_stage(s->coupling.user, s, stage->time, stage->first, err));
  return SW_OK;
}

/* Computes velocity and acceleration of the solved stage. */
SW_HOT
static void stage_rates(size_t n, double rate, double inertia, const double *restrict y,
                        const double *restrict xhat, const double *restrict yhat,
                        double *restrict v, double *restrict a) {
  for (size_t i = 0; i < n; i++) {
    v[i] = (y[i] - xhat[i]) * rate;
    a[i] = (y[i] - yhat[i]) * rate * rate * inertia;
  }
}

static void finish(sw_system *s, const sw_stage *stage, int statics) {
  const double rate = statics || !isfinite(stage->hbar) ? 0.0 : 1.0 / stage->hbar;
  sw_rails_follow(s, stage, statics);
  sw_spin_end_stage(s, stage->y);
  if (stage->a)
    stage_rates(s->freedoms, rate, inertia_of(stage), stage->y, stage->xhat, s->yhat, stage->v,
                stage->a);
  else
    for (size_t i = 0; i < s->freedoms; i++) stage->v[i] = (stage->y[i] - stage->xhat[i]) * rate;
  if (s->waiting) sw_waits_finish(s, stage);
  SW_ITEMS(sw_held_node, h, s->held, s->held_count) {
    if (!s->bodies[h->body].waits) sw_held_react(s, h);
    sw_system_held_velocity(s, h, stage->v + 3 * h->node);
  }
  sw_bridges_react(s);
  sw_rails_finish(s, stage);
  sw_strain_finish(s, stage->y);
}

/* Spins without inertia may have no equilibrium nearby, e.g. after the release of a flat wire on
 * its edge. From iteration STEADY on they have inertia. */
enum { STEADY = 7 };

/* Returns the largest number of iterations: twice as many for wires in a bundle, because their many
 * touches need more to agree and this costs less than two half steps; also for single wires that
 * are solved one by one [-]. */
static int most_iterations(const sw_system *s, const sw_newton *newton) {
  const int bundle = sw_bridges_any(s) && !newton->statics;
  return newton->max_iterations * (bundle || sw_part_is_single(s) ? 2 : 1);
}

/* If an update throws wires of a bundle too far, touches learn little from it. After this many
 * shortened updates stages hardly ever converged [-]. */
enum { MOST_THROWN = 3 };

static int is_thrown(const sw_system *s, const sw_newton *newton, int shortened) {
  return shortened >= MOST_THROWN && !newton->statics && sw_bridges_any(s);
}

/* Touches of a bundle that do not agree shorten update after update. About one in twenty stages
 * converged after losing more whole updates than this; the others took all iterations in vain
 * [-]. */
static const double MOST_LOST = 6.0;

static int disagrees(const sw_system *s, const sw_newton *newton, double lost) {
  return lost > MOST_LOST && !newton->statics && sw_bridges_any(s);
}

static sw_status iterate(sw_system *s, const sw_stage *stage, const sw_newton *newton,
                         sw_stage_report *report, sw_error *err) {
  int waits = 0, far = 0, shortened = 0;
  double lost = 0; /* sum of the shares by which touches shortened updates [-] */
  for (int i = 1; i <= most_iterations(s, newton); i++) {
    report->iterations = i;
    if (sw_interrupted()) return SW_EINTR;
    if (i == STEADY && !newton->statics) sw_spin_slow_down(s, mass_rate(stage));
    SW_TRY(solve_once(s, stage, newton, report, err));
    const double share = share_of(s, newton, report);
    if (share < 0) return sw_fail(err, SW_EDIVERGED, "positions are no longer finite numbers");
    if (share == 0) return sw_fail(err, SW_ENOCONV, "nothing holds a wire in its place");
    far += share < report->share;
    if (sw_lead_fails(s, newton, far, shortened))
      return sw_fail(err, SW_ENOCONV, "wires would go too far in %d iterations", i);
    if (sw_lead_waits(s, newton, stage->y, share, &waits)) continue;
    shortened += share < report->share;
    if (is_thrown(s, newton, shortened))
      return sw_fail(err, SW_ENOCONV, "wires of a bundle would be thrown apart");
    lost += 1.0 - report->share;
    if (disagrees(s, newton, lost))
      return sw_fail(err, SW_ENOCONV, "touches of a bundle do not agree");
    apply(s, stage, share);
    if (share < 1.0) continue;
    if (sw_stage_converged(s, stage, newton, report, mass_rate(stage))) return SW_OK;
  }
  return sw_fail(err, SW_ENOCONV, "no convergence in %d iteration%s", report->iterations,
                 report->iterations == 1 ? "" : "s");
}

/* Solves one part. The report is of the part with most iterations. */
static sw_status iterate_part(sw_system *s, const sw_stage *stage, const sw_newton *newton,
                              sw_stage_report *report, sw_error *err) {
  sw_stage_report own = {0};
  if (s->coupling.part) s->coupling.part(s->coupling.user, s);
  const sw_status status = iterate(s, stage, newton, &own, err);
  if (own.iterations > report->iterations) report->iterations = own.iterations;
  report->rotation = fmax(report->rotation, own.rotation);
  report->negative += own.negative;
  return status;
}

/* Solves the bodies without coupling one after another, then the coupled ones together, so that
 * their bridges are still there at the stage's end. One evaluation covers all bodies. */
static sw_status iterate_parts(sw_system *s, const sw_stage *stage, const sw_newton *newton,
                               sw_stage_report *report, sw_error *err) {
  sw_status status = SW_OK;
  int group = 0;
  const sw_counters before = s->counters;
  for (size_t b = 0; b < s->body_count && status == SW_OK; b++) {
    group |= s->bodies[b].coupled;
    if (s->bodies[b].coupled || s->bodies[b].waits) continue;
    s->part = b, s->part_end = b + 1;
    status = iterate_part(s, stage, newton, report, err);
  }
  s->part = 0, s->part_end = s->body_count;
  s->group = group && status == SW_OK;
  if (s->group) status = iterate_part(s, stage, newton, report, err);
  s->group = 0;
  if (s->coupling.part) s->coupling.part(s->coupling.user, s);
  s->counters.newton = before.newton + (size_t)report->iterations;
  s->counters.evaluations = before.evaluations + (size_t)report->iterations;
  return status;
}

/* 1 if there is one body only, and it waits. */
static int all_waits(const sw_system *s) { return s->body_count == 1 && s->bodies[0].waits; }

static sw_status solve(sw_system *s, const sw_stage *stage, const sw_newton *newton,
                       sw_stage_report *report, sw_error *err) {
  SW_TRY(begin(s, stage, newton->statics, err));
  if (sw_parts_any(s, newton))
    SW_TRY(iterate_parts(s, stage, newton, report, err));
  else if (!all_waits(s))
    SW_TRY(iterate(s, stage, newton, report, err));
  if (!sw_spins_are_whole(s, stage->y, report->iterations))
    return sw_fail(err, SW_ENOCONV, "a wire would be thrown through itself");
  finish(s, stage, newton->statics);
  return SW_OK;
}

sw_status sw_system_stage(sw_system *s, const sw_stage *stage, const sw_newton *newton,
                          sw_stage_report *report, sw_error *err) {
  *report = (sw_stage_report){0};
  s->loads_kept = 0, s->first.x = NULL;
  if (stage->strain_past) sw_strain_begin_stage(s, stage);
  s->inner = stage->inner, s->stays = 0;
  const sw_status status = solve(s, stage, newton, report, err);
  s->inner = 0;
  sw_strain_end_stage(s);
  return status;
}
