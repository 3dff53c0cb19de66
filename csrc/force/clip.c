/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A snap-in clip: a potential U(u, v) across the wire (clip_law.h), spread over the clip's width W
 * by the window chi(a) = 2 cos^2(pi a / W), |a| < W/2, whose mean is 1:
 *   E = (1/W) integral of U chi |da| over the wire's centre line,
 * with u along the clip's direction, v across, and a along its axis. It acts on whatever part of
 * the wire is inside, wherever its nodes are. Each slice da has the energy of whichever section
 * lies in it: a move of the wire along itself takes no work, so the clip pushes across it only. (By
 * ds, the wire would have the false tension U chi / W.) The integral is a sum over evenly spaced
 * places, at most W/16 apart, within each edge; the window's sum is exact where edges are equal. In
 * a mesh the clip acts on the centres of rings; coupling stiffness is lumped into each ring's own.
 *
 * Friction acts along the axis: each node has a spring with limit mu |grad U|, which slips at a
 * stretch of W/200. |grad U| is the node's push in the last accepted state. Friction is therefore a
 * potential within a step, with a symmetric stiffness, and lags one step behind a changing push. At
 * rest the search is repeated until it no longer lags (catch_up).
 *
 * Floor and walls have a strength. A wire pressed through them, from inside or outside, has broken
 * the clip, which does not act on the wire any more. The model does not cover a wire that crosses
 * the clip at more than 45 degrees, or one that goes right through it within one step. Each of
 * these cases is reported as an event. */
#include <math.h>
#include <stddef.h>

#include "force/clip_bent.h"
#include "force/clip_watch.h"
#include "force/force.h"

static const sw_param rows[] = {
    SW_CLIP_ROWS,
    {"friction", SW_PARAM_NUMBER, "-", 0, 0, HUGE_VAL, 0, NULL, offsetof(sw_clip_args, friction),
     "Coulomb coefficient against sliding along the axis"},
    {"stiffness", SW_PARAM_NUMBER, "N/m", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(sw_clip_args, stiffness),
     "stiffness of floor and walls (default: 50 times the larger force over the wire's radius)"},
    {"strength", SW_PARAM_NUMBER, "N", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(sw_clip_args, strength),
     "force at which floor and walls break (default: 20 times the larger force)"},
};

static sw_status check(const void *args, const sw_beam *beam, sw_error *err) {
  const sw_clip_args *a = args;
  const sw_vec d = sw_unit_or(a->direction, sw_v(0, 0, 0));
  const sw_vec t = sw_unit_or(a->axis, sw_v(0, 0, 0));
  if (!(sw_norm2(d) > 0) || !(sw_norm2(t) > 0))
    return sw_fail(err, SW_EINVAL, "force clip: direction and axis must not be zero vectors");
  if (!(sw_norm(sw_cross(d, t)) > 0.1))
    return sw_fail(
        err, SW_EINVAL,
        "force clip: direction and axis must be perpendicular; here they are %.3g degrees apart",
        180.0 / M_PI * asin(sw_norm(sw_cross(d, t))));
  SW_TRY(sw_clip_check_lips(a, "clip", err));
  if (a->radius < beam->radius * (1 - 1e-9))
    return sw_fail(err, SW_EINVAL,
                   "force clip: radius = %g m of the seat is below the wire's %g m; leave it out, "
                   "or name the wires of this clip",
                   a->radius, beam->radius);
  return SW_OK;
}

/* --- history ------------------------------------------------------------------ */

sw_clip sw_clip_met(const void *args, const sw_field *f, const double *history) {
  sw_clip c = sw_clip_of(args, &f->plan->beam);
  c.law.caught = history && history[SW_CLIP_STATE] != SW_CLIP_EMPTY;
  return c;
}

static size_t state_size(const sw_plan *plan) {
  return SW_CLIP_HEAD + SW_CLIP_EACH * sw_axis_points(plan);
}

static double place_of(const sw_clip *c, const sw_field *f, size_t i) {
  return sw_dot(c->axis, sw_sub(sw_axis_at(f, i), c->at));
}

/* Returns the stretch of node i's friction spring if it did not slip [m]. */
static double stretch_of(const sw_clip *c, const sw_field *f, const double *h, size_t i) {
  return h[SW_CLIP_STRETCH] + place_of(c, f, i) - h[SW_CLIP_PLACE];
}

/* Returns the energy of a friction spring whose largest force is `most`, plus the work of slipping
 * beyond. */
static double friction_energy(double stretch, double most, double slip) {
  const double e = fabs(stretch);
  return e < slip ? 0.5 * most * e * e / slip : most * (e - 0.5 * slip);
}

static void add_friction(const sw_clip *c, sw_field *f) {
  const double slip = SW_CLIP_SLIP * c->width;
  for (size_t i = 0; f->history && f->history[SW_CLIP_RUBS] > 0 && i < sw_axis_points(f->plan);
       i++) {
    const double *h = f->history + SW_CLIP_HEAD + SW_CLIP_EACH * i;
    if (!(h[SW_CLIP_MOST] > 0)) continue;
    const double e = stretch_of(c, f, h, i);
    const double force = -h[SW_CLIP_MOST] * fmax(-1.0, fmin(1.0, e / slip));
    if (f->want & SW_WANT_ENERGY) f->energy += friction_energy(e, h[SW_CLIP_MOST], slip);
    sw_axis_push(f, i, sw_scale(c->axis, force), c->axis,
                 fabs(e) < slip ? h[SW_CLIP_MOST] / slip : 0);
  }
}

static sw_status eval(const void *args, sw_field *f, sw_error *err SW_UNUSED) {
  if (sw_clip_is_broken(f->history)) return SW_OK;
  const sw_clip c = sw_clip_met(args, f, f->history);
  const int what = f->want & SW_WANT_STIFFNESS ? SW_CLIP_WANT_STIFFNESS : 0;
  for (long e = sw_clip_find(&c, f, 0); e >= 0; e = sw_clip_find(&c, f, e + 1)) {
    sw_clip_walk walk;
    sw_clip_sum sum;
    if (!sw_clip_begin(&c, f, (size_t)e, &walk) || sw_clip_far(&c, &walk)) continue;
    sw_clip_sum_of(&c, &walk, what, &sum);
    f->energy += f->want & SW_WANT_ENERGY ? sum.energy : 0.0;
    sw_clip_on_edge(&c, f, (size_t)e, &sum);
  }
  add_friction(&c, f);
  return SW_OK;
}

/* Updates the friction springs after slipping, the dissipated work, and the largest friction of the
 * next step. A sticking node keeps its friction force as long as the new limit allows it. */
static void commit_friction(const sw_clip *c, const sw_field *f, const sw_clip_pushes *known,
                            double *history) {
  const double slip = SW_CLIP_SLIP * c->width;
  const size_t points = sw_axis_points(f->plan);
  const int begun = history[SW_CLIP_BEGUN] > 0;
  double *each = history + SW_CLIP_HEAD;
  for (size_t i = 0; i < points; i++) {
    double *h = each + SW_CLIP_EACH * i;
    const double trial = stretch_of(c, f, h, i);
    const double kept = h[SW_CLIP_MOST] > 0 ? fmax(-slip, fmin(slip, trial)) : 0.0;
    if (begun) /* the springs' new energy is subtracted below */
      history[SW_CLIP_DISSIPATED] += h[SW_CLIP_MOST] * fabs(trial - kept) * (h[SW_CLIP_MOST] > 0) +
                                     friction_energy(kept, h[SW_CLIP_MOST], slip);
    h[SW_CLIP_STRETCH] = fabs(kept) < slip ? kept * h[SW_CLIP_MOST] : copysign(HUGE_VAL, kept);
    h[SW_CLIP_PLACE] = place_of(c, f, i), h[SW_CLIP_MOST] = 0;
  }
  sw_clip_measure_friction(c, f, known, each);
  sw_clip_bend_friction(c, f, each);
  history[SW_CLIP_RUBS] = 0;
  for (size_t i = 0; i < points; i++) {
    double *h = each + SW_CLIP_EACH * i;
    h[SW_CLIP_STRETCH] =
        h[SW_CLIP_MOST] > 0 ? fmax(-slip, fmin(slip, h[SW_CLIP_STRETCH] / h[SW_CLIP_MOST])) : 0.0;
    history[SW_CLIP_RUBS] += h[SW_CLIP_MOST] > 0;
    history[SW_CLIP_DISSIPATED] -=
        begun ? friction_energy(h[SW_CLIP_STRETCH], h[SW_CLIP_MOST], slip) : 0.0;
  }
}

/* Fills the first history. The normal force is not known before the first solve. In a static first
 * solve friction holds the wire up to mu times the larger lip force, so that a wire held by clips
 * alone does not slide away. */
static void begin_history(const void *args, const sw_field *f, double *history) {
  const sw_clip c = sw_clip_of(args, &f->plan->beam);
  double *each = history + SW_CLIP_HEAD;
  if (!(c.friction > 0)) return;
  for (size_t i = 0; i < sw_axis_points(f->plan); i++)
    each[SW_CLIP_EACH * i + SW_CLIP_PLACE] = place_of(&c, f, i);
  for (long e = sw_clip_find(&c, f, 0); e >= 0; e = sw_clip_find(&c, f, e + 1)) {
    sw_clip_sum sum;
    if (!sw_clip_edge(&c, f, (size_t)e, SW_CLIP_WANT_MIDDLE, &sum)) continue;
    const double half = 0.5 * sum.share;
    if (fabs(sum.u) > sum.share * (c.law.out + c.law.in)) continue;
    for (size_t end = 0; end < 2; end++)
      each[SW_CLIP_EACH * ((size_t)e + end) + SW_CLIP_MOST] += c.friction * half * c.strongest;
    history[SW_CLIP_RUBS] = SW_CLIP_GUESS;
  }
}

/* Returns the friction on the wire along the axis [N]; *most: the largest that there can be [N]. */
static double friction_of(const sw_clip *c, const sw_field *f, const double *history,
                          double *most) {
  double sum = 0;
  *most = 0;
  for (size_t i = 0; i < sw_axis_points(f->plan); i++) {
    const double *h = history + SW_CLIP_HEAD + SW_CLIP_EACH * i;
    if (!(h[SW_CLIP_MOST] > 0)) continue;
    const double e = stretch_of(c, f, h, i) / (SW_CLIP_SLIP * c->width);
    sum -= h[SW_CLIP_MOST] * fmax(-1.0, fmin(1.0, e));
    *most += h[SW_CLIP_MOST];
  }
  return sum;
}

/* Gives friction the limits of the present push. A guess did not act in continuation. */
static double catch_up(const void *args, const sw_field *f, int guesses, double *history) {
  const sw_clip c = sw_clip_met(args, f, history);
  const int guessed = history[SW_CLIP_RUBS] == SW_CLIP_GUESS;
  double most, now;
  if (sw_clip_is_broken(history) || !(c.friction > 0) || (guesses && !guessed)) return 0;
  const double before = friction_of(&c, f, history, &most);
  commit_friction(&c, f, NULL, history);
  const double change = fabs(friction_of(&c, f, history, &now) - before);
  if (!(fmax(now, most) > 0)) return 0;
  return guessed ? HUGE_VAL : change / fmax(now, most);
}

/* 1 if some of the wire is near enough for a step to bring it in. */
static int near_by(const sw_clip *c, const sw_field *f) {
  const double reach = 4.0 * (c->law.out + c->law.in + c->law.reach);
  for (long e = sw_clip_find(c, f, 0); e >= 0; e = sw_clip_find(c, f, e + 1)) {
    sw_clip_walk w;
    if (!sw_clip_begin(c, f, (size_t)e, &w)) continue;
    if (fmin(fabs(w.a[0]), fabs(w.b[0])) < reach && fmin(fabs(w.a[1]), fabs(w.b[1])) < reach)
      return 1;
  }
  return 0;
}

static int idle(const double *history) {
  return sw_clip_is_broken(history) || (history[SW_CLIP_BEGUN] > 0 && !(history[SW_CLIP_NEAR] > 0));
}

/* Share of the lips' length that a step may move the wire over. The lips' force rises and falls
 * within half of each flank; a step does not see a peak between its two states. At twice this value
 * peaks are up to 15 % off, at half 2 % at twice the cost (spec/scene/clip_steps_spec) [-]. */
static const double FOLLOWED = 1.0 / 16;

/* Returns the way over the lips between two heights u, which begin in the seat and end at `high`.
 */
static double way_over(double one, double two, double high) {
  return fabs(fmax(0.0, fmin(high, two)) - fmax(0.0, fmin(high, one)));
}

static double oversteps(const void *args, const sw_field *f, const double *history,
                        const double *x) {
  if (!history || idle(history) || f->statics) return 0;
  const sw_clip c = sw_clip_met(args, f, history);
  const double high = c.law.out + c.law.in, beside = c.law.clearance + 2.0 * c.law.reach;
  sw_field after = *f;
  double most = 0;
  after.x = x;
  for (long e = sw_clip_find(&c, f, 0); e >= 0; e = sw_clip_find(&c, f, e + 1)) {
    sw_clip_walk was, is;
    double one[2], two[2];
    if (!sw_clip_begin(&c, f, (size_t)e, &was)) continue;
    const double middle = sw_clip_middle_share(&was);
    const int stays =
        sw_clip_begin(&c, &after, (size_t)e, &is); /* 0: the edge leaves, torn out or sliding */
    sw_clip_place_on(&was, middle, one),
        sw_clip_place_on(&is, stays ? sw_clip_middle_share(&is) : middle, two);
    if (fmin(fabs(one[1]), fabs(two[1])) > beside) continue;
    most = fmax(most, way_over(one[0], two[0], high) / (FOLLOWED * high));
  }
  return most;
}

/* Ends the action of a broken clip. The energy stored in the clip and its friction springs is
 * lost. */
static void give_up(const sw_clip *c, const sw_field *f, double *history) {
  const double slip = SW_CLIP_SLIP * c->width;
  sw_clip_sum sum;
  history[SW_CLIP_RUBS] = history[SW_CLIP_NEAR] = 0;
  for (long e = sw_clip_find(c, f, 0); e >= 0; e = sw_clip_find(c, f, e + 1))
    if (sw_clip_edge(c, f, (size_t)e, 0, &sum)) history[SW_CLIP_DISSIPATED] += sum.energy;
  for (size_t i = 0; i < sw_axis_points(f->plan); i++) {
    double *h = history + SW_CLIP_HEAD + SW_CLIP_EACH * i;
    if (h[SW_CLIP_MOST] > 0)
      history[SW_CLIP_DISSIPATED] += friction_energy(stretch_of(c, f, h, i), h[SW_CLIP_MOST], slip);
    h[SW_CLIP_MOST] = 0;
  }
}

static void commit(const void *args, const sw_field *f, double *history) {
  const sw_clip c = sw_clip_met(args, f, history);
  history[SW_CLIP_NEWS] = SW_CLIP_NO_NEWS;
  if (sw_clip_is_broken(history)) return;
  const int was_near = history[SW_CLIP_NEAR] > 0 || !(history[SW_CLIP_BEGUN] > 0);
  history[SW_CLIP_NEAR] = near_by(&c, f);
  sw_clip_pushes pushes;
  const sw_clip_middle m = sw_clip_middle_of(&c, f, c.friction > 0 ? &pushes : NULL);
  if (sw_clip_breaks(&c, &m, f->time, history)) { /* also from far to far within one step */
    give_up(&c, f, history);
    return;
  }
  if (history[SW_CLIP_NEAR] > 0 || was_near) {
    sw_clip_follow(&c, &m, f->time, f->statics, history);
    sw_clip_watch_edges(&c, &m, f->plan->beam.EI, history);
    history[SW_CLIP_LAST] = m.u;
    if (c.friction > 0) commit_friction(&c, f, &pushes, history);
  }
  /* a wire that was above the mouth and left may come back from anywhere */
  if (!(history[SW_CLIP_NEAR] > 0) && history[SW_CLIP_STATE] == SW_CLIP_ABOVE)
    history[SW_CLIP_STATE] = SW_CLIP_EMPTY;
  history[SW_CLIP_BEGUN] = 1;
}

/* Interpolates the old nodes' springs by arc length. Each new node gets its length's share of the
 * old friction. */
static void inherit(const sw_plan *old, const double *from, const sw_field *f, double *history) {
  const size_t before = sw_axis_points(old), points = sw_axis_points(f->plan);
  for (size_t k = 0; k < SW_CLIP_HEAD; k++) history[k] = from[k];
  for (size_t i = 0; i < points; i++) {
    double at;
    double *h = history + SW_CLIP_HEAD + SW_CLIP_EACH * i;
    const size_t e = sw_plan_locate(old, sw_axis_s(f->plan, i), &at);
    if (before < 2) continue;
    const double *a = from + SW_CLIP_HEAD + SW_CLIP_EACH * e, *b = a + SW_CLIP_EACH;
    const double length = sw_axis_s(old, e + 1) - sw_axis_s(old, e);
    const double own = 0.5 * (sw_axis_s(f->plan, i + 1 < points ? i + 1 : i) -
                              sw_axis_s(f->plan, i > 0 ? i - 1 : i));
    for (int k = 0; k < SW_CLIP_EACH; k++) h[k] = a[k] + at * (b[k] - a[k]);
    if (points != before) h[SW_CLIP_MOST] *= own / length;
  }
}

/* --- read-outs --------------------------------------------------------------------- */

static const char *const outputs[] = {
    "share",    "u",        "v",          "s",        "force_x",    "force_y",     "force_z",
    "way",      "out",      "state",      "peak",     "insertions", "in_time",     "in_s",
    "in_peak",  "removals", "out_time",   "out_peak", "broken",     "broken_time", "broken_force",
    "strength", "run_peak", "peak_slope", NULL};

static void read(const void *args, const sw_field *f, const double *history, double *out) {
  const sw_clip c = sw_clip_met(args, f, history);
  sw_clip_middle m = sw_clip_middle_of(&c, f, NULL);
  if (sw_clip_is_broken(history)) m.force = sw_v(0, 0, 0), m.share = 0;
  double most;
  m.force = sw_madd(m.force, c.axis, friction_of(&c, f, history, &most));
  const double values[] = {m.share,
                           m.u,
                           m.v,
                           m.s,
                           m.force.x,
                           m.force.y,
                           m.force.z,
                           c.law.in + c.law.out,
                           c.law.out,
                           history[SW_CLIP_STATE],
                           history[SW_CLIP_PEAK],
                           history[SW_CLIP_IN],
                           history[SW_CLIP_IN_TIME],
                           history[SW_CLIP_IN_S],
                           history[SW_CLIP_IN_PEAK],
                           history[SW_CLIP_OUT],
                           history[SW_CLIP_OUT_TIME],
                           history[SW_CLIP_OUT_PEAK],
                           history[SW_CLIP_BROKEN],
                           history[SW_CLIP_BROKEN_TIME],
                           history[SW_CLIP_BROKEN_FORCE],
                           c.law.strength,
                           history[SW_CLIP_RUN_PEAK],
                           history[SW_CLIP_PEAK_SLOPE]};
  for (size_t k = 0; k < sizeof values / sizeof values[0]; k++) out[k] = values[k];
}

/* A node carries at most 2 length / W of the clip, and at most the whole clip. Leapfrog's limit is
 * 2 / omega. */
static double stable_dt(const void *args, const sw_plan *plan) {
  const sw_clip c = sw_clip_of(args, &plan->beam);
  const double k = sw_clip_stiffness(&c, SW_CLIP_SLIP * c.width);
  double rate2 = 0;
  const size_t points = sw_axis_points(plan);
  for (size_t i = 0; i < points; i++) {
    const double length =
        0.5 * (sw_axis_s(plan, i + 1 < points ? i + 1 : i) - sw_axis_s(plan, i > 0 ? i - 1 : i));
    rate2 = fmax(rate2, k * fmin(1.0, 2.0 * length / c.width) / (plan->beam.mass * length));
  }
  return rate2 > 0 ? 2.0 / sqrt(rate2) : HUGE_VAL;
}

const sw_force_class sw_force_clip = {
    .name = "clip",
    .summary = "a snap-in clip that wires are pressed into; scene:clip makes one to look at",
    .loses = "friction",
    .flags = SW_FORCE_ANY_BODY | SW_FORCE_OF_AXIS | SW_FORCE_ANY_SHAPE,
    .params = SW_PARAMS("force clip", rows),
    .eval = eval,
    .stable_dt = stable_dt,
    .check = check,
    .state_size = state_size,
    .commit = commit,
    .idle = idle,
    .inherit = inherit,
    .catch_up = catch_up,
    .begin = begin_history,
    .begin_run = sw_clip_begin_run,
    .news = sw_clip_news,
    .oversteps = oversteps,
    .mistake = sw_clip_mistake,
    .largest_share = sw_clip_largest_share,
    .outputs = outputs,
    .read = read,
};
