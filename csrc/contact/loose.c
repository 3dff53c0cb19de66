/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Friction of sliding that is less than that of sticking: which one a touch has, and wires that
 * break loose within a step. A touch that begins to slide has the friction of sticking for all of
 * that step, although it loses it at once: peaks were up to 1.6 times too large. So the step is cut
 * in halves until it ends shortly before that moment. */
#include <math.h>

#include "contact/jolt.h"
#include "contact/rebound.h"
#include "contact/surface.h"
#include "contact/touch.h"

/* A touch that did not slide before slides at once if its speed along the surface at the step's
 * start would carry it farther than CARRIED in the step (friction's spring holds up to about as
 * far), or is above SLIDES: in the short parts of a blow a wire that lands slides less far [m],
 * [m/s]. */
static const double CARRIED = 5e-6, SLIDES = 1e-3;

/* 1 if a touch that did not slide before slides already at the step's start: the wire lands, was
 * thrown, or lies on something that has jumped to a speed. */
static int comes_sliding(const sw_contact *c, const sw_system *s, const sw_touch *t) {
  const sw_body *b = &s->bodies[t->body];
  const sw_vec wall = sw_obstacle_velocity_before(c, s, t);
  sw_vec v = sw_sub(sw_mean_of(s->v, 0, &t->spot), wall);
  if (b->roll_block) {
    const sw_levers levers = sw_touch_levers(s, t);
    v = sw_add(v, sw_levers_shift(&levers, s->v + 3 * s->nodes + b->first_roll, 1));
    v = sw_add(v, sw_levers_tilt(&levers, s->v));
  }
  v = sw_madd(v, t->press.normal, -sw_dot(v, t->press.normal));
  return sw_norm(v) > fmin(CARRIED / c->h, SLIDES);
}

double sw_contact_coefficient(const sw_contact *c, const sw_system *s, const sw_memory *m,
                              const sw_touch *t) {
  const sw_contact_obstacle *o = &c->obstacles[t->obstacle];
  if (o->kinetic == o->friction) return o->friction;
  if (m && m->kept.sliding) return o->kinetic;
  return c->regime != SW_CONTACT_STATIC && comes_sliding(c, s, t) ? o->kinetic : o->friction;
}

/* Friction that is lost too late, times the step, over the wire's usual force [s]. Cables drawn off
 * a table (0.4, sliding 0.2) have peaks, as means over 10 ms, within 4 % of those of steps of 0.2
 * ms (spec/contact/loose_spec). With three times this value peaks are up to 1.15 times those. */
static const double LATE = 1e-4;

/* Friction that a touch loses as it begins to slide in this step [N]. */
static double lost_by(const sw_contact *c, const sw_touch *t) {
  const sw_contact_obstacle *o = &c->obstacles[t->obstacle];
  if (!(o->kinetic < o->friction) || t->friction < o->friction) return 0;
  if (!t->press.next_sliding || !(t->press.normal_force > 0)) return 0;
  return (o->friction - o->kinetic) * t->press.normal_force;
}

double sw_contact_lost(const sw_contact *c, const sw_body *b) {
  size_t i, end;
  double sum = 0;
  if (!c->touch_count || !c->slick_count) return 0;
  sw_contact_touches_of(c, b->first_node, b->first_node + b->plan->nodes, &i, &end);
  for (; i < end && i < c->touch_count; i++) /* not those that wait */
    sum += lost_by(c, &c->touches[i]);
  return sum;
}

int sw_contact_breaks_loose(sw_contact *c, const sw_system *s, double h) {
  if (c->regime != SW_CONTACT_IMPLICIT || !isfinite(c->least)) return 0;
  for (size_t i = 0; c->slick_count && i < c->touch_count;) { /* sorted by body */
    const size_t body = c->touches[i].body;
    double lost = 0;
    for (; i < c->touch_count && c->touches[i].body == body; i++)
      lost += lost_by(c, &c->touches[i]);
    if (lost > 0 && lost * h > LATE * sw_contact_usual_force(s, s->bodies[body].plan))
      c->soonest = fmin(c->soonest, 0.5 * h);
  }
  return c->soonest < h;
}
