/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports a rod whose sharpest bend of the run takes only an edge or two, for instance between a
 * grip and a clip beside it. Such a wire is too flexible there: its radius is too large, and the
 * forces and moments of the holds beside it are too small. */
#include <math.h>
#include <string.h>

#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "watch/observe.h"

/* The second difference of the curvature from node to node, over the curvature, from which a bend
 * is told. Of 122 drawn scenes with six cables (grips, pads, pegs, clips, drops, twist) 30 had an
 * event edges; 2.3 times as many edges changed a radius or a force by more than 12 % in 27 of them.
 * A grip 15 to 30 mm beside a clip had forces 6 to 70 % too small above 0.7, at most 16 % below
 * (spec/scene/clip_edges_spec) [-]. */
static const double UNEVEN = 0.7;
/* The number of segments that is advised makes it about this [-]. */
static const double EVEN = 0.15;
/* Wider bends than this, over the wire's radius, are not told: 1 % of strain [-]. */
static const double WIDEST = 100.0;
/* A bend is that of a corner of the drawn path if the corner's turn is more than this share of it
 * [-]. */
static const double OF_CORNER = 0.5;

/* 1 if the run's list has an event of this kind for the wire. */
static int is_told(sw_scene *s, const char *kind, const char *name) {
  const sw_events *events = sw_scene_events_of(s);
  for (size_t i = 0; i < events->count; i++)
    if (!strcmp(events->list[i].kind, kind) && !strcmp(events->list[i].object, name)) return 1;
  return 0;
}

static double mean_edge(const sw_mesh *m) {
  return (m->s[m->n - 1] - m->s[0]) / (double)(m->n - 1);
}

/* Returns how uneven a bend of a taut wire at one place is: from node to node it decays by exp(-q),
 * 2 sinh(q/2) = h sqrt(T/EI). If edges are too long for that, watch/edges.c tells it [-]. */
static double taut_uneven(const sw_scene_wire *w, double edge) {
  const double T = w->extremes.tension.value;
  if (!(T > 0)) return 0;
  return 2.0 * (1.0 - exp(-2.0 * asinh(0.5 * edge * sqrt(T / w->beam.EI))));
}

static void watch(sw_scene *s, const sw_scene_wire *w) {
  const sw_extreme *bend = &w->extremes.curvature;
  const sw_sharpness *sharp = &w->extremes.sharp;
  if (w->strand.web || !(w->beam.EI > 0) || !(bend->value * WIDEST * w->beam.radius > 1)) return;
  if (sharp->round > 0 || is_told(s, "edges", w->name)) return;
  const double edge = mean_edge(&w->mesh), at = bend->s - w->mesh.s[0];
  if (!(sharp->uneven > fmax(UNEVEN, taut_uneven(w, edge)))) return;
  if (sw_corner_turn(w, bend->s, edge) > OF_CORNER * edge * bend->value) return;
  const double segments = ceil((double)(w->mesh.n - 1) * sharp->uneven / EVEN);
  sw_scene_tell(
      s, "edges", w->name, at, segments,
      "the sharpest bend of wire '%s', %.4g mm at s = %.4g m, takes only one or two edges "
      "of %.4g mm: it may be far sharper, and forces of holds beside it larger; try "
      "segments = %.0f",
      w->name, 1e3 / bend->value, at, 1e3 * edge, segments);
}

void sw_scene_end_bends(sw_scene *s) {
  for (size_t k = 0; k < sw_scene_wire_slots(s); k++) {
    const sw_scene_wire *w = sw_scene_wire_in(s, k);
    if (!sw_scene_is_loose(w)) watch(s, w);
  }
}
