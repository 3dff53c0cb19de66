/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two wires cross. Their smooth curves x(u) and y(v), with u and v along their segments, touch at
 * their nearest places: x'.(x - y) = 0 and y'.(y - x) = 0. A wire that goes round the other one is
 * equally near everywhere. So, as on pegs (contact/round.c), its place stays near the middle of its
 * edge, more firmly with more bending: x'.(x - y) + firm |x'|^2 (u - 1/2) = 0, and likewise for y.
 * Wires along each other touch with chords. */
#include "mutual/pairs_curve.h"

#include <math.h>

#include "touch/lean.h"
#include "touch/same.h"

/* Wires touch with curves if the sum of their radii is below this share of the longest edge, as on
 * pegs [-]. */
static const double ROUND = 0.9;
/* A crossing begins where the sine of the angle between the wires is above ACROSS, and ends below
 * STILL_ACROSS. The strands of a twisted pair lie along each other [-]. */
static const double STILL_ACROSS = 0.35, ACROSS = 0.5;

/* --- at the step's start -------------------------------------------------------------------- */

/* 1 if the wires touch with chords everywhere. The answer is the same for all their segments. */
static int are_fine(const sw_pairs *p, const sw_system *s, const sw_near *n) {
  if (n->body[0] == n->body[1]) return 1; /* a coiled wire lies along itself at any angle */
  const double one = s->bodies[n->body[0]].plan->beam.radius;
  const double two = s->bodies[n->body[1]].plan->beam.radius;
  return !(one + two < ROUND * fmax(p->edge[n->body[0]], p->edge[n->body[1]]));
}

double sw_pair_off_middle(const sw_body *b, uint32_t node, const double *x) {
  const size_t i = node - b->first_node;
  double most = 0;
  for (size_t j = i; j < i + 2; j++) {
    if (j == 0 || j >= b->plan->edges) continue;
    const sw_vec before = sw_edge_at(x, b->first_node + j - 1);
    most = fmax(most, sw_norm2(sw_sub(sw_edge_at(x, b->first_node + j), before)));
  }
  return sqrt(most);
}

double sw_pair_bulge(const sw_pairs *p, const sw_system *s, const sw_near *n) {
  if (are_fine(p, s, n)) return 0;
  return 0.125 * (sw_pair_off_middle(&s->bodies[n->body[0]], n->one, s->x) +
                  sw_pair_off_middle(&s->bodies[n->body[1]], n->two, s->x));
}

/* --- places ----------------------------------------------------------------------------------- */

/* Returns a place on the curve, which continues half an edge beyond its segment. The first and last
 * half edge of a wire are straight. */
sw_bow sw_pair_bow(const sw_system *s, const sw_pair *k, int side, double at) {
  const sw_body *b = &s->bodies[k->body[side]];
  const uint32_t node = side ? k->two : k->one;
  const size_t i = node - b->first_node;
  const uint32_t late = at >= 0.5;
  if (!k->smooth || (late ? i + 1 == b->plan->edges : i == 0)) return sw_bow_chord(node, at);
  return sw_bow_around(node + late - 1, late ? at - 0.5 : at + 0.5);
}

/* State of the search: both places and their limits. */
typedef struct search {
  double at[2], low[2], high[2];
  double ahead[2]; /* last step of the search */
} search;

static search begin(const sw_system *s, const sw_pair *k, const double at[2]) {
  search f = {.at = {at[0], at[1]}};
  for (int side = 0; side < 2; side++) {
    const sw_body *b = &s->bodies[k->body[side]];
    const size_t i = (side ? k->two : k->one) - b->first_node;
    f.low[side] = i == 0 ? 0.0 : -0.5;
    f.high[side] = i + 1 == b->plan->edges ? 1.0 : 1.5;
  }
  return f;
}

/* Smallest relative determinant: wires along each other have no crossing, but the search must end
 * [-]. */
static const double NEARLY = 1e-3;

/* Makes a Newton step. rest: residuals of the two equations; rise, both: their derivatives. A place
 * at its limit stays there. */
static void step(search *f, const double rest[2], const double rise[2], double both) {
  const double least = NEARLY * rise[0] * rise[1];
  const double det = fmax(rise[0] * rise[1] - both * both, least);
  double ahead[2] = {-(rise[1] * rest[0] + both * rest[1]) / det,
                     -(both * rest[0] + rise[0] * rest[1]) / det};
  for (int i = 0; i < 2; i++) {
    const double to = fmin(fmax(f->at[i] + ahead[i], f->low[i]), f->high[i]);
    if (to == f->at[i] + ahead[i]) continue;
    ahead[i] = to - f->at[i];
    ahead[1 - i] = (both * ahead[i] - rest[1 - i]) / rise[1 - i];
  }
  for (int i = 0; i < 2; i++) {
    const double to = fmin(fmax(f->at[i] + ahead[i], f->low[i]), f->high[i]);
    f->ahead[i] = to - f->at[i];
    f->at[i] = to;
  }
}

enum { MOST_TURNS = 40 };            /* most steps of the search [-] */
static const double SHARP = 1e-13;   /* tolerance, of an edge [-] */
static const double ROUNDING = 1e-9; /* of an edge: a place at a joint is on both segments [-] */

static search find(const sw_system *s, const sw_pair *k, const double *y, const double at[2]) {
  search f = begin(s, k, at);
  for (int turn = 0; turn < MOST_TURNS; turn++) {
    const sw_bow bow[2] = {sw_pair_bow(s, k, 0, f.at[0]), sw_pair_bow(s, k, 1, f.at[1])};
    const sw_vec d = sw_bows_apart(y, bow);
    const sw_vec a = sw_bow_along(y, &bow[0]), b = sw_bow_along(y, &bow[1]);
    const double aa = sw_norm2(a), bb = sw_norm2(b);
    const double rest[2] = {sw_dot(a, d) + k->firm[0] * aa * (f.at[0] - 0.5),
                            -sw_dot(b, d) + k->firm[1] * bb * (f.at[1] - 0.5)};
    const double rise[2] = {sw_meet_rise(aa, sw_dot(d, sw_bow_bend(y, &bow[0])), k->firm[0]),
                            sw_meet_rise(bb, -sw_dot(d, sw_bow_bend(y, &bow[1])), k->firm[1])};
    step(&f, rest, rise, sw_dot(a, b));
    if (fabs(f.ahead[0]) < SHARP && fabs(f.ahead[1]) < SHARP) break;
  }
  return f;
}

int sw_pair_crossing(const sw_system *s, const sw_pair *k, const double *y, double at[2],
                     int slides[2]) {
  const search f = find(s, k, y, at);
  for (int i = 0; i < 2; i++) {
    if (!(f.at[i] > -ROUNDING && f.at[i] < 1 + ROUNDING)) return 0;
    slides[i] = f.at[i] > f.low[i] && f.at[i] < f.high[i];
    at[i] = fmin(fmax(f.at[i], 0), 1);
  }
  return 1;
}

/* A pair counts as parallel if its segments diverge little; short segments do so at any angle.
 * Parallel pairs touch with chords, without a search, if the sine of their angle is below this
 * [-]. */
static const double ALONG = 0.2;

static int runs_along(const double *x, const sw_pair *k) {
  const sw_vec u = sw_edge_at(x, k->one), v = sw_edge_at(x, k->two);
  return sw_norm2(sw_cross(u, v)) < ALONG * ALONG * sw_norm2(u) * sw_norm2(v);
}

/* 1 if the curves cross at an angle whose sine is above this. Neighbouring segments find the same
 * place and so agree. */
static int crosses(const sw_system *s, const sw_pair *k, double sine) {
  const double middle[2] = {0.5, 0.5};
  const search f = find(s, k, s->x, middle);
  const sw_bow bow[2] = {sw_pair_bow(s, k, 0, f.at[0]), sw_pair_bow(s, k, 1, f.at[1])};
  const sw_vec a = sw_bow_along(s->x, &bow[0]), b = sw_bow_along(s->x, &bow[1]);
  return sw_norm2(sw_cross(a, b)) > sine * sine * sw_norm2(a) * sw_norm2(b);
}

void sw_pair_find_curves(const sw_pairs *p, const sw_system *s, sw_pair *k) {
  const sw_near n = {.one = k->one, .two = k->two, .body = {k->body[0], k->body[1]}};
  const double middle[2] = {0.5, 0.5};
  if (are_fine(p, s, &n) || (k->parallel && runs_along(s->x, k))) return;
  const sw_met *m = sw_pair_recall(p, k, middle, SW_CROSSING);
  k->smooth = 1; /* needed to find the curves' place */
  k->smooth = crosses(s, k, m && m->smooth ? STILL_ACROSS : ACROSS);
  k->parallel &= !k->smooth;
  for (int side = 0; side < 2 && k->smooth; side++) {
    const sw_body *b = &s->bodies[k->body[side]];
    const uint32_t node = side ? k->two : k->one;
    const double h = b->plan->rest[node - b->first_node];
    const double curvature = sw_pair_off_middle(b, node, s->x) / (h * h);
    k->firm[side] = fmax(0.0, k->reach * curvature - SW_GOES_ROUND);
    k->lone[side] = fmax(0.0, 1.0 - k->firm[side] / (1.0 - SW_GOES_ROUND));
  }
}

static sw_vec square_to(sw_vec v, sw_vec along) {
  return sw_madd(v, along, -sw_dot(v, along) / fmax(sw_norm2(along), 1e-300));
}

sw_vec sw_pair_normal(const double *y, const sw_bow bow[2], const int slides[2]) {
  const sw_vec d = sw_bows_apart(y, bow);
  const sw_vec a = sw_bow_along(y, &bow[0]), b = sw_bow_along(y, &bow[1]);
  const sw_vec across = sw_cross(a, b), up = sw_v(0, 0, 1);
  if (slides[0] && slides[1])
    return sw_unit_or(sw_dot(across, d) < 0 ? sw_neg(across) : across, up);
  if (!slides[0] && !slides[1]) return sw_unit_or(d, up);
  return sw_unit_or(square_to(d, slides[0] ? a : b), up);
}

sw_vec sw_pair_leaning(const sw_system *s, const sw_pair *k, const double *y, const sw_meet *t,
                       sw_vec normal, double steady) {
  sw_vec out = normal;
  if (!k->smooth || !(steady > 0)) return normal;
  for (int side = 0; side < 2; side++) {
    const sw_body *b = &s->bodies[k->body[side]];
    const double place = (double)((side ? k->two : k->one) - b->first_node) + t->at[side];
    const double lean = k->lone[side] * sw_lean_of(s, b, place, steady);
    const sw_vec along = sw_unit_or(sw_bow_along(y, &t->bow[side]), sw_v(0, 0, 0));
    out = sw_madd(out, along, side ? -lean : lean);
  }
  return sw_unit_or(out, normal);
}
