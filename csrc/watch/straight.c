/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A wire that is perfectly straight stays so under any push along it: nothing bends it to a side,
 * not even rounding. Real ones buckle, and the run says so. */
#include <math.h>

#include "body/join.h"
#include "body/touching.h"
#include "modal/modal.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/system.h"
#include "watch/observe.h"

/* A wire whose tangents differ by less than this is straight [-]. */
static const double STRAIGHT = 1e-9;
/* Push over EI/L^2 below which no wire that is held somewhere buckles: pi^2/4 [-]. */
static const double LEAST_PUSH = 2.467;
/* A slower growth does not count, over sqrt(g/L) [-]. */
static const double SLOWEST = 1.0 / 30.0;
/* A push is looked at again when it has grown by this factor [-]. */
static const double GROWN = 1.2;

/* The largest push in an edge, and where; 0: none [N]. */
static double largest_push(const sw_system *system, const sw_body *b, size_t *edge) {
  double push = 0;
  for (size_t e = 0; e < b->plan->edges; e++)
    if (-system->tension[b->first_edge + e] > push)
      push = -system->tension[b->first_edge + e], *edge = e;
  return push;
}

static int is_straight(const sw_system *system, const sw_body *b) {
  const double *x = system->x + 3 * b->first_node;
  sw_vec before = {0};
  for (size_t e = 0; e < b->plan->edges; e++) {
    const sw_vec t = sw_unit_or(sw_sub(sw_vec_at(x, e + 1), sw_vec_at(x, e)), sw_v(1, 0, 0));
    if (e > 0 && !(sw_dist(t, before) <= STRAIGHT)) return 0;
    before = t;
  }
  return 1;
}

static int cannot_be_said(sw_status status) {
  return status == SW_EDIVERGED || status == SW_EINVAL;
}

/* With the system linearised. */
static sw_status look_at(sw_scene *s, size_t w, double push, size_t edge) {
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[w];
  const double g = fmax(sw_norm(sw_scene_gravity(s)), 1.0),
               rate = SLOWEST * sqrt(g / b->plan->length);
  size_t count = 0;
  const sw_status status = sw_modal_unstable(system, w, rate * rate, &count);
  if (cannot_be_said(status)) return SW_OK;
  if (status != SW_OK || count == 0) return status;
  system->bodies[w].pushed = HUGE_VAL;
  sw_scene_tell(s, "buckling", sw_scene_wire_in(s, w)->name, b->plan->s[edge] - b->plan->s[0], push,
                "wire '%s' stays straight under a push of %.3g N, though it is unstable in %zu "
                "directions: it would buckle, but nothing bends it to a side; draw it bent by a "
                "thousandth of its length, or add a small force across",
                sw_scene_wire_in(s, w)->name, push, count);
  return SW_OK;
}

/* Is the wire straight, and pushed by enough more than when it was looked at last? */
static int is_new_push(const sw_scene *s, size_t w, double *push, size_t *edge) {
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[w];
  if (b->plan->web || sw_scene_joined(s, w)) return 0;
  *push = largest_push(system, b, edge);
  if (!(*push * b->plan->length * b->plan->length > LEAST_PUSH * b->plan->beam.EI)) return 0;
  return *push > GROWN * b->pushed && is_straight(system, b);
}

/* The system is linearised once for all wires. */
static sw_status look_at_all(sw_scene *s, int *linear, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  sw_status made = SW_OK;
  for (size_t w = 0; w < system->body_count; w++) {
    size_t edge = 0;
    double push;
    if (!is_new_push(s, w, &push, &edge)) continue;
    system->bodies[w].pushed = push;
    if (!*linear) made = sw_scene_linearise(s, NULL, 0, err);
    *linear = 1;
    if (cannot_be_said(made)) continue;
    SW_TRY(made);
    SW_TRY(look_at(s, w, push, edge));
  }
  return SW_OK;
}

sw_status sw_scene_look_for_buckling(sw_scene *s, sw_error *err) {
  int linear = 0;
  sw_scene_enter(s, 1); /* a force may be a user's function */
  const sw_status status = look_at_all(s, &linear, err);
  sw_scene_enter(s, -1);
  if (linear) sw_system_refresh(sw_scene_system(s));
  return status;
}
