/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines that pass through each other. Most steps only compare boxes and the direction of edges: a
 * line whose edges all go forward does not meet itself. Else there is a list of near segments,
 * valid until a node has moved by half of its spare. */
#include "mutual/through.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "base/halving.h"
#include "base/simd.h"
#include "mutual/cells.h"
#include "mutual/crossing.h"
#include "mutual/pair.h"
#include "system/join.h"

/* The list's spare is this multiple of the longest edge: a longer list lasts longer, but has more
 * neighbours along a straight line. Or this multiple of the nodes' way in the step, if that is more
 * [-]. */
static const double SPARE = 2.0, SPARE_WAYS = 4.0;
/* Axes that have crossed are clear beyond this share of the sum of radii [-]. */
static const double CLEAR = 0.5;
/* Segments on each side in which a crossing is searched after a step; most crossings that are
 * followed; with more near pairs than this, nothing is watched [-]. */
enum { WINDOW = 4, MOST_UNDER_WAY = 16, MOST_LISTED = 1000000 };
/* With more bodies than this the list is cheaper than comparing all boxes [-]. */
enum { MANY = 512 };

typedef struct listed {
  uint32_t one, two, body[2];
  double known, travel; /* distance when it was last measured; way of its nodes until then [m] */
  double reach;         /* sum of the radii [m] */
  sw_rods_past past;
} listed;

/* Two places whose axes have crossed and are not yet clear. */
typedef struct crossing {
  sw_pass at;
  int odd;     /* 1: they are on the other side */
  size_t step; /* in which they crossed last */
} crossing;

typedef struct box {
  sw_vec low, high;
} box;

struct sw_through {
  int looks;    /* 0: contact keeps all lines apart */
  double time;  /* of the state [s] */
  size_t steps; /* followed so far */
  size_t nodes, bodies;
  double *x0;         /* (nodes x 3) the state [m] */
  box *boxes, *swept; /* (bodies) of the state, and of the way to it; not of a lone line */
  double *twist0;     /* (spans) of the state [rad] */
  size_t x0_capacity, box_capacity, twist_capacity, spans;
  listed *list;
  size_t count, capacity;
  listed *flat; /* of the list before: pairs in a plane, whose side only the list knows */
  size_t flat_count, flat_capacity;
  int is_listed;              /* 1: the list is valid for nodes at listed_at */
  double spare;               /* distance beyond a crossing's up to which it is complete [m] */
  double *listed_at, *travel; /* (nodes x 3), (nodes) [m] */
  size_t at_capacity, travel_capacity;
  void *grid;
  size_t grid_capacity;
  crossing crossings[MOST_UNDER_WAY];
  size_t under_way;
};

static int is_line(const sw_body *b) { return !b->plan->web && b->plan->edges > 0; }

static int is_watched(const sw_system *s, const sw_mutual *contact, size_t a, size_t b) {
  if (!is_line(&s->bodies[a]) || !is_line(&s->bodies[b])) return 0;
  return !contact || !sw_mutual_keeps_apart(contact, a, b);
}

static int any_watched(const sw_system *s, const sw_mutual *contact) {
  for (size_t a = 0; a < s->body_count; a++)
    for (size_t b = a; b < s->body_count; b++)
      if (is_watched(s, contact, a, b)) return 1;
  return 0;
}

/* --- boxes ------------------------------------------------------------------------------------ */

static sw_vec lower(sw_vec a, sw_vec b) {
  return sw_v(a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z);
}
static sw_vec upper(sw_vec a, sw_vec b) {
  return sw_v(a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z);
}

SW_HOT
static box box_of(const sw_body *b, const double *x) {
  sw_vec low = sw_vec_at(x, b->first_node), high = low;
  for (size_t i = 1; i < b->plan->nodes; i++) {
    const sw_vec p = sw_vec_at(x, b->first_node + i);
    low = lower(low, p), high = upper(high, p);
  }
  return (box){low, high};
}

/* Takes the boxes of the present state, and of the way to it. A lone line needs none. */
static void take_boxes(sw_through *t, const sw_system *s, int anew) {
  for (size_t k = 0; t->bodies > 1 && t->bodies <= MANY && k < t->bodies; k++) {
    const sw_body *b = &s->bodies[k];
    if (!is_line(b) || (b->waits && !anew)) continue;
    const box before = t->boxes[k], now = box_of(b, s->x);
    t->boxes[k] = t->swept[k] = now;
    if (anew) continue;
    t->swept[k].low = lower(before.low, now.low);
    t->swept[k].high = upper(before.high, now.high);
  }
}

static int overlap(const box *a, const box *b, double room) {
  return a->low.x <= b->high.x + room && b->low.x <= a->high.x + room &&
         a->low.y <= b->high.y + room && b->low.y <= a->high.y + room &&
         a->low.z <= b->high.z + room && b->low.z <= a->high.z + room;
}

/* 1 if all edges go forward along the line from end to end. */
static int goes_forward(const sw_body *b, const double *x, sw_vec along) {
  for (size_t e = 0; e < b->plan->edges; e++)
    if (!(sw_dot(along, sw_edge_at(x, b->first_node + e)) > 0)) return 0;
  return 1;
}

/* 1 if lines may have met since the last state. */
static int may_meet(sw_through *t, const sw_system *s, const sw_mutual *contact) {
  if (t->bodies > MANY) return 1;
  take_boxes(t, s, 0);
  for (size_t k = 0; k < t->bodies; k++) {
    const sw_body *b = &s->bodies[k];
    if (!is_line(b)) continue;
    for (size_t m = k + 1; m < t->bodies; m++) {
      const double room = b->plan->beam.radius + s->bodies[m].plan->beam.radius;
      if ((b->waits && s->bodies[m].waits) || !overlap(&t->swept[k], &t->swept[m], room)) continue;
      if (is_watched(s, contact, k, m)) return 1;
    }
    if (b->waits || !is_watched(s, contact, k, k)) continue;
    const size_t last = b->first_node + b->plan->edges;
    const sw_vec along = sw_sub(sw_vec_at(s->x, last), sw_vec_at(s->x, b->first_node));
    if (!goes_forward(b, s->x, along) || !goes_forward(b, t->x0, along)) return 1;
  }
  return 0;
}

/* --- the list --------------------------------------------------------------------------------- */

typedef struct search {
  sw_through *t;
  const sw_system *s;
  const sw_mutual *contact;
} search;

/* Segments of one line are neighbours up to a length along it of half a turn of the smallest
 * radius. */
static int are_apart_along(const sw_body *b, size_t i, size_t j) {
  return j > i + 1 && b->plan->s[j] - b->plan->s[i + 1] >= M_PI * b->plan->beam.radius;
}

static double distance_of(const double *x, uint32_t one, uint32_t two) {
  double at[2];
  return sw_segments_nearest(sw_vec_at(x, one), sw_vec_at(x, one + 1u), sw_vec_at(x, two),
                             sw_vec_at(x, two + 1u), at);
}

static sw_status look_at(void *user, const sw_thing *a, const sw_thing *b) {
  const search *of = user;
  const sw_system *s = of->s;
  sw_through *t = of->t;
  listed n = {.one = a->node, .two = b->node, .body = {a->body, b->body}};
  if (b <= a || !is_watched(s, of->contact, n.body[0], n.body[1])) return SW_OK;
  const sw_body *body = &s->bodies[n.body[0]];
  if (n.body[0] == n.body[1] &&
      !are_apart_along(body, n.one - body->first_node, n.two - body->first_node))
    return SW_OK;
  n.reach = sw_pair_radii(s, n.body);
  n.known = distance_of(s->x, n.one, n.two);
  if (!(n.known - SW_CROSSING_NEAR * n.reach < t->spare) || sw_joins_near(s, n.one, n.two))
    return SW_OK;
  if (t->count == MOST_LISTED) return SW_ELIMIT;
  SW_TRY(SW_GROW(t->list, t->capacity, t->count + 1));
  t->list[t->count++] = n;
  return SW_OK;
}

static sw_rods rods_of(const listed *n, const double *x) {
  return (sw_rods){{sw_vec_at(x, n->one), sw_vec_at(x, n->one + 1u)},
                   {sw_vec_at(x, n->two), sw_vec_at(x, n->two + 1u)}};
}

static sw_status keep_sides(sw_through *t) {
  t->flat_count = 0;
  for (size_t k = 0; t->is_listed && k < t->count; k++) {
    if (!t->list[k].past.side && !(sw_norm(t->list[k].past.way) > 0)) continue;
    const sw_rods r = rods_of(&t->list[k], t->x0);
    if (sw_rods_side(&r, t->list[k].reach)) continue;
    SW_TRY(SW_GROW(t->flat, t->flat_capacity, t->flat_count + 1));
    t->flat[t->flat_count++] = t->list[k];
  }
  return SW_OK;
}

static void give_sides(sw_through *t) {
  for (size_t k = 0; k < t->flat_count; k++)
    SW_ITEMS(listed, n, t->list, t->count)
      if (n->one == t->flat[k].one && n->two == t->flat[k].two) n->past = t->flat[k].past;
}

static sw_status list_anew(sw_through *t, const sw_system *s, const sw_mutual *contact,
                           double way) {
  search of = {t, s, contact};
  double longest = 0, widest = 0;
  size_t segments = 0;
  sw_cells g;
  SW_ITEMS(const sw_body, b, s->bodies, s->body_count) {
    if (!is_line(b)) continue;
    segments += b->plan->edges, widest = fmax(widest, b->plan->beam.radius);
    for (size_t e = 0; e < b->plan->edges; e++)
      longest = fmax(longest, sw_norm2(sw_edge_at(s->x, b->first_node + e)));
  }
  longest = sqrt(longest);
  t->spare = fmax(SPARE * longest, SPARE_WAYS * way);
  SW_TRY(sw_cells_make(&t->grid, &t->grid_capacity, segments,
                       longest + t->spare + 2.0 * SW_CROSSING_NEAR * widest, &g));
  SW_ITEMS(const sw_body, b, s->bodies, s->body_count)
    for (size_t e = 0; is_line(b) && e < b->plan->edges; e++)
      sw_cells_put(&g, s->x, (uint32_t)(b - s->bodies), b->first_node + e, b->first_node + e + 1,
                   b->plan->beam.radius);
  SW_TRY(keep_sides(t));
  t->count = 0;
  for (size_t k = 0; k < g.count; k++) SW_TRY(sw_cells_around(&g, &g.things[k], look_at, &of));
  give_sides(t);
  SW_TRY(SW_FILL(t->listed_at, t->at_capacity, s->x, 3 * t->nodes));
  SW_TRY(SW_GROW_EMPTY(t->travel, t->travel_capacity, t->nodes));
  for (size_t i = 0; i < t->nodes; i++) /* the list is for this step, too */
    t->travel[i] = sw_dist(sw_vec_at(s->x, i), sw_vec_at(t->x0, i));
  t->is_listed = 1;
  return SW_OK;
}

/* Makes the list valid for the way from the last state to this one. Nodes' longest way: *way. */
static sw_status list_near(sw_through *t, const sw_system *s, const sw_mutual *contact,
                           double *way) {
  *way = sw_pairs_largest_move(s->x, t->x0, t->nodes);
  if (t->is_listed) {
    for (size_t i = 0; i < t->nodes; i++)
      t->travel[i] += sw_dist(sw_vec_at(s->x, i), sw_vec_at(t->x0, i));
    if (2.0 * sw_pairs_largest_move(s->x, t->listed_at, t->nodes) <= t->spare) return SW_OK;
  }
  return list_anew(t, s, contact, *way);
}

/* --- crossings -------------------------------------------------------------------------------- */

static double arc_of(const sw_system *s, uint32_t body, uint32_t node, double at) {
  const sw_body *b = &s->bodies[body];
  const size_t i = node - b->first_node;
  return b->plan->s[i] + at * b->plan->rest[i];
}

/* The places have crossed. Each crossing is counted once in a step. */
static void note(sw_through *t, const sw_system *s, const listed *n, const double at[2]) {
  const sw_pass here = {
      {n->body[0], n->body[1]},
      {arc_of(s, n->body[0], n->one, at[0]), arc_of(s, n->body[1], n->two, at[1])}};
  const double one = s->bodies[n->body[0]].plan->rest[n->one - s->bodies[n->body[0]].first_node];
  const double two = s->bodies[n->body[1]].plan->rest[n->two - s->bodies[n->body[1]].first_node];
  const double near = WINDOW * fmax(one, two) + n->reach;
  for (size_t k = 0; k < t->under_way; k++) {
    crossing *c = &t->crossings[k];
    if (c->at.body[0] != here.body[0] || c->at.body[1] != here.body[1]) continue;
    if (fabs(c->at.s[0] - here.s[0]) > near || fabs(c->at.s[1] - here.s[1]) > near) continue;
    if (c->step != t->steps) c->odd = !c->odd;
    c->at = here, c->step = t->steps;
    return;
  }
  if (t->under_way == MOST_UNDER_WAY) return;
  t->crossings[t->under_way++] = (crossing){.at = here, .odd = 1, .step = t->steps};
}

/* Looks at a pair that may have come near. Bounds of its distance leave out most of them. */
static void look_closer(sw_through *t, const sw_system *s, listed *n, double way) {
  const double *travel = t->travel;
  const double gone = travel[n->one] + travel[n->one + 1] + travel[n->two] + travel[n->two + 1];
  double at[2];
  if (n->known - (gone - n->travel) > SW_CROSSING_NEAR * n->reach) return;
  n->known = distance_of(s->x, n->one, n->two), n->travel = gone;
  if (n->known - 2.0 * way > SW_CROSSING_NEAR * n->reach) return;
  const sw_rods from = rods_of(n, t->x0), to = rods_of(n, s->x);
  if (sw_rods_cross(&from, &to, n->reach, &n->past, at)) note(t, s, n, at);
}

/* The state is now the system's. */
static void take(sw_through *t, const sw_system *s, double time) {
  for (size_t k = 0; k < t->bodies; k++) {
    const sw_body *b = &s->bodies[k];
    const size_t first = 3 * b->first_node;
    if (b->waits || !is_line(b)) continue;
    memcpy(t->x0 + first, s->x + first, 3 * b->plan->nodes * sizeof *t->x0);
  }
  if (t->spans) memcpy(t->twist0, s->twist, t->spans * sizeof *t->twist0);
  t->time = time;
}

sw_status sw_through_follow(sw_through *t, const sw_system *s, const sw_mutual *contact,
                            double time) {
  sw_status status = SW_OK;
  if (!t || !t->looks) return SW_OK;
  t->steps++;
  if (may_meet(t, s, contact)) {
    double way;
    status = list_near(t, s, contact, &way);
    for (size_t k = 0; status == SW_OK && k < t->count; k++) look_closer(t, s, &t->list[k], way);
    if (status == SW_ELIMIT) t->looks = 0, status = SW_OK;
  } else {
    t->is_listed = 0;
  }
  take(t, s, time);
  return status;
}

/* --- passes ----------------------------------------------------------------------------------- */

static size_t edge_at(const sw_plan *p, double s) {
  size_t i = 0;
  SW_FIRST_NOT(p->s[i] <= s, i, 0, p->nodes);
  return i ? (i < p->edges ? i - 1 : p->edges - 1) : 0;
}

/* Returns the least distance of segments near a crossing, and moves it there [m]. */
static double least_near(const sw_system *s, crossing *c) {
  const sw_body *one = &s->bodies[c->at.body[0]], *two = &s->bodies[c->at.body[1]];
  const size_t i = edge_at(one->plan, c->at.s[0]), j = edge_at(two->plan, c->at.s[1]);
  double least = HUGE_VAL;
  for (size_t a = i > WINDOW ? i - WINDOW : 0; a <= i + WINDOW && a < one->plan->edges; a++)
    for (size_t b = j > WINDOW ? j - WINDOW : 0; b <= j + WINDOW && b < two->plan->edges; b++) {
      if (one == two && !are_apart_along(one, a, b)) continue;
      const double d =
          distance_of(s->x, (uint32_t)(one->first_node + a), (uint32_t)(two->first_node + b));
      if (!(d < least)) continue;
      least = d;
      c->at.s[0] = one->plan->s[a] + 0.5 * one->plan->rest[a];
      c->at.s[1] = two->plan->s[b] + 0.5 * two->plan->rest[b];
    }
  return least;
}

int sw_through_next(sw_through *t, const sw_system *s, sw_pass *out) {
  for (size_t k = 0; t && k < t->under_way; k++) {
    crossing *c = &t->crossings[k];
    const crossing was = *c;
    const uint32_t body[2] = {(uint32_t)was.at.body[0], (uint32_t)was.at.body[1]};
    if (!(least_near(s, c) > CLEAR * sw_pair_radii(s, body))) continue;
    *c = t->crossings[--t->under_way];
    *out = was.at;
    if (was.odd) return 1;
    k--;
  }
  return 0;
}

/* --- life ------------------------------------------------------------------------------------- */

sw_status sw_through_begin(sw_through **out, const sw_system *s, const sw_mutual *contact,
                           double time) {
  if (!*out && !(*out = sw_alloc(1, sizeof **out))) return SW_ENOMEM;
  sw_through *t = *out;
  if (t->bodies != s->body_count || time < t->time) t->under_way = 0;
  t->looks = t->is_listed = 0; /* nothing is followed if memory runs out here */
  t->nodes = s->nodes, t->bodies = s->body_count, t->time = time;
  if (!any_watched(s, contact)) return SW_OK;
  SW_TRY(SW_FILL(t->x0, t->x0_capacity, s->x, 3 * t->nodes));
  t->spans = s->span_count;
  SW_TRY(SW_FILL(t->twist0, t->twist_capacity, s->twist, t->spans));
  SW_TRY(SW_GROW_EMPTY(t->boxes, t->box_capacity, 2 * t->bodies));
  t->swept = t->boxes + t->bodies;
  take_boxes(t, s, 1);
  t->looks = 1;
  return SW_OK;
}

int sw_through_last(const sw_through *t, const sw_system *s, sw_through_state *out) {
  if (!t || !t->looks || t->nodes != s->nodes || t->spans != s->span_count) return 0;
  *out = (sw_through_state){t->x0, t->twist0, t->time};
  return 1;
}

void sw_through_free(sw_through *t) {
  if (t)
    SW_FREE_ALL(t->x0, t->twist0, t->boxes, t->list, t->flat, t->listed_at, t->travel, t->grid, t);
}
