/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports a wire that slips over a part of itself which a rigid grip holds, as the loop of a knot
 * does. Such a grip has no body: nothing but the wire itself is there, and the loop comes off over
 * the end. Real fingers would stop it. */
#include <math.h>

#include "body/touching.h"
#include "link/hold.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "watch/observe.h"

/* What touches the held part. A loop may be round it from the start. */
enum { NOT_SEEN, CLEAR, TOUCHED, TOLD };

/* A knot that is drawn tight at the grip touches the wire at its face. This part of the grip, in
 * radii and as a share of its width, does not count [-]. */
static const double AT_FACE = 2.0, SHARE = 0.25;

static int is_grip(const sw_hold *h) {
  return h->alive && h->s2 > h->s1 && !sw_hold_passes(h) && !h->cls->hold->rail;
}

/* 1 if the place is in the grip, and not at a face behind which the wire goes on. */
static int is_inside(const sw_scene *s, const sw_hold *h, double at) {
  const sw_scene_wire *w = sw_scene_wire_in(s, h->wire);
  const sw_mesh *m = &w->mesh;
  const double face = fmin(AT_FACE * w->beam.radius, SHARE * (h->s2 - h->s1));
  const double first = h->s1 > m->s[0] ? h->s1 + face : h->s1;
  const double last = h->s2 < m->s[m->n - 1] ? h->s2 - face : h->s2;
  return at >= first && at <= last;
}

static double place_on(const sw_system *s, const sw_pair_place *p, int k) {
  const sw_body *b = &s->bodies[p->body[k]];
  const double *arc = b->plan->s;
  const double from = arc[p->node[k] - b->first_node], to = arc[p->end[k] - b->first_node];
  return from + p->at[k] * (to - from);
}

/* A loop goes round the grip's axis by more than this angle within this distance, over the wire's
 * radius. A straight piece that lies on the part, such as a turn of a coil beside it, goes by less
 * than half a turn [rad], [-]. */
static const double ROUND = 3.5, NEAR = 20.0;

/* A line through a place of the wire, along it. */
typedef struct line {
  sw_vec at, along;
} line;

static line axis_at(const sw_system *s, const sw_pair_place *p, int k) {
  const sw_vec from = sw_vec_at(s->x, p->node[k]), to = sw_vec_at(s->x, p->end[k]);
  const sw_vec way = sw_sub(to, from);
  return (line){sw_madd(from, way, p->at[k]), sw_unit_or(way, sw_v(0, 0, 1))};
}

/* Returns the angle by which the wire goes round the axis from a node on, in steps of `step` nodes,
 * within a distance [rad]. */
static double goes_round(const sw_system *s, const sw_body *b, size_t node, int step, line axis,
                         double within) {
  const size_t first = b->first_node, last = first + b->plan->nodes - 1;
  sw_vec before = sw_sub(sw_vec_at(s->x, node), axis.at);
  double sum = 0;
  while (node != (step > 0 ? last : first)) {
    node += (size_t)step;
    const sw_vec now = sw_sub(sw_vec_at(s->x, node), axis.at);
    if (sw_norm(now) > within) break;
    const sw_vec u = sw_madd(before, axis.along, -sw_dot(before, axis.along));
    const sw_vec v = sw_madd(now, axis.along, -sw_dot(now, axis.along));
    sum += atan2(sw_dot(sw_cross(u, v), axis.along), sw_dot(u, v));
    before = now;
  }
  return sum;
}

/* 1 if the wire goes round its place k of these two as a loop does, at the other one. */
static int is_loop(const sw_system *s, const sw_pair_place *p, int k) {
  const sw_body *b = &s->bodies[p->body[k]];
  const line axis = axis_at(s, p, k);
  const double within = NEAR * b->plan->beam.radius;
  const size_t node = p->at[1 - k] < 0.5 ? p->node[1 - k] : p->end[1 - k];
  const double on = goes_round(s, b, node, 1, axis, within);
  return fabs(on - goes_round(s, b, node, -1, axis, within)) > ROUND;
}

/* Returns where a loop of the wire touches its part in the grip, or NAN: nowhere [m]. */
static double touched(const sw_scene *s, const sw_hold *h) {
  const sw_system *system = sw_scene_system(s);
  size_t next[2] = {0, 0};
  sw_pair_place p;
  while (sw_scene_next_place(s, h->wire, next, &p)) {
    if (p.body[0] != p.body[1]) continue;
    for (int k = 0; k < 2; k++) {
      const double here = place_on(system, &p, k), there = place_on(system, &p, 1 - k);
      if (!is_inside(s, h, here) || (there >= h->s1 && there <= h->s2)) continue;
      if (is_loop(system, &p, k)) return here;
    }
  }
  return NAN;
}

void sw_scene_watch_passed(sw_scene *s) {
  if (!sw_scene_places(s)) return;
  SW_EACH(hold, h, s) {
    if (!is_grip(h) || h->watch.over == TOLD || sw_scene_system(s)->bodies[h->wire].plan->web)
      continue;
    const double at = touched(s, h);
    const int before = h->watch.over;
    h->watch.over = isnan(at) ? CLEAR : TOUCHED;
    if (isnan(at) || before != CLEAR) continue;
    const sw_scene_wire *w = sw_scene_wire_in(s, h->wire);
    h->watch.over = TOLD;
    sw_scene_tell(
        s, "passed", w->name, at - w->mesh.s[0], NAN,
        "wire '%s' slips over its part in the grip of '%s': an imposed grip has no body "
        "that would stop it, and what follows is wrong. Grasp it by 'plates', or keep the "
        "loop away",
        w->name, h->name);
  }
}
