/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds unstable wires that cannot buckle in the simulation. A perfectly straight wire stays
 * straight under any push along it and any torsion, and a wire in a plane stays in the plane:
 * nothing bends it to a side, not even rounding. Real wires buckle, and the run reports this. */
#include <float.h>
#include <math.h>
#include <stdio.h>

#include "body/join.h"
#include "body/spin.h"
#include "body/touching.h"
#include "contact/contact.h"
#include "modal/modal.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/system.h"
#include "watch/across.h"
#include "watch/observe.h"

/* A wire whose tangents differ by at most this is straight [-]. */
static const double STRAIGHT = 1e-9;
/* Push over EI/L^2 below which no wire with a hold buckles: pi^2/4 [-]. */
static const double LEAST_PUSH = 2.467;
/* Growth rates below this are ignored, over sqrt(g/L) [-]. */
static const double SLOWEST = 1.0 / 30.0;
/* A wire is checked again when its push has grown by this factor [-]. */
static const double GROWN = 1.2;

/* Push from rounding of places, in units in the last place of their coordinates per edge [-]. */
static const double ROUNDED = 16.0;

/* Returns a push that rounding may have made; in a long wire it may exceed the buckling push
 * [N]. */
static double rounding_of(const sw_system *system, const sw_body *b) {
  const double *x = system->x + 3 * b->first_node;
  const sw_beam *beam = &b->plan->beam;
  const size_t last = b->plan->nodes - 1;
  const double far = fmax(sw_norm(sw_vec_at(x, 0)), sw_norm(sw_vec_at(x, last)));
  const double edge = b->plan->length / (double)b->plan->edges;
  return ROUNDED * DBL_EPSILON * (far + b->plan->length) / edge * beam->EA;
}

/* Torsion M bends a wire as a push of M^2/(4 EI) does: a long rod is stable if its tension is
 * larger (Greenhill). */
typedef struct load {
  double push;   /* largest in an edge; below 0: all are taut [N] */
  double moment; /* largest torsion [N m] */
  double both;   /* push that bends as both do [N] */
  size_t edge;   /* of the largest push */
} load;

static load load_of(const sw_system *system, const sw_body *b) {
  load l = {.push = -HUGE_VAL};
  sw_extreme torsion = {0};
  for (size_t e = 0; e < b->plan->edges; e++)
    if (-system->tension[b->first_edge + e] > l.push)
      l.push = -system->tension[b->first_edge + e], l.edge = e;
  if (b->plan->beam.GJ > 0 && b->plan->beam.EI > 0) sw_scene_torsion(system, b, &torsion);
  l.moment = torsion.value * b->plan->beam.GJ;
  l.both = l.push;
  if (l.moment > 0) l.both += l.moment * l.moment / (4 * b->plan->beam.EI);
  return l;
}

/* Tangents of a wire in a plane are out of the plane by at most this [-]. Rounding in a rotated
 * scene bends a wire less than this before it starts to fall. */
static const double IN_PLANE = 1e-6;
/* A wire in a plane is checked only when slower than this, over sqrt(g L) [-]. A faster one may be
 * elsewhere before it buckles. */
static const double SLOW = 0.01;
/* Growth of a bend, as a logarithm, that friction of a wire at rest must hold: to a hundredth of
 * the length. Cables that a hand pushed onto a peg were that far aside when they slid off it, or
 * less (spec/scene/arched_peg_spec) [-]. */
static const double LIKELY = 2.3;
/* A wire that is bent by less is nearly straight, see watch/unbent.c [-]. */
static const double BENT = 0.02;
/* A motion goes across the plane if at least this share of its squared shifts does [-]. By symmetry
 * either all of it does or none. */
static const double ACROSS = 0.5;

static sw_vec tangent_at(const sw_system *system, const sw_body *b, size_t e) {
  const double *x = system->x + 3 * b->first_node;
  return sw_unit_or(sw_sub(sw_vec_at(x, e + 1), sw_vec_at(x, e)), sw_v(1, 0, 0));
}

static int is_straight(const sw_system *system, const sw_body *b) {
  for (size_t e = 1; e < b->plan->edges; e++)
    if (!(sw_dist(tangent_at(system, b, e), tangent_at(system, b, e - 1)) <= STRAIGHT)) return 0;
  return 1;
}

static double gravity_of(const sw_scene *s) { return fmax(sw_norm(sw_scene_gravity(s)), 1.0); }

static int is_slow(const sw_scene *s, const sw_system *system, const sw_body *b) {
  const double most = SLOW * sqrt(gravity_of(s) * b->plan->length);
  for (size_t i = b->first_node; i < b->first_node + b->plan->nodes; i++)
    if (!(sw_norm2(sw_vec_at(system->v, i)) <= most * most)) return 0;
  return 1;
}

int sw_scene_lies_in_plane(const sw_system *system, const sw_body *b, double bent, sw_vec *normal) {
  const sw_vec first = tangent_at(system, b, 0);
  sw_vec n = {0};
  for (size_t e = 1; e < b->plan->edges; e++) {
    const sw_vec turn = sw_cross(first, tangent_at(system, b, e));
    if (sw_norm2(turn) > sw_norm2(n)) n = turn;
  }
  *normal = sw_unit_or(n, sw_v(0, 0, 0));
  if (!(sw_norm2(n) > bent * bent)) return 0;
  n = *normal;
  for (size_t e = 0; e < b->plan->edges; e++)
    if (!(fabs(sw_dot(tangent_at(system, b, e), n)) <= IN_PLANE)) return 0;
  return 1;
}

/* Share of a motion's squared shifts that goes along a direction [-]. */
static double share_along(const sw_modes *modes, size_t k, size_t nodes, sw_vec normal) {
  const size_t width = modes->unknowns / nodes;
  double across = 0, all = 0;
  for (size_t i = 0; i < nodes; i++) {
    const sw_vec x = sw_load(modes->shapes + k * modes->unknowns + i * width);
    across += sw_dot(x, normal) * sw_dot(x, normal), all += sw_norm2(x);
  }
  return all > 0 ? across / all : 0;
}

sw_status sw_scene_unstable_across(const sw_scene *s, size_t w, const sw_across *of, size_t *count,
                                   double *rate) {
  const sw_system *system = sw_scene_system(s);
  sw_modes modes;
  sw_error ignored;
  *count = 0, *rate = 0;
  SW_TRY(sw_modal_solve(system, w, 0, of->slow, NULL, &modes, &ignored));
  for (size_t k = 0; k < modes.unstable; k++) {
    if (!(share_along(&modes, k, system->bodies[w].plan->nodes, of->normal) > ACROSS)) continue;
    if (of->slips && !sw_scene_overcomes(s, w, &modes, k, of->growth)) continue;
    const double rate2 = -modes.omega2[k] - sw_scene_drawn_back(s, w, &modes, k);
    if (!(rate2 > of->slow)) continue;
    *count += 1;
    *rate = fmax(*rate, sqrt(rate2));
  }
  sw_modes_free(&modes);
  return SW_OK;
}

static int cannot_be_said(sw_status status) {
  return status == SW_EDIVERGED || status == SW_EINVAL || status == SW_ENOCONV;
}

/* Writes what bends the wire: its push, or its torsion if that does more. Returns the value. */
static double name_load(const load *l, char *out, size_t size) {
  const int twisted = l->both > 2 * l->push;
  const double value = twisted ? l->moment : l->push;
  snprintf(out, size, twisted ? "torsion of %.3g N m" : "push of %.3g N", value);
  return value;
}

static void tell(sw_scene *s, size_t w, const load *l, size_t count, int slips) {
  const sw_body *b = &sw_scene_system(s)->bodies[w];
  const char *name = sw_scene_wire_in(s, w)->name;
  const double at = b->plan->s[l->edge] - b->plan->s[0];
  char text[48];
  const double value = name_load(l, text, sizeof text);
  if (slips)
    sw_scene_tell(
        s, "buckling", name, at, value,
        "wire '%s' stays in a plane under a %s, held in it by friction only: a "
        "real wire may slide off to a side; draw it bent out of the plane by a thousandth "
        "of its length",
        name, text);
  else if (!count)
    sw_scene_tell(s, "buckling", name, at, value,
                  "wire '%s' stays in a plane under a %s, but is unstable across it: a "
                  "real wire would fall to a side; draw it bent out of the plane by a thousandth "
                  "of its length, or add a small force across it",
                  name, text);
  else
    sw_scene_tell(s, "buckling", name, at, value,
                  "wire '%s' stays straight under a %s, but is unstable in %zu "
                  "direction%s: a real wire would buckle; draw it bent by a thousandth of its "
                  "length, or add a small force across it",
                  name, text, count, count == 1 ? "" : "s");
}

/* Checks a wire of the linearised system. normal: of the plane in which the wire lies; zero: it is
 * straight. slips: its touches slide, unless friction holds a real wire's bend. */
static sw_status look_at(sw_scene *s, size_t w, const load *l, sw_vec normal, int slips) {
  sw_system *system = sw_scene_system(s);
  const double rate = SLOWEST * sqrt(gravity_of(s) / system->bodies[w].plan->length);
  const sw_across of = {normal, rate * rate, slips, fmin(LIKELY, system->bodies[w].arched.growth)};
  const int flat = sw_norm2(normal) > 0;
  size_t count = 0;
  double fastest;
  sw_status status = sw_modal_unstable(system, w, rate * rate, &count);
  if (status == SW_OK && flat && count > 0)
    status = sw_scene_unstable_across(s, w, &of, &count, &fastest);
  if (cannot_be_said(status)) return SW_OK;
  if (status != SW_OK || count == 0) return status;
  system->bodies[w].pushed = HUGE_VAL;
  tell(s, w, l, flat ? 0 : count, slips);
  return SW_OK;
}

/* 1 if the wire is straight or in a plane, and pushed or twisted by enough more than at its last
 * check. */
static int is_new_load(const sw_scene *s, size_t w, load *l, sw_vec *normal) {
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[w];
  if (b->plan->web || sw_scene_joined(s, w)) return 0;
  *l = load_of(system, b);
  if (!(l->both * b->plan->length * b->plan->length > LEAST_PUSH * b->plan->beam.EI)) return 0;
  if (!(l->both > rounding_of(system, b))) return 0;
  *normal = sw_v(0, 0, 0);
  return l->both > GROWN * b->pushed &&
         (is_straight(system, b) ||
          (is_slow(s, system, b) && sw_scene_lies_in_plane(system, b, 0, normal)));
}

/* How the system is linearised. */
enum { NOT, STICKING, SLIPPING };

/* Linearises the system, if it is not linear in this way. *can: 0: it cannot be. */
static sw_status make(sw_scene *s, int how, int *linear, int *can, sw_error *err) {
  if (*linear != how) {
    const sw_status made =
        how == SLIPPING ? sw_scene_linearise_slipping(s, err) : sw_scene_linearise(s, NULL, 0, err);
    *linear = how, *can = !cannot_be_said(made);
    if (*can) return made;
  }
  return SW_OK;
}

/* 1 if obstacles touch the wire and it is bent in a plane. watch/unbent.c tells of friction on
 * wires that are nearly straight. */
static int may_slip(const sw_scene *s, const sw_body *b) {
  size_t first, end;
  sw_vec normal;
  if (!sw_scene_contact(s) || !sw_scene_lies_in_plane(sw_scene_system(s), b, BENT, &normal))
    return 0;
  sw_contact_touches_of(sw_scene_contact(s), b->first_node, b->first_node + b->plan->nodes, &first,
                        &end);
  return end > first;
}

/* Checks all wires. The system is linearised once for all of them. A wire in a plane that touches
 * hold is checked with friction that a real wire's bend overcomes, too. */
static sw_status look_at_all(sw_scene *s, int *linear, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  int can = 1;
  for (size_t w = 0; w < system->body_count; w++) {
    load l;
    sw_vec normal;
    sw_body *b = &system->bodies[w];
    if (!is_new_load(s, w, &l, &normal)) continue;
    b->pushed = l.both;
    for (int how = STICKING; how <= SLIPPING && b->pushed < HUGE_VAL; how++) {
      if (how == SLIPPING && !may_slip(s, b)) continue;
      SW_TRY(make(s, how, linear, &can, err));
      if (can) SW_TRY(look_at(s, w, &l, normal, how == SLIPPING));
    }
  }
  return SW_OK;
}

sw_status sw_scene_look_for_buckling(sw_scene *s, sw_error *err) {
  int linear = NOT;
  sw_scene_enter(s, 1); /* a force may be a user's function */
  const sw_status status = look_at_all(s, &linear, err);
  sw_scene_enter(s, -1);
  if (linear) sw_system_refresh(sw_scene_system(s));
  return status;
}
