/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the candidates of a step (a node or segment, and an obstacle that it may touch), and the
 * stiffness of new touches. */
#include <math.h>

#include "base/alloc.h"
#include "base/interrupt.h"
#include "contact/arc.h"
#include "contact/depth.h"
#include "contact/pads.h"
#include "contact/round.h"
#include "touch/same.h"

/* Stiffness over mass/hbar^2 in implicit steps. It is far above what the step resolves: the gap
 * closes to 1/1000 of the free fall [-]. */
static const double IMPLICIT_SHARE = 1000.0;
/* An explicit step is stable while k h^2 / m stays below 4 [-]. */
static const double EXPLICIT_SHARE = 0.2;
static const double STAGE_SHARE = 0.3; /* hbar of the default method over the step [-] */
static const double SKIN = 1.5;        /* nearer places than this many radii are candidates [-] */

static int outside(const sw_bounds *b, sw_vec low, sw_vec high) {
  return low.x > b->max.x || high.x < b->min.x || low.y > b->max.y || high.y < b->min.y ||
         low.z > b->max.z || high.z < b->min.z;
}

static inline double larger(double a, double b) { return a > b ? a : b; }
static inline double smaller(double a, double b) { return a < b ? a : b; }

static inline sw_vec low_of(sw_vec a, sw_vec b) {
  return sw_v(smaller(a.x, b.x), smaller(a.y, b.y), smaller(a.z, b.z));
}
static inline sw_vec high_of(sw_vec a, sw_vec b) {
  return sw_v(larger(a.x, b.x), larger(a.y, b.y), larger(a.z, b.z));
}

double sw_flight_reserve(const sw_contact *c, const sw_system *s, sw_vec v) {
  const double g = sw_norm(sw_load(s->gravity));
  const double reserve = 1.5; /* [-] */
  return reserve * c->h * (sw_norm(v) + g * c->h) + SW_FLIGHT_LEAST;
}

/* Adds the distance of a line's smooth curve from its chords at each node. The curve touches edges
 * and corners that the chords do not reach. Otherwise a limp wire with coarse edges would sink into
 * an edge in short steps, whose reach is little more than the radius. */
static void add_bulge(const sw_system *s, const sw_body *b, double *reach) {
  const double *const x = s->x + 3 * b->first_node;
  if (b->plan->web || b->plan->beam.rolls) return;
  for (size_t i = 1; i + 1 < b->plan->nodes; i++) {
    const sw_vec before = sw_vec_at(x, i - 1), own = sw_vec_at(x, i), after = sw_vec_at(x, i + 1);
    reach[i] += sw_norm(sw_add(sw_sub(before, own), sw_sub(after, own))) / 8.0;
  }
}

/* Finds for each node the widest gap to a resting obstacle that may close in the step. */
static void reach_out(sw_contact *c, const sw_system *s, const sw_body *b) {
  const double radius = b->plan->beam.radius;
  double *const reach = c->reach + b->first_node;
  const double *const v = s->v + 3 * b->first_node;
  const double whole = b->plan->length + (b->plan->web ? 2.0 * radius : 0.0);
  const double still = radius * SKIN + c->widening * sw_flight_reserve(c, s, sw_v(0, 0, 0));
  const double time = c->widening * (sw_flight_reserve(c, s, sw_v(1, 0, 0)) -
                                     sw_flight_reserve(c, s, sw_v(0, 0, 0)));
  for (size_t i = 0; i < b->plan->nodes; i++)
    reach[i] = c->regime == SW_CONTACT_STATIC ? whole : still + time * sw_norm(sw_load(v + 3 * i));
  if (c->regime != SW_CONTACT_STATIC) add_bulge(s, b, reach);
}

/* The same for obstacle o, with its motion. */
static double reach_of(const sw_contact *c, const sw_system *s, size_t node, size_t o) {
  if (c->regime == SW_CONTACT_STATIC || !c->broad.moves[o]) return c->reach[node];
  const sw_vec x = sw_contact_where(c, s->x, node, node, 0);
  return c->reach[node] + sw_norm(sw_obstacle_velocity(&c->start[o], x)) * c->h;
}

/* Decides whether the wire touches the candidate's obstacle with its smooth curve or its chords. */
static void find_smooth(const sw_contact *c, const sw_system *s, sw_candidate *k) {
  const sw_body *b = &s->bodies[k->body];
  if (b->plan->web || b->plan->beam.rolls) return;
  sw_contact_find_round(c, s, k);
  k->smooth = c->sharp[k->obstacle] || k->round || sw_contact_meets_curve(c, s, k);
}

static sw_status add_candidate(sw_contact *c, const sw_system *s, size_t body, size_t node,
                               size_t other, int o, int segment) {
  const sw_body *b = &s->bodies[body];
  const double *masses = b->plan->lumped;
  SW_TRY(SW_GROW(c->candidates, c->candidate_capacity, c->candidate_count + 1));
  sw_contact_expect(c, o);
  c->candidates[c->candidate_count++] =
      (sw_candidate){.obstacle = o,
                     .segment = segment,
                     .node = node,
                     .other = other,
                     .body = body,
                     .radius = b->plan->beam.radius,
                     .skin = sw_plan_skin(b->plan, node - b->first_node),
                     .mass = 0.5 * (masses[node - b->first_node] + masses[other - b->first_node])};
  sw_candidate *k = &c->candidates[c->candidate_count - 1];
  find_smooth(c, s, k);
  k->arcs = sw_contact_arcs(c, s, k);
  return SW_OK;
}

/* Returns the other end of segment number k (from 1) that starts at node i, or i if there is
 * none. */
static size_t other_end(const sw_plan *p, size_t i, int k) {
  const sw_web *w = p->web;
  if (!w) return k == 1 && i + 1 < p->nodes ? i + 1 : i;
  const size_t at = w->side_first[i] + (size_t)k - 1;
  return at < w->side_first[i + 1] ? w->side[at] : i;
}

static sw_status segment_candidates(sw_contact *c, const sw_system *s, size_t body, size_t i,
                                    size_t o, double reach) {
  const sw_body *b = &s->bodies[body];
  const size_t node = b->first_node + i;
  const sw_vec x = sw_contact_where(c, s->x, node, node, 0);
  for (int k = 1; other_end(b->plan, i, k) != i; k++) {
    const size_t other = b->first_node + other_end(b->plan, i, k);
    const sw_vec y = sw_contact_where(c, s->x, other, other, 0);
    const double wide = larger(reach, reach_of(c, s, other, o));
    const sw_vec w = sw_v(wide, wide, wide);
    if (outside(&c->bounds[o], sw_sub(low_of(x, y), w), sw_add(high_of(x, y), w))) continue;
    SW_TRY(add_candidate(c, s, body, node, other, (int)o, k));
    sw_candidate *own = &c->candidates[c->candidate_count - 1];
    own->samples = sw_pad_samples(c, b->plan, i, o);
    if (own->samples) own->smooth = own->round = own->arcs = 0;
  }
  return SW_OK;
}

/* A node and the other ends of its segments. */
typedef struct outlook {
  sw_vec x;      /* the node's position [m] */
  sw_bounds box; /* of all nodes [m] */
  double reach;  /* largest reach of these nodes, without the motion of obstacles [m] */
} outlook;

static outlook look_out(const sw_contact *c, const sw_system *s, const sw_body *b, size_t i) {
  const size_t node = b->first_node + i;
  const sw_vec x = sw_contact_where(c, s->x, node, node, 0);
  outlook out = {x, {x, x}, c->reach[node]};
  for (int k = 1; other_end(b->plan, i, k) != i; k++) {
    const size_t other = b->first_node + other_end(b->plan, i, k);
    const sw_vec y = sw_contact_where(c, s->x, other, other, 0);
    out.box = (sw_bounds){low_of(out.box.min, y), high_of(out.box.max, y)};
    out.reach = larger(out.reach, c->reach[other]);
  }
  return out;
}

static int out_of_reach(const sw_bounds *b, const outlook *at) {
  const sw_vec r = sw_v(at->reach, at->reach, at->reach);
  return outside(b, sw_sub(at->box.min, r), sw_add(at->box.max, r));
}

static sw_status obstacle_candidates(sw_contact *c, const sw_system *s, size_t body, size_t i,
                                     const outlook *at, size_t o) {
  const sw_body *b = &s->bodies[body];
  const size_t node = b->first_node + i;
  sw_closest near;
  if (c->obstacles[o].off) return SW_OK;
  if (!c->broad.moves[o] && out_of_reach(&c->bounds[o], at)) return SW_OK;
  const double reach = reach_of(c, s, node, o);
  const sw_vec r = sw_v(reach, reach, reach);
  if (!(c->spaced[o] > 0) && !outside(&c->bounds[o], sw_sub(at->x, r), sw_add(at->x, r)) &&
      sw_shape_point(c->obstacles[o].shape, sw_pose_local(c->start[o].pose, at->x), reach, &near))
    SW_TRY(add_candidate(c, s, body, node, node, (int)o, 0));
  if (c->flat[o] || c->dense[o]) return SW_OK;
  return segment_candidates(c, s, body, i, o, reach);
}

static sw_status node_candidates(sw_contact *c, sw_system *s, size_t body, size_t i) {
  size_t count;
  const outlook at = look_out(c, s, &s->bodies[body], i);
  const int *near = sw_broad_near(&c->broad, &at.box, at.reach, &count, &s->counters.looks);
  for (size_t k = 0; k < count; k++)
    SW_TRY(obstacle_candidates(c, s, body, i, &at, (size_t)near[k]));
  return SW_OK;
}

/* Order of candidates and memory: node, then obstacle, then segment. */
static int before(const sw_contact *c, const sw_memory *m, const sw_candidate *k) {
  if (m->node != k->node) return m->node < k->node;
  const int id = c->obstacles[k->obstacle].id;
  if (m->obstacle != id) return m->obstacle < id;
  return m->segment < k->segment;
}

/* A mesh that lies on something has soft touches for its weight, and touches keep their stiffness.
 * When pads come, these touches become as stiff as new ones, with the same force; their excess
 * depth is reduced slowly. Into soft touches, a section that pads widen would sink: the push on a
 * table was 0.013 instead of 0.37 N if the gripper came 1 ms after the wire
 * (spec/contact/pads_come_spec). In statics touches are stiffened anyway. */
static void make_firm(sw_contact *c, const sw_candidate *k) {
  if (!(k->least > 0) || c->regime != SW_CONTACT_IMPLICIT) return;
  for (size_t m = k->memory; m < k->memory_end; m++) sw_kept_firm(&c->memory[m].kept, k->least);
}

static void match_memory(sw_contact *c) {
  size_t m = 0;
  for (size_t i = 0; i < c->candidate_count; i++) {
    sw_candidate *k = &c->candidates[i];
    while (m < c->memory_count && before(c, &c->memory[m], k)) m++;
    k->memory = m;
    const int id = c->obstacles[k->obstacle].id;
    while (m < c->memory_count && c->memory[m].node == k->node && c->memory[m].obstacle == id &&
           c->memory[m].segment == k->segment)
      m++;
    k->memory_end = m;
    make_firm(c, k);
    k->last = k->last_end = 0;
  }
}

void sw_contact_stiffness(sw_contact_regime regime, const sw_plan *p, double force, double nominal,
                          double *base, double *rate2) {
  *base = force / sw_depth_for(SW_ALLOWED_DEPTH, p->web ? SW_THIN : p->beam.radius);
  *rate2 = 0;
  if (regime == SW_CONTACT_IMPLICIT)
    *rate2 = IMPLICIT_SHARE / (STAGE_SHARE * STAGE_SHARE * nominal * nominal);
  if (regime == SW_CONTACT_EXPLICIT) {
    *base = 0;
    *rate2 = EXPLICIT_SHARE / (nominal * nominal);
  }
}

/* Smallest stiffness of touches of an object of particles, over a bound on a particle's own
 * stiffness. The object may be weightless [-]. */
static const double HARD_SHARE = 1.0;

/* A mesh shorter than this many radii is a slice: it represents a section and does not bend. The
 * stiffness of its touches is HARDER times that of a solid section against squeezing, computed from
 * its EA [-]. */
static const double SLICE = 1.0, HARDER = 100.0;
/* The same for a ring with a wall: multiple of wall times length over radius^3 [-]. */
static const double HARDER_WALL = 1e5;

/* Stiffness of touches between objects of particles, and of particles with wires, over the
 * stiffness that holds a particle. Then no force presses a particle in by more than a tenth of the
 * object's own compression [-]. */
static const double HARDER_GRAIN = 10.0;

double sw_contact_hardness(const sw_web *web, size_t particle) {
  return HARDER_GRAIN * web->behind[particle];
}

/* Share of the body's usual force that one touch carries [N]. */
static double usual_force(const sw_plan *p, double weight) {
  const double L = p->length, r = p->beam.radius;
  if (!p->web || L >= SLICE * r) return fmax(weight, p->beam.EI / (L * L));
  const double solid = HARDER * p->beam.EA * L / (M_PI * r * r);
  const double ring = HARDER_WALL * p->web->wall * L / (r * r * r);
  return fmax(weight, SW_ALLOWED_DEPTH * (ring > 0 ? ring : solid));
}

/* Stiffness of the touches of a wire wound on something thick and round: at least EA/R [N/m]. Where
 * the wire runs on with the force Q, it sinks in by Q/k, and it rises again further on. This
 * stretches it by EA Q/(k R), and friction keeps part of this. The tension is off by 5 % of the
 * brake's force with EA/R, by 18 % with a tenth of it, and by 1 % with four times as much, which
 * takes 1.6 times the iterations (H07V-K 10, 10 N, edges of R/10; spec/contact/winding_spec). In
 * poses the same on obstacles that move, and on facets as narrow as an edge: with usual touches the
 * wire was 48 um deep, and kept 0.8 to 1.3 times its tension (spec/contact/wound_poses_spec). On
 * wider facets such touches would take seven times the iterations. */
static double round_stiffness(const sw_contact *c, const sw_body *b, const sw_candidate *k) {
  const size_t i = k->node - b->first_node, o = (size_t)k->obstacle;
  const double edge = b->plan->rest[i < b->plan->edges ? i : i - 1];
  const int still = c->regime == SW_CONTACT_STATIC;
  if (c->regime == SW_CONTACT_EXPLICIT || b->plan->web || k->round) return 0;
  if (still && (!c->broad.moves[o] || c->obstacles[o].grips > 0)) return 0;
  const double bare = still && c->facet[o] <= edge ? c->facet_radius[o] : 0.0;
  const double radius = fmax(c->round[o], bare) + b->plan->beam.radius;
  return fmax(c->round[o], bare) > 0 && radius > SW_THICK * edge ? b->EA / radius : 0.0;
}

/* Sets the stiffness of a wire's new touches, from its weight, its bending or the force of a
 * pad. */
static void set_stiffness(sw_contact *c, const sw_system *s, size_t body, size_t first) {
  const sw_plan *p = s->bodies[body].plan;
  const double L = p->length, weight = p->beam.mass * L * sw_norm(sw_load(s->gravity));
  double base, rate2;
  sw_contact_stiffness(c->regime, p, usual_force(p, weight), c->nominal, &base, &rate2);
  if (p->web && !p->web->per_ring && c->regime != SW_CONTACT_EXPLICIT)
    rate2 = fmax(rate2, HARD_SHARE * 0.5 * (p->web->rate2 + p->web->solid_rate2));
  const double squeezing = sw_contact_squeezing_force(s, p);
  for (size_t i = first; i < c->candidate_count; i++) {
    sw_candidate *k = &c->candidates[i];
    const double grips = c->obstacles[k->obstacle].grips;
    k->squeezing = squeezing;
    k->usual = fmax(fmax(base, rate2 * k->mass), round_stiffness(c, &s->bodies[body], k));
    if (k->samples) k->usual *= SW_LEAST_SAMPLES / (double)k->samples;
    k->least = p->web && c->regime != SW_CONTACT_EXPLICIT
                   ? sw_pad_mesh_stiffness(c, p, k->node - s->bodies[body].first_node,
                                           sw_vec_at(s->x, k->node), (size_t)k->obstacle)
                   : 0.0;
    k->usual = fmax(k->usual, k->least);
    if (p->web || !(grips > 0)) continue;
    const double soft = sw_pad_stiffness(c, p, k, k->node - s->bodies[body].first_node);
    k->given = c->regime != SW_CONTACT_EXPLICIT;
    k->usual = k->given
                   ? soft
                   : fmin(soft, k->usual); /* without this limit explicit steps may be unstable */
  }
}

/* Makes room for one candidate at each node: the usual number if all wires lie on one obstacle. */
static sw_status reserve(sw_contact *c, size_t nodes) {
  return SW_GROW(c->candidates, c->candidate_capacity, nodes);
}

/* Makes empty lists with room for many touches: lists that grow one by one would be copied
 * often. */
static sw_status make_room(sw_contact *c, size_t bodies) {
  const size_t n = c->candidate_count;
  SW_TRY(SW_GROW(c->ranges, c->range_capacity, bodies));
  SW_TRY(SW_GROW_EMPTY(c->touches, c->touch_capacity, n));
  SW_TRY(SW_GROW_EMPTY(c->last, c->last_capacity, n));
  return SW_GROW_EMPTY(c->pressed, c->pressed_capacity, SW_BOOK_STAGES * n);
}

sw_status sw_contact_find_candidates(sw_contact *c, sw_system *s, sw_error *err) {
  sw_status status = SW_GROW(c->reach, c->reach_capacity, s->nodes);
  if (status == SW_OK) status = reserve(c, s->nodes);
  if (status == SW_OK) status = sw_broad_update(c);
  if (status == SW_OK) status = sw_contact_wait(c, s);
  c->candidate_count = c->touch_count = c->last_count = c->pressed_count = 0;
  c->unmarked = 1;
  c->hardens = c->falls = 0;
  memset(c->wound, 0, c->count * sizeof *c->wound);
  memset(c->curved, 0, c->count * sizeof *c->curved);
  for (size_t b = 0; b < s->body_count && status == SW_OK; b++) {
    const size_t first = c->candidate_count;
    if (s->bodies[b].waits) continue;
    const sw_web *web = s->bodies[b].plan->web;
    sw_pads_look(c, s->bodies[b].plan);
    sw_contact_find_wound(c, s, b);
    sw_contact_find_curved(c, s, b);
    reach_out(c, s, &s->bodies[b]);
    for (size_t i = 0; i < s->bodies[b].plan->nodes && status == SW_OK; i++)
      if (sw_interrupted())
        status = SW_EINTR;
      else if (!web || web->outer[i])
        status = node_candidates(c, s, b, i);
    set_stiffness(c, s, b, first);
    sw_contact_find_drawn(c, s, b, first);
  }
  if (status == SW_OK) status = make_room(c, s->body_count);
  if (status != SW_OK) return sw_fail(err, status, "contact: %s", sw_status_text(status));
  match_memory(c);
  return SW_OK;
}
