/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds segments near each other with a grid of cells. The list holds all pairs within a generous
 * reach. It is valid until a node has moved by half of the reserve of this reach. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "base/interrupt.h"
#include "base/simd.h"
#include "mutual/cells.h"
#include "mutual/pairs_curve.h"
#include "system/join.h"
#include "touch/same.h"

static double clamp01(double t) { return t < 0 ? 0 : t > 1 ? 1 : t; }

double sw_segments_nearest(sw_vec a0, sw_vec a1, sw_vec b0, sw_vec b1, double at[2]) {
  const sw_vec u = sw_sub(a1, a0), v = sw_sub(b1, b0), w = sw_sub(a0, b0);
  const double uu = sw_norm2(u), vv = sw_norm2(v), uv = sw_dot(u, v), uw = sw_dot(u, w),
               vw = sw_dot(v, w);
  const double det = uu * vv - uv * uv;
  double s = 0.5, t;
  if (det > 1e-12 * uu * vv) s = clamp01((uv * vw - vv * uw) / det);
  t = vv > 0 ? (uv * s + vw) / vv : 0.0;
  if (t < 0 || t > 1) {
    t = clamp01(t);
    s = uu > 0 ? clamp01((uv * t - uw) / uu) : 0.0;
  }
  at[0] = s, at[1] = t;
  return sw_dist(sw_madd(a0, u, s), sw_madd(b0, v, t));
}

/* --- the list ------------------------------------------------------------------ */

static double widest_radius(const sw_pairs *p, const sw_system *s) {
  double widest = 0;
  for (size_t b = 0; b < s->body_count; b++)
    if (sw_mutual_takes_part(&p->m, b)) widest = fmax(widest, s->bodies[b].plan->beam.radius);
  return widest;
}

/* 0 for segments of one wire that are too near along it, and for neighbours. A wire bent with the
 * smallest radius touches itself after a length of pi radii. */
static int apart_along(const sw_system *s, const sw_near *n) {
  if (n->body[0] != n->body[1]) return 1;
  const sw_body *b = &s->bodies[n->body[0]];
  const size_t i = n->one - b->first_node, j = n->two - b->first_node;
  return j > i + 1 && b->plan->s[j] - b->plan->s[i + 1] >= M_PI * b->plan->beam.radius;
}

double sw_pair_radii(const sw_system *s, const uint32_t body[2]) {
  return s->bodies[body[0]].plan->beam.radius + s->bodies[body[1]].plan->beam.radius;
}

/* With more near pairs than this, segments are much shorter than the wire is thick [-]. */
static const size_t MOST_NEAR = 30000000;

/* A search for near segments. */
typedef struct search {
  sw_pairs *p;
  const sw_system *s;
} search;

/* Adds a pair to the list if it is near. Of two segments the first one searches. */
static sw_status look_at(void *user, const sw_thing *t, const sw_thing *u) {
  const search *all = user;
  const sw_system *s = all->s;
  sw_pairs *p = all->p;
  sw_near n = {.one = t->node, .two = u->node, .body = {t->body, u->body}};
  double at[2];
  if (u <= t || !sw_mutual_rule(&p->m, n.body)->on || !apart_along(s, &n)) return SW_OK;
  n.distance = sw_segments_nearest(sw_vec_at(s->x, n.one), sw_vec_at(s->x, n.one + 1u),
                                   sw_vec_at(s->x, n.two), sw_vec_at(s->x, n.two + 1u), at);
  n.bulge = sw_pair_bulge(p, s, &n);
  n.known = n.distance -= n.bulge;
  n.radii = sw_pair_radii(s, n.body);
  if (!(n.distance - n.radii < p->listed_reach)) return SW_OK;
  if (sw_joins_near(s, n.one, n.two)) return SW_OK;
  if (p->near_count == MOST_NEAR) return SW_ELIMIT;
  SW_TRY(SW_GROW(p->near, p->near_capacity, p->near_count + 1));
  p->near[p->near_count++] = n;
  return SW_OK;
}

static void sort_from(sw_near *a, size_t n) {
  for (size_t i = 1; i < n; i++) {
    const sw_near v = a[i];
    size_t j = i;
    for (; j > 0 && a[j - 1].two > v.two; j--) a[j] = a[j - 1];
    a[j] = v;
  }
}

static sw_status list_anew(sw_pairs *p, const sw_system *s, double reach) {
  search all = {p, s};
  sw_cells g;
  SW_TRY(sw_cells_fill(&p->m, s, reach, 0, &g));
  p->near_count = 0;
  p->listed_reach = reach;
  p->listed_nodes = 0;
  for (size_t k = 0; k < g.count; k++) {
    const size_t first = p->near_count;
    if (sw_interrupted()) return SW_EINTR;
    SW_TRY(sw_cells_around(&g, &g.things[k], look_at, &all));
    sort_from(p->near + first, p->near_count - first);
  }
  SW_TRY(SW_GROW(p->listed_at, p->listed_capacity, 7 * s->nodes));
  p->before = p->listed_at + 3 * s->nodes;
  p->travel = p->before + 3 * s->nodes;
  p->listed_nodes = s->nodes;
  memcpy(p->listed_at, s->x, 3 * s->nodes * sizeof *s->x);
  memcpy(p->before, s->x, 3 * s->nodes * sizeof *s->x);
  memset(p->travel, 0, s->nodes * sizeof *p->travel);
  return SW_OK;
}

/* Square of the largest distance of a node between two sets of positions. */
SW_HOT
static double largest_distance2(size_t n, const double *restrict a, const double *restrict b) {
  double most = 0;
  for (size_t i = 0; i < n; i++) {
    const double x = a[3 * i] - b[3 * i], y = a[3 * i + 1] - b[3 * i + 1];
    const double z = a[3 * i + 2] - b[3 * i + 2], d2 = x * x + y * y + z * z;
    most = most > d2 ? most : d2;
  }
  return most;
}

double sw_pairs_largest_move(const double *x0, const double *x1, size_t nodes) {
  return sqrt(largest_distance2(nodes, x0, x1));
}

/* Adds the lengths of the nodes' paths since the last step, taken as straight. */
SW_HOT
static void add_travel(size_t n, const double *restrict x, double *restrict before,
                       double *restrict travel) {
  for (size_t i = 0; i < n; i++) {
    const double dx = x[3 * i] - before[3 * i], dy = x[3 * i + 1] - before[3 * i + 1];
    const double dz = x[3 * i + 2] - before[3 * i + 2];
    travel[i] += sqrt(dx * dx + dy * dy + dz * dz);
  }
  for (size_t i = 0; i < 3 * n; i++) before[i] = x[i];
}

/* The list's reach is GENEROSITY times the requested reach plus LEAST_SPARE of the largest radius,
 * so that it lasts longer. */
static const double GENEROSITY = 2.0;  /* factor [-] */
static const double LEAST_SPARE = 2.0; /* of the largest radius [-] */

sw_status sw_pairs_list(sw_pairs *p, const sw_system *s, double reach) {
  if (p->listed_nodes == s->nodes) {
    add_travel(s->nodes, s->x, p->before, p->travel);
    if (p->listed_reach - 2.0 * sw_pairs_largest_move(s->x, p->listed_at, s->nodes) >= reach)
      return SW_OK;
  }
  return list_anew(p, s, GENEROSITY * reach + LEAST_SPARE * widest_radius(p, s));
}

/* --- pairs of a step --------------------------------------------------------------- */

static double longest_edge(const sw_plan *p) {
  double longest = 0;
  for (size_t e = 0; e < p->edges; e++) longest = fmax(longest, p->rest[e]);
  return longest;
}

/* Segments touch along their length, not at a point, if they diverge by less than this along the
 * shorter of them. WOUND_SPREAD is for wires that stay beside each other, as in a twisted pair: as
 * crossings they would touch here and there, and the places would come and go. Shares of the sum of
 * radii [-]. */
static const double PARALLEL_SPREAD = 0.25, WOUND_SPREAD = 0.75;
/* WOUND_SPREAD is only for edges up to this many sums of radii: the nodes, which then touch, must
 * not be too far apart [-]. */
static const double WOUND_EDGE = 3.0;
/* A wire stays beside another one if the nodes beyond its segment are not further away than the
 * segment by more than this share of the sum of radii. Nodes of crossing wires are further away by
 * 0.2 and more [-]. */
static const double BESIDE = 0.1;
enum { NEIGHBOURS = 3 }; /* segments on each side in which the other wire is searched [-] */

static double distance_to(const double *x, sw_vec q, uint32_t segment) {
  const sw_vec a = sw_vec_at(x, segment), u = sw_edge_at(x, segment);
  const double at = sw_dot(sw_sub(q, a), u) / fmax(sw_norm2(u), 1e-300);
  return sw_dist(q, sw_madd(a, u, fmin(1.0, fmax(0.0, at))));
}

/* 1 if the node is at most `most` away from the wire near its segment. */
static int is_beside(const sw_system *s, sw_vec q, uint32_t body, uint32_t segment, double most) {
  const sw_body *b = &s->bodies[body];
  const size_t i = segment - b->first_node, from = i > NEIGHBOURS ? i - NEIGHBOURS : 0;
  for (size_t k = from; k <= i + NEIGHBOURS && k < b->plan->edges; k++)
    if (distance_to(s->x, q, (uint32_t)(b->first_node + k)) <= most) return 1;
  return 0;
}

static int goes_on_beside(const sw_system *s, const sw_near *n, double reach) {
  const sw_body *b = &s->bodies[n->body[0]];
  const size_t i = n->one - b->first_node;
  const double most = n->distance + n->bulge + BESIDE * reach;
  if (n->body[0] == n->body[1]) return 0;
  if (i > 0 && !is_beside(s, sw_vec_at(s->x, n->one - 1), n->body[1], n->two, most)) return 0;
  return i + 2 >= b->plan->nodes ||
         is_beside(s, sw_vec_at(s->x, n->one + 2), n->body[1], n->two, most);
}

static int is_parallel(const sw_system *s, const sw_near *n, double reach) {
  const sw_vec u = sw_edge_at(s->x, n->one), v = sw_edge_at(s->x, n->two);
  const double longer = fmax(sw_norm2(u), sw_norm2(v));
  const double spread2 = longer > 0 ? sw_norm2(sw_cross(u, v)) / longer : 0.0;
  const double usual = PARALLEL_SPREAD * reach, wound = WOUND_SPREAD * reach;
  if (spread2 < usual * usual) return 1;
  return spread2 < wound * wound && longer < WOUND_EDGE * WOUND_EDGE * reach * reach &&
         goes_on_beside(s, n, reach);
}

static double segment_mass(const sw_body *b, size_t node) {
  return b->plan->beam.mass * b->plan->rest[node - b->first_node];
}

static double lighter_mass(const sw_system *s, const sw_near *n) {
  return fmin(segment_mass(&s->bodies[n->body[0]], n->one),
              segment_mass(&s->bodies[n->body[1]], n->two));
}

/* Gap up to which a pair is chosen: a share of its radii, plus the approach by gravity and by its
 * speed (or an upper bound of it) in the step. */
static double reserve_of(const sw_pairs *p, double reach, double fast) {
  const double reserve = SW_LISTED_GAP * reach + p->m.fall + SW_RESERVE * p->m.h * fast;
  return reserve > p->m.least_reserve ? reserve : p->m.least_reserve;
}

static double travel_of(const sw_pairs *p, const sw_near *n) {
  return p->travel[n->one] + p->travel[n->one + 1] + p->travel[n->two] + p->travel[n->two + 1];
}

static double larger(double a, double b) { return a > b ? a : b; }

static double fastest(const sw_system *s) {
  double most = 0;
  for (size_t i = 0; i < s->nodes; i++) {
    const double v2 = sw_norm2(sw_vec_at(s->v, i));
    most = most > v2 ? most : v2;
  }
  return sqrt(most);
}

/* A pair is not in the matrix until it touches if its gap is larger than its approach in the step
 * plus this share of the sum of radii [-]. The zeros of a bundle's second neighbours would make the
 * factor twice as long. */
static const double TO_BRIDGE = .03;

/* Plans the pair's bridges in the matrix; for curves those of their crossing at the step's
 * start. */
static sw_status plan_bridges(sw_system *s, const sw_pair *k) {
  sw_bow bow[2] = {sw_bow_chord(k->one, 0), sw_bow_chord(k->two, 0)};
  double at[2] = {0.5, 0.5};
  int slides[2];
  if (k->smooth && sw_pair_crossing(s, k, s->x, at, slides))
    bow[0] = sw_pair_bow(s, k, 0, at[0]), bow[1] = sw_pair_bow(s, k, 1, at[1]);
  for (uint32_t i = 0; i < bow[0].spot.count; i++)
    for (uint32_t j = 0; j < bow[1].spot.count; j++)
      SW_TRY(sw_system_plan_bridge(s, bow[0].spot.node[i], bow[1].spot.node[j]));
  return SW_OK;
}

static sw_status add_pair(sw_pairs *p, sw_system *s, const sw_near *n, double sum) {
  const sw_ends ends = sw_segments(n->one, n->two, n->body);
  SW_TRY(SW_GROW(p->pairs, p->pair_capacity, p->m.pair_count + 1));
  sw_pair *k = &p->pairs[p->m.pair_count++];
  *k = (sw_pair){.one = n->one,
                 .two = n->two,
                 .body = {n->body[0], n->body[1]},
                 .parallel = is_parallel(s, n, sum),
                 .held = sw_ends_held(s, &ends),
                 .reach = sum,
                 .usual = fmax(fmin(p->m.base[n->body[0]], p->m.base[n->body[1]]),
                               p->m.rate2 * lighter_mass(s, n))};
  k->bridged = !k->held && n->distance - sum <= TO_BRIDGE * sum + p->m.h * sw_ends_speed(s, &ends);
  return SW_OK;
}

/* Finds the pairs that cross with curves, then the pattern of the matrix. */
static sw_status look_at_curves(sw_pairs *p, sw_system *s) {
  SW_ITEMS(sw_pair, k, p->pairs, p->m.pair_count) {
    sw_pair_find_curves(p, s, k);
    if (k->bridged) SW_TRY(plan_bridges(s, k));
  }
  return SW_OK;
}

/* 1 if a pair may touch in the step and is chosen. The distance is measured only if its lower bound
 * is small enough. */
static int may_touch(sw_pairs *p, const sw_system *s, sw_near *n, double fast) {
  const int still = p->m.regime == SW_CONTACT_STATIC;
  const double sum = n->radii;
  double at[2];
  n->distance = n->known - (travel_of(p, n) - n->travel); /* lower bound */
  if (n->distance - sum >= reserve_of(p, sum, fast)) return 0;
  n->distance = sw_segments_nearest(sw_vec_at(s->x, n->one), sw_vec_at(s->x, n->one + 1u),
                                    sw_vec_at(s->x, n->two), sw_vec_at(s->x, n->two + 1u), at);
  n->distance -= n->bulge = sw_pair_bulge(p, s, n);
  n->known = n->distance, n->travel = travel_of(p, n);
  const sw_ends ends = sw_segments(n->one, n->two, n->body);
  return n->distance - sum < reserve_of(p, sum, still ? 0.0 : sw_ends_speed(s, &ends));
}

/* Makes the list of segments near each other; *fast: bound of their relative speeds [m/s]. */
static sw_status list_near(sw_pairs *p, const sw_system *s, double *fast) {
  *fast = p->m.regime == SW_CONTACT_STATIC ? 0.0 : 2.0 * fastest(s);
  for (size_t b = 0; b < s->body_count; b++)
    if (sw_mutual_takes_part(&p->m, b)) p->edge[b] = longest_edge(s->bodies[b].plan);
  return sw_pairs_list(p, s, reserve_of(p, 2.0 * widest_radius(p, s), *fast));
}

/* A woken body wakes its neighbours. */
sw_status sw_pairs_wake(sw_mutual *m, sw_system *s) {
  sw_pairs *p = sw_pairs_of(m);
  double fast;
  SW_TRY(list_near(p, s, &fast));
  for (int any = 1; any;) {
    any = 0;
    for (size_t k = 0; k < p->near_count; k++) {
      sw_body *one = &s->bodies[p->near[k].body[0]], *two = &s->bodies[p->near[k].body[1]];
      if (one->waits == two->waits || !may_touch(p, s, &p->near[k], fast)) continue;
      one->waits = two->waits = 0;
      any = 1;
    }
  }
  return SW_OK;
}

static int both_wait(const sw_system *s, const sw_near *n) {
  return s->bodies[n->body[0]].waits && s->bodies[n->body[1]].waits;
}

sw_status sw_pairs_choose(sw_mutual *m, sw_system *s) {
  sw_pairs *p = sw_pairs_of(m);
  double fast;
  SW_TRY(list_near(p, s, &fast));
  p->least_left = -HUGE_VAL;
  SW_TRY(sw_system_begin_plan(s));
  SW_ITEMS(sw_near, n, p->near, p->near_count) {
    if (sw_interrupted()) return SW_EINTR;
    if (s->waiting && both_wait(s, n)) continue;
    if (may_touch(p, s, n, fast))
      SW_TRY(add_pair(p, s, n, n->radii));
    else
      p->least_left = larger(p->least_left, n->radii - n->distance);
  }
  sw_pairs_match(p);
  return look_at_curves(p, s);
}
