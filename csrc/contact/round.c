/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A wire bent over a thin peg between two of its nodes. Its smooth curve touches at the nearest
 * place to the peg's middle line and is pushed there perpendicular to itself. A wire that goes
 * round the peg is equally near everywhere, and rounding would decide. So a touch stays near the
 * middle of its edge, more firmly with more curvature: x'.(x - q) + firm |x'|^2 (u - 1/2) = 0, with
 * the curve x, the place u on the edge and the nearest place q on the middle line. The touch uses
 * the distance of the curve's tangent from the line, which differs from the curve's distance in
 * second order. */
#include "contact/round.h"

#include <math.h>

#include "base/halving.h"
#include "touch/same.h"

/* A wire touches a round obstacle with its curve if the radius of obstacle plus wire is below this
 * many edges. If it is larger, only if the wire does not go round; above SW_THICK only if it does
 * not even begin to go round [-]. */
static const double THIN = 0.9;
/* A wire goes round if curvature times radius is above this. Then its chords touch the obstacle
 * until they no longer press; a capstan needs them. Chords lie outside the curve, so the change to
 * the curve releases the wire and makes no energy [-]. */
static const double WOUND = 0.9;
/* Smallest firmness at a thin obstacle if curvature times radius is above twice LOOSE_FROM; it
 * decreases to 0 at LOOSE_FROM [-]. */
static const double LOOSE = 0.1, LOOSE_FROM = 0.25;

/* --- at the step's start -------------------------------------------------------------------- */

static sw_vec tangent_at(const sw_system *s, const sw_body *b, size_t e) {
  const double *x = s->x + 3 * (b->first_node + e);
  return sw_unit_or(sw_sub(sw_load(x + 3), sw_load(x)), sw_v(0, 0, 0));
}

/* Largest curvature of a wire at the ends of its edges from low to high [1/m]. */
static double bend_at(const sw_system *s, const sw_body *b, size_t low, size_t high) {
  const sw_plan *p = b->plan;
  double most = 0;
  for (size_t e = low > 0 ? low - 1 : 0; e <= high && e + 1 < p->edges; e++) {
    const double turn = sw_dist(tangent_at(s, b, e + 1), tangent_at(s, b, e));
    most = fmax(most, turn / fmin(p->rest[e], p->rest[e + 1]));
  }
  return most;
}

/* Largest curvature at the edges of a node, or at one edge. */
static double bend_beside(const sw_system *s, const sw_body *b, size_t node, int segment) {
  const size_t i = node - b->first_node, high = i < b->plan->edges ? i : b->plan->edges - 1;
  return bend_at(s, b, segment || i == 0 ? high : i - 1, high);
}

size_t sw_contact_first_memory(const sw_contact *c, size_t node) {
  size_t i;
  SW_FIRST_NOT(c->memory[i].node < node, i, 0, c->memory_count);
  return i;
}

void sw_contact_find_wound(sw_contact *c, const sw_system *s, size_t body) {
  const sw_body *b = &s->bodies[body];
  if (b->plan->web) return;
  for (size_t i = sw_contact_first_memory(c, b->first_node); i < c->memory_count; i++) {
    const sw_memory *m = &c->memory[i];
    if (m->node >= b->first_node + b->plan->nodes) return;
    if (!m->segment || !(m->kept.normal_force > 0)) continue;
    const size_t o = sw_contact_index(c, m->obstacle);
    if (o == c->count || !(c->round[o] > 0)) continue;
    const double radius = c->round[o] + b->plan->beam.radius;
    if (m->feature != SW_ON_CURVE || radius * bend_beside(s, b, m->node, 1) > WOUND)
      c->wound[o] = (int)body + 1;
  }
}

/* A wire is taken as straight this far beyond its edges [-]. */
static const double BESIDE = 1.0;
/* Chords, not curves, touch rims, and this many radii plus edges near the ends [-]. */
static const double FROM_RIM = 1.0, EDGES_FROM_RIM = 2.0;
/* Chords also touch if the wire lies along a thick obstacle: sine of their angle below this [-]. */
static const double ACROSS = 0.5;

/* 1 if the wire, taken as straight, crosses the middle line well between its ends. */
static int passes_side(const sw_contact *c, const sw_system *s, const sw_candidate *k, size_t low,
                       size_t high) {
  const sw_shape *shape = c->obstacles[k->obstacle].shape;
  const sw_body *b = &s->bodies[k->body];
  const sw_pose pose = c->start[k->obstacle].pose;
  const sw_vec a = sw_pose_local(pose, sw_vec_at(s->x, b->first_node + low));
  const sw_vec d = sw_sub(sw_pose_local(pose, sw_vec_at(s->x, b->first_node + high + 1)), a);
  const double radius = c->round[k->obstacle] + b->plan->beam.radius;
  const double aside = FROM_RIM * radius + EDGES_FROM_RIM * b->plan->rest[low];
  sw_vec q, e;
  sw_shape_middle(shape, a, &q, &e);
  const sw_vec across = sw_madd(d, e, -sw_dot(d, e));
  const double size2 = sw_norm2(across);
  if (!(size2 > ACROSS * ACROSS * sw_norm2(d))) return 0;
  const double t = -sw_dot(across, sw_sub(a, q)) / size2;
  const sw_vec x = sw_madd(a, d, fmin(fmax(t, -BESIDE), 1.0 + BESIDE));
  if (!(sw_shape_middle(shape, x, &q, &e) > 0)) return 0;
  return sw_shape_middle(shape, sw_madd(x, e, aside), &q, &e) > 0 &&
         sw_shape_middle(shape, sw_madd(x, e, -aside), &q, &e) > 0;
}

/* Most edges checked on each side. That is more than one radius of a drum with fine edges; on
 * nearly flat sides, more would cost more time than the step [-]. */
enum { FARTHEST = 64 };

/* 1 if a wire begins to go round something thick, or is held there, judged over one radius along
 * the wire. Its chords then touch the obstacle from the start: a curve that is replaced by chords
 * releases the wire, and the wire strikes the obstacle again. */
static int begins_round(const sw_system *s, const sw_body *b, double radius, size_t low,
                        size_t high) {
  const size_t far = (size_t)fmin(radius / b->plan->rest[low], FARTHEST);
  const size_t first = low > far ? low - far : 0, last = high + far;
  for (size_t i = first; i <= last + 1 && i < b->plan->nodes; i++)
    if (b->plan->held[i] != SW_FREE) return 1;
  return radius * bend_at(s, b, first, last) > SW_GOES_ROUND;
}

/* Firmness at an obstacle; round: curvature times radius. The nearest place of a wire that hardly
 * bends is definite: firmness there would make energy as the touch slides, and cost 20 % more
 * iterations (spec/contact/oblique_spec). */
static double firmness(int thin, double round) {
  const double least = thin ? LOOSE * sw_limit(round / LOOSE_FROM - 1.0, 0.0, 1.0) : 0.0;
  return fmax(least, round - SW_GOES_ROUND);
}

void sw_contact_find_round(const sw_contact *c, const sw_system *s, sw_candidate *k) {
  const sw_body *b = &s->bodies[k->body];
  const sw_plan *p = b->plan;
  const size_t i = k->node - b->first_node, high = i < p->edges ? i : p->edges - 1;
  const size_t low = k->segment || i == 0 ? high : i - 1;
  const double radius = c->round[k->obstacle] + p->beam.radius;
  const double edge = fmin(p->rest[low], p->rest[high]);
  const int thin = radius < THIN * edge;
  k->round = 0;
  if (!(c->round[k->obstacle] > 0)) return;
  const double round = radius * bend_beside(s, b, k->node, k->segment);
  const int wound = c->wound[k->obstacle] == (int)k->body + 1 || round > WOUND ||
                    (radius > SW_THICK * edge && begins_round(s, b, radius, low, high));
  k->round = thin || (!wound && passes_side(c, s, k, low, high));
  k->firm = firmness(thin, round);
  for (size_t j = 0; j < 2; j++) {
    const size_t beside = j ? high + 1 : high - (high > 0);
    k->firm_beside[j] = firmness(thin, radius * bend_at(s, b, beside, beside));
  }
  k->lone = fmin(1.0, fmax(0.0, (1.0 - round) / (1.0 - SW_GOES_ROUND)));
}

/* --- places ----------------------------------------------------------------------------------- */

/* Function that rises through 0 at the place of touch [m2]; NAN beyond the ends of the middle
 * line. */
static double rise_at(const sw_piece *c, double u) {
  sw_vec along, q, e;
  const sw_vec x = sw_contact_curve(c, u, &along);
  if (!(sw_shape_middle(c->shape, x, &q, &e) > 0)) return NAN;
  return sw_dot(along, sw_sub(x, q)) + c->firm * sw_norm2(along) * (u - 0.5);
}

enum { PARTS = 4, MOST_TURNS = 40 };  /* pieces of an edge; most search steps [-] */
static const double AS_SHARP = 1e-14; /* [-] */

/* Finds its zero between two places by secants; the value at an end that stays is halved (Illinois
 * method). */
static double find_place(const sw_piece *c, double low, double high, double at_low,
                         double at_high) {
  double last = low;
  for (int i = 0, side = 0; i < MOST_TURNS; i++) {
    const double u = (low * at_high - high * at_low) / (at_high - at_low), rise = rise_at(c, u);
    if (fabs(u - last) < AS_SHARP) return u;
    last = u;
    if (rise < 0) {
      low = u, at_low = rise;
      if (side < 0) at_high *= 0.5;
    } else {
      high = u, at_high = rise;
      if (side > 0) at_low *= 0.5;
    }
    side = rise < 0 ? -1 : 1;
  }
  return last;
}

/* Share of the stiffness of a place beside a joint to the next edge. Where a wire begins to go
 * round, places on two edges come near each other at their joint. With full stiffness of both, the
 * wire would get twice the force at once, be thrown back, and get one again. So the second place
 * takes over from the first gradually as the zero moves. */
static double share_beside(const sw_piece *c, double joint, double beside, double way) {
  sw_vec along, q, e;
  const sw_vec x = sw_contact_curve(c, joint, &along);
  const double both = 0.5 * (c->firm + beside) * sw_norm2(along);
  if (!(both > 0) || !(sw_shape_middle(c->shape, x, &q, &e) > 0)) return 1.0;
  const double rise = way * sw_dot(along, sw_sub(x, q)) + 0.5 * c->firm * sw_norm2(along);
  return fmin(1.0, fmax(0.0, rise / both));
}

static double share_of(const sw_piece *c) {
  const double before = c->starts ? 1.0 : share_beside(c, 0.0, c->firm_beside[0], -1.0);
  const double after = c->ends ? 1.0 : share_beside(c, 1.0, c->firm_beside[1], 1.0);
  return before * after;
}

/* Up to this share of w, its part perpendicular to the curve is rounding: the wire goes through the
 * middle of a ball [-]. */
static const double THROUGH = 1e-9;

/* Normal of a place with the offset w from the middle line: perpendicular to the curve and to the
 * line. The part of w perpendicular to the curve is not used: where the wire crosses the line
 * obliquely and the place is not the nearest one, it has a component along the line, which would
 * push the wire along the obstacle and make energy. For a ball the line is a point, and the normal
 * is that part of w. */
static sw_vec normal_of(sw_vec w, sw_vec along, sw_vec e) {
  const sw_vec out = sw_unit_or(sw_cross(along, e), sw_perpendicular(along));
  if (!(sw_norm2(e) > 0)) {
    const sw_vec across = sw_madd(w, along, -sw_dot(w, along));
    return sw_norm2(across) > THROUGH * THROUGH * sw_norm2(w) ? sw_unit_or(across, out) : out;
  }
  return sw_dot(out, w) < 0 ? sw_neg(out) : out;
}

/* Makes the place at u; 0: the wire runs along the obstacle. */
static int make_place(const sw_piece *c, double u, sw_place *place) {
  sw_vec tangent, q, e;
  const sw_vec x = sw_contact_curve(c, u, &tangent);
  const double radius = sw_shape_middle(c->shape, x, &q, &e);
  const sw_vec w = sw_sub(x, q), along = sw_unit_or(tangent, sw_v(0, 0, 1));
  const sw_vec n = normal_of(w, along, e);
  const double d = sw_dot(n, w);
  if (!(radius > 0) || !sw_contact_goes_across(along, e)) return 0;
  *place = (sw_place){.near = {.gap = d - radius,
                               .at = u,
                               .normal = n,
                               .point = sw_madd(q, n, radius),
                               .feature = SW_ON_CURVE},
                      .sharp = SW_SHARP_ROUND,
                      .edge = e,
                      .along = along,
                      .faint = 1.0 - share_of(c)};
  return 1;
}

/* A place along the edge: the curve, the nearest place of the middle line and its direction. */
typedef struct mark {
  double u, rise;
  sw_vec x, q, e;
} mark;

static mark mark_at(const sw_piece *c, double u) {
  sw_vec along;
  mark m = {.u = u, .rise = rise_at(c, u), .x = sw_contact_curve(c, u, &along)};
  (void)sw_shape_middle(c->shape, m.x, &m.q, &m.e);
  return m;
}

/* 1 if the function may rise, fall and rise again between two marks: the middle line there turns by
 * more than 15 degrees [-]. Inside a ring the nearest place of the middle line moves faster than
 * the wire, and jumps to the other side where the wire crosses the ring's axis. */
static int wavers(const mark *a, const mark *b) {
  const double little = 0.966; /* cosine of that */
  return sw_dot(a->e, b->e) < little && sw_dist(a->q, b->q) > 1.2 * sw_dist(a->x, b->x);
}

enum { MOST_HALVINGS = 12 }; /* of a part in which the function wavers [-] */

/* Lists the places between two marks. */
static void list_between(const sw_piece *c, double reach, const mark *a, const mark *b, int halvings,
                         sw_places *list) {
  sw_place place;
  if (halvings < MOST_HALVINGS && wavers(a, b)) {
    const mark mid = mark_at(c, 0.5 * (a->u + b->u));
    list_between(c, reach, a, &mid, halvings + 1, list);
    list_between(c, reach, &mid, b, halvings + 1, list);
    return;
  }
  if (a->rise < 0 && b->rise >= 0 && list->count < SW_PLACES_MOST &&
      make_place(c, find_place(c, a->u, b->u, a->rise, b->rise), &place) && place.near.gap < reach)
    list->place[list->count++] = place;
}

/* A ring may give several places. */
void sw_contact_round_places(const sw_piece *c, double reach, sw_places *list) {
  mark before = mark_at(c, 0.0);
  for (int i = 1; i <= PARTS; i++) {
    const mark after = mark_at(c, (double)i / PARTS);
    list_between(c, reach, &before, &after, 0, list);
    before = after;
  }
}

/* --- what is left to nodes and chords -------------------------------------------------------- */

int sw_contact_is_rounds(const sw_contact *c, const sw_candidate *k, sw_vec a, sw_vec b,
                         double at) {
  sw_vec q, along;
  return sw_shape_middle(c->obstacles[k->obstacle].shape, sw_lerp(a, b, at), &q, &along) > 0 &&
         sw_contact_goes_across(sw_sub(b, a), along);
}

int sw_contact_over_round(const sw_contact *c, const sw_candidate *k, const sw_closest *near,
                          sw_vec *along) {
  sw_vec q;
  const sw_vec node = sw_madd(near->point, near->normal, near->gap);
  return sw_shape_middle(c->obstacles[k->obstacle].shape, node, &q, along) > 0;
}
