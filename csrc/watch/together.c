/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports lines that turn together while they press each other, as turns on a drum that lie on each
 * other. Friction between lines acts at their axes. If two of them turn like one body, their
 * surfaces do not slide, but their axes move at different speeds: friction takes this for sliding
 * and pulls the outer one back. 1.8 turns of FLRY-B 0.5 wound with 3 N bear 14 N
 * (spec/contact/together_spec).
 *
 * With the tangents t, the radii r and the normal n from the second line to the first one, the
 * surfaces slide by u + sum r (n . dt/ds) t, where u is the velocity of the first axis relative to
 * the second one. Lines only: the surface of a mesh has its own particles. */
#include <math.h>
#include <stdio.h>

#include "base/each.h"
#include "body/touching.h"
#include "contact/contact.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/system.h"
#include "watch/observe.h"

/* Friction counts if the surfaces slide by less than this share of the sliding of the axes [-]. */
static const double SURFACES = 0.5;
/* Slower axes do not slide [m/s]. */
static const double SLOW = 1e-4;
/* Such friction on a wire is told above this share of its largest tension or its usual force. It is
 * 0.5 to 0.8 of it in wound turns. In a coil (examples/10_kink.lua) it is 0.4 with a pull that is a
 * quarter off, 0.12 with one that is a tenth off [-]. */
static const double TOLD = 0.1;

/* Adds the velocity of one line's axis at the place to *axis, and that of its surface, times sign;
 * returns 0 for a mesh. */
static int add_motion(const sw_system *s, const sw_pair_place *p, int k, double sign, sw_vec *axis,
                      sw_vec *surface) {
  const sw_body *b = &s->bodies[p->body[k]];
  const sw_vec v0 = sw_vec_at(s->v, p->node[k]), v1 = sw_vec_at(s->v, p->end[k]);
  const sw_vec edge = sw_sub(sw_vec_at(s->x, p->end[k]), sw_vec_at(s->x, p->node[k]));
  const double length = sw_norm(edge);
  if (b->plan->web || !(length > 0)) return 0;
  const sw_vec moves = sw_scale(sw_lerp(v0, v1, p->at[k]), sign);
  const double turns = sw_dot(sw_sub(v1, v0), p->normal) / length;
  *axis = sw_add(*axis, moves);
  *surface = sw_madd(sw_add(*surface, moves), edge, b->plan->beam.radius * turns / length);
  return 1;
}

/* Returns the friction at a place if the axes slide there and the surfaces do not; else 0 [N]. */
static double false_friction(const sw_system *s, const sw_pair_place *p) {
  sw_vec axis = {0, 0, 0}, surface = {0, 0, 0};
  if (!add_motion(s, p, 0, 1.0, &axis, &surface) || !add_motion(s, p, 1, -1.0, &axis, &surface))
    return 0;
  axis = sw_madd(axis, p->normal, -sw_dot(axis, p->normal));
  surface = sw_madd(surface, p->normal, -sw_dot(surface, p->normal));
  const double speed = sw_norm(axis);
  if (!(speed > SLOW) || sw_norm(surface) > SURFACES * speed) return 0;
  return fmax(0.0, -sw_dot(p->friction, axis) / speed);
}

/* Adds a place's friction to both of its lines. */
static void add(sw_system *s, const sw_pair_place *p) {
  const double friction = false_friction(s, p);
  for (int k = 0; k < 2 && friction > 0; k++) {
    sw_body *b = &s->bodies[p->body[k]];
    if (k && p->body[0] == p->body[1]) break; /* it counts once */
    b->together.sum += friction;
    if (!(friction > b->together.most)) continue;
    b->together.most = friction, b->together.with = p->body[!k];
  }
}

static void tell(sw_scene *s, const sw_scene_wire *w, const sw_scene_wire *other, double sum) {
  char who[2 * SW_NAME_SIZE + 32];
  snprintf(who, sizeof who, other == w ? "turns of wire '%s'" : "wires '%s' and '%s'", w->name,
           other->name);
  sw_events_go_on(sw_scene_events_of(s), "together", w->name, sw_scene_time(s)); /* one in a run */
  sw_scene_tell(s, "together", w->name, (double)NAN, sum,
                "%s turn together while pressed: friction acts at their axes and takes this for "
                "sliding, with %.3g N on '%s'. Its tension, up to %.3g N, may be too large; "
                "friction = 0 between them gives the least",
                who, sum, w->name, w->extremes.tension.value);
}

void sw_scene_watch_together(sw_scene *s) {
  sw_system *system = sw_scene_system(s);
  size_t next[2] = {0, 0};
  sw_pair_place p;
  if (!sw_scene_places(s)) return;
  SW_ITEMS(sw_body, b, system->bodies, system->body_count) b->together.sum = b->together.most = 0;
  while (sw_scene_next_place(s, SIZE_MAX, next, &p)) add(system, &p);
  for (size_t k = 0; k < system->body_count; k++) {
    const sw_body *b = &system->bodies[k];
    const sw_scene_wire *w = sw_scene_wire_in(s, k);
    if (b->waits || !(b->together.sum > 0)) continue;
    const double usual = sw_contact_usual_force(system, b->plan);
    if (b->together.sum > TOLD * fmax(w->extremes.tension.value, usual))
      tell(s, w, sw_scene_wire_in(s, b->together.with), b->together.sum);
  }
}
