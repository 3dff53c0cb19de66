/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes the touches of an iterate, with their memory of earlier steps and of the previous
 * iterate. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "contact/arc.h"
#include "contact/curve.h"
#include "contact/depth.h"
#include "contact/halt.h"
#include "contact/recall.h"
#include "contact/surface.h"
#include "system/part.h"
#include "touch/same.h"

/* A touch continues in the next iterate if its gap is below STILL_NEAR of the radius and the cosine
 * of the turn of its normal is above SAME_SIDE [-]. */
static const double STILL_NEAR = 0.5, SAME_SIDE = 0.7;

/* Number of pulls that do not release a touch of a mesh in statics. The first solve with a pull may
 * have had too many touches at once; without them nothing would hold the mesh. */
enum { SPARE_PULLS = 1 };

/* Returns a new touch, all zero, at the end of the list; NULL: out of memory. */
static sw_touch *new_touch(sw_contact *c) {
  if (SW_GROW(c->touches, c->touch_capacity, c->touch_count + 1) != SW_OK) return NULL;
  sw_touch *t = &c->touches[c->touch_count];
  sw_touch_fetch(t, SW_FETCH_ALL);
  return memset(t, 0, sizeof *t);
}

/* Moves the new touch to its position in the list, which is sorted by candidate. A segment may find
 * a touch of the neighbouring segment. */
static void take_in(sw_contact *c) {
  size_t i = c->touch_count++;
  const size_t candidate = c->touches[i].candidate;
  if (i == c->parts.touch || c->touches[i - 1].candidate <= candidate) return;
  const sw_touch t = c->touches[i];
  for (; i > c->parts.touch && c->touches[i - 1].candidate > candidate; i--)
    c->touches[i] = c->touches[i - 1];
  c->touches[i] = t;
}

/* Returns `best` or the touch of the last iterate on an edge of the same obstacle, whichever is
 * nearer. */
static const sw_touch *nearer(const sw_touch *last, const sw_candidate *k, double at,
                              double *nearest, const sw_touch *best) {
  if (!last->sharp || last->obstacle != k->obstacle || last->body != k->body) return best;
  const double d = fabs(((double)last->node - (double)k->node) + last->at - at);
  if (!(d < *nearest)) return best;
  *nearest = d;
  return last;
}

/* Returns the touch of the previous iterate; on a smooth curve also from the neighbouring segment.
 * In a stage solved in parts the list also has touches of the previous stage. */
static const sw_touch *last_for(const sw_contact *c, const sw_candidate *k, double at, int feature,
                                sw_vec normal) {
  const sw_touch *best = NULL;
  double nearest = sw_contact_within(k, SW_SAME_TOUCH);
  for (size_t i = k->last; i < k->last_end; i++) {
    const sw_touch *t = &c->last[i];
    const double d =
        fabs(t->at - at) + sw_contact_apart(t->feature == feature, sw_dot(t->press.normal, normal));
    if (d < nearest) best = t, nearest = d;
  }
  if (!k->smooth || !k->segment) return best;
  const size_t before = c->parts.on ? c->parts.before : 0, now = k->last >= before;
  const size_t low = now ? before : 0, high = now ? c->last_count : before;
  for (size_t i = k->last; i-- > low && c->last[i].node + 1 >= k->node;)
    best = nearer(&c->last[i], k, at, &nearest, best);
  for (size_t i = k->last_end; i < high && c->last[i].node <= k->node + 1; i++)
    best = nearer(&c->last[i], k, at, &nearest, best);
  return best;
}

/* Position of a touch as a mean of nodes. Chords touch a round obstacle at its rims and along
 * itself; such touches are on the chord, the others of a smooth wire on its curve. */
static sw_mean spot_of(const sw_system *s, const sw_candidate *k, const sw_touch *t, double at) {
  const int on_chord = k->round && k->segment && !t->sharp && t->feature != SW_BEHIND_BARRIER;
  return on_chord ? sw_mean_chord(k->node, k->other, at) : sw_contact_spot(s, k, at);
}

/* Displacement of the wire's material at the touch since the step's start, relative to the
 * obstacle's; of a rolling wire that of its surface. Sunk nodes count with their own place: the
 * sinking is computed at the step's start and does not turn with the obstacle. */
static sw_vec relative_shift(const sw_contact *c, const sw_system *s, const sw_touch *t,
                             const double *y) {
  const sw_vec from = sw_mean_of(s->x, 0, &t->spot);
  const sw_vec to = sw_mean_of(y, 0, &t->spot);
  const sw_vec carried = sw_contact_carried(c, s, t, from);
  const sw_body *b = &s->bodies[t->body];
  if (!b->roll_block) return sw_sub(to, carried);
  const sw_levers levers = sw_touch_levers(s, t);
  const sw_vec before = sw_rotate(c->start[t->obstacle].pose.q,
                                  sw_unrotate(c->now[t->obstacle].pose.q, t->press.normal));
  const sw_vec turned = sw_scale(sw_sub(t->press.normal, before), b->plan->beam.radius);
  const sw_vec arm = sw_madd(turned, levers.along, -levers.lies * sw_dot(levers.along, turned));
  const sw_vec rolled = sw_levers_shift(&levers, b->roll_turn, 1);
  const sw_vec tilted = sw_sub(sw_levers_tilt(&levers, y), sw_levers_tilt(&levers, s->x));
  return sw_add(sw_add(sw_sub(to, carried), arm), sw_add(rolled, tilted));
}

/* The same since the touch was last seen. This includes the motion of an explicit method after its
 * last evaluation in a step. */
static sw_vec shift_since(const sw_contact *c, const sw_system *s, const sw_touch *t,
                          const double *y) {
  const sw_candidate *k = &c->candidates[t->candidate];
  if (c->regime != SW_CONTACT_EXPLICIT) return relative_shift(c, s, t, y);
  const sw_closest here = sw_contact_spotted(c, t);
  const sw_memory *m = sw_contact_remembered(c, k, &here);
  if (!m) return relative_shift(c, s, t, y);
  const sw_mean spot = spot_of(s, k, t, m->at);
  const sw_vec now = sw_mean_place(c, y, &spot);
  return sw_sub(now, sw_pose_point(c->now[t->obstacle].pose, m->seen));
}

/* A predicted slide of a mesh's particle counts only if a spring of this multiple of its inertia
 * would slide too. A prediction moves a sticking particle far more than its touch's spring yields,
 * although only its inertia requires that [-]. */
static const double NEIGHBOURS = 30.0;

/* Stiffness of friction's spring in the test for a sure slide [N/m]. */
static double felt_stiffness(const sw_contact *c, const sw_system *s, const sw_touch *t) {
  const sw_web *web = s->bodies[t->body].plan->web;
  if (!web || !web->per_ring || c->regime != SW_CONTACT_IMPLICIT) return HUGE_VAL;
  return NEIGHBOURS * c->candidates[t->candidate].mass / (c->h * c->h);
}

/* Where nothing touched before, a shift along the surface of up to this many roundings of the
 * position counts as zero. It would give friction a random direction, different for each touch
 * [-]. */
static const double ROUNDINGS = 16.0 * DBL_EPSILON;

static sw_vec without_rounding(sw_vec u, sw_vec normal, sw_vec place) {
  const double most = ROUNDINGS * sw_norm(place), away = sw_dot(u, normal);
  return sw_norm2(sw_madd(u, normal, -away)) <= most * most ? sw_scale(normal, away) : u;
}

/* 1 if a touch without memory has not slid in this step: it closed where it is. A mesh's particle
 * that slid in the previous iterate goes on, although the last solve left a gap: otherwise its
 * friction would act in every other iterate, and open the gap in between. */
static int closed_here(const sw_web *web, const sw_press *press, const sw_touch *last) {
  const int slid = web && last && sw_norm2(last->press.trial) > 0;
  return press->gap >= 0 && press->active && !slid;
}

/* 1 if reversals of a slide are counted, so that it finally sticks. In statics always for meshes of
 * elements: their particles between pads would otherwise reverse in every other iterate. */
static int counts_reversals(const sw_contact *c, const sw_system *s, const sw_touch *t) {
  if (c->regime == SW_CONTACT_IMPLICIT) return c->updates > 0;
  const sw_web *web = s->bodies[t->body].plan->web;
  return (web && web->solid_rate2 > 0) || sw_broad_moves(c);
}

/* Sets the spring of friction. A turning obstacle turns the slide of the step's first stage with
 * it: otherwise friction of a wire that slides would have a direction of earlier in the step. */
static void aim(const sw_contact *c, const sw_touch *last, sw_vec u, sw_touch *t) {
  const int same = last && last->stage == (uint16_t)c->stage;
  if (!last || same || !c->broad.moves[t->obstacle]) {
    sw_press_aim(&t->press, u, last ? &last->press : NULL, same, c->first);
    return;
  }
  sw_press before = last->press;
  const sw_quat now = c->now[t->obstacle].pose.q;
  before.slip = sw_rotate(now, sw_unrotate(c->before[t->obstacle], before.slip));
  sw_press_aim(&t->press, u, &before, same, c->first);
}

/* Begins friction of a touch. A new touch has moved freely, so it slides first. For a rolling wire
 * a long spring does not mean a slide: on a curved surface its shift and its turn are predicted
 * less exactly than that. */
static void begin_friction(const sw_contact *c, const sw_system *s, const sw_memory *m,
                           const sw_touch *last, const double *y, sw_touch *t) {
  sw_press *press = &t->press;
  sw_vec u = shift_since(c, s, t, y);
  if (m)
    u = sw_add(u, sw_rotate(c->now[t->obstacle].pose.q, sw_contact_stretch(c, t, &m->kept)));
  else if (closed_here(s->bodies[t->body].plan->web, press, last))
    u = sw_v(0, 0, 0);
  else
    u = without_rounding(u, press->normal, t->point);
  aim(c, last, u, t);
  if (last && last->press.reversals > 0 && counts_reversals(c, s, t))
    press->reversals = last->press.reversals;
  const int rolls = s->bodies[t->body].roll_block != NULL, searches = last && c->ahead_count;
  /* its couple lifts a touch that sticks: it would close in every other iterate */
  const int went_on = last && (last->press.active || (rolls && last->press.next_sliding));
  t->friction = sw_contact_arc_friction(c, s, m, t, sw_contact_coefficient(c, s, m, t));
  t->slid = m ? m->slid : 0.0;
  if (searches) press->ahead = last->press.ahead;
  sw_press_resume(press, m ? &m->kept : NULL, last ? &last->press : NULL, went_on || searches,
                  press->k * sw_larger(0.0, -press->gap));
  const int held = m && !m->kept.sliding && !(rolls && went_on && press->sliding) &&
                   (rolls || (!last && c->regime == SW_CONTACT_STATIC));
  if (!held && !searches) sw_press_begin(press, t->friction, went_on || m, felt_stiffness(c, s, t));
}

int sw_contact_is_held(const sw_system *s, const sw_candidate *k) {
  const sw_body *b = &s->bodies[k->body];
  const int *held = b->plan->held;
  return held[k->node - b->first_node] != SW_FREE && held[k->other - b->first_node] != SW_FREE;
}

/* Stiffness of a new touch [N/m]. A wire pushed by its end carries far more than its weight, and
 * stiffening its touch after it has sunk in would throw the end back. So the end's touch is as
 * stiff as the wire itself from the beginning. */
static double end_stiffness(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                            const double *y, sw_vec normal) {
  const sw_body *b = &s->bodies[k->body];
  const size_t i = k->node - b->first_node, last = b->plan->nodes - 1;
  if (c->regime != SW_CONTACT_IMPLICIT || b->plan->web || k->segment || (i > 0 && i < last))
    return k->usual;
  const size_t e = i ? last - 1 : 0, at = b->first_node + e;
  const sw_vec edge = sw_sub(sw_vec_at(y, at + 1), sw_vec_at(y, at));
  const double along = sw_dot(sw_unit_or(edge, sw_v(0, 0, 0)), normal);
  return sw_larger(k->usual, along * along * b->EA / b->plan->rest[e]);
}

/* Stiffness of a touch [N/m]. usual: that of a new one, which is higher near pads. */
static double stiffness_of(const sw_contact *c, const sw_candidate *k, const sw_memory *m,
                           const sw_touch *last, double usual) {
  if (c->regime == SW_CONTACT_EXPLICIT) return k->usual;
  if (last) return last->stiffer;
  return !m ? usual : sw_larger(m->kept.k, c->regime == SW_CONTACT_STATIC ? usual : 0.0);
}

/* 1 if a touch is that of the previous iterate, a little shifted. */
static int goes_on(const sw_contact *c, const sw_candidate *k, const sw_press *press,
                   const sw_touch *last) {
  return last && c->regime != SW_CONTACT_EXPLICIT && press->gap < STILL_NEAR * k->radius &&
         sw_dot(press->normal, last->press.normal) > SAME_SIDE;
}

/* 1 if the place gives friction's direction. In bundles the direction is an unknown, as between
 * wires: otherwise thrown wires would reverse in every other iterate. A single wire may reverse
 * too, but most agree sooner by the place; after some updates its direction becomes an unknown. */
static int goes_by_place(const sw_contact *c, const sw_system *s, const sw_candidate *k) {
  const int apart = s->coupling.part && !(s->bodies[k->body].coupled & SW_TOUCHING);
  return (apart && c->updates < SW_PATIENCE) || c->regime != SW_CONTACT_IMPLICIT ||
         s->bodies[k->body].plan->web;
}

/* Sets the data of a touch that follow from its place. */
static void take_place(const sw_contact *c, const sw_system *s, const sw_candidate *k, double at,
                       const double *y, const sw_place *place, sw_touch *t) {
  const sw_pose *pose = &c->now[k->obstacle].pose;
  t->obstacle = k->obstacle, t->segment = k->segment;
  t->node = k->node, t->other = k->other, t->body = k->body;
  t->feature = place->near.feature;
  t->at = at;
  t->sharp = (uint8_t)place->sharp, t->edge = place->edge;
  t->spot = spot_of(s, k, t, at);
  const sw_vec local = place->near.point; /* not read back: the touch is not in the cache yet */
  t->local = local, t->point = sw_pose_point(*pose, local);
  t->seen = sw_pose_local(*pose, sw_mean_place(c, y, &t->spot));
  t->acts = sw_mean_of(y, 0, &t->spot);
  t->held = sw_contact_is_held(s, k);
  t->candidate = (uint32_t)(k - c->candidates);
  t->stage = (uint16_t)c->stage;
}

/* Where the force acts on a wire that rolls, once its normal is known. */
static void find_surface(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                         const double *y, sw_touch *t) {
  t->edge = sw_contact_arc_lies(c, s, k, y, t);
  t->edge_now = sw_rotate(c->now[t->obstacle].pose.q, t->edge);
  const double radius = s->bodies[k->body].plan->beam.radius;
  t->acts = sw_madd(t->acts, t->press.normal, sw_norm(t->edge) - radius);
}

/* Decides whether a touch presses in this iterate. */
static void activate(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                     const sw_memory *m, const sw_touch *last, sw_press *press) {
  const sw_web *web = s->bodies[k->body].plan->web;
  const int still = c->regime == SW_CONTACT_STATIC;
  if (still && m && web && web->per_ring) press->spare = SPARE_PULLS;
  sw_press_activate(press, goes_on(c, k, press, last) ? &last->press : NULL);
  if (!still || last || web || press->active) return;
  press->active = sw_press_lies(press); /* this touch may carry the whole wire */
}

/* Sets the distance of the wire's arc outside its chord or smooth curve. */
static void rise(sw_contact *c, const sw_system *s, const sw_candidate *k, const sw_memory *m,
                 const double *y, const sw_place *place, sw_touch *t) {
  if (!k->arcs || t->feature == SW_BEHIND_BARRIER) return;
  t->rise = sw_contact_arc_rise(c, s, k, place, y, t->press.normal);
  if (c->regime == SW_CONTACT_IMPLICIT && !t->sharp)
    t->rise = sw_contact_arc_mean(s, k, m, t->rise);
  if (m && m->kept.left < HUGE_VAL) t->fallen = sw_larger(0.0, m->rise - t->rise);
  c->falls |= t->fallen > 0;
}

/* The memory as it holds for the candidate. What other edges have left outside (sw_kept.left) goes
 * on only at its own place: the nodes beside a chord on a peg are outside in any case. m: NULL if
 * nothing pressed there. */
static sw_kept kept_by(const sw_contact *c, const sw_candidate *k, const sw_memory *m,
                       const sw_closest *here) {
  const sw_memory *own = m ? NULL : sw_contact_remembered(c, k, here);
  if (own && own->kept.edited) return (sw_kept){.left = own->kept.left, .edited = 1};
  if (!m) return (sw_kept){0};
  sw_kept kept = m->kept;
  if (m->node == k->node && m->segment == k->segment) return kept;
  if (kept.left == HUGE_VAL) kept.left = DBL_MAX;
  kept.left = sw_larger(0.0, kept.left);
  return kept;
}

sw_status sw_contact_add_touch(sw_contact *c, const sw_system *s, const sw_candidate *k,
                               const double *y, const sw_place *place) {
  const sw_closest *near = &place->near;
  const double at = k->segment ? near->at : 0.0;
  const sw_vec out = sw_rotate(c->now[k->obstacle].pose.q, near->normal);
  const sw_closest here = {.at = at, .normal = near->normal, .feature = near->feature};
  const sw_memory *m = sw_contact_recalled(c, s, k, &here, y);
  const sw_touch *last = last_for(c, k, at, near->feature, out);
  const sw_plan *plan = s->bodies[k->body].plan;
  sw_touch *const t = new_touch(c);
  if (!t) return SW_ENOMEM;
  sw_press *press = &t->press;
  take_place(c, s, k, at, y, place, t);
  t->steady = m ? m->kept.steady : 0.0, t->known = m != NULL;
  t->usual = end_stiffness(c, s, k, y, out);
  t->stiffer = stiffness_of(c, k, m, last, t->usual);
  press->normal = sw_contact_leaning(c, s, k, place, place->sharp ? t->steady : 0.0);
  if (s->bodies[k->body].roll_block) find_surface(c, s, k, y, t);
  rise(c, s, k, m, y, place, t);
  press->gap = near->gap - k->skin + t->rise;
  t->share = sw_place_share(place);
  press->k = t->share * (c->softer ? sw_contact_softer(c, s, k, t->stiffer) : t->stiffer);
  press->by_place = goes_by_place(c, s, k);
  press->gap += sw_contact_aslant(c, k->node, k->other, at, press->normal);
  press->soft = sw_contact_softness(c, s, m, t);
  const sw_kept known = kept_by(c, k, m, &here), *const kept = m || known.edited ? &known : NULL;
  t->edited = known.edited && c->regime == SW_CONTACT_IMPLICIT;
  t->squeezed = sw_contact_is_squeezed(c, s, k, kept, t);
  sw_contact_forgive(c, s, k, kept, y, t);
  if (m && !t->squeezed)
    t->hardened = sw_kept_hardened(&m->kept, t->share * t->stiffer, plan->web != NULL);
  c->hardens |= t->hardened > 0;
  press->gap += t->forgiven;
  press->gap_after = press->gap;
  activate(c, s, k, m, last, press);
  begin_friction(c, s, m, last, y, t);
  if (t->held) press->active = 0;
  take_in(c);
  return SW_OK;
}
