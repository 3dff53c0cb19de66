/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports wires that stay straight, or in a plane, under a push for longer than real wires do, and
 * then buckle. The bend of a real wire grows from its own crookedness. In a perfectly straight one
 * it grows from rounding, so steps and edges decide how hard the push is when the wire buckles:
 * hundreds of times too hard. A push that is still borne at the end of a run is reported by
 * watch/straight.c.
 */
#include <math.h>

#include "scene/course.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/axis.h"
#include "watch/across.h"
#include "watch/observe.h"

/* Directions of all edges of a straight wire differ from its chord by at most this. Real wires are
 * bent by a thousandth of their length, which is ten times as much [-]. */
static const double STRAIGHT = 3e-4;
/* A wire that is bent in a plane by more than STRAIGHT, such as one whose hold lifts a little while
 * it pushes, is still perfectly straight across that plane. If it is bent by more than FLAT, a push
 * bends it further in the plane [-]. */
static const double FLAT = 0.02;
/* A wire in a plane may bear a push a little above its buckling load for long, as it bends in that
 * plane. It is told of from this share of the push under which a real wire buckles [-]. */
static const double ABOVE = 1.5;
/* After this much growth, as its logarithm, the bend of a real wire would be its own length three
 * times over. A wire that is bent by a few millionths of its length, as by its weight, has left its
 * line, too [-]. */
static const double GROWTH = 8.0;
/* How far a wire has left its line. */
enum { STRAIGHT_ON, IN_PLANE, LEFT };

static sw_vec aside_of(const sw_body *b, const double *x, size_t e, sw_vec chord) {
  const sw_vec from = sw_axis_place(b, x, e), to = sw_axis_place(b, x, e + 1);
  const sw_vec edge = sw_unit_or(sw_sub(to, from), chord);
  return sw_madd(edge, chord, -sw_dot(edge, chord));
}

static int shape_of(const sw_system *system, const sw_body *b) {
  const double *x = system->x + 3 * b->first_node;
  const size_t last = sw_axis_edges(b);
  const sw_vec whole = sw_sub(sw_axis_place(b, x, last), sw_axis_place(b, x, 0));
  const sw_vec chord = sw_unit_or(whole, sw_v(1, 0, 0));
  sw_vec most = sw_v(0, 0, 0);
  for (size_t e = 0; e < last; e++) {
    const sw_vec aside = aside_of(b, x, e, chord);
    if (sw_norm2(aside) > FLAT * FLAT) return LEFT; /* most wires, at once */
    if (sw_norm2(aside) > sw_norm2(most)) most = aside;
  }
  if (sw_norm(most) <= STRAIGHT) return STRAIGHT_ON;
  const sw_vec across = sw_unit_or(sw_cross(chord, most), sw_v(0, 0, 0));
  for (size_t e = 0; e < last; e++)
    if (fabs(sw_dot(aside_of(b, x, e, chord), across)) > STRAIGHT) return LEFT;
  return IN_PLANE;
}

static void tell(sw_scene *s, size_t wire, const sw_unbent *u) {
  const char *name = sw_scene_wire_in(s, wire)->name;
  sw_scene_tell(s, "buckling", name, u->at, u->push,
                "wire '%s' stayed %s up to a push of %.3g N, until rounding let it buckle. A real "
                "wire buckles under %.3g N at most: draw it bent %sby a thousandth of its length",
                name, u->plane ? "in a plane" : "straight", u->push, u->due,
                u->plane ? "out of that plane " : "");
}

/* 1 if a real wire had buckled under this push. */
static int is_too_much(const sw_unbent *u) {
  return u->due > 0 && u->push > (u->plane ? ABOVE * u->due : 0);
}

/* The push ended, or the run, and the wire never buckled. */
static void tell_borne(sw_scene *s, size_t wire, const sw_unbent *u) {
  const char *name = sw_scene_wire_in(s, wire)->name;
  sw_events_go_on(sw_scene_events_of(s), "buckling", name, sw_scene_time(s)); /* one in a run */
  sw_scene_tell(s, "buckling", name, u->at, u->push,
                "wire '%s' stayed %s under a push of %.3g N. A real wire buckles under "
                "%.3g N at most, also with this friction: draw it bent %sby a thousandth of its "
                "length, or add a small force across it",
                name, u->plane ? "in a plane" : "straight", u->push, u->due,
                u->plane ? "out of that plane " : "");
}

/* A pose lasts for as long as a bend takes. */
static double grown_in(const sw_scene *s, double rate, double time) {
  return sw_course_is_still(sw_scene_course(s)) ? GROWTH : rate * time;
}

void sw_scene_watch_unbent(sw_scene *s, size_t wire, const sw_bend *bend) {
  sw_system *system = sw_scene_system(s);
  sw_body *b = &system->bodies[wire];
  sw_unbent *u = &b->unbent;
  const double time = sw_scene_time(s), since = time - u->seen;
  u->seen = time;
  if (b->waits || !(b->plan->beam.EI > 0)) return;
  const int pushed = bend->rate > 0;
  const int shape = (pushed || u->due > 0) && since > 0 ? shape_of(system, b) : LEFT;
  const int was_straight = u->due > 0 && !u->plane; /* it buckles in a plane */
  if (pushed && (shape == STRAIGHT_ON || (shape == IN_PLANE && !was_straight))) {
    const double rate = sw_bend_rate_in_trough(s, b, bend);
    if (!(rate > 0)) return; /* it bears more yet */
    if (sw_bend_grows(b, bend, u->growth)) u->growth += grown_in(s, rate, since);
    u->plane |= shape == IN_PLANE;
    if (u->growth < GROWTH) return;
    if (!(u->due > 0)) u->due = bend->piece.push;
    if (bend->piece.push > u->push)
      u->push = bend->piece.push, u->at = sw_axis_arc(b, bend->piece.edge);
    return;
  }
  if (is_too_much(u)) b->arched = (sw_arched){.seen = time}; /* told once */
  if (is_too_much(u) && pushed)
    tell(s, wire, u);
  else if (is_too_much(u) && shape != LEFT)
    tell_borne(s, wire, u);
  *u = (sw_unbent){.seen = time};
}

void sw_scene_end_unbent(sw_scene *s) {
  for (size_t w = 0; w < sw_scene_wire_slots(s); w++) {
    sw_body *b = &sw_scene_system(s)->bodies[w];
    if (is_too_much(&b->unbent) && b->pushed < HUGE_VAL) tell_borne(s, w, &b->unbent);
  }
}
