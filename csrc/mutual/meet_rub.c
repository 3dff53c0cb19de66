/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Friction of a touch of two bodies: the way of their surfaces, and how it begins from memory.
 *
 * Friction acts at the surfaces. A wire whose edge turns moves its surface along itself, by the
 * radius times the turn; a wire that turns about itself moves it across. Wires that turn like one
 * body, as turns wound onto each other or the strands of a pair that is twisted, do not rub
 * (spec/contact/together_spec, spec/contact/twisting_spec). */
#include <math.h>

#include "base/alloc.h"
#include "contact/contact.h"
#include "mutual/meet.h"
#include "touch/same.h"

/* Carries a tangential vector at normal `from` to normal `to`. */
static sw_vec carry(sw_vec v, sw_vec from, sw_vec to) {
  const double share = sw_dot(to, v) / sw_larger(1.0 + sw_dot(from, to), 1e-12);
  return sw_madd(v, sw_add(from, to), -share);
}

/* Normal force of a touch without memory: computed from its depth, but zero if the depth may come
 * from the prediction, which would give thousands of weights [N]. Friction then starts at zero.
 * Enough friction to stop the lighter wire would throw about the wires of a bundle that only fall
 * on each other. */
static double first_force(const sw_meet *t) {
  return t->flies ? 0.0 : sw_larger(0.0, -t->press.gap) * t->press.k;
}

/* Displacement of friction's spring from the memory [m]. Where it becomes or was stiff, its force
 * stays. Otherwise its length: with its force a tight pair of cables would gain energy. */
static sw_vec stretch(const sw_meet *t, const sw_met *met) {
  const int stiff = t->press.soft > 0 || sw_kept_is_stiff(&met->kept);
  return stiff ? sw_press_stretch(&t->press, &met->kept, 0) : met->kept.elastic;
}

/* An end that touches with its tip has no surface along the other wire: where the square of the
 * cosine between edge and surface is below this, the lever falls with it [-]. */
static const double OBLIQUE = 0.5;

static void set_levers(const sw_system *s, sw_meet *t, const double *y) {
  const sw_vec n = t->press.normal;
  const double near = sw_dot(n, sw_bows_apart(y, t->bow)) / t->reach; /* less than 1 when pressed */
  for (int k = 0; k < 2; k++) {
    const sw_body *b = &s->bodies[t->of.body[k]];
    const sw_vec edge = sw_bow_along(y, &t->bow[k]);
    const sw_vec beside = sw_madd(edge, n, -sw_dot(edge, n));
    const double length2 = sw_larger(sw_norm2(beside), OBLIQUE * sw_norm2(edge));
    if (b->plan->web || !(length2 > 0)) continue; /* a mesh's surface has particles */
    t->lever[k] = sw_scale(beside, near * b->plan->beam.radius / length2);
  }
}

sw_vec sw_meet_passes(const sw_meet *t, const double *v) {
  sw_vec u = sw_bows_apart(v, t->bow);
  for (int k = 0; k < 2 && sw_meet_turns(t); k++)
    u = sw_madd(u, t->lever[k], sw_dot(t->press.normal, sw_bow_along(v, &t->bow[k])));
  return sw_meet_eased(t, u);
}

/* Returns the turn of a wire's edges about themselves at a place, or 0 if it is not known [rad]. */
static double turn_at(sw_mutual *m, const sw_system *s, const double *y, const sw_meet *t,
                      int side) {
  const uint32_t body = t->of.body[side];
  const sw_body *b = &s->bodies[body];
  char *turned = &m->turned[body];
  if (*turned == 0) {
    *turned = 2;
    if (SW_GROW(m->turns, m->turns_capacity, s->nodes) != SW_OK) return 0;
    if (sw_system_turns(s, b, y, m->turns + b->first_node)) *turned = 1;
  }
  if (*turned == 2) return 0;
  const size_t last = b->first_node + b->plan->edges - 1, e = t->of.node[side];
  const double here = m->turns[e < last ? e : last];
  if (t->bow[side].spot.count < 3) return here;
  const size_t i = t->bow[side].spot.node[1];
  return 0.5 * (m->turns[i - 1] + m->turns[i]);
}

/* Wires roll on each other where they lie along each other: where the cosine between them is above
 * this. Wires that cross, and are hooked on each other at 30 m/s, did not converge [-]. */
static const double ALONG = 0.8;

/* Wires that roll on each other do not rub across: their turns about themselves move the surfaces.
 * Returns the way that the turns undo. The turns follow from holds and shape; friction does not
 * turn the wires. So turns never make a way or reverse it: it would be work that no hold does. */
static sw_vec undone_by_turns(sw_mutual *m, const sw_system *s, const double *y, const sw_meet *t) {
  const double both = sw_norm(t->lever[0]) * sw_norm(t->lever[1]);
  sw_vec turned = {0, 0, 0};
  if (!(fabs(sw_dot(t->lever[0], t->lever[1])) > ALONG * both)) return turned;
  for (int k = 0; k < 2; k++) {
    const double radius = s->bodies[t->of.body[k]].plan->beam.radius;
    const sw_vec along = sw_unit_or(t->lever[k], sw_v(0, 0, 0));
    turned = sw_madd(turned, sw_cross(along, t->press.normal), radius * turn_at(m, s, y, t, k));
  }
  return turned;
}

/* Part of the way u of the axes by which the wires roll. Shifts within the way that the turns undo
 * do not rub either, if that is longer than friction's longest spring. */
static sw_vec roll(sw_meet *t, sw_vec u, sw_vec turned, double longest) {
  const double most = sw_norm(turned), way = most > 0 ? sw_dot(u, turned) / most : 0;
  const int inside = way >= 0 && way <= most;
  if (!(most > 0)) return turned;
  if (inside && most > longest) t->eases = sw_scale(turned, 1.0 / most);
  return sw_scale(turned, sw_limit(way, 0.0, most) / most);
}

/* Wires that roll let go of what friction's spring holds across, for no torque does its work: a
 * spring that drives the roll relaxes by the way of it, so that it makes no energy; one that brakes
 * is let go within a way as long as the longest spring. */
static sw_vec let_go(sw_vec held, sw_vec rolled, double longest) {
  const double way = sw_norm(rolled);
  if (!(way > 0)) return held;
  const sw_vec side = sw_scale(rolled, 1.0 / way);
  const double here = sw_dot(held, side);
  if (here < 0) return sw_madd(held, side, sw_smaller(way, -here));
  return sw_madd(held, side, -here * (way < longest ? way / longest : 1.0));
}

void sw_meet_begin_friction(sw_mutual *m, const sw_system *s, const double *y, sw_meet *t,
                            const sw_met *met, const sw_meet *last) {
  sw_press *press = &t->press;
  const double friction = sw_mutual_rule(m, t->of.body)->friction;
  const int pressed = met && met->kept.normal_force > 0, went_on = last && last->press.active;
  if (friction > 0 && (pressed || press->active)) set_levers(s, t, y);
  sw_vec u = sw_sub(sw_meet_passes(t, y), sw_meet_passes(t, s->x));
  const double longest = pressed ? friction * met->kept.normal_force / sw_press_grip(press) : 0.0;
  const sw_vec turned = sw_meet_turns(t) ? undone_by_turns(m, s, y, t) : sw_v(0, 0, 0);
  const sw_vec rolled = roll(t, u, turned, longest);
  u = sw_sub(u, rolled);
  /* Poses take the turns from the last iterate, and leave the couples out. With them 84 % of 256
   * coarse scenes of wires that lie on each other came to rest, without them 92 %; with friction on
   * the axes 95 %. */
  if (m->regime == SW_CONTACT_STATIC && !m->looks && s->poses)
    t->lever[0] = t->lever[1] = sw_v(0, 0, 0);
  if (pressed)
    u = sw_add(u, let_go(carry(stretch(t, met), met->normal, press->normal), rolled, longest));
  else if (!press->active)
    u = sw_v(0, 0, 0);
  sw_press_aim(press, u, last ? &last->press : NULL, last && last->stage == m->stage, m->first);
  if (last && m->updates > 0) press->reversals = last->press.reversals;
  sw_press_resume(press, pressed ? &met->kept : NULL, last ? &last->press : NULL, went_on,
                  first_force(t));
  /* soft springs let touches creep; in such a solve sticking touches slide too */
  if (m->soft && pressed && press->active) press->sliding = met->kept.sliding;
  sw_press_begin(press, friction, went_on || pressed, HUGE_VAL);
}
