/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Impacts. A step with a new touch is repeated with a lower approach speed, which just reaches the
 * surface (or is reversed by the restitution). The impulse acts at the step's start, so that the
 * integrator never sees the shock, which would make it bounce. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "contact/rebound.h"
#include "contact/round.h"
#include "contact/surface.h"
#include "touch/same.h"

/* Cosine between normals below which two touches of a place are on different flanks of a groove.
 * Each must be struck: otherwise the integrator treats the second blow, and bounces [-]. */
static const double SAME_FLANK = 0.7;

static int was_struck(const sw_contact *c, const sw_pressed *t, size_t node, size_t *looks) {
  for (uint32_t i = c->impact_at[node]; i; i = c->impacts[i - 1].before) {
    const sw_impact *m = &c->impacts[i - 1];
    const double ahead = node < t->node ? -1.0 : node > t->node ? 1.0 : 0.0;
    ++*looks;
    if (m->obstacle == t->obstacle && m->segment == t->segment &&
        fabs(ahead + m->at - t->at) < SW_SAME_TOUCH && sw_dot(m->normal, t->normal) > SAME_FLANK)
      return 1;
  }
  return 0;
}

/* 1 if the touch's impact was already treated in this step. On the smooth curve another iterate may
 * find the same touch from the neighbouring segment. */
static int dealt_with(const sw_contact *c, const sw_pressed *t, size_t *looks) {
  if (was_struck(c, t, t->node, looks)) return 1;
  if (!t->sharp) return 0;
  return (t->node > 0 && was_struck(c, t, t->node - 1, looks)) ||
         (t->node + 1 < c->places && was_struck(c, t, t->node + 1, looks));
}

static void note_impact(sw_contact *c, const sw_system *s, const sw_pressed *t, sw_vec kick) {
  if (SW_GROW(c->impacts, c->impact_capacity, c->impact_count + 1) != SW_OK) return;
  c->impacts[c->impact_count++] = (sw_impact){.obstacle = t->obstacle,
                                              .segment = t->segment,
                                              .node = t->node,
                                              .first = s->bodies[t->body].first_node,
                                              .at = t->at,
                                              .kick = kick,
                                              .normal = t->normal,
                                              .before = c->impact_at[t->node]};
  c->impact_at[t->node] = (uint32_t)c->impact_count;
}

sw_status sw_contact_calm(sw_contact *c, size_t nodes) {
  for (size_t i = 0; i < c->impact_count; i++) {
    c->impact_at[c->impacts[i].node] = 0;
    c->lost[c->impacts[i].first] = 0;
  }
  for (size_t i = 0; i < c->barrier_count; i++) c->barrier_at[c->barriers[i].node] = 0;
  c->barrier_count = c->impact_count = 0;
  if (c->regime != SW_CONTACT_STATIC) c->behind.found = 0; /* a pose has many solves */
  if (nodes <= c->places) return SW_OK;
  c->places = 0;
  SW_TRY(SW_GROW(c->impact_at, c->place_capacity, 4 * nodes));
  memset(c->impact_at, 0, 4 * nodes * sizeof *c->impact_at);
  c->barrier_at = c->impact_at + nodes;
  c->lost = (double *)(void *)(c->impact_at + 2 * nodes);
  c->places = nodes;
  return SW_OK;
}

/* Computes each node's share of a touch's momentum; held nodes have none. */
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

/* Mean velocity of the obstacle's material at p in the step. */
static sw_vec mean_velocity(const sw_contact *c, int obstacle, sw_vec p) {
  const sw_contact_at *from = &c->start[obstacle], *to = &c->now[obstacle];
  if (!(c->stage_time > c->time)) return sw_obstacle_velocity(from, p);
  const sw_vec after = sw_pose_point(to->pose, sw_pose_local(from->pose, p));
  return sw_scale(sw_sub(after, p), 1.0 / (c->stage_time - c->time));
}

/* Returns the obstacle's velocity at p for an impact. *slow: slower approaches are not impacts
 * [m/s]. A closed touch uses the speed at the step's start: the integrator treats what the obstacle
 * gains within the step, and a restart would only disturb it. A gap that closes within the step
 * uses the mean speed: with the starting speed the wire would be reached early and leave again. */
static sw_vec striking_velocity(const sw_contact *c, const sw_pressed *t, sw_vec p, double gap,
                                double *slow) {
  const sw_vec start = sw_obstacle_velocity(&c->start[t->obstacle], p);
  const sw_vec mean = mean_velocity(c, t->obstacle, p);
  *slow = SW_SLOWEST_IMPACT;
  if (gap > SW_CLOSED) return mean;
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

/* Moment of inertia of a section about an axis through its centre. Exactly 0 for a single particle,
 * for which rounding would leave a little [kg m2]. */
static double inertia_about(const sw_system *s, const sw_body *b, const section *c, sw_vec axis) {
  double sum = 0;
  if (c->end - c->first == 1) return 0;
  for (size_t k = c->first; k < c->end; k++) {
    const sw_vec r = sw_sub(sw_load(s->x + 3 * (b->first_node + k)), c->centre);
    if (b->plan->held[k] == SW_FREE) sum += b->plan->lumped[k] * sw_norm2(sw_cross(axis, r));
  }
  return sum;
}

/* Changes a node's velocity by dv. A strike on a particle of a wire stops the whole section as a
 * rigid body that may turn. The section's springs do this within all but the shortest steps, and
 * would throw it back. Returns the impulse over |dv| [kg]. */
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

/* A touch and its obstacle at the step's start. */
typedef struct encounter {
  sw_vec at;             /* point on the wire's surface if it can roll, else on its axis [m] */
  double gap;            /* [m] */
  sw_vec wall;           /* the obstacle's velocity there [m/s] */
  sw_vec speed;          /* the wire's velocity relative to it [m/s] */
  double approach, slow; /* closing speed of the gap; slower ones are not impacts [m/s] */
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
  e.gap = fmax(0.0, sw_dot(t->normal, sw_sub(x, plane)) + aslant + t->rise - radius);
  e.wall = striking_velocity(c, t, e.at, e.gap, &e.slow);
  e.speed = sw_sub(sw_mean_of(s->v, 0, &t->spot), e.wall);
  e.approach = -sw_dot(e.speed, t->normal);
  return e;
}

/* Returns the velocity towards the obstacle that a touch loses; 0: no impact [m/s]. */
static double velocity_lost(sw_contact *c, const sw_system *s, const sw_pressed *t,
                            const encounter *meets, double h) {
  const double allowed = meets->gap / h, e = c->obstacles[t->obstacle].restitution;
  const double pull = fmax(0.0, -sw_dot(sw_load(s->gravity), t->normal));
  const sw_meeting m = sw_rebound_meet(meets->gap, meets->approach, pull);
  if (e > 0 ? !(m.speed > meets->slow) : !(meets->approach > allowed + meets->slow)) return 0;
  /* a rebound that returns within the step does not count */
  const int rebounds = e * m.speed > 0.5 * pull * h;
  if (rebounds && sw_rebound_too_early(c, e, meets->gap, pull, m, h)) return 0;
  return fmax(0.0, rebounds ? meets->approach * (1.0 + e) : meets->approach - allowed);
}

/* 1 for a touch on a pad that already holds a wire: it trembles and is not an impact. */
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
  double change = velocity_lost(c, s, t, &e, h), w[SW_MEAN_MOST], mass = 0, kicked = 0;
  if (!(change > 0)) return 0;
  shares(s, t, w);
  if (c->regime == SW_CONTACT_IMPLICIT && o->restitution > 0)
    change = sw_rebound_limit(c, s, t, &(sw_rebound){w, e.wall, change, e.approach - e.gap / h});
  sw_vec v = e.speed;
  if (levers.count) {
    v = sw_levers_struck(&levers, v, s->v);
    v = sw_add(v, sw_levers_shift(&levers, s->v + 3 * s->nodes + b->first_roll, 1));
  }
  const sw_vec along = sw_madd(v, t->normal, -sw_dot(v, t->normal));
  const sw_vec brake = sw_levers_brake(&b->plan->beam, &levers, along, o->kinetic * change);
  const sw_vec dv = sw_madd(brake, t->normal, change);
  for (size_t k = 0; k < t->spot.count; k++) {
    if (!(w[k] > 0)) continue;
    mass += w[k] * b->plan->lumped[t->spot.node[k] - b->first_node];
    kicked += w[k] * kick(s, b, t->spot.node[k], sw_scale(dv, w[k]));
  }
  c->struck += kicked * sw_dot(dv, e.wall);
  const sw_vec impulse = sw_scale(dv, -kicked);
  sw_contact_add_blow(c, t->obstacle, e.at, impulse);
  if (levers.count)
    sw_levers_kick(b->plan, &levers, sw_scale(brake, mass),
                   s->delta + 3 * s->nodes + b->first_roll);
  note_impact(c, s, t, impulse);
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
                      .rise = t->rise,
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

/* The speed at a standing wall without restitution is the wire's. Below this share of the slowest
 * impact speed there is certainly no impact, also with rounding [-]. */
static const double SURELY = 1.0 - 1e-6;

static int is_slow(const sw_contact *c, const sw_system *s, const sw_pressed *t) {
  if (c->broad.moves[t->obstacle] || c->obstacles[t->obstacle].restitution > 0) return 0;
  return -sw_dot(sw_mean_of(s->v, 0, &t->spot), t->normal) <= SURELY * SW_SLOWEST_IMPACT;
}

/* 1 if the touch may still have an impact. Then *e describes it. */
static int may_strike(const sw_contact *c, sw_system *s, const sw_pressed *t, encounter *e) {
  if (trembles(c, t) || dealt_with(c, t, &s->counters.looks)) return 0;
  const sw_levers levers = levers_of(s, t);
  *e = encounter_of(c, s, t, &levers);
  return 1;
}

/* Bits of c->strikes: some touch of the body strikes with the present velocities; some touch may
 * rebound. */
enum { STRIKES = 1, REBOUNDS = 2 };

/* Finds the bodies that strike. Touches of the others need no turn: a strike changes the velocities
 * of its own body only. Returns 0 if there are none. */
static int find_bodies(sw_contact *c, sw_system *s, double h) {
  const double soonest = c->soonest;
  int any = 0;
  memset(c->strikes, 0, s->body_count);
  for (size_t i = 0; i < c->pressed_count; i++) {
    const sw_pressed *t = &c->pressed[i];
    unsigned char *of = &c->strikes[t->body];
    encounter e;
    if (*of & STRIKES) continue;
    if (c->obstacles[t->obstacle].restitution > 0) *of |= REBOUNDS;
    if (is_slow(c, s, t) || !may_strike(c, s, t, &e)) continue;
    if (!(velocity_lost(c, s, t, &e, h) > 0)) continue;
    *of |= STRIKES, any = 1;
    if (s->body_count == 1) break;
  }
  if (any) c->soonest = soonest; /* strike_all judges these touches again, one by one */
  return any;
}

int sw_contact_will_strike(const sw_contact *c, sw_system *s, size_t first, size_t end) {
  for (size_t i = first; i < end; i++) {
    const sw_touch *t = &c->touches[i];
    if (t->held || !(t->press.normal_force > 0) || c->obstacles[t->obstacle].restitution > 0)
      continue;
    const sw_pressed met = sw_contact_pressed(t);
    encounter e;
    if (is_slow(c, s, &met) || !may_strike(c, s, &met, &e)) continue;
    if (e.approach > e.gap / c->h + e.slow) return 1;
  }
  return 0;
}

/* Lists the touches that may strike, alone or after others have struck. Returns their number. */
static size_t find_turns(sw_contact *c, sw_system *s) {
  size_t count = 0;
  for (size_t i = 0; i < c->pressed_count; i++) {
    const sw_pressed *t = &c->pressed[i];
    encounter e;
    if (!c->strikes[t->body] || !may_strike(c, s, t, &e)) continue;
    c->turns[count++] = (sw_turn){.meets = e.approach > 0 ? e.gap / e.approach : HUGE_VAL,
                                  .closes = e.approach,
                                  .node = t->node,
                                  .obstacle = t->obstacle,
                                  .touch = (uint32_t)i};
  }
  return count;
}

/* For a step that does not bounce: keeps only touches that rebound; the others come to rest
 * anyway. */
static void leave_dull(sw_contact *c) {
  size_t kept = 0;
  for (size_t i = 0; i < c->pressed_count; i++)
    if (c->obstacles[c->pressed[i].obstacle].restitution > 0) c->pressed[kept++] = c->pressed[i];
  c->pressed_count = kept;
}

/* The touch that meets its obstacle first strikes first; among simultaneous ones the fastest. The
 * order matters because places of neighbouring segments share nodes, and it must not depend on the
 * end from which nodes are counted. */
int sw_contact_strike_all(sw_contact *c, sw_system *s, double h, int dull) {
  int changed = 0;
  if (dull) leave_dull(c);
  if (!c->pressed_count || SW_GROW(c->strikes, c->strikes_capacity, s->body_count) != SW_OK ||
      !find_bodies(c, s, h) || SW_GROW(c->turns, c->turn_capacity, c->pressed_count) != SW_OK)
    return 0;
  const size_t n = find_turns(c, s);
  (void)SW_GROW(c->impacts, c->impact_capacity, c->impact_count + n);
  qsort(c->turns, n, sizeof *c->turns, by_meeting);
  for (size_t i = 0; i < n; i++) {
    const sw_pressed *t = &c->pressed[c->turns[i].touch];
    if (dealt_with(c, t, &s->counters.looks)) continue;
    changed |= strike(c, s, t, h);
  }
  return changed;
}
