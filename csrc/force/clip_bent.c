/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Friction of a clip comes from the whole push N = (1/W) integral of |grad U| chi da: most of it is
 * a couple that bends the wire, and its two forces cancel in the clip's force. Straight edges are
 * pressed in at other places than a bent wire: with edges of W N was up to 16 % off, by where nodes
 * lie, with edges of W/2 5 %. Their force F and moment M on the wire are right within 1 % there.
 *
 * So N is computed from F and M: a beam of cubic elements over the clip's width bears the
 * potential of the seat, loaded at its two ends by the wire outside. Shear and moment of the wire
 * at its nodes outside say how F and M are shared between the two ends. Between lips, floor and
 * walls of a seated wire the potential is a function of u plus one of v: a beam for each. Tension
 * counts: without it N of FLRY-B 0.5 under 40 N was 3 % off.
 *
 * The push is not known for a wire that is not seated or near the lips' largest force, passes the
 * clip twice, is held in it, or has no bending stiffness. */
#include "force/clip_bent.h"

#include <math.h>
#include <string.h>

enum {
  ELEMENTS = 16,               /* N is within 0.1 % of that of 32, of FEW within 0.6 % [-] */
  FEW = 8,                     /* for edges above LONG, with which N is less accurate than that */
  PLACES = 3 * ELEMENTS,       /* of the quadrature, at most */
  UNKNOWNS = 2 * ELEMENTS + 2, /* deflection and slope at the elements' ends, at most */
  BAND = 4,
  PATIENT = 12, /* iterations after which they go half the way */
  MOST_ITERATIONS = 40
};

/* Edges below this share of the width are not corrected: they are within 1 % [-]. */
static const double SHORT = 0.125;
/* Edges above this share take fewer elements, in half the time [-]. */
static const double LONG = 0.34;
/* Largest u of an edge's middle over the inner flank, and depth over the reach of floor and walls:
 * both push hardest at 0.5. The beam's ends may go further, up to where the push ends [-]. */
static const double DEEP = 0.45, ENDS = 1.0;
/* Largest move of an iteration, over the inner flank; least stiffness of the seat in the matrix,
 * over EI/W^3; move over the flank at which iterations end [-]. */
static const double FAR = 0.3, ADDED = 1e-3, DONE = 1e-4;
/* Weight of a place, over the mean, below which the seat need not bear it: the wire hardly touches
 * the clip's edges [-]. */
static const double THIN = 0.01;

/* What the wire outside does to an end of the beam. */
typedef struct load {
  double shear, moment; /* [N], [N m] */
  int known;
} load;

/* Derivatives of the potential along u (plane 0) or v (plane 1) [N], [N/m]. */
typedef struct slope {
  double d, dd;
} slope;

/* In the seat, where the potential is a sum of one along u and one along v. */
static slope seat(const sw_clip_law *l, int plane, double x) {
  const sw_clip_point p = sw_clip_at(l, plane == 0 ? x : 0.0, plane == 0 ? 0.0 : x);
  return plane == 0 ? (slope){p.u, p.uu} : (slope){p.v, p.vv};
}

/* 1 if the seat bears the wire here. */
static int bears(const sw_clip_law *l, int plane, double x, double deep) {
  if (plane == 0 && x > 0) return x < deep * l->out;
  return fabs(x) - l->clearance < deep * l->reach;
}

/* --- loads ------------------------------------------------------------------------- */

/* The wire in the clip: its first and last place, and which of them lies at lower a. */
typedef struct part {
  size_t ends[2];      /* at lower and at higher a */
  int step;            /* from the lower to the higher end: +1 or -1 */
  double force[2];     /* on the clip, along u and v [N] */
  double moment[2];    /* its moment about the clip's middle [N m] */
  double push, window; /* sum of the edges' pushes [N]; share of the window that is filled [-] */
  double tension;      /* mean of the edges [N] */
  int elements;        /* of the beam [-] */
} part;

static double along(const sw_clip *c, const sw_field *f, size_t i) {
  return sw_dot(c->axis, sw_sub(sw_axis_at(f, i), c->at));
}

/* 1 if the wire's place i is held: its moment is not that of its bend. */
static int held(const sw_plan *plan, size_t i) { return plan->web ? 1 : plan->held[i] != SW_FREE; }

/* Returns the tension of edge e [N]. */
static double tension_of(const sw_field *f, size_t e) {
  const sw_plan *plan = f->plan;
  const double rest = plan->web ? sw_axis_s(plan, e + 1) - sw_axis_s(plan, e) : plan->rest[e];
  return plan->beam.EA * (sw_norm(sw_sub(sw_axis_at(f, e + 1), sw_axis_at(f, e))) / rest - 1.0);
}

/* Adds edge e to the wire in the clip; 0: the seat does not bear it. */
static int add_edge(const sw_clip *c, const sw_field *f, size_t e, double *longest, part *p) {
  sw_clip_sum sum;
  sw_clip_walk w;
  double at[2];
  if (!sw_clip_begin(c, f, e, &w)) return 1;
  sw_clip_place_on(&w, sw_clip_middle_share(&w), at);
  if (!bears(&c->law, 0, at[0], DEEP) || !bears(&c->law, 1, at[1], DEEP)) return 0;
  *longest = fmax(*longest, w.length);
  sw_clip_sum_of(c, &w, SW_CLIP_WANT_PUSH | SW_CLIP_WANT_MIDDLE, &sum);
  p->tension += tension_of(f, e) * sum.all[0];
  p->push += sum.push[0] + sum.push[1], p->window += sum.all[0];
  for (size_t end = 0; end < 2; end++)
    for (int k = 0; k < 2; k++) {
      p->force[k] += sum.g[end][k];
      p->moment[k] += sum.g[end][k] * along(c, f, e + end);
    }
  return 1;
}

/* Finds the wire in the clip; 0: its push is not corrected. */
static int find_part(const sw_clip *c, const sw_field *f, part *p) {
  const long first = sw_clip_find(c, f, 0);
  double longest = 0;
  long last = first - 1;
  *p = (part){0};
  for (long e = first; e >= 0; last = e, e = sw_clip_find(c, f, e + 1))
    if (e != last + 1 || !add_edge(c, f, (size_t)e, &longest, p)) return 0;
  if (first < 0 || longest < SHORT * c->width || !(p->push > 0) || !(p->window > 0)) return 0;
  p->elements = longest > LONG * c->width ? FEW : ELEMENTS;
  p->tension = fmax(p->tension / p->window, -f->plan->beam.EI / (c->width * c->width));
  p->step = along(c, f, (size_t)last + 1) > along(c, f, (size_t)first) ? 1 : -1;
  p->ends[p->step > 0 ? 0 : 1] = (size_t)first;
  p->ends[p->step > 0 ? 1 : 0] = (size_t)last + 1;
  for (size_t i = (size_t)first + 1; i <= (size_t)last && !f->plan->web; i++)
    if (held(f->plan, i)) return 0;
  return 1;
}

/* Returns EI times the curvature at place i that has two neighbours, along d [N m]. A wire that is
 * evenly curved at rest bears this moment less a constant, which bends it at rest too. */
static double moment_at(const sw_field *f, size_t i, sw_vec d) {
  const sw_vec a = sw_sub(sw_axis_at(f, i), sw_axis_at(f, i - 1));
  const sw_vec b = sw_sub(sw_axis_at(f, i + 1), sw_axis_at(f, i));
  const double turn = sw_dot(d, sw_unit_or(b, d)) - sw_dot(d, sw_unit_or(a, d));
  return f->plan->beam.EI * turn / (0.5 * (sw_norm(a) + sw_norm(b)));
}

/* Returns the rise of the edge from place i to its neighbour over its way along the axis [-]. */
static double rise(const sw_clip *c, const sw_field *f, long i, long step, sw_vec d) {
  const sw_vec by = sw_sub(sw_axis_at(f, (size_t)(i + step)), sw_axis_at(f, (size_t)i));
  const double way = sw_dot(by, c->axis);
  return fabs(way) > 0 ? sw_dot(by, d) / way : 0.0;
}

/* Fills the load on an end of the beam (0 at -W/2, 1 at W/2) from the bend and tension of the wire
 * outside. Between its nodes the moment changes evenly. */
static load load_of(const sw_clip *c, const sw_field *f, const part *p, size_t end, sw_vec d) {
  const long outward = end ? p->step : -p->step, last = (long)sw_axis_points(f->plan) - 1;
  const long in = (long)p->ends[end], out = in + outward;
  const double way = end ? 1.0 : -1.0, from = along(c, f, (size_t)in), edge = 0.5 * way * c->width;
  if (out < 0 || out > last) /* the wire ends in the clip or just outside: nothing, or a hold */
    return (load){.known = !held(f->plan, (size_t)in)};
  const int ends = out == 0 || out == last;
  if (ends && held(f->plan, (size_t)out)) return (load){0};
  const double m = moment_at(f, (size_t)in, d), beyond = ends ? 0 : moment_at(f, (size_t)out, d);
  const double rate = (m - beyond) / (from - along(c, f, (size_t)out));
  const double pull = p->tension * rise(c, f, in, outward, d); /* across the axis */
  const double inside = rate - pull + p->tension * rise(c, f, in, -outward, d);
  return (load){
      .shear = way * (pull - rate), .moment = way * (m + inside * (edge - from)), .known = 1};
}

/* Gives both ends what is missing to the clip's force and moment: all to an end whose load is not
 * known, else half to each. climb: of the beam from end to end [m]. */
static void complete(const sw_clip *c, const part *p, int plane, double climb, load ends[2]) {
  const double half = 0.5 * c->width;
  const int same = ends[0].known == ends[1].known;
  const double share[2] = {same ? 0.5 : !ends[0].known, same ? 0.5 : !ends[1].known};
  const double shear = p->force[plane] - ends[0].shear - ends[1].shear;
  for (int k = 0; k < 2; k++) ends[k].shear += share[k] * shear;
  const double turn = p->moment[plane] + p->tension * climb;
  const double moment =
      turn - ends[0].moment - ends[1].moment - half * (ends[1].shear - ends[0].shear);
  for (int k = 0; k < 2; k++) ends[k].moment += share[k] * moment;
}

/* --- the beam ------------------------------------------------------------------------ */

/* Equations of a beam: bands of the matrix, right side, and the unknowns. */
typedef struct beam {
  int elements, places, unknowns;
  double EI, tension, element;           /* [N m2], [N], length of an element [m] */
  double weight[PLACES];                 /* of the places of the quadrature [-] */
  double shape[3][BAND];                 /* of an element's unknowns at its places [-], [m] */
  double a[UNKNOWNS][BAND], b[UNKNOWNS]; /* matrix from the diagonal on; residual */
  double x[UNKNOWNS];                    /* deflection and slope in turn [m], [-] */
} beam;

static const double GAUSS[3] = {0.1127016653792583, 0.5, 0.8872983346207417};
static const double WEIGHT[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

/* Sets shapes and weights. The seat does not push beyond an end of the wire. */
static void begin(const sw_clip *c, const sw_field *f, const part *p, beam *o) {
  const double low = along(c, f, p->ends[0]), high = along(c, f, p->ends[1]);
  o->elements = p->elements, o->places = 3 * p->elements, o->unknowns = 2 * p->elements + 2;
  o->EI = f->plan->beam.EI, o->tension = p->tension, o->element = c->width / p->elements;
  for (int g = 0; g < 3; g++) {
    const double t = GAUSS[g], h = o->element, s = 1.0 - t;
    const double shape[BAND] = {s * s * (1.0 + 2.0 * t), h * t * s * s, t * t * (3.0 - 2.0 * t),
                                -h * t * t * s};
    memcpy(o->shape[g], shape, sizeof shape);
  }
  for (int k = 0; k < o->places; k++) {
    const int element = k / 3;
    const double a = ((element + GAUSS[k % 3]) / o->elements - 0.5) * c->width;
    const double chi = 1.0 + cos(2.0 * M_PI * a / c->width);
    o->weight[k] = a < low || a > high ? 0.0 : WEIGHT[k % 3] / o->elements * chi;
  }
}

static double deflection(const beam *o, int place) {
  double x = 0;
  for (int i = 0; i < BAND; i++) x += o->shape[place % 3][i] * o->x[2 * (place / 3) + i];
  return x;
}

static void add_element(beam *o, int e) {
  const double h = o->element, k = o->EI / (h * h * h), t = o->tension / (30.0 * h);
  const double bend[BAND][BAND] = {{12, 6 * h, -12, 6 * h},
                                   {6 * h, 4 * h * h, -6 * h, 2 * h * h},
                                   {-12, -6 * h, 12, -6 * h},
                                   {6 * h, 2 * h * h, -6 * h, 4 * h * h}};
  const double pull[BAND][BAND] = {{36, 3 * h, -36, 3 * h},
                                   {3 * h, 4 * h * h, -3 * h, -h * h},
                                   {-36, -3 * h, 36, -3 * h},
                                   {3 * h, -h * h, -3 * h, 4 * h * h}};
  for (int i = 0; i < BAND; i++)
    for (int j = 0; j < BAND; j++) {
      const double K = k * bend[i][j] + t * pull[i][j];
      o->b[2 * e + i] += K * o->x[2 * e + j];
      if (j >= i) o->a[2 * e + i][j - i] += K;
    }
}

static void add_seat(const sw_clip_law *l, int plane, beam *o) {
  const double least = ADDED * o->EI / pow(o->elements * o->element, 3);
  for (int k = 0; k < o->places; k++) {
    if (!(o->weight[k] > 0)) continue; /* beyond an end of the wire */
    const slope s = seat(l, plane, deflection(o, k));
    const double stiff = o->weight[k] * fmax(s.dd, least), *const n = o->shape[k % 3];
    const int first = 2 * (k / 3);
    for (int i = 0; i < BAND; i++) {
      o->b[first + i] += o->weight[k] * s.d * n[i];
      for (int j = i; j < BAND; j++) o->a[first + i][j - i] += stiff * n[i] * n[j];
    }
  }
}

/* Solves a d = b in place of both. */
static void solve(beam *o) {
  for (int i = 0; i < o->unknowns; i++)
    for (int j = 1; j < BAND && i + j < o->unknowns; j++) {
      const double m = o->a[i][j] / o->a[i][0];
      for (int k = j; k < BAND; k++) o->a[i + j][k - j] -= m * o->a[i][k];
      o->b[i + j] -= m * o->b[i], o->a[i][j] = m;
    }
  for (int i = o->unknowns - 1; i >= 0; i--) {
    o->b[i] /= o->a[i][0];
    for (int j = 1; j < BAND && i + j < o->unknowns; j++) o->b[i] -= o->a[i][j] * o->b[i + j];
  }
}

/* Goes this part of an iteration; returns its largest move [m]. */
static double iterate(const sw_clip *c, int plane, const load ends[2], double go, beam *o) {
  double most = 0;
  memset(o->a, 0, sizeof o->a), memset(o->b, 0, sizeof o->b);
  for (int e = 0; e < o->elements; e++) add_element(o, e);
  add_seat(&c->law, plane, o);
  for (int k = 0; k < 2; k++) {
    o->b[k ? o->unknowns - 2 : 0] -= ends[k].shear;
    o->b[k ? o->unknowns - 1 : 1] -= ends[k].moment;
  }
  solve(o);
  for (int i = 0; i < o->unknowns; i += 2) most = fmax(most, fabs(o->b[i]));
  const double limit = FAR * c->law.out + c->law.clearance, share = go * fmin(1.0, limit / most);
  for (int i = 0; i < o->unknowns; i++) o->x[i] -= share * o->b[i];
  return most;
}

/* 0: nothing acts on the beam in this plane, as where a wire is drawn and bent in the other one. */
static int is_loaded(const part *p, int plane, const load ends[2]) {
  double sum = fabs(p->force[plane]) + fabs(p->moment[plane]);
  for (int k = 0; k < 2; k++) sum += fabs(ends[k].shear) + fabs(ends[k].moment);
  return sum != 0;
}

/* Fills the push at each place in one plane [N]; 0: the seat does not bear the beam. */
static int push_in(const sw_clip *c, const part *p, int plane, const load outside[2], beam *o,
                   double push[PLACES]) {
  double move = is_loaded(p, plane, outside) ? HUGE_VAL : 0.0;
  memset(o->x, 0, sizeof o->x);
  for (int k = 0; move > DONE * c->law.out; k++) {
    load ends[2] = {outside[0], outside[1]};
    if (k == MOST_ITERATIONS) return 0;
    complete(c, p, plane, o->x[o->unknowns - 2] - o->x[0], ends);
    move = iterate(c, plane, ends, k < PATIENT ? 1.0 : 0.5, o);
  }
  for (int k = 0; k < o->places; k++) {
    const double x = deflection(o, k);
    if (o->weight[k] > THIN / o->elements && !bears(&c->law, plane, x, ENDS)) return 0;
    push[k] = seat(&c->law, plane, x).d;
  }
  return 1;
}

/* Returns the push on the bent wire, or that of its edges [N]. */
static double push_of(const sw_clip *c, const sw_field *f, const part *p) {
  const sw_vec d[2] = {c->direction, c->across};
  double push[2][PLACES] = {{0}}, sum = 0;
  beam o;
  begin(c, f, p, &o);
  for (int plane = 0; plane < 2; plane++) {
    const load outside[2] = {load_of(c, f, p, 0, d[plane]), load_of(c, f, p, 1, d[plane])};
    if (!push_in(c, p, plane, outside, &o, push[plane])) return p->push;
  }
  for (int k = 0; k < o.places; k++) sum += o.weight[k] * hypot(push[0][k], push[1][k]);
  return sum;
}

void sw_clip_bend_friction(const sw_clip *c, const sw_field *f, double *each) {
  part p;
  if (!(f->plan->beam.EI > 0) || !find_part(c, f, &p)) return;
  const double push = push_of(c, f, &p), scale = fmin(1.0, push / p.push);
  const double more = c->friction * fmax(0.0, push - p.push) / p.window;
  const size_t first = p.ends[p.step > 0 ? 0 : 1], last = p.ends[p.step > 0 ? 1 : 0];
  for (size_t e = first; e < last; e++) {
    sw_clip_sum sum;
    if (!(more > 0) || !sw_clip_edge(c, f, e, SW_CLIP_WANT_MIDDLE, &sum)) continue;
    for (size_t end = 0; end < 2; end++)
      each[SW_CLIP_EACH * (e + end) + SW_CLIP_MOST] += 0.5 * more * sum.all[0];
  }
  for (size_t i = first; i <= last && scale < 1.0; i++)
    each[SW_CLIP_EACH * i + SW_CLIP_MOST] *= scale;
}
