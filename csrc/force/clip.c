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
 * of the step, its stiffness symmetric, and it lags one step behind a push that changes.
 *
 * Floor and walls bear their strength. A wire that is pressed through them, from within or from
 * outside, has broken the clip, which does nothing to it from then on. A wire that crosses the clip
 * at an angle of more than 45 degrees, or passes it altogether within one step, is outside of
 * what this describes. All of that is told. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>

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
    {"strength", SW_PARAM_NUMBER, "N", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(sw_clip_args, strength),
     "of floor and walls, beyond which they break (default: 20 times the larger force)"},
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
  THERE_BEFORE, /* 1: the wire passed the clip's plane in the last accepted state, at */
  U_BEFORE,     /* this height and */
  V_BEFORE,     /* this far to the side [m] */
  PUSH,         /* the most that floor or wall did to it since it is deep in them [N] */
  BROKEN,       /* by what the wire has broken it, see below; 0 = it has not */
  BROKEN_TIME,
  BROKEN_FORCE,
  NEWS, /* what is to be told of the last step */
  NEWS_VALUE,
  NEWS_S,
  HEAD
};
enum { STRETCH, PLACE, MOST, EACH };
enum { EMPTY, INSERTING, SEATED, ABOVE };
enum { NO_NEWS, THROUGH_FLOOR, THROUGH_WALL, FROM_OUTSIDE, CROSSING, PASSED };

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

static int is_broken(const double *history) { return history && history[BROKEN] > 0; }

static sw_status eval(const void *args, sw_field *f, sw_error *err) {
  if (is_broken(f->history)) return SW_OK;
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
  double passes;  /* share of the width that it passes through, anywhere [-] */
  double at[2];   /* u and v of that [m] */
  double along;   /* of the wire there and the axis, the cosine [-] */
} middle;

/* Cosine of the angle between the edge and the axis. */
static double cosine(const sw_clip *c, const sw_field *f, size_t e) {
  const sw_vec d = sw_sub(sw_axis_at(f, e + 1), sw_axis_at(f, e));
  return fabs(sw_dot(c->axis, sw_unit_or(d, c->axis)));
}

static middle middle_of(const sw_clip *c, const sw_field *f) {
  middle m = {0};
  for (long e = sw_clip_find(c, f, 0); e >= 0; e = sw_clip_find(c, f, e + 1)) {
    sw_clip_sum sum;
    if (!sw_clip_edge(c, f, (size_t)e, 0, &sum)) continue;
    m.share += sum.share;
    m.u += sum.u, m.v += sum.v, m.s += sum.s;
    m.passes += sum.all[0], m.at[0] += sum.all[1], m.at[1] += sum.all[2];
    m.along += sum.share * cosine(c, f, (size_t)e);
    m.push -= sum.g[0][0] + sum.g[1][0];
    for (int end = 0; end < 2; end++) m.force = sw_sub(m.force, sw_clip_world(c, sum.g[end]));
  }
  if (m.share > 0) m.u /= m.share, m.v /= m.share, m.s /= m.share, m.along /= m.share;
  if (m.passes > 0) m.at[0] /= m.passes, m.at[1] /= m.passes;
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

/* --- what it does not bear or describe ------------------------------------------------ */

static const double PART = 0.25; /* of the width, from which on a wire counts as there [-] */
static const double STEEP = 0.7071067812; /* cosine of the largest angle of crossing [-] */
static const double TOUCHES = 1e-3;       /* of the larger force, from which on it is told of [-] */
static const double PRESSED = 0.2;        /* of the strength: the push before can be told [-] */

static void tell(double *h, int what, double value, double s) {
  h[NEWS] = what, h[NEWS_VALUE] = value, h[NEWS_S] = s;
}

/* Is a wire at u, v between the walls, or under the lips' top beside or under the clip's body? */
static int inside(const sw_clip_law *l, double u, double v) {
  return u < l->out && u > -l->clearance - l->reach && fabs(v) < l->clearance + l->reach;
}

/* Does the straight way from one place to the other go through the body, below the lips' top? */
static int goes_through(const sw_clip_law *l, const double from[2], const double to[2]) {
  enum { LOOKS = 64 };
  for (int k = 1; k < LOOKS; k++) {
    const double share = (double)k / LOOKS;
    if (inside(l, from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])))
      return 1;
  }
  return 0;
}

/* Is it where floor or walls, pressed from either side, have borne all they can? */
static int deep(const sw_clip_law *l, const double at[2]) {
  const double below = -l->clearance - at[0], aside = fabs(at[1]) - l->clearance;
  const double low = 0.5 * l->reach, high = 1.5 * l->reach;
  return (below > low && below < high) || (aside > low && aside < high);
}

/* How a wire that was in the clip has left it, on the straight way from one place to the next,
 * other than by its mouth. */
static int way_out(const sw_clip_law *l, const double from[2], const double to[2]) {
  const double wall = l->clearance + l->reach, floor = -wall;
  const double v0 = fabs(from[1]), v1 = fabs(to[1]);
  if (v1 > wall) {
    const double share = v0 < wall ? (wall - v0) / (v1 - v0) : 0.0;
    const double u = from[0] + share * (to[0] - from[0]);
    if (u < l->out && u >= floor) return THROUGH_WALL;
  }
  return to[0] < floor ? THROUGH_FLOOR : NO_NEWS;
}

/* Has the wire gone where this is valid no more? */
static int look(const sw_clip *c, const middle *m, double *h) {
  const sw_clip_law *l = &c->law;
  const double before[2] = {h[U_BEFORE], h[V_BEFORE]};
  const int there = m->passes >= THERE && h[THERE_BEFORE] > 0;
  const int caught = h[STATE] == SEATED || h[STATE] == INSERTING;
  const int touches = sw_norm(m->force) > TOUCHES * c->strongest;
  if (m->share > PART && touches && m->along < STEEP)
    tell(h, CROSSING, 180.0 / 3.14159265358979323846 * acos(m->along), m->s);
  if (!there) return NO_NEWS;
  if (caught) return way_out(l, before, m->at);
  if (inside(l, before[0], before[1])) return NO_NEWS;
  const int in = inside(l, m->at[0], m->at[1]), from_above = before[0] >= l->out;
  if (in ? from_above : !goes_through(l, before, m->at)) return NO_NEWS;
  return !from_above && h[PUSH] > PRESSED * l->strength ? FROM_OUTSIDE : PASSED;
}

/* 1: the clip is broken for this wire. */
static int breaks(const sw_clip *c, const middle *m, double time, double *h) {
  const double push = sw_norm(m->force), most = fmax(push, h[PUSH]);
  const double step = hypot(m->at[0] - h[U_BEFORE], m->at[1] - h[V_BEFORE]);
  const int how = look(c, m, h);
  h[THERE_BEFORE] = m->passes >= THERE, h[U_BEFORE] = m->at[0], h[V_BEFORE] = m->at[1];
  h[PUSH] = deep(&c->law, m->at) ? most : push;
  if (!how) return 0;
  h[BROKEN] = how, h[BROKEN_TIME] = time, h[BROKEN_FORCE] = most;
  tell(h, how, how == PASSED ? step : most, m->s);
  begin(h, EMPTY);
  return 1;
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

static int idle(const double *history) {
  return is_broken(history) || (history[BEGUN] > 0 && !(history[NEAR] > 0));
}

/* A broken clip does nothing any more; what it and friction's springs stored is lost. */
static void give_up(const sw_clip *c, const sw_field *f, double *history) {
  const double slip = SLIP * c->width;
  sw_clip_sum sum;
  history[RUBS] = history[NEAR] = 0;
  for (long e = sw_clip_find(c, f, 0); e >= 0; e = sw_clip_find(c, f, e + 1))
    if (sw_clip_edge(c, f, (size_t)e, 0, &sum)) history[DISSIPATED] += sum.energy;
  for (size_t i = 0; i < sw_axis_points(f->plan); i++) {
    double *h = history + HEAD + EACH * i;
    if (h[MOST] > 0) history[DISSIPATED] += friction_energy(stretch_of(c, f, h, i), h[MOST], slip);
    h[MOST] = 0;
  }
}

static void commit(const void *args, const sw_field *f, double *history) {
  const sw_clip c = clip_of(args, f, history);
  history[NEWS] = NO_NEWS;
  if (is_broken(history)) return;
  const int was_near = history[NEAR] > 0 || !(history[BEGUN] > 0);
  history[NEAR] = near_by(&c, f);
  if (history[NEAR] > 0 || was_near) {
    const middle m = middle_of(&c, f);
    if (breaks(&c, &m, f->time, history)) {
      give_up(&c, f, history);
      return;
    }
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

static const char *const outputs[] = {
    "share",    "u",        "v",        "s",        "force_x",    "force_y",     "force_z",
    "way",      "out",      "state",    "peak",     "insertions", "in_time",     "in_s",
    "in_peak",  "removals", "out_time", "out_peak", "broken",     "broken_time", "broken_force",
    "strength", NULL};

static void read(const void *args, const sw_field *f, const double *history, double *out) {
  const sw_clip c = clip_of(args, f, history);
  middle m = middle_of(&c, f);
  if (is_broken(history)) m.force = sw_v(0, 0, 0), m.share = 0;
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
                           history[OUT_PEAK],
                           history[BROKEN],
                           history[BROKEN_TIME],
                           history[BROKEN_FORCE],
                           c.law.strength};
  for (size_t k = 0; k < sizeof values / sizeof values[0]; k++) out[k] = values[k];
}

static int news(const void *args, const double *history, sw_force_news *out) {
  static const char *const how[] = {"", "its floor", "a wall", "a wall from outside"};
  const int what = (int)history[NEWS];
  const double value = history[NEWS_VALUE];
  (void)args;
  if (what == NO_NEWS) return 0;
  *out = (sw_force_news){.kind = "clip", .s = history[NEWS_S], .value = value};
  if (what == CROSSING)
    snprintf(out->text, sizeof out->text,
             "the wire crosses it at %.3g degrees, more than the 45 that it describes", value);
  else if (what == PASSED)
    snprintf(out->text, sizeof out->text,
             "the wire goes through it within one step, by %.3g mm, and is free of it",
             1e3 * value);
  else
    snprintf(out->text, sizeof out->text,
             "OVERLOADED, the wire breaks through %s with %.4g N and is free of it", how[what],
             value);
  return 1;
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
    .news = news,
    .outputs = outputs,
    .read = read,
};
