/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Convergence of a stage's iterate. */
#include <math.h>

#include "base/each.h"
#include "system/assemble.h"
#include "system/factors.h"
#include "system/join.h"
#include "system/part.h"
#include "system/rail.h"
#include "system/stage_parts.h"
#include "system/web.h"

/* Like fmax, but inline: these loops run over all numbers of a wire in each iteration. */
static inline double larger(double most, double x) { return x > most ? x : most; }

static double largest_shift(const sw_system *s) {
  double largest = 0;
  SW_PART_EACH(s, b) {
    const double *delta = s->delta + 3 * s->bodies[b].first_node;
    for (size_t i = 0; i < 3 * s->bodies[b].plan->nodes; i++)
      largest = larger(largest, fabs(delta[i]));
  }
  return largest;
}

/* A smaller shift in an iteration, over the wire's length, counts as the fixed point of forces
 * without stiffness, and as the right side of a stiffness's jumps [-]. */
static const double FIXED_POINT = 1e-9;

/* Rounding of the solve: along stiff edges a shift delta has the error eps (ka/kb) delta, with an
 * edge's stiffness ka along and kb across. The error of its axial force is ka times that. */
static const double ROUNDING = 2.3e-16; /* [-] */
/* Accepted error of an axial force, over the wire's weight or bending force [-]. */
static const double FORCE_NOISE = 1e-3;

/* Returns the larger of a body's weight and its bending force [N]. */
static double usual_force(const sw_system *s, const sw_body *b) {
  const double L = b->plan->length, EI = b->plan->beam.EI;
  return fmax(b->plan->beam.mass * L * sw_norm(sw_load(s->gravity)), EI / (L * L));
}

/* Returns the largest shift for which a body's axial forces are accurate [m]. */
static double trusted_shift(const sw_system *s, const sw_body *b, double hbar, int statics) {
  const sw_plan *p = b->plan;
  const double L = p->length, l = L / (double)p->edges;
  const double ka = b->EA / l;
  const double inertia = statics || !isfinite(hbar) ? 0.0 : p->beam.mass * l / (hbar * hbar);
  const double kb = 12.0 * p->beam.EI / (l * l * l) + inertia;
  return FORCE_NOISE * usual_force(s, b) * kb / (ROUNDING * ka * ka);
}

static int drowned_in_rounding(const sw_system *s, const sw_stage *stage, int statics) {
  double shift = -1;
  SW_PART_EACH(s, b) {
    const sw_body *body = &s->bodies[b];
    if (body->plan->web) continue; /* its springs form no chain in which rounding adds up */
    const double trusted = trusted_shift(s, body, stage->hbar, statics);
    if (!(trusted < body->plan->length && trusted > 0)) continue;
    if (shift < 0) shift = largest_shift(s);
    if (shift > trusted) return 1;
  }
  return 0;
}

/* Accepted error of a bending moment, over the wire's length times the sum of its weight and
 * inertia force; updates below the second number are rounding [-]. */
static const double MOMENT_NOISE = 1e-4, LEAST_UPDATE = 1e-5;

static double fastest(const sw_system *s, const sw_body *b, const sw_stage *stage, double rate2) {
  double largest2 = 0;
  for (size_t i = b->first_node; i < b->first_node + b->plan->nodes; i++) {
    const sw_vec off = sw_sub(sw_load(stage->y + 3 * i), sw_load(s->yhat + 3 * i));
    largest2 = larger(largest2, sw_norm2(off));
  }
  return sqrt(largest2) * rate2;
}

/* An update by the share u of an edge's length, along or across, leaves an error of about EI u^2 /
 * l in a hinge's moment, dashpots included: the moment is linear in the update, the edges are not.
 * For soft wires the rotation limit keeps this small. In stiff wires that turned fast the error was
 * a thousand times the moment of the inertia forces. Returns 1 if it is too large. */
static int bends_roughly(const sw_system *s, const sw_stage *stage, const sw_newton *newton,
                         double rate2) {
  if (newton->statics) return 0;
  SW_PART_EACH(s, k) {
    const sw_body *b = &s->bodies[k];
    const sw_plan *p = b->plan;
    const double stiff = p->beam.EI + b->viscosity / stage->hbar;
    const double hinge = stiff * (double)p->edges / p->length;
    const double arm = MOMENT_NOISE * p->beam.mass * p->length * p->length;
    const double weight = arm * sw_norm(sw_load(s->gravity)), u = newton->accept_rotation;
    double largest = 0;
    if (p->web || hinge * u * u <= weight) continue;
    for (size_t e = 0; e < p->edges; e++) {
      const double *d = s->delta + 3 * (b->first_node + e), r = b->field.reciprocal[e];
      largest = larger(largest, sw_norm2(sw_sub(sw_load(d + 3), sw_load(d))) * r * r);
    }
    if (stiff * largest <= p->beam.EI * LEAST_UPDATE * LEAST_UPDATE || hinge * largest <= weight)
      continue;
    if (hinge * largest > weight + arm * fastest(s, b, stage, rate2)) return 1;
  }
  return 0;
}

/* After an update by the share u of an edge's length across it, the edge is longer by l u^2/2 than
 * in the linear axial law. The next step begins with that length, and so with T l u^2/2 more
 * energy. An update may leave this share of the kinetic energy and of the weight times the radius.
 * It is half of the referee's limit for a step. A cable drawn over an edge by 500 N gained 4e-5 of
 * its energy in a step: 56 of 670 steps were redone, now 2; with twice this share it is 47 at some
 * step sizes (spec/contact/taut_edge_spec) [-]. */
static const double ENERGY_NOISE = 5e-4;

static double kinetic_of(const sw_body *b, const sw_stage *stage) {
  const double rate = 1.0 / stage->hbar;
  double sum = 0;
  for (size_t i = 0; i < b->plan->nodes; i++) {
    const size_t at = 3 * (b->first_node + i);
    const sw_vec way = sw_sub(sw_load(stage->y + at), sw_load(stage->xhat + at));
    if (isfinite(b->plan->lumped[i])) sum += b->plan->lumped[i] * sw_norm2(way);
  }
  return 0.5 * sum * rate * rate;
}

/* Returns the energy of the update's error in length, if each edge turned by u [J]. */
static double off_by_turn(const sw_system *s, const sw_body *b, double u) {
  const double *T = s->tension + b->first_edge, *rest = b->plan->rest;
  double sum = 0;
  for (size_t e = 0; e < b->plan->edges; e++) sum += larger(0.0, T[e]) * rest[e];
  return 0.5 * sum * u * u;
}

/* Returns this energy for the update itself [J]. */
static double off_by_update(const sw_system *s, const sw_body *b) {
  const double *T = s->tension + b->first_edge, *rest = b->plan->rest;
  const sw_field *f = &b->field;
  double sum = 0;
  for (size_t e = 0; e < b->plan->edges; e++) {
    const double *d = s->delta + 3 * (b->first_node + e), r = f->reciprocal[e];
    const sw_vec t = sw_v(f->tangent[0][e], f->tangent[1][e], f->tangent[2][e]);
    const sw_vec turn = sw_scale(sw_sub(sw_load(d + 3), sw_load(d)), r);
    const double along = sw_dot(turn, t);
    sum += larger(0.0, T[e]) * rest[e] * larger(0.0, sw_norm2(turn) - along * along);
  }
  return 0.5 * sum;
}

/* 1 if the update changes the lengths of a taut wire's edges too much for the linear axial law. */
static int pulls_roughly(const sw_system *s, const sw_stage *stage, const sw_newton *newton,
                         const sw_stage_report *report) {
  if (!newton->keeps_energy || report->rotation <= LEAST_UPDATE) return 0;
  SW_PART_EACH(s, k) {
    const sw_body *b = &s->bodies[k];
    if (b->plan->web || !isfinite(stage->hbar)) continue;
    const double weight = ENERGY_NOISE * usual_force(s, b) * b->plan->beam.radius;
    if (off_by_turn(s, b, report->rotation) <= weight) continue;
    const double most = weight + ENERGY_NOISE * kinetic_of(b, stage);
    if (off_by_update(s, b) > most) return 1;
  }
  return 0;
}

/* The same error in length makes a straight wire between two holds too tight, by EA times the mean
 * of u^2/2. It pushed a cable that sank onto a table in its first step with the cable's whole
 * weight. An update may leave PULL_NOISE of the usual force or of the tension. A wire with SLACKER
 * times this length to spare takes it up by its sag [-]. */
static const double PULL_NOISE = 1e-2, SLACKER = 20.0;

/* Returns the error of the axial force between two held nodes of a body, 0 if sag takes it up
 * [N]. */
static double false_pull(const sw_system *s, const sw_body *b, const double *y, size_t from,
                         size_t to) {
  const sw_plan *p = b->plan;
  const double *delta = s->delta + 3 * b->first_node, *x = y + 3 * b->first_node;
  const sw_field *f = &b->field;
  const double length = p->s[to] - p->s[from];
  double longer = 0;
  for (size_t e = from; e < to; e++) {
    const sw_vec t = sw_v(f->tangent[0][e], f->tangent[1][e], f->tangent[2][e]);
    const sw_vec turn =
        sw_scale(sw_sub(sw_vec_at(delta, e + 1), sw_vec_at(delta, e)), f->reciprocal[e]);
    const double along = sw_dot(turn, t);
    longer += 0.5 * p->rest[e] * larger(0.0, sw_norm2(turn) - along * along);
  }
  const double spare = length - sw_dist(sw_vec_at(x, from), sw_vec_at(x, to));
  return spare > SLACKER * longer ? 0 : b->EA * longer / length;
}

/* 1 if the update makes a straight wire between holds too tight or too loose. */
static int tightens_roughly(const sw_system *s, const sw_stage *stage, const sw_newton *newton,
                            const sw_stage_report *report) {
  if (newton->statics) return 0;
  const double most = 0.5 * report->rotation * report->rotation;
  SW_PART_EACH(s, k) {
    const sw_body *b = &s->bodies[k];
    const sw_plan *p = b->plan;
    const double usual = PULL_NOISE * usual_force(s, b);
    if (p->web || !(b->EA * most > usual)) continue;
    for (size_t i = 0, from = p->nodes; i < p->nodes; i++) {
      if (p->held[i] == SW_FREE) continue;
      const double T = i > 0 ? fabs(s->tension[b->first_edge + i - 1]) : 0;
      if (from + 1 < i && false_pull(s, b, stage->y, from, i) > fmax(usual, PULL_NOISE * T))
        return 1;
      from = i;
    }
  }
  return 0;
}

/* Solid elements have no axial force of their own with a linear law. An update that changes edges
 * by the share u leaves an error of up to EA u^2/2 in the force of a section, and the next step
 * begins with it. A section released by pads had 19 weights a step later. Each element has its own
 * error, and most cancel: about a two-hundredth of the bound was seen. An update may leave this
 * bound, over the usual force and the inertia force [-]. */
static const double SOLID_NOISE = 1.0;

/* 1 if the update changes solid elements too much for the solve's linearised forces. */
static int deforms_roughly(const sw_system *s, const sw_stage *stage, const sw_newton *newton,
                           double rate2) {
  if (newton->statics) return 0;
  SW_PART_EACH(s, k) {
    const sw_body *b = &s->bodies[k];
    const sw_plan *p = b->plan;
    if (!p->web || !p->web->solids || !p->web->rings) continue;
    const size_t at = 3 * b->first_node;
    const double u = sw_web_change(b, b->field.x, NULL, s->delta + at);
    const double off = 0.5 * p->beam.EA * u * u, usual = SOLID_NOISE * usual_force(s, b);
    if (!(off > usual)) continue;
    if (off > usual + SOLID_NOISE * p->beam.mass * p->length * fastest(s, b, stage, rate2))
      return 1;
  }
  return 0;
}

static double usual_force_at(const sw_system *s, size_t node) {
  return usual_force(s, &s->bodies[sw_system_body_of(s, node)]);
}

/* 1 if some tie's pull at the new places differs from the linearised pull of the solve: the tie was
 * slack before the update, or turned far in it. */
static int mistakes_ties(const sw_system *s, const double *y) {
  if (sw_part_is_single(s)) return 0;
  for (size_t k = 0; s->joins && k < s->joins->spring_count; k++) {
    const sw_join_spring *tie = &s->joins->springs[k];
    if (!tie->tie || !(tie->k > 0)) continue;
    const sw_vec now = sw_join_spring_force(tie, y);
    const double off = sw_dist(now, sw_join_tie_expected(tie, y, s->delta));
    const double usual = fmin(usual_force_at(s, tie->i), usual_force_at(s, tie->j));
    if (off > FORCE_NOISE * fmax(usual, sw_norm(now))) return 1;
  }
  return 0;
}

/* 1 if the last matrix may have hidden unstable directions: cautious iterations omit the negative
 * stiffness of meshes and of particles that repel each other. */
static int hides_directions(const sw_system *s, const sw_newton *newton,
                            const sw_stage_report *report) {
  if (!newton->counts || !sw_evaluate_cautious(report->iterations)) return 0;
  SW_PART_EACH(s, b) {
    if (s->bodies[b].plan->web || s->bodies[b].web_pair_count) return 1;
  }
  return 0;
}

/* Accepted mistake of forces whose stiffness may jump, over the wire's weight or bending force; and
 * the shift, over the wire's length, above which an update has not such a small one [-]. */
static const double KINK_NOISE = 1e-5, NEARLY = 1e-6;

/* 1 if the forces whose stiffness may jump are, after the update, what the solve expected of them,
 * so that no jump was passed. In a clip's swings shifts over the length were 8e-5, 5e-9, 1e-15:
 * a third iteration only showed that the second was the last. */
static int expects_kinks(const sw_system *s, const sw_body *b, const sw_stage *stage) {
  const double *x = stage->y + 3 * b->first_node, *delta = s->delta + 3 * b->first_node;
  double off = 0;
  if (b->is_explicit || b->plan->web) return 0;
  SW_ITEMS(const sw_term, t, b->terms, b->term_count) {
    if (!t->cls->commit || (t->cls->idle && t->history && t->cls->idle(t->history))) continue;
    if (!t->cls->mistake) return 0;
    off += t->cls->mistake(t->args, &b->field, t->history, x, delta);
  }
  return off <= KINK_NOISE * usual_force(s, b);
}

/* 1 if a body with such forces, or with forces without stiffness, needs another iteration: its
 * update is not a fixed point, and it is not known that the next one would be. A search for rest
 * goes on to the fixed point: its end is a result, not the start of a step that mends it. */
static int misses_kinks(const sw_system *s, const sw_stage *stage, const sw_newton *newton) {
  SW_PART_EACH(s, k) {
    const sw_body *b = &s->bodies[k];
    if (!b->is_explicit && !b->is_kinked) continue;
    const double shift = largest_shift(s) / b->plan->length;
    if (shift <= FIXED_POINT) continue;
    if (!newton->keeps_energy || !(shift <= NEARLY) || !expects_kinks(s, b, stage)) return 1;
  }
  return 0;
}

int sw_stage_converged(sw_system *s, const sw_stage *stage, const sw_newton *newton,
                       const sw_stage_report *report, double rate2) {
  /* contact sees rough updates too: the next iteration starts from its findings */
  s->rough = sw_factors_stale(s, report) || report->rotation > newton->accept_rotation ||
             bends_roughly(s, stage, newton, rate2) || pulls_roughly(s, stage, newton, report) ||
             deforms_roughly(s, stage, newton, rate2);
  const int settled =
      !s->coupling.settled || s->coupling.settled(s->coupling.user, s, stage->y, s->delta);
  if (!settled || s->rough) return 0;
  if (newton->statics && largest_shift(s) > newton->accept_shift) return 0;
  if (!sw_rails_settled(s) || mistakes_ties(s, stage->y)) return 0;
  if (tightens_roughly(s, stage, newton, report)) return 0;
  if (drowned_in_rounding(s, stage, newton->statics)) return 0;
  if (hides_directions(s, newton, report)) return 0;
  return !misses_kinks(s, stage, newton);
}
