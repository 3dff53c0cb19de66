/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Follows a wire's place in the clip and reports its events. */
#include "force/clip_watch.h"

#include <math.h>
#include <stdio.h>

/* Returns the cosine of the angle between edge and axis. */
static double cosine(const sw_clip *c, const sw_field *f, size_t e) {
  const sw_vec d = sw_sub(sw_axis_at(f, e + 1), sw_axis_at(f, e));
  return fabs(sw_dot(c->axis, sw_unit_or(d, c->axis)));
}

/* Returns the rise of the edge over its way along the axis, at most 1. */
static double slope(const sw_clip *c, const sw_field *f, size_t e) {
  const sw_vec d = sw_sub(sw_axis_at(f, e + 1), sw_axis_at(f, e));
  const double along = sw_dot(c->axis, d), up = sw_dot(c->direction, d);
  return fabs(along) > fabs(up) ? up / along : 1.0;
}

static void note_push(sw_clip_pushes *p, size_t edge, const double push[2]) {
  const size_t i = p->count++;
  if (i >= SW_CLIP_KNOWN) return;
  p->edge[i] = edge;
  for (int end = 0; end < 2; end++) p->push[i][end] = push[end];
}

static void add_friction(const sw_clip *c, size_t edge, const double push[2], double *each) {
  for (size_t end = 0; end < 2; end++)
    each[SW_CLIP_EACH * (edge + end) + SW_CLIP_MOST] += c->friction * push[end];
}

void sw_clip_measure_friction(const sw_clip *c, const sw_field *f, const sw_clip_pushes *known,
                              double *each) {
  if (known && known->count <= SW_CLIP_KNOWN) {
    for (size_t i = 0; i < known->count; i++) add_friction(c, known->edge[i], known->push[i], each);
    return;
  }
  for (long e = sw_clip_find(c, f, 0); e >= 0; e = sw_clip_find(c, f, e + 1)) {
    sw_clip_sum sum;
    if (sw_clip_edge(c, f, (size_t)e, SW_CLIP_WANT_PUSH, &sum))
      add_friction(c, (size_t)e, sum.push, each);
  }
}

sw_clip_middle sw_clip_middle_of(const sw_clip *c, const sw_field *f, sw_clip_pushes *pushes) {
  const int what = SW_CLIP_WANT_MIDDLE | (pushes ? SW_CLIP_WANT_PUSH : 0);
  sw_clip_middle m = {0};
  if (pushes) pushes->count = 0;
  for (long e = sw_clip_find(c, f, 0); e >= 0; e = sw_clip_find(c, f, e + 1)) {
    sw_clip_sum sum;
    if (!sw_clip_edge(c, f, (size_t)e, what, &sum)) continue;
    if (pushes) note_push(pushes, (size_t)e, sum.push);
    m.share += sum.share;
    m.u += sum.u, m.v += sum.v, m.s += sum.s;
    m.passes += sum.all[0], m.at[0] += sum.all[1], m.at[1] += sum.all[2];
    m.along += sum.share * cosine(c, f, (size_t)e);
    m.slope += sum.share * slope(c, f, (size_t)e);
    m.edge = fmax(m.edge, sw_norm(sw_sub(sw_axis_at(f, (size_t)e + 1), sw_axis_at(f, (size_t)e))));
    m.push -= sum.g[0][0] + sum.g[1][0];
    for (size_t end = 0; end < 2; end++) {
      const sw_vec push = sw_neg(sw_clip_world(c, sum.g[end]));
      const double a = sw_dot(c->axis, sw_sub(sw_axis_at(f, (size_t)e + end), c->at));
      m.force = sw_add(m.force, push);
      m.couple = sw_madd(m.couple, sw_cross(c->axis, push), a);
    }
  }
  if (m.share > 0) m.u /= m.share, m.v /= m.share, m.s /= m.share;
  if (m.share > 0) m.along /= m.share, m.slope /= m.share;
  if (m.passes > 0) m.at[0] /= m.passes, m.at[1] /= m.passes;
  return m;
}

/* THERE: a wire is in the clip if it fills this share of its width. SETTLED: it is seated after
 * this share of the way from the lips' top to the seat [-]. */
static const double THERE = 0.5, SETTLED = 0.5;

static void begin(double *h, int state) {
  h[SW_CLIP_STATE] = state, h[SW_CLIP_PEAK] = h[SW_CLIP_RUN_PEAK] = h[SW_CLIP_GOES_IN] = 0;
}

/* Returns the state of a wire that is not caught. SW_CLIP_ABOVE: above the lips and between the
 * ends of the funnel's walls. */
static int outside(const sw_clip *c, const sw_clip_middle *m) {
  const double way = c->law.out + c->law.in;
  const double mouth = c->law.clearance + 2.0 * c->law.reach + 0.5 * c->law.in;
  if (m->share < THERE || m->u < -c->law.clearance - c->law.reach) return SW_CLIP_EMPTY;
  if (fabs(m->v) > mouth) return SW_CLIP_EMPTY;
  return m->u < way ? SW_CLIP_INSERTING : SW_CLIP_ABOVE;
}

/* --- overload, and cases that the model does not cover -------------------------------- */

static const double PART = 0.25; /* share of the width from which a crossing is reported [-] */
static const double STEEP = 0.7071067812; /* cosine of the largest crossing angle [-] */
static const double TOUCHES = 1e-3; /* least force of a crossing, over the larger lip force [-] */
static const double PRESSED = 0.2;  /* push over strength above which a wall counts as broken [-] */

static void tell(double *h, int what, double value, double s) {
  h[SW_CLIP_NEWS] = what, h[SW_CLIP_NEWS_VALUE] = value, h[SW_CLIP_NEWS_S] = s;
}

/* 1 if u, v is inside the clip's body: below the lips' top, above the middle of the floor, and
 * between the middles of the walls. */
static int inside(const sw_clip_law *l, double u, double v) {
  return u < l->out && u > -l->clearance - l->reach && fabs(v) < l->clearance + l->reach;
}

/* 1 if the straight way between two places goes through the clip's body. */
static int goes_through(const sw_clip_law *l, const double from[2], const double to[2]) {
  enum { LOOKS = 64 };
  for (int k = 1; k < LOOKS; k++) {
    const double share = (double)k / LOOKS;
    if (inside(l, from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])))
      return 1;
  }
  return 0;
}

/* 1 if floor or wall, pressed from either side, is past its largest force at this place. */
static int deep(const sw_clip_law *l, const double at[2]) {
  const double below = -l->clearance - at[0], aside = fabs(at[1]) - l->clearance;
  const double low = 0.5 * l->reach, high = 1.5 * l->reach;
  return (below > low && below < high) || (aside > low && aside < high);
}

/* Returns how a caught wire left the clip on the straight way between two places: through a wall,
 * through the floor, or neither (also by the mouth). */
static int way_out(const sw_clip_law *l, const double from[2], const double to[2]) {
  const double wall = l->clearance + l->reach, floor = -wall;
  const double v0 = fabs(from[1]), v1 = fabs(to[1]);
  if (v1 > wall) {
    const double share = v0 < wall ? (wall - v0) / (v1 - v0) : 0.0;
    const double u = from[0] + share * (to[0] - from[0]);
    if (u < l->out && u >= floor) return SW_CLIP_THROUGH_WALL;
  }
  return to[0] < floor ? SW_CLIP_THROUGH_FLOOR : SW_CLIP_NO_NEWS;
}

/* Returns how the wire broke or passed the clip, or SW_CLIP_NO_NEWS. Reports a steep crossing. */
static int look(const sw_clip *c, const sw_clip_middle *m, double *h) {
  const sw_clip_law *l = &c->law;
  const double before[2] = {h[SW_CLIP_U_BEFORE], h[SW_CLIP_V_BEFORE]};
  const int there = m->passes >= THERE && h[SW_CLIP_THERE_BEFORE] > 0;
  const int caught = h[SW_CLIP_STATE] == SW_CLIP_SEATED || h[SW_CLIP_STATE] == SW_CLIP_INSERTING;
  const int touches = sw_norm(m->force) > TOUCHES * c->strongest;
  if (m->share > PART && touches && m->along < STEEP)
    tell(h, SW_CLIP_CROSSING, 180.0 / M_PI * acos(m->along), m->s);
  if (!there) return SW_CLIP_NO_NEWS;
  if (caught) return way_out(l, before, m->at);
  if (inside(l, before[0], before[1])) return SW_CLIP_NO_NEWS;
  const int in = inside(l, m->at[0], m->at[1]), from_above = before[0] >= l->out;
  if (in ? from_above : !goes_through(l, before, m->at)) return SW_CLIP_NO_NEWS;
  return !from_above && h[SW_CLIP_PUSH] > PRESSED * l->strength ? SW_CLIP_FROM_OUTSIDE
                                                                : SW_CLIP_PASSED;
}

int sw_clip_breaks(const sw_clip *c, const sw_clip_middle *m, double time, double *h) {
  const double push = sw_norm(m->force), most = fmax(push, h[SW_CLIP_PUSH]);
  const double step = hypot(m->at[0] - h[SW_CLIP_U_BEFORE], m->at[1] - h[SW_CLIP_V_BEFORE]);
  const int how = look(c, m, h);
  h[SW_CLIP_THERE_BEFORE] = m->passes >= THERE, h[SW_CLIP_U_BEFORE] = m->at[0],
  h[SW_CLIP_V_BEFORE] = m->at[1];
  h[SW_CLIP_PUSH] = deep(&c->law, m->at) ? most : push;
  if (!how) return 0;
  h[SW_CLIP_BROKEN] = how, h[SW_CLIP_BROKEN_TIME] = time, h[SW_CLIP_BROKEN_FORCE] = most;
  tell(h, how, how == SW_CLIP_PASSED ? step : most, m->s);
  begin(h, SW_CLIP_EMPTY);
  return 1;
}

/* A wire that leaves at an angle is peeled out, and its edges must resolve the peeling: with edges
 * of a quarter, half and the whole of the width, the force was up to 5, 25 and 45 % off
 * (spec/scene/clipping_spec). */
static const double COARSE = 0.255; /* edge length over the width from which this is reported [-] */
static const double ASKEW = 0.5;    /* its rise within the width, over the inner flank [-] */

/* A wire that passes the lips with less than this share of their force is reported: peeled place by
 * place, or in steps that miss the peak. The clip's forces are those of a wire that passes evenly;
 * peaks of such a wire are at most a few percent too low (spec/scene/clip_steps_spec) [-]. */
static const double EVEN = 0.9;
/* Its rise within the width, over the flank: below it the steps are the reason. A rise of r of a
 * flank lowers the peak by 1 - (pi r)^2/12 or less of it, because the width is weighted by 1 + cos
 * [-]. */
static const double LEANS = 0.25;

/* Takes over the pull on a wire that still went in. */
static void arrive(double *h) {
  if (!(h[SW_CLIP_GOES_IN] > 0)) return;
  h[SW_CLIP_GOES_IN] = 0;
  h[SW_CLIP_PEAK] = h[SW_CLIP_RUN_PEAK] = h[SW_CLIP_HELD];
  h[SW_CLIP_PEAK_SLOPE] = h[SW_CLIP_HELD_SLOPE];
}

static void come_out(const sw_clip *c, const sw_clip_middle *m, double time, double *h) {
  arrive(h);
  h[SW_CLIP_OUT]++, h[SW_CLIP_OUT_TIME] = time, h[SW_CLIP_OUT_PEAK] = h[SW_CLIP_PEAK];
  const double rise = c->width * fabs(h[SW_CLIP_PEAK_SLOPE]);
  if (rise > ASKEW * c->law.out && m->edge > COARSE * c->width)
    tell(h, SW_CLIP_COARSE, m->edge, m->s);
  else if (m->share >= THERE && h[SW_CLIP_PEAK] < EVEN * c->retention)
    tell(h, rise > LEANS * c->law.out ? SW_CLIP_PEELED_OUT : SW_CLIP_UNSEEN_OUT, h[SW_CLIP_PEAK],
         m->s);
  else
    tell(h, m->share >= THERE ? SW_CLIP_CAME_OUT : SW_CLIP_SLID_OUT, h[SW_CLIP_PEAK], m->s);
}

static void go_in(const sw_clip *c, const sw_clip_middle *m, double time, double *h) {
  h[SW_CLIP_IN]++, h[SW_CLIP_IN_TIME] = time, h[SW_CLIP_IN_S] = m->s,
                   h[SW_CLIP_IN_PEAK] = h[SW_CLIP_PEAK];
  const double rise = c->width * fabs(h[SW_CLIP_PEAK_SLOPE]);
  if (h[SW_CLIP_PEAK] < EVEN * c->insertion)
    tell(h, rise > LEANS * c->law.in ? SW_CLIP_PEELED_IN : SW_CLIP_UNSEEN_IN, h[SW_CLIP_PEAK],
         m->s);
  begin(h, SW_CLIP_SEATED);
  h[SW_CLIP_GOES_IN] = 1, h[SW_CLIP_SINCE] = time, h[SW_CLIP_HELD] = 0;
}

/* A wire has arrived if it has not moved in for this time, twice that in which lips draw it in.
 * Until then they pull it, without a load from outside. A gripper that opened on such a wire moved
 * it by micrometres: its pull was 71 % of the retention in steps of 1 ms, 5 % in steps of 5 ms
 * (spec/scene/clip_arrives_spec) [s]. */
static const double ARRIVES = 4e-3;

/* 1 while a seated wire still goes in. */
static int goes_in(const sw_clip_middle *m, double time, int statics, double *h) {
  if (!(h[SW_CLIP_GOES_IN] > 0)) return 0;
  if (m->u < h[SW_CLIP_LAST])
    h[SW_CLIP_SINCE] = time, h[SW_CLIP_HELD] = 0;
  else if (-m->push > h[SW_CLIP_HELD])
    h[SW_CLIP_HELD] = -m->push, h[SW_CLIP_HELD_SLOPE] = m->slope;
  if (m->u < h[SW_CLIP_LAST] || !(statics || time - h[SW_CLIP_SINCE] > ARRIVES)) return 1;
  arrive(h);
  return 0;
}

/* In a run's first step a wire that moves in by less than this share of the inner flank counts as
 * at rest: the pull that it bears from the run before is one of this run too [-]. */
static const double RESTS = 0.01;

void sw_clip_follow(const sw_clip *c, const sw_clip_middle *m, double time, int statics,
                    double *h) {
  const int caught = h[SW_CLIP_STATE] == SW_CLIP_SEATED || h[SW_CLIP_STATE] == SW_CLIP_INSERTING;
  const int gone = m->share < THERE || m->u >= c->law.out + c->law.in;
  if (caught && gone) {
    if (h[SW_CLIP_STATE] == SW_CLIP_SEATED) come_out(c, m, time, h);
    begin(h, m->share < THERE ? SW_CLIP_EMPTY : SW_CLIP_ABOVE);
  } else if (!caught) {
    const int state = outside(c, m), drawn_there = !(h[SW_CLIP_BEGUN] > 0) && m->u < c->law.out;
    if (h[SW_CLIP_STATE] != state)
      begin(h, state == SW_CLIP_INSERTING && drawn_there ? SW_CLIP_SEATED : state);
  }
  if (h[SW_CLIP_STATE] == SW_CLIP_INSERTING) {
    if (m->u > c->law.out && m->push > h[SW_CLIP_PEAK]) /* below the top the lips pull it in */
      h[SW_CLIP_PEAK] = m->push, h[SW_CLIP_PEAK_SLOPE] = m->slope;
    if (m->u > (1.0 - SETTLED) * c->law.out) return;
    go_in(c, m, time, h);
  }
  /* Only outward motion counts: on the way in the lips pull the wire too, without a load from
   * outside. */
  if (h[SW_CLIP_STATE] != SW_CLIP_SEATED || goes_in(m, time, statics, h)) return;
  const double back = h[SW_CLIP_RUN_PEAK] < 0 ? RESTS * c->law.out : 0.0;
  h[SW_CLIP_RUN_PEAK] = fmax(0.0, h[SW_CLIP_RUN_PEAK]);
  if (m->u < h[SW_CLIP_LAST] - back) return;
  h[SW_CLIP_RUN_PEAK] = fmax(h[SW_CLIP_RUN_PEAK], -m->push);
  if (m->u < h[SW_CLIP_LAST]) return;
  if (-m->push > h[SW_CLIP_PEAK]) h[SW_CLIP_PEAK] = -m->push, h[SW_CLIP_PEAK_SLOPE] = m->slope;
}

void sw_clip_begin_run(double *history) { history[SW_CLIP_RUN_PEAK] = -1; }

/* Beside a clip a wire bends by the way that nodes lie in it. The smallest bend radius was off by
 * up to OFF (edge / width)^2: three catalogue cables with a clamp 12 to 40 mm beside a clip of 8
 * mm, at all places of nodes, edges of 2 to 8 mm (spec/scene/clip_edges_spec). It is told from
 * edges of WIDE widths on, if the clip bends the wire by more than BENDS within an edge, by its
 * force or by its couple [-], [-], [rad]. */
static const double OFF = 0.25, WIDE = 0.6, BENDS = 0.01;

void sw_clip_watch_edges(const sw_clip *c, const sw_clip_middle *m, double EI, double *h) {
  const int in = h[SW_CLIP_STATE] == SW_CLIP_SEATED || h[SW_CLIP_STATE] == SW_CLIP_INSERTING;
  if (h[SW_CLIP_NEWS] != SW_CLIP_NO_NEWS || !in) return;
  if (!(m->edge > WIDE * c->width)) return;
  const double moment = fmax(0.5 * sw_norm(m->force) * m->edge, sw_norm(m->couple));
  if (moment * m->edge > BENDS * EI) tell(h, SW_CLIP_LONG_EDGES, m->edge, m->s);
}

static void write_edges(const sw_clip_args *args, double edge, sw_force_news *out) {
  const double share = edge / args->width;
  out->kind = "edges";
  snprintf(out->text, sizeof out->text,
           "edges of %.3g mm in a clip of %.3g mm: bend radii beside it may be %.0f %% off, forces "
           "of holds too; try edges of %.3g mm (2 %%)",
           1e3 * edge, 1e3 * args->width, 100.0 * OFF * share * share, 250.0 * args->width);
}

/* Says with which part of the lips' force a wire passed them, and why. */
static void write_weak(const sw_clip_args *args, const double *h, sw_force_news *out) {
  const int what = (int)h[SW_CLIP_NEWS];
  const int in = what == SW_CLIP_PEELED_IN || what == SW_CLIP_UNSEEN_IN;
  const double given = in ? args->insertion : args->retention;
  const char *const way = in ? "in" : "out";
  out->kind = "askew";
  if (what == SW_CLIP_PEELED_IN || what == SW_CLIP_PEELED_OUT)
    snprintf(out->text, sizeof out->text,
             "the wire goes %s askew (%.2g degrees), one end first, at %.3g N; straight, or "
             "with lips that yield only together, it takes %.4g N",
             way, 180.0 / M_PI * atan(fabs(h[SW_CLIP_PEAK_SLOPE])), h[SW_CLIP_NEWS_VALUE], given);
  else
    snprintf(out->text, sizeof out->text,
             "the wire goes %s at %.3g N, as the steps see it, but it takes %.4g N; take "
             "smaller steps",
             way, h[SW_CLIP_NEWS_VALUE], given);
}

static void write_out(const sw_clip_args *args, const double *h, sw_force_news *out) {
  out->kind = "out";
  if ((int)h[SW_CLIP_NEWS] == SW_CLIP_CAME_OUT)
    snprintf(out->text, sizeof out->text, "the wire comes out, at %.4g N; its retention is %.4g N",
             h[SW_CLIP_NEWS_VALUE], args->retention);
  else
    snprintf(out->text, sizeof out->text, "the wire slides out along the clip's axis");
}

int sw_clip_news(const void *args, const double *history, sw_force_news *out) {
  static const char *const how[] = {"", "its floor", "a wall", "a wall from outside"};
  const int what = (int)history[SW_CLIP_NEWS];
  const double value = history[SW_CLIP_NEWS_VALUE];
  if (what == SW_CLIP_NO_NEWS) return 0;
  *out = (sw_force_news){.kind = "clip", .s = history[SW_CLIP_NEWS_S], .value = value};
  if (what == SW_CLIP_CROSSING)
    snprintf(
        out->text, sizeof out->text,
        "the wire crosses the clip at %.3g degrees; the clip's model is valid up to 45 degrees",
        value);
  else if (what == SW_CLIP_COARSE)
    snprintf(out->text, sizeof out->text,
             "the wire comes out askew (%.2g degrees): its edges of %.3g mm are longer than a "
             "quarter of the clip's width, so the force may be 25 %% wrong",
             180.0 / M_PI * atan(fabs(history[SW_CLIP_PEAK_SLOPE])), 1e3 * value);
  else if (what == SW_CLIP_LONG_EDGES)
    write_edges(args, value, out);
  else if (what == SW_CLIP_CAME_OUT || what == SW_CLIP_SLID_OUT)
    write_out(args, history, out);
  else if (what >= SW_CLIP_PEELED_IN)
    write_weak(args, history, out);
  else if (what == SW_CLIP_PASSED)
    snprintf(out->text, sizeof out->text,
             "the wire passes through the clip within one step, by %.3g mm, and is free; take "
             "smaller steps",
             1e3 * value);
  else
    snprintf(out->text, sizeof out->text,
             "OVERLOADED, the wire breaks through %s with %.4g N and is free", how[what], value);
  return 1;
}
