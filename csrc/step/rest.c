/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Static equilibrium: the mixed Newton from where the scene is; when that fails
 * (mechanisms, snap-through, sliding contact) or ends in an equilibrium that is
 * not stable, pseudo-transient continuation from the start, which is implicit
 * Euler with velocities forgotten and a growing step. */
#include "step/rest.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "scene/world.h"
#include "step/jaw.h"
#include "step/run.h"

static const sw_param rows[] = {
    {"tolerance", SW_PARAM_NUMBER, "m", 1e-9, 0, 1, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(sw_settle_args, tolerance),
     "largest shift of a node in the last iteration (or quantities, see help 'tolerance')"},
    {"max_iterations", SW_PARAM_INTEGER, "-", 4000, 1, 1e9, 0, NULL,
     offsetof(sw_settle_args, max_iterations), "most matrix solves"},
};
const sw_params sw_settle_params = SW_PARAMS("scene:settle", rows);

enum { NEWTON_ITERATIONS = 60, SLIDES = 8, MOST_REDOS = 20 };
static const double FIRST_PSEUDO_STEP = 0.02; /* of sqrt(length/g) [-] */
static const double LARGEST_GROWTH = 1e6;     /* of the first pseudo step [-] */
static const double STATIC_TURN = 1e-7;       /* last rotation of a converged solve [rad] */
/* A direction in which a disturbance needs longer to grow than this counts as
 * neutral, not as unstable. */
static const double SLOWEST_GROWTH = 30.0; /* of sqrt(length/g) [-] */
static const double NUDGE = 1e-4;          /* of the length, off an unstable place [-] */
enum { MOST_NUDGES = 2 };
/* Wires that rub follow their holds to the next pose without going far, or they jump: which
 * continuation finds sooner than many more updates that would take them far [-]. */
enum { FAR_IN_POSES = 6 };
/* Parts of a hold's way from where it was to where it is to be. */
static const double LONGEST_PART = 0.4; /* of the shortest edge [-] */
static const double LONG_PART = 0.1;    /* of the longest wire, where nothing rubs [-] */
static const double WIDEST_PART = 0.5;  /* [rad] */
static const double MOST_PARTS = 2000;
/* Where holds are on their way wires need not come to rest as closely as where they arrive: their
 * nodes to so much, of an edge [-]. */
static const double PASSING = 1e-4;

typedef struct statics {
  sw_scene *s;
  const sw_settle_args *args;
  sw_settle_report *report;
  int (*interrupted)(void);
  int most_far;   /* see sw_newton */
  double passing; /* share of an edge that nodes of a place on the way may be off [-] */
  double edge;    /* the shortest [m] */
  double touched; /* time up to which contact has followed the obstacles [s] */
  int *too_far;   /* see sw_scene_rest; or NULL */
  double *zero, *from, *y, *v; /* (freedoms) */
  double *tension;             /* (edges) at the start of an attempt */
  double *kept, *begun;        /* (state) put aside; as settling found it */
  sw_pose *from_poses;         /* (holds) where the holds were */
} statics;

static double longest(const sw_scene *s) {
  double length = 0;
  for (size_t w = 0; w < s->wire_count; w++) {
    const sw_mesh *m = &s->wires[w].mesh;
    length = fmax(length, m->s[m->n - 1] - m->s[0]);
  }
  return length;
}

/* sqrt(length/g); weightless scenes: any scale will do. */
static double time_scale(const sw_scene *s) {
  return sqrt(longest(s) / fmax(sw_norm(s->gravity), 1.0));
}

static double first_step(const sw_scene *s) { return FIRST_PSEUDO_STEP * time_scale(s); }

/* A loose mesh that an obstacle touches on one side is pushed on for as long as the pseudo step
 * is. Is it further than its own size away from where it was? */
static int thrown(const statics *p) {
  const sw_system *s = &p->s->system;
  for (size_t b = 0; b < s->body_count; b++) {
    const sw_body *body = &s->bodies[b];
    const double size = body->plan->length + 2.0 * body->plan->beam.radius;
    double least = HUGE_VAL;
    for (size_t i = 0; body->plan->web && i < body->plan->nodes; i++) {
      const size_t n = body->first_node + i;
      const int is_free = body->plan->held[i] == SW_FREE;
      least = fmin(least, is_free ? sw_dist(sw_vec_at(p->y, n), sw_vec_at(s->x, n)) : 0.0);
    }
    if (isfinite(least) && least > size) return 1;
  }
  return 0;
}

static sw_status solve(statics *p, double hbar, const sw_newton *newton, sw_error *err) {
  sw_scene *s = p->s;
  sw_stage_report r = {0};
  const sw_stage stage = {
      .time = s->time, .hbar = hbar, .xhat = p->from, .vhat = p->zero, .y = p->y, .v = p->v};
  memcpy(p->from, s->system.x, s->system.freedoms * sizeof(double));
  memcpy(p->tension, s->system.tension, s->system.edges * sizeof(double));
  sw_system_begin_step(&s->system);
  sw_status status = SW_OK;
  const double h = isfinite(hbar) ? hbar : 0.0;
  status = sw_scene_begin_contact(s, SW_CONTACT_STATIC, p->touched, h, first_step(s), err);
  for (int redo = 0; status == SW_OK; redo++) {
    status = sw_system_stage(&s->system, &stage, newton, &r, err);
    p->report->iterations += (size_t)r.iterations;
    if (status != SW_OK || !sw_scene_review_static(s, p->y)) break;
    if (newton->statics || redo == MOST_REDOS)
      status = sw_fail(err, SW_ENOCONV, "the wire would pass through an obstacle");
  }
  if (status == SW_OK && !newton->statics && hbar > first_step(s) && sw_scene_has_contact(s) &&
      thrown(p))
    status = sw_fail(err, SW_ENOCONV, "a loose mesh would be thrown far");
  p->report->negative = r.negative;
  if (status != SW_OK) memcpy(s->system.tension, p->tension, s->system.edges * sizeof(double));
  return status;
}

/* Make y the state, for contact too unless it is on trial. Returns the largest
 * shift [m]. */
static double take(statics *p, int trial) {
  sw_scene *s = p->s;
  double shift = 0;
  for (size_t i = 0; i < 3 * s->system.nodes; i++)
    shift = fmax(shift, fabs(p->y[i] - s->system.x[i]));
  sw_system_follow(&s->system, p->y);
  memcpy(s->system.x, p->y, s->system.freedoms * sizeof(double));
  memset(s->system.v, 0, s->system.freedoms * sizeof(double));
  memset(s->system.a, 0, s->system.freedoms * sizeof(double));
  sw_system_strain_from_state(&s->system);
  if (trial) return shift;
  sw_scene_commit_contact(s);
  p->touched = s->time;
  return shift;
}

/* Have obstacles moved since contact knew them? Then friction drags the wires. */
static int dragged(const statics *p) {
  return p->s->contact && p->touched != p->s->time && sw_contact_moves(p->s->contact);
}

/* A wire that nothing holds may lie where it can be shifted without effort, on a smooth table: a
 * direction in which rounding alone would carry it far. Meshes have touches enough to keep them. */
static int loose(const sw_scene *s) {
  for (size_t b = 0; b < s->system.body_count; b++) {
    const sw_plan *plan = s->system.bodies[b].plan;
    size_t i = 0;
    while (i < plan->nodes && plan->held[i] == SW_FREE) i++;
    if (!plan->web && i == plan->nodes && !sw_scene_joined(s, b)) return 1;
  }
  return 0;
}

/* Forces that a little mass leaves out of balance, over its weight [-]. */
static const double LITTLE = 1e-5;

static sw_status newton_attempt(statics *p, int iterations, sw_error *err) {
  const sw_newton newton = {.max_iterations = iterations,
                            .accept_rotation = fmax(STATIC_TURN, p->passing),
                            .limit_rotation = 1.0,
                            .statics = 1,
                            .accept_shift = fmax(p->args->tolerance, p->passing * p->edge),
                            .most_far = p->most_far};
  const double slowest = SLOWEST_GROWTH * time_scale(p->s);
  const int massive = loose(p->s);
  SW_TRY(solve(p, massive ? slowest : HUGE_VAL, &newton, err));
  p->report->residual = p->args->tolerance;
  const double shift = take(p, p->report->negative > 0);
  const double far = LITTLE * fmax(sw_norm(p->s->gravity), 1.0) * slowest * slowest;
  if (p->report->negative == 0 && !(massive && shift > far)) return SW_OK;
  /* once more with a little mass: rounding in neutral directions drops out */
  SW_TRY(solve(p, slowest, &newton, err));
  if (take(p, p->report->negative > 0) > far && massive && p->report->negative == 0)
    return sw_fail(err, SW_ENOCONV, "a wire that nothing holds is carried away");
  return SW_OK;
}

static void put_aside(const sw_scene *s, double *kept) {
  memcpy(kept, s->system.state, s->system.state_size * sizeof(double));
}

static void take_back(sw_scene *s, const double *kept) {
  memcpy(s->system.state, kept, s->system.state_size * sizeof(double));
}

/* A smooth push to the sides, the same in every run, that no symmetry of a
 * scene shares. */
static void nudge(statics *p, int number) {
  sw_system *s = &p->s->system;
  const double size = NUDGE * longest(p->s);
  for (size_t b = 0; b < s->body_count; b++) {
    const sw_body *body = &s->bodies[b];
    for (size_t i = 0; i < body->plan->nodes; i++) {
      if (body->plan->held[i] != SW_FREE) continue;
      const double u = body->plan->s[i] / body->plan->length + 0.3 * number;
      double *x = s->x + 3 * (body->first_node + i);
      x[0] += size * sin(2.3 * u + 0.4);
      x[1] += size * sin(3.1 * u + 0.9);
      x[2] += size * sin(4.7 * u + 1.3);
    }
  }
}

/* Of the pseudo step, by what the last one took: where wires touch, one that fails costs more
 * than is gained by a long one [-]. */
static double growth(const sw_scene *s, size_t iterations) {
  if (!sw_scene_has_contact(s) || iterations <= 8) return 1.6;
  return iterations <= 14 ? 1.1 : 0.7;
}

static int stops(sw_status status) {
  return status == SW_ECALLBACK || status == SW_ENOMEM || status == SW_EINTR || status == SW_ELIMIT;
}

static sw_status transient(statics *p, sw_error *err) {
  sw_scene *s = p->s;
  const double first = first_step(s);
  const sw_newton newton = {
      .max_iterations = 30, .accept_rotation = 0.01, .limit_rotation = 0.3, .statics = 0};
  /* what is dragged along must not be kept from it by inertia */
  double tau = dragged(p) ? SLOWEST_GROWTH * time_scale(s) : first;
  p->report->transient = 1;
  while (p->report->iterations < (size_t)p->args->max_iterations) {
    if (p->interrupted && p->interrupted()) return SW_EINTR;
    const size_t before = p->report->iterations;
    const sw_status status = solve(p, tau, &newton, err);
    if (stops(status)) return status;
    if (status != SW_OK) {
      tau *= 0.25;
      if (p->too_far && tau < time_scale(s) && dragged(p)) {
        *p->too_far = 1;
        return sw_fail(err, SW_ENOCONV, "obstacles drag the wires too far in one step");
      }
      if (tau < 1e-9 * first) return status;
      continue;
    }
    p->report->residual = take(p, 0);
    /* in a shorter step than the first one what is out of balance shifts by tau^2 */
    const double reserve = fmax(1.0, first * first / (tau * tau));
    if (p->report->residual * reserve <= p->args->tolerance) return SW_OK;
    tau = fmin(tau * growth(s, p->report->iterations - before), LARGEST_GROWTH * first);
  }
  return sw_fail(err, SW_ENOCONV,
                 "not at rest after %zu iterations: the last step still moved %.3g m",
                 p->report->iterations, p->report->residual);
}

/* Newton's iteration from where continuation came to rest, which stays when that fails: the
 * equilibrium is then not isolated, or (unstable: 1) not stable. What touches there is kept too. */
static sw_status polish(statics *p, int *unstable, sw_error *err) {
  sw_error why = {"out of memory"};
  sw_tape rest = {0};
  sw_status status = sw_live_take(p->s, &rest);
  if (status == SW_OK) status = newton_attempt(p, NEWTON_ITERATIONS, &why);
  if (stops(status)) sw_fail(err, status, "%s", why.text);
  *unstable = status == SW_OK && p->report->negative > 0;
  if (status == SW_OK ? *unstable : !stops(status)) status = sw_live_back(p->s, &rest, err);
  sw_tape_free(&rest);
  return status;
}

static sw_status find_rest(statics *p, sw_error *err) {
  put_aside(p->s, p->kept);
  sw_status status = newton_attempt(p, NEWTON_ITERATIONS, err);
  if (status == SW_ENOCONV && dragged(p)) { /* touches may begin to slide one by one */
    take_back(p->s, p->kept);
    const double most = NEWTON_ITERATIONS + SLIDES * (double)p->s->system.nodes;
    status = newton_attempt(p, (int)fmin(most, (double)p->args->max_iterations), err);
  }
  if ((status == SW_OK && p->report->negative == 0) || stops(status)) return status;
  take_back(p->s, p->kept);
  for (int k = 0;; k++) {
    int again = 0;
    SW_TRY(transient(p, err));
    SW_TRY(polish(p, &again, err));
    if (!again || k == MOST_NUDGES) return SW_OK;
    nudge(p, k);
  }
}

/* Where the holds are as the state's wires know them. */
static void find_from_poses(statics *p) {
  const sw_system *s = &p->s->system;
  for (size_t i = s->held_count; i-- > 0;) {
    const sw_held_node *h = &s->held[i];
    const double *q = s->turn + 4 * h->hold;
    const sw_quat turn = {q[0], q[1], q[2], q[3]};
    p->from_poses[h->hold] =
        (sw_pose){sw_sub(sw_vec_at(s->x, h->node), sw_rotate(turn, h->local)), turn};
  }
}

static double shortest_edge(const sw_system *s) {
  double shortest = HUGE_VAL;
  for (size_t b = 0; b < s->body_count; b++) {
    const sw_plan *p = s->bodies[b].plan;
    if (p->web && p->web->rings > 1)
      shortest = fmin(shortest, p->length / (double)(p->web->rings - 1));
    for (size_t e = 0; p->web && !p->web->per_ring && e < p->web->links; e++)
      shortest = fmin(shortest, p->web->link[e].rest);
    for (size_t e = 0; e < p->edges; e++) shortest = fmin(shortest, p->rest[e]);
  }
  return shortest;
}

/* How far out particles of a mesh are from the axis about which a hold turns them [m]. */
static double widest_mesh(const sw_system *s) {
  double widest = 0;
  for (size_t b = 0; b < s->body_count; b++) {
    const sw_plan *p = s->bodies[b].plan;
    if (p->web && p->web->rings > 1) widest = fmax(widest, p->beam.radius);
  }
  return widest;
}

/* Number of parts into which the way of the holds to their places is cut, so that no part
 * shifts a hold by more than longest_shift [m] or turns it far. lever: nor may a point so far
 * from the hold shift by more as the hold turns [m]. */
static sw_status count_parts(statics *p, double lever, double longest_shift, size_t *parts,
                             sw_error *err) {
  sw_system *s = &p->s->system;
  double most = 0;
  SW_TRY(sw_system_place_holds(s, p->s->time, NULL, NULL, NULL, err)); /* feeds move nodes */
  for (size_t k = 0; k < s->hold_count; k++) {
    const sw_pose *from = &p->from_poses[k], *to = &s->hold_states[k].pose;
    const double turn = sw_norm(sw_quat_log(sw_quat_mul(to->q, sw_quat_conj(from->q))));
    const double shift = (sw_dist(from->p, to->p) + lever * turn) / longest_shift;
    most = fmax(most, fmax(shift, turn / WIDEST_PART));
  }
  *parts = most <= 1 ? 1 : (size_t)fmin(ceil(most), MOST_PARTS);
  return SW_OK;
}

static sw_status follow_in(statics *p, size_t parts, sw_error *err) {
  sw_status status = SW_OK;
  for (size_t i = 1; status == SW_OK && i <= parts; i++) {
    p->s->part_from = i < parts ? p->from_poses : NULL;
    p->s->part = (double)i / (double)parts;
    p->passing = i < parts ? PASSING : 0.0;
    status = find_rest(p, err);
    if (status == SW_OK && p->interrupted && p->interrupted()) status = SW_EINTR;
  }
  p->s->part_from = NULL;
  p->passing = 0;
  return status;
}

/* Is the rest of the wires independent of their past? */
static int forgets(const sw_scene *s) {
  if (s->pairs || s->crowd || s->grains) return 0;
  for (size_t o = 0; o < s->obstacle_count; o++)
    if (s->obstacles[o].alive && fmax(s->obstacles[o].friction, s->obstacles[o].kinetic) > 0)
      return 0;
  for (size_t b = 0; b < s->system.body_count; b++)
    if (s->system.bodies[b].plan->web) return 0;
  return 1;
}

/* In parts that do not depend on the mesh, as long as each leads from one stable equilibrium
 * straight to the next. 1: it did; else all is as it was. */
static sw_status follow_fast(statics *p, size_t parts, int *done, sw_error *err) {
  sw_tape start = {0};
  const double touched = p->touched;
  sw_error why = {"out of memory"};
  sw_status status = sw_live_take(p->s, &start);
  *done = 0;
  for (size_t i = 1; status == SW_OK && i <= parts; i++) {
    p->s->part_from = i < parts ? p->from_poses : NULL;
    p->s->part = (double)i / (double)parts;
    status = newton_attempt(p, NEWTON_ITERATIONS, &why);
    if (status == SW_OK && p->report->negative > 0) status = SW_ENOCONV;
    if (status == SW_OK && p->interrupted && p->interrupted()) status = SW_EINTR;
  }
  p->s->part_from = NULL;
  *done = status == SW_OK;
  if (stops(status)) sw_fail(err, status, "%s", why.text);
  if (!*done && !stops(status)) {
    p->touched = touched;
    status = sw_live_back(p->s, &start, err);
  }
  sw_tape_free(&start);
  return status;
}

/* How far the holds went, a turn counting as what it does to half a wire. */
static double drive_shift(const statics *p) {
  const sw_system *s = &p->s->system;
  double largest = 0;
  for (size_t k = 0; k < s->hold_count; k++) {
    const sw_pose *from = &p->from_poses[k], *to = &s->hold_states[k].pose;
    const double turn = sw_norm(sw_quat_log(sw_quat_mul(to->q, sw_quat_conj(from->q))));
    largest = fmax(largest, sw_dist(from->p, to->p) + 0.5 * longest(p->s) * turn);
  }
  return largest;
}

/* Settle at every part of the holds' way. The parts are only for convergence: the memory of
 * forces is brought up to date at the last one alone. Where particles of a mesh are further
 * from the axis than its slices from each other, the usual parts may be too wide to begin with. */
static sw_status follow_holds(statics *p, sw_error *err) {
  size_t parts, more, fewer;
  int done = 0;
  p->edge = shortest_edge(&p->s->system);
  const double edge = LONGEST_PART * p->edge;
  SW_TRY(count_parts(p, 0.0, edge, &parts, err));
  const int poses = p->touched != p->s->time;
  if (poses && !forgets(p->s) && drive_shift(p) > 0) p->most_far = FAR_IN_POSES;
  SW_TRY(count_parts(p, 0.0, fmax(edge, LONG_PART * longest(p->s)), &fewer, err));
  if (fewer < parts && forgets(p->s)) SW_TRY(follow_fast(p, fewer, &done, err));
  if (done) return SW_OK;
  const sw_status status = follow_in(p, parts, err);
  if (status != SW_ENOCONV) return status;
  SW_TRY(count_parts(p, widest_mesh(&p->s->system), edge, &more, err));
  if (more <= parts) return status;
  take_back(p->s, p->begun);
  return follow_in(p, more, err);
}

static void conclude(sw_scene *s, sw_status status, sw_settle_report *report, const sw_error *why) {
  report->ok = status == SW_OK;
  if (status != SW_OK)
    sw_fail(&report->reason, status, "%.400s", why->text[0] ? why->text : sw_status_text(status));
  s->discontinuous = 1;
}

/* Did the wires move much further than their holds and obstacles? Then they have left one
 * equilibrium for another. */
static const double JUMP = 4.0;           /* largest shift over the drives' own [-] */
static const double SMALLEST_JUMP = 0.01; /* of the longest wire [-] */

static double largest_shift_since(const statics *p) {
  const sw_system *s = &p->s->system;
  double largest = 0;
  for (size_t i = 0; i < s->nodes; i++)
    largest = fmax(largest, sw_dist(sw_vec_at(s->x, i), sw_vec_at(p->begun, i)));
  return largest;
}

sw_status sw_scene_rest(sw_scene *s, double since, int *too_far, const sw_settle_args *args,
                        int (*interrupted)(void), sw_settle_report *report, sw_error *why) {
  const size_t n = s->system.freedoms, size = s->system.state_size;
  double *block = sw_alloc(4 * n + s->system.edges + 2 * size, sizeof *block);
  sw_pose *poses = sw_alloc(s->system.hold_count, sizeof *poses);
  if (!block || !poses) {
    sw_free(block);
    sw_free(poses);
    return sw_fail(why, SW_ENOMEM, "scene '%s': out of memory", s->name);
  }
  statics p = {.s = s,
               .args = args,
               .report = report,
               .interrupted = interrupted,
               .touched = since,
               .too_far = too_far};
  p.zero = block, p.from = block + n, p.y = block + 2 * n, p.v = block + 3 * n;
  p.tension = block + 4 * n;
  p.kept = p.tension + s->system.edges, p.begun = p.kept + size;
  p.from_poses = poses;
  find_from_poses(&p);
  put_aside(s, p.begun);
  s->system.still = 1;
  const sw_status status = follow_holds(&p, why);
  s->system.still = 0;
  if (status == SW_OK) {
    const double shift = largest_shift_since(&p);
    report->jumped =
        report->transient && shift > SMALLEST_JUMP * longest(s) && shift > JUMP * drive_shift(&p);
  } else if (status != SW_EINTR) {
    take_back(s, p.begun);
  }
  s->discontinuous = 1;
  sw_free(block);
  sw_free(poses);
  return status;
}

sw_status sw_scene_balance(sw_scene *s, double tolerance, long most, sw_error *err) {
  const sw_settle_args args = {.tolerance = tolerance, .max_iterations = most};
  sw_settle_report report = {0};
  return sw_scene_rest(s, s->time, NULL, &args, NULL, &report, err);
}

enum { MOST_ROUNDS = 100 };

/* Jaws that hold with a force go on holding with it. */
static sw_status settle_held(sw_scene *s, const sw_settle_args *args, int (*interrupted)(void),
                             sw_settle_report *report, sw_error *err) {
  if (!sw_jaw_begin_rest(s)) return sw_scene_rest(s, s->time, NULL, args, interrupted, report, err);
  for (int round = 1;; round++) {
    const sw_status status =
        sw_scene_squeezed_rest(s, s->time, NULL, args, interrupted, report, err);
    const int more = sw_jaw_end_rest(s, status == SW_OK);
    if (status != SW_OK || !more || round == MOST_ROUNDS) return status;
    sw_jaw_follow(s);
    if (!sw_jaw_begin_rest(s)) return SW_OK;
  }
}

sw_status sw_scene_settle(sw_scene *s, const sw_settle_args *args, int (*interrupted)(void),
                          sw_settle_report *report, sw_error *err) {
  sw_error why = {""};
  *report = (sw_settle_report){0};
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_scene_readable(s, err));
  if (!s->wire_count) return sw_fail(err, SW_EINVAL, "scene '%s': there is no wire", s->name);
  SW_TRY(sw_scene_build(s, err));
  s->running++;
  sw_status status = settle_held(s, args, interrupted, report, &why);
  s->running--;
  sw_scene_reset_extremes(s);
  s->span = 0;
  if (status == SW_OK) status = sw_step_observe(s, &why);
  conclude(s, status, report, &why);
  return status == SW_ECALLBACK || status == SW_ENOMEM ? sw_fail(err, status, "%s", why.text)
                                                       : SW_OK;
}
