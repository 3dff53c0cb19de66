/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports lines that lie along each other and go round each other while they press, as the strands
 * of a coil: friction across them acts on their axes, without the torques by which it turns each
 * line about itself. These would balance it: without them it brakes the common turn of the lines
 * (spec/physics/knot_spec). Where holds turn the lines along with each other, they do not rub
 * (mutual/meet_rub.c), and nothing is reported. Lines only: the
 * surface of a mesh has its own particles. */
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

/* Lines lie along each other if the cosine between them is above this [-]. */
static const double ALONG = 0.8;
/* Slower axes do not slide [m/s]. */
static const double SLOW = 1e-4;
/* Such friction on a wire is told above this share of its largest tension or its usual force. It is
 * 1 to 2 of it in a coil whose pull is 9 to 18 % too small, 0.3 in one whose pull is right [-]. */
static const double TOLD = 0.4;

static sw_vec edge_of(const sw_system *s, const sw_pair_place *p, int k) {
  return sw_sub(sw_vec_at(s->x, p->end[k]), sw_vec_at(s->x, p->node[k]));
}

static sw_vec speed_of(const sw_system *s, const sw_pair_place *p, int k) {
  return sw_lerp(sw_vec_at(s->v, p->node[k]), sw_vec_at(s->v, p->end[k]), p->at[k]);
}

/* Returns the friction by which a place brakes lines that move across each other; else 0 [N]. */
static double across(const sw_system *s, const sw_pair_place *p) {
  const sw_vec one = edge_of(s, p, 0), two = edge_of(s, p, 1);
  if (s->bodies[p->body[0]].plan->web || s->bodies[p->body[1]].plan->web) return 0;
  if (!(fabs(sw_dot(one, two)) > ALONG * sw_norm(one) * sw_norm(two))) return 0;
  const sw_vec side = sw_unit_or(sw_cross(one, p->normal), sw_v(0, 0, 0));
  const double moves = sw_dot(sw_sub(speed_of(s, p, 0), speed_of(s, p, 1)), side);
  if (!(fabs(moves) > SLOW)) return 0;
  return fmax(0.0, -sw_dot(p->friction, side) * (moves > 0 ? 1.0 : -1.0));
}

/* Adds a place's friction to both of its lines. */
static void add(sw_system *s, const sw_pair_place *p) {
  const double friction = across(s, p);
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
  sw_scene_tell(
      s, "together", w->name, (double)NAN, sum,
      "%s go round each other while pressed: friction across them, %.3g N on '%s', brakes "
      "this without turning them about themselves. Tension and moments may be wrong; compare with "
      "friction = 0 between them",
      who, sum, w->name);
}

/* Returns the largest tension of a line so far in the run, and now. */
static double tension_of(const sw_system *s, const sw_body *b, const sw_scene_wire *w) {
  double most = w->extremes.tension.value;
  for (size_t e = 0; e < b->plan->edges; e++) most = fmax(most, s->tension[b->first_edge + e]);
  return most;
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
    if (b->together.sum > TOLD * fmax(tension_of(system, b, w), usual))
      tell(s, w, sw_scene_wire_in(s, b->together.with), b->together.sum);
  }
}
