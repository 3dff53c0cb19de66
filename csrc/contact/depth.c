/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Allowed depth of touches with obstacles, and the depth of an accepted state. */
#include "contact/depth.h"

#include <math.h>

#include "base/halving.h"
#include "contact/contact.h"
#include "touch/drawn.h"

/* A wire is limp if tension times edge^2 is above this multiple of EI: it bends within a small part
 * of an edge. Statics may leave the usual depth to a limp string; with less it does not settle
 * [-]. */
static const double LIMP = 500.0;

/* Statics leave less than the usual depth to a touch from this share of the squeezing force on,
 * which is three weights. From a hundred on, a cable that is pushed through a channel with corners
 * was 46 um deep in walls that leave it 0.7 mm, so that it was bent less: its push was 6 to 11 %
 * too small (spec/contact/pushed_channel_spec). Ends do not bend a wire by their depth, and one
 * that sticks slipped 0.5 mm while its touch was stiffened (spec/physics/pushed_tip_spec) [-]. */
static const double AT_REST = 0.03;

/* 1 if statics must leave less than the usual depth to a touch because the depth lowers the tension
 * or the bend: the touch presses with more than the line's weight. */
static int is_taut(const sw_system *s, const sw_candidate *k, const sw_touch *t) {
  const sw_body *b = &s->bodies[t->body];
  const size_t i = t->node - b->first_node, e = i < b->plan->edges ? i : i - 1;
  const double edge = b->plan->rest[e], tension = s->tension[b->first_edge + e];
  const int is_end = !t->segment && (i == 0 || i == b->plan->edges);
  const double firm = is_end ? k->squeezing : AT_REST * k->squeezing;
  return t->press.normal_force >= firm && tension * edge * edge < LIMP * b->plan->beam.EI;
}

/* Pads fix the places that they press. Open ones that come near do not: a cable under another one
 * would count as taut, and its touches would change between the usual and a small depth without end
 * (spec/physics/poses_pads_near_spec). */
static void take_pads(const sw_contact *c, const sw_body *b, sw_drawn *drawn) {
  const size_t end = b->first_node + b->plan->nodes;
  size_t m;
  SW_FIRST_NOT(c->memory[m].node < b->first_node, m, 0, c->memory_count);
  for (; m < c->memory_count && c->memory[m].node < end; m++) {
    const size_t o = sw_contact_index(c, c->memory[m].obstacle);
    if (c->memory[m].kept.normal_force > 0 && o < c->count && c->obstacles[o].grips > 0)
      sw_drawn_take(drawn, c->memory[m].node);
  }
}

void sw_contact_find_drawn(sw_contact *c, const sw_system *s, size_t body, size_t first) {
  if (c->regime == SW_CONTACT_EXPLICIT || s->bodies[body].plan->web) return;
  sw_drawn drawn = sw_drawn_of(s, body);
  if (c->regime == SW_CONTACT_STATIC) take_pads(c, &s->bodies[body], &drawn);
  for (size_t k = first; k < c->candidate_count && c->regime == SW_CONTACT_IMPLICIT; k++)
    if (c->obstacles[c->candidates[k].obstacle].grips > 0)
      sw_drawn_take(&drawn, c->candidates[k].node);
  for (size_t k = first; k < c->candidate_count; k++)
    c->candidates[k].drawn = sw_drawn_has(&drawn, c->candidates[k].node, c->candidates[k].other);
}

/* No smaller depth is asked for, in motion and in statics, where shifts of 1 nm end the search. In
 * motion, with a tenth of it, turns that are wound onto each other with coarse edges bear 8 % more
 * (spec/contact/together_spec) [m]. */
static const double LEAST = 1e-6, LEAST_AT_REST = 1e-8;

/* 1 if the usual depth may take more tension from a line than its weight, or the line has more.
 * Lines with less only lie or hang: with little depth soft ones do not come to rest. */
static int may_be_taut(const sw_system *s, const sw_touch *t, double usual) {
  const sw_body *b = &s->bodies[t->body];
  const size_t i = t->node - b->first_node;
  if (i == 0 || i >= b->plan->edges) return 0;
  const sw_vec before = sw_vec_across(b->field.tangent, i - 1);
  const sw_vec turns = sw_sub(sw_vec_across(b->field.tangent, i), before);
  const double turn = fabs(sw_dot(turns, t->press.normal));
  return sw_drawn_is_taut(s, t->body, t->node, b->EA * usual * turn / b->plan->rest[i],
                          0.1 * sw_contact_usual_force(s, b->plan));
}

static double shortening(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                         const sw_touch *t) {
  const int still = c->regime == SW_CONTACT_STATIC;
  if (!k->drawn) return HUGE_VAL;
  if (still && !may_be_taut(s, t, sw_depth_for(SW_DEEPEST, k->radius))) return HUGE_VAL;
  return sw_drawn_depth(s, t->body, t->node, t->other, t->press.normal,
                        sw_depth_for(still ? LEAST_AT_REST : LEAST, k->radius));
}

double sw_contact_deepest(const sw_contact *c, const sw_system *s, const sw_touch *t) {
  const sw_candidate *k = &c->candidates[t->candidate];
  const int line = k->squeezing > 0, pad = c->obstacles[t->obstacle].grips > 0;
  if (!line || pad) return SW_DEEPEST;
  const double usual = sw_depth_for(SW_DEEPEST, k->radius);
  const double shallow = sw_smaller(usual, SW_SHALLOW * k->radius);
  const int still = c->regime == SW_CONTACT_STATIC;
  return fmin(shortening(c, s, k, t), still && !is_taut(s, k, t) ? usual : shallow);
}

double sw_contact_depth_before(const sw_contact *c, const sw_system *s, const sw_touch *t) {
  const sw_vec from = sw_pose_local(c->start[t->obstacle].pose, sw_mean_place(c, s->x, &t->spot));
  const sw_vec way = sw_rotate(c->now[t->obstacle].pose.q, sw_sub(t->seen, from));
  return t->forgiven - t->press.gap + sw_dot(t->press.normal, way);
}

/* A line that moves over a curved surface sinks in by its motion. It may come out by this share of
 * its path, enough where the surface turns by 0.2 rad in a step [-]. */
static const double TURNS = 0.1;

/* Returns how far a touch may come out up to this stage [m]. With SW_PART cables on pegs were
 * thrown in short steps when a chord of 10 mm touched a second time (spec/contact/let_out_spec). */
static double let_out(const sw_contact *c, const sw_system *s, const sw_touch *t) {
  const sw_web *web = s->bodies[t->body].plan->web;
  const sw_vec of = sw_obstacle_velocity(&c->start[t->obstacle], t->point);
  const double moves = sw_norm(sw_sub(sw_mean_of(s->v, 0, &t->spot), of));
  const int slowly = (web && web->per_ring) || c->fresh;
  const double speed = SW_LET_OUT + (slowly ? 0.0 : TURNS * moves);
  return sw_smaller(speed, SW_PART) * (c->stage_time - c->time);
}

/* Depth on the segment beside a held node that no force removes [m]. A node held beyond an edge is
 * below the faces that end there, but inside none. */
static double imposed(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                      const sw_touch *t, const double *y) {
  const sw_body *b = &s->bodies[k->body];
  const int first = b->plan->held[k->node - b->first_node] != SW_FREE;
  const int last = b->plan->held[k->other - b->first_node] != SW_FREE;
  sw_closest near;
  if (!k->segment || first == last) return 0;
  const sw_vec held = sw_vec_at(y, first ? k->node : k->other);
  const sw_pose pose = c->now[k->obstacle].pose;
  const sw_vec local = sw_pose_local(pose, held);
  if (!sw_shape_point(c->obstacles[k->obstacle].shape, local, k->skin, &near)) return 0;
  const double plane = sw_dot(t->press.normal, sw_sub(held, t->point));
  const double at = fmin(fmax(t->at, 0.0), 1.0);
  const double deep = k->skin - fmax(near.gap, plane);
  return (first ? 1.0 - at : at) * fmax(0.0, deep);
}

void sw_contact_forgive(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                        const sw_kept *last, const double *y, sw_touch *t) {
  const int pressed = last && c->regime == SW_CONTACT_IMPLICIT &&
                      (last->left < 0 || last->left == HUGE_VAL); /* though outside */
  if (c->regime == SW_CONTACT_EXPLICIT) return;                   /* force follows depth */
  if (t->press.gap >= 0 && !pressed) return;
  const double always = imposed(c, s, k, t, y);
  const double depth = sw_contact_depth_before(c, s, t) - always;
  t->forgiven = always;
  if (c->regime != SW_CONTACT_IMPLICIT) return;
  sw_kept kept = last ? *last : (sw_kept){0};
  if (!t->squeezed) kept.left = 0;
  const sw_left left = sw_press_leave(depth, last ? &kept : NULL, let_out(c, s, t));
  t->forgiven += left.forgiven, t->left = left.left;
  t->let_out = left.let_out;
}

/* In motion a touch counts as squeezed from this share of the squeezing force on, which is three
 * weights: it is stiffened from step to step, with the same force. A touch that is stiffened within
 * a step comes out at once, and the force of a clamp that pressed a cable into a table jumped by
 * 7 % (spec/scene/hold_press_spec). With two weights a landing depends on rounding
 * (spec/scene/feed_energy_spec); with five and ten clamps are the same [-]. */
static const double IN_MOTION = 0.03;

/* New edges that are off the depth of their force stay so from this share of the allowed depth on.
 * Below, a wire that only lies on something comes to lie as if it had always had them [-]. */
static const double OF_EDGES = 0.1;

/* Further inside than this share of the radius they come out, though that makes energy. Chords of
 * 0.6 of a peg's radius beside a clamp are off by a tenth. With the usual depth as the limit the
 * force of a cable doubled in short steps, with none it stays inside unseen. Outside they always
 * stay: else the wire would lose its force (spec/contact/held_beside_spec) [-]. */
static const double TOO_DEEP = 0.25;

/* 1 if the line has got other edges, and they stay at the depth where they are. */
static int stays(const sw_contact *c, const sw_system *s, const sw_kept *last, const sw_touch *t,
                 double deepest) {
  if (c->regime != SW_CONTACT_IMPLICIT || last->left != HUGE_VAL) return 0;
  const double off = sw_contact_depth_before(c, s, t) - last->depth;
  return fabs(off) > OF_EDGES * deepest && off <= TOO_DEEP * c->candidates[t->candidate].radius;
}

int sw_contact_is_squeezed(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                           const sw_kept *last, const sw_touch *t) {
  if (!last || !(k->squeezing > 0)) return 0;
  const int moves = c->regime == SW_CONTACT_IMPLICIT && !c->fresh;
  const double from = moves ? IN_MOTION * k->squeezing : k->squeezing;
  const int kept = last->left != 0 && last->left < HUGE_VAL;
  if (last->normal_force >= from || kept) return 1;
  const double deepest = sw_contact_deepest(c, s, t);
  return stays(c, s, last, t, deepest) || last->depth > deepest;
}
