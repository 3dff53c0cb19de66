/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A snap-in clip: a potential U(u, v) across the wire (clip_law.h), spread over the clip's width W
 * by the window chi(a) = 2 cos^2(pi a / W), |a| < W/2, whose mean is 1:
 *   E = (1/W) integral of U chi ds over the wire's centre line,
 * with u, v, a along the clip's direction, across both, and along its axis. So it takes hold of
 * whatever part of the wire is there, not of nodes, and a straight wire slides along the axis
 * without being pushed either way. The integral is a sum over places at even distances of at most
 * W/16 within each edge, for which the window's sum is exact where edges are equal. Of meshes of
 * particles it takes the middles of rings and leaves the stiffness between neighbouring rings in
 * the rings' own.
 *
 * Friction acts along the axis: at each node a spring that is W/200 long when it slips, with
 * mu times the push |grad U| that the node had in the last accepted state. So it is a potential
 * of the step, its stiffness symmetric, and it lags one step behind a push that changes. A wire
 * that crosses the clip at an angle of more than about 45 degrees, or loops through it more than
 * once, is outside of what this describes. */
#include <math.h>
#include <stddef.h>

#include "force/clip_sum.h"
#include "force/force.h"

static const double SLIP = 1.0 / 200.0; /* length of friction's spring as it slips, of W [-] */

static const sw_param rows[] = {
    SW_CLIP_ROWS,
    {"friction", SW_PARAM_NUMBER, "-", 0, 0, HUGE_VAL, 0, NULL, offsetof(sw_clip_args, friction),
     "Coulomb coefficient against sliding along the axis"},
    {"stiffness", SW_PARAM_NUMBER, "N/m", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(sw_clip_args, stiffness),
     "of floor and walls (default: 50 times the larger force over the wire's radius)"},
};

static sw_status check(const void *args, const sw_beam *beam, sw_error *err) {
  const sw_clip_args *a = args;
  const sw_vec d = sw_unit_or(a->direction, sw_v(0, 0, 0));
  const sw_vec t = sw_unit_or(a->axis, sw_v(0, 0, 0));
  if (!(sw_norm2(d) > 0) || !(sw_norm2(t) > 0))
    return sw_fail(err, SW_EINVAL, "force clip: direction and axis must not be zero vectors");
  if (!(sw_norm(sw_cross(d, t)) > 0.1))
    return sw_fail(err, SW_EINVAL,
                   "force clip: direction and axis must be across each other; here they are %.3g "
                   "degrees apart",
                   180.0 / 3.14159265358979323846 * asin(sw_norm(sw_cross(d, t))));
  if (a->radius < beam->radius * (1 - 1e-9))
    return sw_fail(err, SW_EINVAL,
                   "force clip: radius = %g m of the seat is below the wire's %g m; leave it out, "
                   "or name the wires that it is for",
                   a->radius, beam->radius);
  return SW_OK;
}

/* --- history ------------------------------------------------------------------ */

/* The head, then three numbers for each node or ring: how far friction's spring is stretched
 * [m], where along the axis the node was [m], and the most friction there [N]. */
enum {
  DISSIPATED,
  BEGUN,
  NEAR, /* 1: some of the wire is within the clip's width and not far above or beside */
  RUBS, /* 1: there is friction at some node */
  STATE,
  PEAK,
  LAST,
  IN,
  IN_TIME,
  IN_S,
  IN_PEAK,
  OUT,
  OUT_TIME,
  OUT_PEAK,
  HEAD
};
enum { STRETCH, PLACE, MOST, EACH };
enum { EMPTY, INSERTING, SEATED, ABOVE };

/* The clip as the wire meets it in this step. */
static sw_clip clip_of(const void *args, const sw_field *f, const double *history) {
  sw_clip c = sw_clip_of(args, &f->plan->beam);
  c.law.caught = history && history[STATE] != EMPTY;
  return c;
}

static size_t state_size(const sw_plan *plan) { return HEAD + EACH * sw_axis_points(plan); }

static double place_of(const sw_clip *c, const sw_field *f, size_t i) {
  return sw_dot(c->axis, sw_sub(sw_axis_at(f, i), c->at));
}

/* Friction at node i: how far its spring would be stretched if it did not slip [m]. */
static double stretch_of(const sw_clip *c, const sw_field *f, const double *h, size_t i) {
  return h[STRETCH] + place_of(c, f, i) - h[PLACE];
}

/* Energy of the spring, or what slipping costs from there on, with most as its force. */
static double friction_energy(double stretch, double most, double slip) {
  const double e = fabs(stretch);
  return e < slip ? 0.5 * most * e * e / slip : most * (e - 0.5 * slip);
}

static void add_friction(const sw_clip *c, sw_field *f) {
  const double slip = SLIP * c->width;
  if (f->history && !(f->history[BEGUN] > 0) && !f->statics) return; /* see begin_history */
  for (size_t i = 0; f->history && f->history[RUBS] > 0 && i < sw_axis_points(f->plan); i++) {
    const double *h = f->history + HEAD + EACH * i;
    if (!(h[MOST] > 0)) continue;
    const double e = stretch_of(c, f, h, i);
    const double force = -h[MOST] * fmax(-1.0, fmin(1.0, e / slip));
    if (f->want & SW_WANT_ENERGY) f->energy += friction_energy(e, h[MOST], slip);
    sw_axis_push(f, i, sw_scale(c->axis, force), c->axis, fabs(e) < slip ? h[MOST] / slip : 0);
  }
}

static sw_status eval(const void *args, sw_field *f, sw_error *err) {
  const sw_clip c = clip_of(args, f, f->history);
  const int stiffness = (f->want & SW_WANT_STIFFNESS) != 0;
  (void)err;
  for (long e = sw_clip_find(&c, f, 0); e >= 0; e = sw_clip_find(&c, f, e + 1)) {
    sw_clip_walk walk;
    sw_clip_sum sum;
    if (!sw_clip_begin(&c, f, (size_t)e, &walk) || sw_clip_far(&c, &walk)) continue;
    if (!sw_clip_edge(&c, f, (size_t)e, stiffness, &sum)) continue;
    f->energy += f->want & SW_WANT_ENERGY ? sum.energy : 0.0;
    sw_clip_on_edge(&c, f, (size_t)e, &sum);
  }
  add_friction(&c, f);
  return SW_OK;
}

/* --- what happens to the wire ----------------------------------------------------- */

/* The wire's part in the clip as a whole. */
typedef struct middle {
  double share;   /* of the width that it passes through, between the walls [-] */
  double u, v, s; /* of its middle [m] */
  double push;    /* of lips, floor and walls along direction [N] */
  sw_vec force;   /* of all [N] */
} middle;

static middle middle_of(const sw_clip *c, const sw_field *f) {
  middle m = {0};
  for (long e = sw_clip_find(c, f, 0); e >= 0; e = sw_clip_find(c, f, e + 1)) {
    sw_clip_sum sum;
    if (!sw_clip_edge(c, f, (size_t)e, 0, &sum)) continue;
    m.share += sum.share;
    m.u += sum.u, m.v += sum.v, m.s += sum.s;
    m.push -= sum.g[0][0] + sum.g[1][0];
    for (int end = 0; end < 2; end++) m.force = sw_sub(m.force, sw_clip_world(c, sum.g[end]));
  }
  if (m.share > 0) m.u /= m.share, m.v /= m.share, m.s /= m.share;
  return m;
}

/* A wire counts as there when it passes through this share of the clip, and as seated when it has
 * gone this share of the way from the lips' top to the seat [-]. */
static const double THERE = 0.5, SETTLED = 0.5;

static void begin(double *h, int state) { h[STATE] = state, h[PEAK] = 0; }

/* Where a wire is that is not in the clip. */
static int outside(const sw_clip *c, const middle *m) {
  const double way = c->law.out + c->law.in;
  if (m->share < THERE || m->u < -c->law.clearance - c->law.reach) return EMPTY;
  return m->u < way ? INSERTING : ABOVE;
}

static void follow(const sw_clip *c, const middle *m, double time, double *h) {
  const int caught = h[STATE] == SEATED || h[STATE] == INSERTING;
  const int gone = m->share < THERE || m->u >= c->law.out + c->law.in;
  if (caught && gone) {
    if (h[STATE] == SEATED) h[OUT]++, h[OUT_TIME] = time, h[OUT_PEAK] = h[PEAK];
    begin(h, m->share < THERE ? EMPTY : ABOVE);
  } else if (!caught) {
    const int state = outside(c, m), drawn_there = !(h[BEGUN] > 0) && m->u < c->law.out;
    if (h[STATE] != state) begin(h, state == INSERTING && drawn_there ? SEATED : state);
  }
  if (h[STATE] == INSERTING) {
    if (m->u > c->law.out) h[PEAK] = fmax(h[PEAK], m->push); /* else the lips pull it in */
    if (m->u > (1.0 - SETTLED) * c->law.out) return;
    h[IN]++, h[IN_TIME] = time, h[IN_S] = m->s, h[IN_PEAK] = h[PEAK];
    begin(h, SEATED);
  }
  /* on its way in it is pulled too, but by nothing outside of the clip */
  if (h[STATE] == SEATED && m->u >= h[LAST]) h[PEAK] = fmax(h[PEAK], -m->push);
}

/* What friction is to be from now on, by what presses each node. */
static void measure_friction(const sw_clip *c, const sw_field *f, double *each) {
  for (long e = sw_clip_find(c, f, 0); e >= 0; e = sw_clip_find(c, f, e + 1)) {
    sw_clip_sum sum;
    if (!sw_clip_edge(c, f, (size_t)e, 0, &sum)) continue;
    for (size_t end = 0; end < 2; end++)
      each[EACH * ((size_t)e + end) + MOST] += c->friction * sum.push[end];
  }
}

/* Friction's springs after slipping, the work that it took, and the most friction from now on. What
 * sticks goes on with the force that it had, as long as friction can bear that. */
static void commit_friction(const sw_clip *c, const sw_field *f, double *history) {
  const double slip = SLIP * c->width;
  const size_t points = sw_axis_points(f->plan);
  const int begun = history[BEGUN] > 0;
  double *each = history + HEAD;
  for (size_t i = 0; i < points; i++) {
    double *h = each + EACH * i;
    const double trial = stretch_of(c, f, h, i);
    const double kept = h[MOST] > 0 ? fmax(-slip, fmin(slip, trial)) : 0.0;
    if (begun) /* less what it will store */
      history[DISSIPATED] +=
          h[MOST] * fabs(trial - kept) * (h[MOST] > 0) + friction_energy(kept, h[MOST], slip);
    h[STRETCH] = fabs(kept) < slip ? kept * h[MOST] : copysign(HUGE_VAL, kept);
    h[PLACE] = place_of(c, f, i), h[MOST] = 0;
  }
  measure_friction(c, f, each);
  history[RUBS] = 0;
  for (size_t i = 0; i < points; i++) {
    double *h = each + EACH * i;
    h[STRETCH] = h[MOST] > 0 ? fmax(-slip, fmin(slip, h[STRETCH] / h[MOST])) : 0.0;
    history[RUBS] += h[MOST] > 0;
    history[DISSIPATED] -= begun ? friction_energy(h[STRETCH], h[MOST], slip) : 0.0;
  }
}

/* What presses the wire is not known before the first solve. In a static one friction then holds it
 * up to mu times the retention, so that a wire which lies in clips alone does not slide away. */
static void begin_history(const void *args, const sw_field *f, double *history) {
  const sw_clip c = sw_clip_of(args, &f->plan->beam);
  double *each = history + HEAD;
  if (!(c.friction > 0)) return;
  for (size_t i = 0; i < sw_axis_points(f->plan); i++) each[EACH * i + PLACE] = place_of(&c, f, i);
  for (long e = sw_clip_find(&c, f, 0); e >= 0; e = sw_clip_find(&c, f, e + 1)) {
    sw_clip_sum sum;
    if (!sw_clip_edge(&c, f, (size_t)e, 0, &sum)) continue;
    const double half = 0.5 * sum.share;
    if (fabs(sum.u) > sum.share * (c.law.out + c.law.in)) continue;
    for (size_t end = 0; end < 2; end++)
      each[EACH * ((size_t)e + end) + MOST] += c.friction * half * c.strongest;
    history[RUBS] = 1;
  }
}

/* Is some of the wire so near that a step may bring it in? */
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

static int idle(const double *history) { return history[BEGUN] > 0 && !(history[NEAR] > 0); }

static void commit(const void *args, const sw_field *f, double *history) {
  const sw_clip c = clip_of(args, f, history);
  const int was_near = history[NEAR] > 0 || !(history[BEGUN] > 0);
  history[NEAR] = near_by(&c, f);
  if (history[NEAR] > 0 || was_near) {
    const middle m = middle_of(&c, f);
    follow(&c, &m, f->time, history);
    history[LAST] = m.u;
    if (c.friction > 0) commit_friction(&c, f, history);
  }
  history[BEGUN] = 1;
}

/* Node for node by arc length, springs and their friction shared out by what there was. */
static void inherit(const sw_plan *old, const double *from, const sw_field *f, double *history) {
  const size_t before = sw_axis_points(old), points = sw_axis_points(f->plan);
  for (size_t k = 0; k < HEAD; k++) history[k] = from[k];
  for (size_t i = 0; i < points; i++) {
    double at;
    double *h = history + HEAD + EACH * i;
    const size_t e = sw_plan_locate(old, sw_axis_s(f->plan, i), &at);
    if (before < 2) continue;
    const double *a = from + HEAD + EACH * e, *b = a + EACH;
    const double length = sw_axis_s(old, e + 1) - sw_axis_s(old, e);
    const double own = 0.5 * (sw_axis_s(f->plan, i + 1 < points ? i + 1 : i) -
                              sw_axis_s(f->plan, i > 0 ? i - 1 : i));
    for (int k = 0; k < EACH; k++) h[k] = a[k] + at * (b[k] - a[k]);
    if (points != before) h[MOST] *= own / length;
  }
}

/* --- read-outs --------------------------------------------------------------------- */

static const char *const outputs[] = {"share",    "u",          "v",        "s",    "force_x",
                                      "force_y",  "force_z",    "way",      "out",  "state",
                                      "peak",     "insertions", "in_time",  "in_s", "in_peak",
                                      "removals", "out_time",   "out_peak", NULL};

static void read(const void *args, const sw_field *f, const double *history, double *out) {
  const sw_clip c = clip_of(args, f, history);
  middle m = middle_of(&c, f);
  for (size_t i = 0; i < sw_axis_points(f->plan); i++) {
    const double *h = history + HEAD + EACH * i;
    const double e = stretch_of(&c, f, h, i) / (SLIP * c.width);
    if (h[MOST] > 0) m.force = sw_madd(m.force, c.axis, -h[MOST] * fmax(-1.0, fmin(1.0, e)));
  }
  const double values[] = {m.share,
                           m.u,
                           m.v,
                           m.s,
                           m.force.x,
                           m.force.y,
                           m.force.z,
                           c.law.in + c.law.out,
                           c.law.out,
                           history[STATE],
                           history[PEAK],
                           history[IN],
                           history[IN_TIME],
                           history[IN_S],
                           history[IN_PEAK],
                           history[OUT],
                           history[OUT_TIME],
                           history[OUT_PEAK]};
  for (size_t k = 0; k < sizeof values / sizeof values[0]; k++) out[k] = values[k];
}

/* A node has at most 2 length / W of the clip, or all of it. Leapfrog's limit is 2 / omega. */
static double stable_dt(const void *args, const sw_plan *plan) {
  const sw_clip c = sw_clip_of(args, &plan->beam);
  const double k = sw_clip_stiffness(&c, SLIP * c.width);
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
    .flags = SW_FORCE_ANY_BODY | SW_FORCE_ANY_SHAPE,
    .params = SW_PARAMS("force clip", rows),
    .eval = eval,
    .stable_dt = stable_dt,
    .check = check,
    .state_size = state_size,
    .commit = commit,
    .idle = idle,
    .inherit = inherit,
    .begin = begin_history,
    .outputs = outputs,
    .read = read,
};
