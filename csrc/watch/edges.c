/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports rods whose edges are too long for a bend. A bend over something sharp is then as wide as
 * an edge, and a taut wire, which cannot bend as much as it should, is stretched instead. */
#include <math.h>

#include "base/halving.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/values.h"
#include "scene/wire.h"
#include "system/system.h"
#include "watch/observe.h"

/* An edge longer than LONG of the bend radius makes the radius about a tenth too large, and the
 * tension of a taut wire wrong by more. Edges of FINE of it make both right within a few percent
 * (spec/lua/long_edges_spec) [-]. */
static const double LONG = 0.8, FINE = 0.4;

/* Returns the length of the edge at s [m]. */
static double edge_at(const sw_plan *plan, double s) {
  size_t after;
  SW_FIRST_NOT(plan->s[after] <= s, after, 1, plan->edges);
  return plan->rest[after - 1];
}

void sw_scene_watch_edges(sw_scene *s, size_t wire, const sw_wire_extremes *now) {
  const sw_plan *plan = sw_scene_system(s)->bodies[wire].plan;
  const sw_extreme *bend = &now->curvature;
  if (plan->web || !(plan->beam.EI > 0) || !(bend->value > 0)) return;
  const double edge = edge_at(plan, bend->s);
  if (!(edge * bend->value > LONG)) return;
  const sw_scene_wire *w = sw_scene_wire_in(s, wire);
  const double segments = ceil(plan->length * bend->value / FINE), at = bend->s - w->mesh.s[0];
  sw_events_go_on(sw_scene_events_of(s), "edges", w->name, sw_scene_time(s));
  sw_scene_tell(s, "edges", w->name, at, segments,
                "edges of %.4g mm of wire '%s' are too long for its bend of %.4g mm at s = %.4g m: "
                "bends and tensions are off by more than a tenth; try segments = %.0f",
                1e3 * edge, w->name, 1e3 / bend->value, at, segments);
}
