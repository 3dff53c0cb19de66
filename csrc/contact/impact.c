/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Impacts. A step that meets an obstacle it did not touch before
 * is redone with the approach speed cut to what just reaches the surface (or
 * turned round by the restitution): the impulse acts at the step's start, and
 * the integrator never sees the shock that would make it bounce. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "contact/round.h"
#include "contact/same.h"

static int was_struck(const sw_contact *c, const sw_pressed *t, size_t node, size_t *looks) {
  for (uint32_t i = c->impact_at[node]; i; i = c->impacts[i - 1].before) {
    const sw_impact *m = &c->impacts[i - 1];
    const double ahead = node < t->node ? -1.0 : node > t->node ? 1.0 : 0.0;
    ++*looks;
    if (m->obstacle == t->obstacle && m->segment == t->segment &&
        fabs(ahead + m->at - t->at) < SW_SAME_TOUCH)
      return 1;
  }
  return 0;
}

/* On the smooth curve, another iterate may find the same touch from the segment beside. */
static int dealt_with(const sw_contact *c, const sw_pressed *t, size_t *looks) {
  if (was_struck(c, t, t->node, looks)) return 1;
  if (!t->sharp) return 0;
  return (t->node > 0 && was_struck(c, t, t->node - 1, looks)) ||
         (t->node + 1 < c->places && was_struck(c, t, t->node + 1, looks));
}

static void note_impact(sw_contact *c, const sw_pressed *t) {
  if (sw_grow((void **)&c->impacts, &c->impact_capacity, c->impact_count + 1, sizeof *c->impacts) !=
      SW_OK)
    return;
  c->impacts[c->impact_count++] = (sw_impact){.obstacle = t->obstacle,
                                              .segment = t->segment,
                                              .node = t->node,
                                              .at = t->at,
                                              .before = c->impact_at[t->node]};
  c->impact_at[t->node] = (uint32_t)c->impact_count;
}

sw_status sw_contact_calm(sw_contact *c, size_t nodes) {
  for (size_t i = 0; i < c->impact_count; i++) c->impact_at[c->impacts[i].node] = 0;
  for (size_t i = 0; i < c->barrier_count; i++) c->barrier_at[c->barriers[i].node] = 0;
  c->barrier_count = c->impact_count = 0;
  if (nodes <= c->places) return SW_OK;
  c->places = 0;
  SW_TRY(sw_grow((void **)&c->impact_at, &c->place_capacity, 2 * nodes, sizeof *c->impact_at));
  memset(c->impact_at, 0, 2 * nodes * sizeof *c->impact_at);
  c->barrier_at = c->impact_at + nodes;
  c->places = nodes;
  return SW_OK;
}

/* Share of the momentum that each node of a touch takes; held ones take none. */
static void shares(const sw_system *s, const sw_pressed *t, double out[SW_MEAN_MOST]) {
  const sw_body *b = &s->bodies[t->body];
  double sum = 0;
  for (size_t e = 0; e < t->spot.count; e++) {
    const int held = b->plan->held[t->spot.node[e] - b->first_node] != SW_FREE;
    out[e] = held ? 0.0 : t->spot.w[e];
    sum += out[e] * out[e];
  }
  for (size_t e = 0; e < t->spot.count; e++) out[e] = sum > 0 ? out[e] / sum : 0.0;
}

/* A gap this small is none: what touches already takes on the obstacle's speed [m]. */
static const double CLOSED = 1e-6;

/* Mean velocity of the obstacle's material at p in the step. */
static sw_vec mean_velocity(const sw_contact *c, int obstacle, sw_vec p) {
  const sw_contact_at *from = &c->start[obstacle], *to = &c->now[obstacle];
  if (!(c->stage_time > c->time)) return sw_obstacle_velocity(from, p);
  const sw_vec after = sw_pose_point(to->pose, sw_pose_local(from->pose, p));
  return sw_scale(sw_sub(after, p), 1.0 / (c->stage_time - c->time));
}

/* The obstacle's velocity at p that matters to an impact, and the approach that does not [m/s].
 * What touches goes on with the speed at the step's start, and what the obstacle gains in the
 * step is no impact: the integrator deals with it, and a restart would only disturb it. A gap
 * closes on the way, so there it is the mean speed: struck with that of the start, a wire would
 * be reached early and leave again. */
static sw_vec striking_velocity(const sw_contact *c, const sw_pressed *t, sw_vec p, double gap,
                                double *slow) {
  const sw_vec start = sw_obstacle_velocity(&c->start[t->obstacle], p);
  const sw_vec mean = mean_velocity(c, t->obstacle, p);
  *slow = SW_SLOWEST_IMPACT;
  if (gap > CLOSED) return mean;
  *slow += 2.0 * fabs(sw_dot(sw_sub(mean, start), t->normal));
  return start;
}

/* The free particles of a node's section, or the node alone; mass and centre of mass. */
typedef struct section {
  size_t first, end;
  double mass;   /* [kg] */
  sw_vec centre; /* [m] */
} section;

static section section_of(const sw_system *s, const sw_body *b, size_t node) {
  const sw_web *web = b->plan->web;
  section c = {.first = node - b->first_node, .centre = {0, 0, 0}};
  c.end = c.first + 1;
  if (web && web->per_ring) {
    const size_t ring = sw_web_ring_of(web, c.first);
    c.first = web->first[ring], c.end = web->first[ring + 1];
  }
  for (size_t k = c.first; k < c.end; k++) {
    if (b->plan->held[k] != SW_FREE) continue;
    c.mass += b->plan->lumped[k];
    c.centre = sw_madd(c.centre, sw_load(s->x + 3 * (b->first_node + k)), b->plan->lumped[k]);
  }
  if (c.mass > 0) c.centre = sw_scale(c.centre, 1.0 / c.mass);
  return c;
}

/* A particle alone has none: what rounding leaves of it is not to count [kg m2]. */
static double inertia_about(const sw_system *s, const sw_body *b, const section *c, sw_vec axis) {
  double sum = 0;
  if (c->end - c->first == 1) return 0;
  for (size_t k = c->first; k < c->end; k++) {
    const sw_vec r = sw_sub(sw_load(s->x + 3 * (b->first_node + k)), c->centre);
    if (b->plan->held[k] == SW_FREE) sum += b->plan->lumped[k] * sw_norm2(sw_cross(axis, r));
  }
  return sum;
}

/* Change a node's velocity by dv. What strikes a particle of a wire stops the whole section, as a
 * rigid one that may turn: its springs do that within any step but the shortest, and would throw it
 * back. Returns the impulse over |dv| [kg]. */
static double kick(sw_system *s, const sw_body *b, size_t node, sw_vec dv) {
  const section c = section_of(s, b, node);
  const sw_vec arm = sw_sub(sw_load(s->x + 3 * node), c.centre), moment = sw_cross(arm, dv);
  const sw_vec axis = sw_unit_or(moment, sw_v(0, 0, 0));
  const double inertia = inertia_about(s, b, &c, axis), lever2 = sw_norm2(moment);
  const double turns = inertia > 0 ? c.mass * lever2 / (inertia * sw_norm2(dv)) : 0.0;
  const double share = 1.0 / (1.0 + turns);
  const sw_vec spin = inertia > 0 ? sw_scale(moment, share * c.mass / inertia) : sw_v(0, 0, 0);
  for (size_t k = c.first; k < c.end; k++) {
    const size_t i = b->first_node + k;
    if (b->plan->held[k] != SW_FREE) continue;
    const sw_vec turn = sw_cross(spin, sw_sub(sw_load(s->x + 3 * i), c.centre));
    sw_accumulate(s->v + 3 * i, sw_madd(turn, dv, share));
  }
  return share * c.mass;
}

/* How a touch with restitution meets its obstacle within a step. */
typedef struct meeting {
  double after; /* so long after the step's start [s] */
  double speed; /* approach at that moment [m/s] */
} meeting;

/* Gravity goes on until the surfaces meet, pull being how much of it is towards the obstacle. */
static meeting meet(double gap, double approach, double pull) {
  const double speed = sqrt(fmax(0.0, approach * fabs(approach) + 2.0 * pull * gap));
  return (meeting){speed + approach > 0 ? 2.0 * gap / (speed + approach) : HUGE_VAL, speed};
}

/* A rebound from above the surface, where the step began, keeps the height that it did not fall
 * through: this share of the rebound's own is let pass [-]. */
static const double HEIGHT_ERROR = 0.02;
/* So is this share of the way in a whole step, which is an error of time [-]. */
static const double WAY_ERROR = 1.0 / 8;
/* A step that is cut ends this share of the time before the surface is met: the next one strikes at
 * its start [-]. */
static const double LEFT_OPEN = 0.02;
/* What meets the surface sooner than by gravity alone is pushed there: so much of the step [-]. */
static const double CUT_AGAIN = 0.7;

/* Is the rebound wrong if it is from where the step begins? Notes when the step is to end then. */
static int is_too_early(sw_contact *c, double e, double gap, double pull, meeting m, double h) {
  const double height = e * e * m.speed * m.speed, fallen = 2.0 * (1.0 - e * e) * pull * gap;
  if (c->regime == SW_CONTACT_EXPLICIT || gap <= CLOSED) return 0;
  if (fallen <= HEIGHT_ERROR * height && gap <= WAY_ERROR * m.speed * c->nominal) return 0;
  const double end = m.after < h ? (1.0 - LEFT_OPEN) * m.after : CUT_AGAIN * h;
  if (end < c->least) return 0;
  c->soonest = fmin(c->soonest, end);
  return 1;
}

/* A touch and its obstacle, at the step's start. */
typedef struct encounter {
  sw_vec at;             /* on the wire's surface, if it can roll; else on its axis [m] */
  double gap;            /* [m] */
  sw_vec wall;           /* the obstacle's velocity there [m/s] */
  sw_vec speed;          /* the wire's against it [m/s] */
  double approach, slow; /* how fast the gap closes, and what is none [m/s] */
} encounter;

static encounter encounter_of(const sw_contact *c, const sw_system *s, const sw_pressed *t,
                              const sw_levers *levers) {
  encounter e;
  const sw_vec x = sw_mean_place(c, s->x, &t->spot);
  const sw_body *b = &s->bodies[t->body];
  const double radius = sw_plan_skin(b->plan, t->node - b->first_node);
  const sw_vec plane = sw_pose_point(c->start[t->obstacle].pose, t->local);
  const double aslant = sw_contact_aslant(c, t->node, t->other, t->at, t->normal);
  e.at = levers->count ? sw_madd(x, t->normal, -radius) : x;
  e.gap = fmax(0.0, sw_dot(t->normal, sw_sub(x, plane)) + aslant - radius);
  e.wall = striking_velocity(c, t, e.at, e.gap, &e.slow);
  e.speed = sw_sub(sw_mean_of(s->v, 0, &t->spot), e.wall);
  e.approach = -sw_dot(e.speed, t->normal);
  return e;
}

/* How much of its velocity towards the obstacle a touch is to lose; 0: it strikes nothing [m/s]. */
static double velocity_lost(sw_contact *c, const sw_system *s, const sw_pressed *t,
                            const encounter *meets, double h) {
  const double allowed = meets->gap / h, e = c->obstacles[t->obstacle].restitution;
  const double pull = fmax(0.0, -sw_dot(sw_load(s->gravity), t->normal));
  const meeting m = meet(meets->gap, meets->approach, pull);
  if (e > 0 ? !(m.speed > meets->slow) : !(meets->approach > allowed + meets->slow)) return 0;
  /* a rebound shorter than a step would be none */
  const int rebounds = e * m.speed > 0.5 * pull * h;
  if (rebounds && is_too_early(c, e, meets->gap, pull, m, h)) return 0;
  return fmax(0.0, rebounds ? meets->approach * (1.0 + e) : meets->approach - allowed);
}

/* What comes to a pad that holds a wire already only trembles. */
static int trembles(const sw_contact *c, const sw_pressed *t) {
  return c->obstacles[t->obstacle].grips > 0 && c->pressing[t->obstacle];
}

static sw_levers levers_of(const sw_system *s, const sw_pressed *t) {
  if (!s->bodies[t->body].roll_block) return (sw_levers){0};
  return sw_levers_at(s, t->body, t->node, t->segment, t->normal);
}

static int strike(sw_contact *c, sw_system *s, const sw_pressed *t, double h) {
  const sw_contact_obstacle *o = &c->obstacles[t->obstacle];
  if (trembles(c, t)) return 0;
  const sw_body *b = &s->bodies[t->body];
  const sw_levers levers = levers_of(s, t);
  const encounter e = encounter_of(c, s, t, &levers);
  const double change = velocity_lost(c, s, t, &e, h);
  if (!(change > 0)) return 0;
  sw_vec v = e.speed;
  if (levers.count) v = sw_add(v, sw_levers_shift(&levers, s->v + 3 * s->nodes + b->first_roll, 1));
  const sw_vec along = sw_madd(v, t->normal, -sw_dot(v, t->normal));
  const sw_vec brake = sw_levers_brake(&b->plan->beam, &levers, along, o->friction * change);
  const sw_vec dv = sw_madd(brake, t->normal, change);
  double w[SW_MEAN_MOST], mass = 0, kicked = 0;
  shares(s, t, w);
  for (size_t k = 0; k < t->spot.count; k++) {
    if (!(w[k] > 0)) continue;
    mass += w[k] * b->plan->lumped[t->spot.node[k] - b->first_node];
    kicked += w[k] * kick(s, b, t->spot.node[k], sw_scale(dv, w[k]));
  }
  c->struck += kicked * sw_dot(dv, e.wall);
  sw_contact_add_blow(c, t->obstacle, e.at, sw_scale(dv, -kicked));
  if (levers.count)
    sw_levers_kick(b->plan, &levers, sw_scale(brake, mass),
                   s->delta + 3 * s->nodes + b->first_roll);
  note_impact(c, t);
  return 1;
}

sw_pressed sw_contact_pressed(const sw_touch *t) {
  return (sw_pressed){.node = (uint32_t)t->node,
                      .other = (uint32_t)t->other,
                      .body = (uint32_t)t->body,
                      .obstacle = t->obstacle,
                      .segment = t->segment,
                      .sharp = t->sharp,
                      .at = t->at,
                      .spot = t->spot,
                      .local = t->local,
                      .normal = t->press.normal,
                      .let_out = t->let_out};
}

int sw_contact_strike(sw_contact *c, sw_system *s, const sw_touch *t, double h) {
  const sw_pressed met = sw_contact_pressed(t);
  return strike(c, s, &met, h);
}

static int by_meeting(const void *left, const void *right) {
  const sw_turn *p = left, *q = right;
  if (p->meets != q->meets) return p->meets < q->meets ? -1 : 1;
  if (p->closes != q->closes) return p->closes > q->closes ? -1 : 1;
  if (p->node != q->node) return p->node < q->node ? -1 : 1;
  if (p->obstacle != q->obstacle) return p->obstacle - q->obstacle;
  return (p->touch > q->touch) - (p->touch < q->touch);
}

/* A wall that stands and gives nothing back is met as fast as the wire comes; by less than this
 * share of the slowest impact there is surely none, whatever rounding does [-]. */
static const double SURELY = 1.0 - 1e-6;

static int is_slow(const sw_contact *c, const sw_system *s, const sw_pressed *t) {
  if (c->broad.moves[t->obstacle] || c->obstacles[t->obstacle].restitution > 0) return 0;
  return -sw_dot(sw_mean_of(s->v, 0, &t->spot), t->normal) <= SURELY * SW_SLOWEST_IMPACT;
}

/* Does any touch strike, with velocities as they are? */
static int any_strikes(sw_contact *c, sw_system *s, double h) {
  const double soonest = c->soonest;
  for (size_t i = 0; i < c->pressed_count; i++) {
    const sw_pressed *t = &c->pressed[i];
    if (is_slow(c, s, t) || trembles(c, t) || dealt_with(c, t, &s->counters.looks)) continue;
    const sw_levers levers = levers_of(s, t);
    const encounter e = encounter_of(c, s, t, &levers);
    if (!(velocity_lost(c, s, t, &e, h) > 0)) continue;
    c->soonest = soonest; /* all are asked again, one after the other */
    return 1;
  }
  return 0;
}

int sw_contact_will_strike(const sw_contact *c, sw_system *s, size_t first, size_t end) {
  for (size_t i = first; i < end; i++) {
    const sw_touch *t = &c->touches[i];
    if (t->held || !(t->press.normal_force > 0) || c->obstacles[t->obstacle].restitution > 0)
      continue;
    const sw_pressed met = sw_contact_pressed(t);
    if (is_slow(c, s, &met) || trembles(c, &met) || dealt_with(c, &met, &s->counters.looks))
      continue;
    const sw_levers levers = levers_of(s, &met);
    const encounter e = encounter_of(c, s, &met, &levers);
    if (e.approach > e.gap / c->h + e.slow) return 1;
  }
  return 0;
}

/* Those that may strike, also once others have: number of them. */
static size_t find_turns(sw_contact *c, sw_system *s) {
  size_t count = 0;
  for (size_t i = 0; i < c->pressed_count; i++) {
    const sw_pressed *t = &c->pressed[i];
    if (trembles(c, t) || dealt_with(c, t, &s->counters.looks)) continue;
    const sw_levers levers = levers_of(s, t);
    const encounter e = encounter_of(c, s, t, &levers);
    c->turns[count++] = (sw_turn){.meets = e.approach > 0 ? e.gap / e.approach : HUGE_VAL,
                                  .closes = e.approach,
                                  .node = t->node,
                                  .obstacle = t->obstacle,
                                  .touch = (uint32_t)i};
  }
  return count;
}

/* In a step that does not bounce only what rebounds strikes: the rest comes to rest by itself. */
static void leave_dull(sw_contact *c) {
  size_t kept = 0;
  for (size_t i = 0; i < c->pressed_count; i++)
    if (c->obstacles[c->pressed[i].obstacle].restitution > 0) c->pressed[kept++] = c->pressed[i];
  c->pressed_count = kept;
}

/* What meets its obstacle first strikes first, and what does so at once, the fastest first,
 * whichever end the wire's nodes are counted from: places of neighbouring segments share nodes. */
static int review_touches(sw_contact *c, sw_system *s, double h) {
  int changed = 0;
  if (!c->pressed_count || !any_strikes(c, s, h) ||
      sw_grow((void **)&c->turns, &c->turn_capacity, c->pressed_count, sizeof *c->turns) != SW_OK)
    return 0;
  const size_t n = find_turns(c, s);
  qsort(c->turns, n, sizeof *c->turns, by_meeting);
  for (size_t i = 0; i < n; i++) {
    const sw_pressed *t = &c->pressed[c->turns[i].touch];
    if (dealt_with(c, t, &s->counters.looks)) continue;
    changed |= strike(c, s, t, h);
  }
  return changed;
}

/* Did every node stay within the reach that its candidates were chosen for? */
static int went_too_far(sw_contact *c, const sw_system *s, const double *x1) {
  double wider = 1.0;
  for (size_t i = 0; i < s->nodes; i++) {
    const sw_vec v = sw_load(s->v + 3 * i), way = sw_sub(sw_vec_at(x1, i), sw_vec_at(s->x, i));
    if (sw_norm2(way) <= SW_FLIGHT_LEAST * SW_FLIGHT_LEAST) continue;
    const double flight = sw_flight_reserve(c, s, v);
    const double shift = sw_norm(way);
    if (shift > flight * c->widening) wider = fmax(wider, shift / flight);
  }
  if (wider <= 1.0) return 0;
  c->widening = 1.5 * wider;
  return 1;
}

/* A step may leave a touch this much deeper than it found it; the law's own
 * depth is below half of that [m]. */
static const double DEEPER = 1e-4;
/* What has the softness of a section is meant to give way; of the radius [-]. */
static const double SQUEEZED = 0.2;
/* In steps below this share of the nominal one depth is taken as it comes [-]. */
static const double SMALLEST_CARE = 1.0 / 64;

/* How deep the candidate's wire is at a place near its obstacle [m]. */
static double depth_of(const sw_contact *c, const sw_candidate *k, const sw_pose *pose,
                       const sw_closest *near) {
  const sw_vec normal = sw_rotate(pose->q, near->normal);
  return k->skin - near->gap - sw_contact_aslant(c, k->node, k->other, near->at, normal);
}

static double depth_of_curve(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                             const sw_contact_at *at, const double *x) {
  sw_piece piece;
  sw_places list;
  double most = 0;
  if (!sw_contact_piece(c, s, k, at, x, k->skin, &piece)) return 0;
  sw_contact_places(c, k, &piece, k->skin, &list);
  for (size_t i = 0; i < list.count; i++) most = fmax(most, k->skin - list.place[i].near.gap);
  return most;
}

/* The same with positions x, where it is deepest. */
static double depth_at(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                       const sw_contact_at *at, const double *x) {
  double deepest = k->smooth && k->segment ? depth_of_curve(c, s, k, at, x) : 0.0;
  if (k->smooth && k->segment && !k->round) return deepest;
  const sw_shape *shape = c->obstacles[k->obstacle].shape;
  const sw_pose *pose = &at[k->obstacle].pose;
  const sw_vec a = sw_pose_local(*pose, sw_contact_where(c, x, k->node, k->node, 0));
  sw_closest near[SW_CLOSEST_MAX];
  near[0].at = 0;
  if (!k->segment) {
    if (!sw_shape_point(shape, a, k->skin, &near[0])) return 0;
    if (k->smooth && sw_contact_is_segments(c, s, k, at, x, &near[0])) return 0;
    return depth_of(c, k, pose, &near[0]);
  }
  const sw_vec b = sw_pose_local(*pose, sw_contact_where(c, x, k->other, k->other, 0));
  for (int i = 0; i < k->samples; i++) {
    near[0].at = sw_sample_at(k, i);
    if (sw_shape_point(shape, sw_lerp(a, b, near[0].at), k->skin, &near[0]))
      deepest = fmax(deepest, depth_of(c, k, pose, &near[0]));
  }
  if (k->samples) return deepest;
  const int n = sw_shape_segment(shape, a, b, k->skin, near);
  for (int i = 0; i < n; i++)
    if (!k->round || !sw_contact_is_rounds(c, k, a, b, near[i].at))
      deepest = fmax(deepest, depth_of(c, k, pose, &near[i]));
  return deepest;
}

/* Did the wire come far enough in the step to be deeper by so much? If not, a node has come from an
 * edge, over which the smooth curve counts, to a face, where it is the node: no smaller step would
 * help. */
static int may_sink(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                    const double *x1, double more) {
  if (!k->smooth || c->broad.moves[k->obstacle]) return 1;
  const sw_body *b = &s->bodies[k->body];
  const size_t end = b->first_node + b->plan->nodes;
  for (size_t i = k->node > b->first_node ? k->node - 1 : k->node; i < end && i <= k->node + 2; i++)
    if (sw_dist(sw_vec_at(x1, i), sw_vec_at(s->x, i)) >= more) return 1;
  return 0;
}

/* The law works with places and normals of the last iterate; on edges and
 * corners these may be stale at the step's end. */
static int cuts_deep(const sw_contact *c, const sw_system *s, const double *x1, double h) {
  if (h < SMALLEST_CARE * c->nominal || c->regime == SW_CONTACT_EXPLICIT) return 0;
  for (size_t i = 0; i < c->candidate_count; i++) {
    const sw_candidate *k = &c->candidates[i];
    if (c->flat[k->obstacle] || sw_contact_is_held(s, k)) continue;
    const double depth = depth_at(c, s, k, c->now, x1);
    const double more = k->given ? SQUEEZED * k->radius : DEEPER;
    if (depth > more && depth > depth_at(c, s, k, c->start, s->x) + more &&
        may_sink(c, s, k, x1, more))
      return 1;
  }
  return 0;
}

/* An impulse at the step's start knows nothing of what forces drive into an obstacle within the
 * step. The integrator makes such a touch bounce: of an obstacle that moves, which does work in
 * that, step after step; and of a mesh, which would hop by g h^2 for ever, the restart at each
 * landing giving it back what damping takes. A plastic step does not bounce. 1 = one is needed,
 * once in a step. */
static int bounces(sw_contact *c, const sw_system *s, const double *v1) {
  if (c->plastic || c->regime == SW_CONTACT_EXPLICIT) return 0;
  for (size_t i = 0; i < c->touch_count; i++) {
    const sw_touch *t = &c->touches[i];
    if (t->known || !(t->press.normal_force > 0) || c->obstacles[t->obstacle].restitution > 0)
      continue;
    const sw_vec wall = sw_obstacle_velocity(&c->now[t->obstacle], t->point);
    const int moves = fabs(sw_dot(wall, t->press.normal)) > SW_SLOWEST_IMPACT;
    if (!moves && !s->bodies[t->body].plan->web) continue;
    const sw_vec v = sw_sub(sw_mean_of(v1, 0, &t->spot), wall);
    if (sw_dot(v, t->press.normal) > SW_SLOWEST_IMPACT) return c->plastic = 1;
  }
  return 0;
}

/* A barrier holds a place as by an endless face, where the obstacle may end just above it. Bearing
 * more than so many weights of its wire, or of the force that bends it, it is in the way of a wire
 * that would pass over; a smaller step knows [-]. */
static const double MOST_BORNE = 10.0;

static int bars_too_hard(const sw_contact *c, const sw_system *s, double h) {
  if (!c->barrier_count || h < SMALLEST_CARE * c->nominal) return 0;
  for (size_t i = 0; i < c->touch_count; i++) {
    const sw_touch *t = &c->touches[i];
    if (t->feature != SW_BEHIND_BARRIER || !(t->press.normal_force > 0)) continue;
    const double usual = sw_contact_usual_force(s, s->bodies[t->body].plan);
    if (t->press.normal_force > MOST_BORNE * usual) return 1;
  }
  return 0;
}

sw_contact_verdict sw_contact_review(sw_contact *c, sw_system *s, const double *x1,
                                     const double *v1, double h, int dull) {
  sw_error err;
  const int hasty = c->hasty;
  c->hasty = 0;
  if (went_too_far(c, s, x1)) {
    c->pressed_count = 0;
    return sw_contact_find_candidates(c, s, &err) == SW_OK ? SW_CONTACT_REDO : SW_CONTACT_SMALLER;
  }
  /* impulses must not see what their neighbours did to the edges between them */
  double *kicks = s->delta + 3 * s->nodes, *rates = s->v + 3 * s->nodes;
  for (size_t e = 0; e < s->rolls; e++) kicks[e] = 0;
  c->soonest = HUGE_VAL;
  const int crossed = sw_contact_cross(c, s, x1, h);
  if (dull) leave_dull(c);
  const int struck = review_touches(c, s, h);
  c->careful |= hasty && !struck;
  for (size_t e = 0; e < s->rolls; e++) rates[e] += kicks[e];
  c->pressed_count = 0;
  if (c->soonest < h) return SW_CONTACT_SOONER;
  if (crossed || struck || hasty) return SW_CONTACT_REDO;
  if (bounces(c, s, v1)) return SW_CONTACT_STRIKE;
  const int smaller = bars_too_hard(c, s, h) || cuts_deep(c, s, x1, h);
  return smaller ? SW_CONTACT_SMALLER : SW_CONTACT_ACCEPT;
}

int sw_contact_review_static(sw_contact *c, sw_system *s, const double *x1) {
  return sw_contact_cross(c, s, x1, 0.0);
}
