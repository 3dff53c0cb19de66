/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pseudo-transient continuation: implicit Euler with velocities forgotten and a growing step. It
 * follows the path that the wires would take. */
#include <math.h>
#include <string.h>

#include "body/touching.h"
#include "step/statics.h"

static const double LARGEST_GROWTH = 1e6; /* of the first pseudo step [-] */

/* Returns the factor on the pseudo step, from the iterations of the last one [-]. Where wires
 * touch, a failed step costs more than a long step gains. In steps shorter than the first one the
 * imbalance shifts wires so little that some touches would need many iterations in every step to
 * find their states. Such steps grow until one fails. */
static double growth(const sw_scene *s, size_t iterations, int is_small) {
  if (!sw_scene_has_contact(s) || iterations <= 8) return 1.6;
  return iterations <= 14 || is_small ? 1.1 : 0.7;
}

/* Continuation leaves out the negative stiffness of compressed wires, which would lead to unstable
 * places. Where compression cancels nearly all stiffness, as of a wire that has buckled sideways
 * under friction, it repeats almost the same step thousands of times. After MANY_ALIKE successive
 * steps that are alike (cosine above ALIKE, length above ALMOST of the step before), the steps that
 * their ratio predicts are taken at once. This excites other modes, which AGAIN_ALIKE further steps
 * damp. With half as many, 6 of 100 runs of cables on pegs do not come to rest; with twice as many
 * all do (spec/physics/peg_poses_spec) [-]. */
enum { MANY_ALIKE = 20, AGAIN_ALIKE = 8 };
static const double ALIKE = 0.99, ALMOST = 0.9;
/* FARTHEST: largest shift at once, over the longest wire; with half and with twice of it all runs
 * come to rest too. LONGER: the shift was too far if the next steps are longer by this factor
 * [-]. */
static const double FARTHEST = 4e-4, LONGER = 1.5;

typedef struct drift {
  double size;   /* of the last step, which is p->way [m] */
  double before; /* size of the last step from which many were taken at once; 0: none yet [m] */
  double most;   /* largest shift at once [m] */
  int alike;     /* steps alike in a row [-] */
} drift;

void sw_rest_go_on(sw_statics *p, double times) {
  sw_system *s = sw_scene_system(p->s);
  for (size_t i = 0; i < s->freedoms; i++) p->y[i] = s->x[i] + times * p->way[i];
  sw_system_follow(s, p->y);
  memcpy(s->x, p->y, s->freedoms * sizeof(double));
}

/* If the last steps were alike, takes many more of them at once. */
static void hurry(sw_statics *p, drift *d) {
  const sw_system *s = sw_scene_system(p->s);
  double size = 0, along = 0;
  for (size_t i = 0; i < s->freedoms; i++) {
    const double shift = p->y[i] - p->from[i];
    if (i < 3 * s->nodes) size += shift * shift, along += shift * p->way[i];
    p->way[i] = shift;
  }
  const double before = d->size, share = before > 0 ? along / (before * before) : 0.0;
  d->size = sqrt(size);
  d->alike = share > ALMOST && along > ALIKE * d->size * before ? d->alike + 1 : 0;
  if (d->alike < (d->before > 0 ? AGAIN_ALIKE : MANY_ALIKE)) return;
  const double longest = FARTHEST * sw_rest_longest(p->s);
  d->most = !(d->before > 0)               ? longest
            : d->size > LONGER * d->before ? 0.5 * d->most
                                           : 2.0 * d->most;
  d->most = fmin(d->most, longest);
  d->before = d->size, d->alike = 0;
  const double left = share < 1 ? share / (1.0 - share) : HUGE_VAL;
  sw_rest_go_on(p, fmin(left, d->most / fmax(p->report->residual, 1e-300)));
}

static const sw_newton CONTINUE = {
    .max_iterations = 30, .accept_rotation = 0.01, .limit_rotation = 0.3, .counts = 1};

/* Factors on the pseudo step after a failure. Just below the longest stable step wires leave an
 * unstable place fastest: with 0.25, 1.3 times as many iterations [-]. */
static const double SHORTER = 0.25, SHORTER_UNSTABLE = 0.6;

static int has_meshes(const sw_system *s) {
  int meshes = 0;
  for (size_t b = 0; b < s->body_count; b++) meshes |= s->bodies[b].plan->web != NULL;
  return meshes;
}

/* Share of the first step below which a step may end anywhere. A mesh that rolls over a corner had
 * unstable directions in steps of half the first one, which threw it to and fro between two places
 * (spec/contact/sinking_poses_spec) [-]. */
static const double LEAST_STABLE = 0.3;

/* 1 if a step of continuation ended where meshes, with the mass of this step, are unstable. Their
 * stiffness is the whole one, so a long step may end in any equilibrium. Meshes that obstacles drag
 * along follow these. */
static int ends_unstable(const sw_statics *p, double tau) {
  const sw_system *s = sw_scene_system(p->s);
  return has_meshes(s) && p->report->negative > 0 && tau > LEAST_STABLE * sw_rest_first_step(p->s);
}

/* Share of all iterations after which unstable steps are taken, too: wires that slide or yield may
 * have no stable place nearby [-]. */
static const double PATIENCE = 0.5;

/* A wire that obstacles or other wires drag along must follow in the first step of continuation,
 * for friction then forgets what it slid, unless the search keeps that. So the inertia in this step
 * must be small beside friction: below 1/LED^2 of the weight, and 1/LEAST_LED^2 after failures.
 * Else a pose is halved
 * [-]. */
static const double LED = 30.0, LEAST_LED = 7.0;

/* Returns how far obstacles or held and fed wires lead others along [m]. */
static double led_by(const sw_statics *p) { return fmax(p->leads, sw_rest_dragged(p)); }

/* Returns the time in which a wire falls about as far [s]. */
static double led_time(const sw_statics *p) {
  return sqrt(led_by(p) / fmax(sw_norm(sw_scene_gravity(p->s)), 1.0));
}

/* Share of all iterations after which a search that keeps what friction slid ends. Most need less
 * than a tenth [-]. */
static const double KEEPING = 0.2;

/* unstable: 1 if the step failed because it ended in an unstable place. */
static sw_status continue_by(sw_statics *p, double tau, int *unstable, sw_error *err) {
  sw_system *s = sw_scene_system(p->s);
  *unstable = 0;
  SW_TRY(sw_rest_solve(p, tau, &CONTINUE, err));
  if (led_by(p) > 0 || !ends_unstable(p, tau) ||
      sw_rest_is_late(p, p->keeps ? PATIENCE * KEEPING : PATIENCE))
    return SW_OK;
  *unstable = 1;
  memcpy(s->tension, p->tension, s->edges * sizeof(double));
  return sw_fail(err, SW_ENOCONV, "a mesh would come to rest in an unstable place");
}

/* Touches of a mesh that slide by turns may go through the same places again and again, some
 * nanometres apart; a wire that lies across another one turns to and fro about the crossing by
 * micrometres (spec/contact/crossed_settle_spec). After MOST_LONGEST of the longest steps
 * continuation begins anew with longest steps that are shorter by SHORTER_LONGEST, down to
 * LEAST_GROWTH times the first one [-]. */
enum { MOST_LONGEST = 8 };
static const double SHORTER_LONGEST = 0.01, LEAST_GROWTH = 10.0;

sw_status sw_rest_transient(sw_statics *p, sw_error *err) {
  sw_scene *s = p->s;
  drift d = {0};
  const double first = sw_rest_first_step(s);
  double longest = LARGEST_GROWTH * first;
  int steps = 0; /* of the longest ones, in a row [-] */
  const int led = led_by(p) > 0;
  double tau =
      p->slow ? SW_REST_SLOWEST_GROWTH * sw_rest_time_scale(s) : fmax(first, LED * led_time(p));
  p->report->transient = 1;
  while (!sw_rest_is_late(p, p->keeps ? KEEPING : 1.0)) {
    if (p->interrupted && p->interrupted()) return SW_EINTR;
    const size_t before = p->report->iterations;
    int unstable;
    const sw_status status = continue_by(p, tau, &unstable, err);
    if (sw_rest_stops(status)) return status;
    if (status != SW_OK) {
      tau *= unstable ? SHORTER_UNSTABLE : SHORTER;
      if (!p->keeps && p->too_far && tau < LEAST_LED * led_time(p)) {
        *p->too_far = 1;
        return sw_fail(err, SW_ENOCONV, "wires are dragged too far in one step");
      }
      if (tau < 1e-9 * first) return status;
      continue;
    }
    p->report->residual = sw_rest_shift(p);
    /* in a step shorter than the first one an imbalance shifts wires by tau^2 */
    const double reserve = fmax(1.0, first * first / (tau * tau));
    const int rests = p->report->residual * reserve <= p->args->tolerance;
    p->holds = p->keeps && !rests;
    (void)sw_rest_take(p, 0);
    p->holds = 0;
    if (rests) return SW_OK;
    if (sw_rest_falls(p)) return sw_rest_fail_fall(p, err);
    hurry(p, &d);
    const double factor = growth(s, p->report->iterations - before, tau < first);
    tau = fmin(tau * factor, longest);
    steps = tau < longest ? 0 : steps + 1;
    if (steps <= MOST_LONGEST) continue;
    longest = fmax(SHORTER_LONGEST * longest, LEAST_GROWTH * first);
    tau = first, steps = 0;
  }
  if (led && p->too_far && !p->keeps) *p->too_far = 1; /* half of the pose may end elsewhere */
  return sw_fail(
      err, SW_ENOCONV,
      "not at rest after %zu iteration%s: the last iteration still moved the wires by %.3g m",
      p->report->iterations, p->report->iterations == 1 ? "" : "s", p->report->residual);
}

/* Steps of continuation no longer than its first step bring stiff modes to rest, while slow swings
 * hardly move. RELAXING: number of such steps. MOST_FAILED: more failed steps end the search
 * [-]. */
enum { RELAXING = 4, MOST_FAILED = 6 };

sw_status sw_rest_relax(sw_statics *p, sw_error *err) {
  const double first = sw_rest_first_step(p->s);
  double tau = first;
  for (int done = 0, failed = 0; done < RELAXING;) {
    const sw_status status = sw_rest_solve(p, tau, &CONTINUE, err);
    if (status != SW_OK && (sw_rest_stops(status) || ++failed > MOST_FAILED)) return status;
    if (status == SW_OK) sw_rest_take(p, 0), done += tau == first;
    tau = status == SW_OK ? fmin(4.0 * tau, first) : 0.25 * tau;
  }
  p->report->relaxed = 1;
  return SW_OK;
}
