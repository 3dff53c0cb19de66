/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports wires that are bent in a plane and move, and are pushed for longer than a real wire stays
 * in that plane. Nothing in the simulation moves such a wire across the plane, not even rounding:
 * two hands that bring a cable's ends together over a peg bend it in the plane of its drawing.
 * watch/straight.c looks at slow wires, watch/unbent.c at nearly straight ones.
 *
 * In poses only wires that friction holds are looked at: other unstable states are left by
 * themselves.
 *
 * A step takes the rate of a straight piece under this push. Only when a real wire had left the
 * plane at this rate, the motions of the bent wire itself are computed. */
#include <math.h>

#include "body/join.h"
#include "body/touching.h"
#include "contact/contact.h"
#include "scene/course.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "watch/across.h"
#include "watch/observe.h"

/* A wire that is bent by less is nearly straight, see watch/unbent.c [-]. */
static const double BENT = 0.02;
/* After this much growth, as its logarithm, the bend of a real wire out of the plane would be its
 * own length three times over [-]. */
static const double GROWTH = 8.0;
/* Growth until the next look, over that at the last one, at least and at most; without the growth
 * before it was bent [-]. */
static const double SOONER = 1.2, LATER = 2.0;

static int can_be_told(const sw_scene *s, size_t w, const sw_body *b) {
  return !b->waits && b->plan->beam.EI > 0 && !b->plan->web && b->pushed < HUGE_VAL &&
         !sw_scene_joined(s, w);
}

static int is_still(const sw_scene *s) { return sw_course_is_still(sw_scene_course(s)); }

/* A pose lasts for as long as a bend takes, at least this long [s]. */
static const double LONG = 1.0;

static void grow(const sw_scene *s, sw_arched *a, double rate, double time) {
  a->growth += is_still(s) ? GROWTH : rate * time;
  a->time += is_still(s) ? fmax(time, LONG) : time;
}

/* A wire that is straight, or bent by rounding, leaves its line to all sides alike: its bend grows
 * across the plane in which it is bent later, too. */
void sw_scene_watch_arched(sw_scene *s, size_t wire, const sw_bend *bend) {
  sw_system *system = sw_scene_system(s);
  sw_body *b = &system->bodies[wire];
  sw_arched *a = &b->arched;
  const double time = sw_scene_time(s), since = time - a->seen;
  sw_vec normal = {0};
  a->seen = time;
  const int pushed = bend->rate > 0 && can_be_told(s, wire, b);
  if (!pushed || (!sw_scene_lies_in_plane(system, b, 0, &normal) && sw_norm2(normal) > 0)) {
    *a = (sw_arched){.seen = time};
    return;
  }
  if (a->pushed && sw_bend_grows(b, bend, a->growth))
    grow(s, a, bend->rate, since); /* else it began within the step */
  if (!sw_scene_lies_in_plane(system, b, BENT, &normal)) a->straight = fmax(0, a->growth - 1);
  a->pushed = 1, a->push = bend->piece.push;
  a->at = b->plan->s[bend->piece.edge] - b->plan->s[0];
  a->normal = normal;
}

static void tell(sw_scene *s, size_t w, int slips) {
  const sw_arched *a = &sw_scene_system(s)->bodies[w].arched;
  const char *name = sw_scene_wire_in(s, w)->name;
  if (is_still(s))
    sw_scene_tell(
        s, "buckling", name, a->at, a->push,
        "wire '%s' stays in a plane under a push of %.3g N, held in it by friction only: a "
        "real wire may slide off to a side; draw it bent out of the plane by a thousandth "
        "of its length",
        name, a->push);
  else if (slips)
    sw_scene_tell(s, "buckling", name, a->at, a->push,
                  "wire '%s' stays in a plane under a push of %.3g N for %.3g s, held in it by "
                  "friction only: a real wire may have left it before; draw it bent out of it by a "
                  "thousandth of its length",
                  name, a->push, a->time);
  else
    sw_scene_tell(s, "buckling", name, a->at, a->push,
                  "wire '%s' stays in a plane under a push of %.3g N for %.3g s, but is unstable "
                  "across it: a real wire has left it by then; draw it bent out of it by a "
                  "thousandth of its length, or add a small force across it",
                  name, a->push, a->time);
}

static double later(double grown) { return fmin(LATER, fmax(SOONER, GROWTH / fmax(grown, 1.0))); }

/* Looks at a wire of the linearised system. slips: its touches slide, unless friction holds a bend
 * that has grown that far. */
static sw_status look_at(sw_scene *s, size_t w, int slips) {
  sw_body *b = &sw_scene_system(s)->bodies[w];
  sw_arched *a = &b->arched;
  const double slow = GROWTH / (LATER * a->time);
  const sw_across of = {a->normal, slow * slow, slips, a->growth};
  size_t count = 0;
  double rate = 0;
  const sw_status status = sw_scene_unstable_across(s, w, &of, &count, &rate);
  if (status == SW_ENOMEM) return status;
  const double grown = status == SW_OK && count > 0 ? rate * a->time : 0;
  if (slips || count > 0 || !sw_scene_contact(s)) /* friction does not matter */
    a->need = a->straight + (a->growth - a->straight) * later(grown);
  if (grown < GROWTH) return SW_OK;
  tell(s, w, slips);
  b->pushed = HUGE_VAL; /* once in a run */
  return SW_OK;
}

/* 1 if a real wire may have left its plane by now. While it is nearly straight, watch/unbent.c
 * tells of it. */
static int is_due(const sw_scene *s, size_t w) {
  const sw_body *b = &sw_scene_system(s)->bodies[w];
  const sw_arched *a = &b->arched;
  sw_vec normal;
  return a->growth >= fmax(GROWTH, a->need) && b->pushed < HUGE_VAL && !(b->unbent.due > 0) &&
         sw_scene_lies_in_plane(sw_scene_system(s), b, BENT, &normal);
}

static sw_status look_at_all(sw_scene *s, int slips, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  sw_status status = SW_OK;
  int linear = 0;
  for (size_t w = 0; w < system->body_count && status == SW_OK; w++) {
    if (!is_due(s, w)) continue;
    if (!linear)
      status = slips ? sw_scene_linearise_slipping(s, err) : sw_scene_linearise(s, NULL, 0, err);
    linear = 1;
    if (status == SW_OK) status = look_at(s, w, slips);
  }
  if (linear) sw_system_refresh(system);
  const int unsaid = status == SW_EDIVERGED || status == SW_EINVAL || status == SW_ENOCONV;
  return unsaid ? SW_OK : status;
}

sw_status sw_scene_look_across(sw_scene *s, sw_error *err) {
  if (!is_still(s)) SW_TRY(look_at_all(s, 0, err)); /* poses leave states that are unstable */
  return sw_scene_contact(s) ? look_at_all(s, 1, err) : SW_OK;
}
