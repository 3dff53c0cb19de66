/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Natural frequencies of a wire about the present equilibrium. */
#include <math.h>
#include <string.h>

#include "body/build.h"
#include "body/join.h"
#include "body/touching.h"
#include "link/joint.h"
#include "modal/modal.h"
#include "read/reading.h"
#include "scene/lookup.h"
#include "scene/parts.h"
#include "scene/review.h"
#include "system/linear.h"
#include "system/system.h"

static const sw_param rows[] = {
    {"modes", SW_PARAM_INTEGER, "-", 6, 1, 200, 0, NULL, offsetof(sw_modes_args, modes),
     "number of frequencies, from the lowest"},
    {"shapes", SW_PARAM_BOOLEAN, "-", 0, 0, 1, 0, NULL, offsetof(sw_modes_args, shapes),
     "true: add mode shapes, as flat node displacements of unit modal mass"},
    {"tolerance", SW_PARAM_NUMBER, "-", 1e-4, 0, 1e9, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(sw_modes_args, tolerance),
     "allowed distance from rest, as a share of the wire's length"},
    {"alone", SW_PARAM_BOOLEAN, "-", 0, 0, 1, 0, NULL, offsetof(sw_modes_args, alone),
     "true: frequencies of this wire alone, with the wires joined to it fixed; together they are "
     "lower"},
};
const sw_params sw_modes_params = SW_PARAMS("wire:frequencies", rows);

/* Unbalanced forces count by how far they would move the wire in this time, over sqrt(length/g)
 * [-]. */
static const double PATIENCE = 3.0;
/* Motions that take longer than this to grow are neutral, as in settling; over sqrt(length/g)
 * [-]. */
static const double SLOWEST_GROWTH = 30.0;
/* Axial forces may be off by this multiple of the tolerance [-]. */
static const double FORCE_SHARE = 100.0;
static const double TWO_PI = 6.283185307179586477;

/* Returns sqrt(length/g). In weightless scenes any scale will do, so g is at least 1 m/s2. */
static double time_scale(const sw_scene *s, size_t w) {
  return sqrt(sw_scene_system(s)->bodies[w].plan->length / fmax(sw_norm(sw_scene_gravity(s)), 1.0));
}

/* Finds the largest speed of a node, and the largest distance of nodes from their holds' present
 * places. */
static sw_status look_at_nodes(sw_scene *s, size_t w, double *speed, double *away, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[w];
  memcpy(system->yhat, system->x, 3 * system->nodes * sizeof(double));
  memcpy(system->velocity, system->v, 3 * system->nodes * sizeof(double));
  SW_TRY(
      sw_system_place_holds(system, sw_scene_time(s), system->yhat, system->velocity, NULL, err));
  *speed = *away = 0;
  for (size_t i = 3 * b->first_node; i < 3 * (b->first_node + b->plan->nodes); i += 3) {
    *speed = fmax(*speed, sw_norm(sw_load(system->velocity + i)));
    *away = fmax(*away, sw_dist(sw_load(system->yhat + i), sw_load(system->x + i)));
  }
  for (size_t e = 0; b->roll_block && e < b->plan->edges; e++)
    *speed =
        fmax(*speed, b->plan->beam.radius * fabs(system->v[3 * system->nodes + b->first_roll + e]));
  return SW_OK;
}

static sw_status check_rest(sw_scene *s, size_t w, double tolerance, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  static const char advice[] = "frequencies are about an equilibrium: call scene:settle() first";
  const char *name = sw_scene_wire_in(s, w)->name;
  const double most = tolerance * system->bodies[w].plan->length, tau = time_scale(s, w);
  double drift, axial, speed, away;
  SW_TRY(look_at_nodes(s, w, &speed, &away, err));
  if (!(speed * tau <= most))
    return sw_fail(err, SW_EINVAL, "wire '%s' moves at up to %.3g m/s; %s", name, speed, advice);
  if (!(away <= most))
    return sw_fail(err, SW_EINVAL,
                   "wire '%s' is not at rest: a hold of it has moved %.3g m away; %s", name, away,
                   advice);
  SW_TRY(sw_modal_unrest(system, w, PATIENCE * tau, &drift, &axial, err));
  if (!(drift <= most))
    return sw_fail(err, SW_EINVAL,
                   "wire '%s' is not at rest: its forces would move it by about %.3g m; %s", name,
                   drift, advice);
  if (!(axial <= FORCE_SHARE * tolerance))
    return sw_fail(err, SW_EINVAL,
                   "wire '%s' is not at rest: its tension will still change by a share of %.3g; %s",
                   name, axial, advice);
  return SW_OK;
}

static sw_status check_joins(const sw_scene *s, size_t w, int alone, sw_error *err) {
  SW_EACH(hold, h, s)
    if (h->alive && h->wire == w && h->cls->hold->rail)
      return sw_fail(
          err, SW_EINVAL,
          "frequencies: wire '%s' slides along '%s'; frequencies are for wires without sliders",
          sw_scene_wire_in(s, w)->name, h->name);
  const sw_joint *join = sw_scene_joined(s, w);
  if (!join || alone) return SW_OK; /* its own stiffness includes that of joins, without bridges */
  return sw_fail(err, SW_EINVAL,
                 "frequencies: wire '%s' is joined to others by '%s' and moves with them; give "
                 "alone = true for the frequencies of this wire with the others fixed",
                 sw_scene_wire_in(s, w)->name, join->name);
}

static void hand_over(const sw_scene *s, size_t w, const sw_modes *m, size_t wanted,
                      sw_modes_result *out) {
  sw_system *system = sw_scene_system(s);
  const size_t n = 3 * system->bodies[w].plan->nodes;
  out->unstable = m->unstable;
  out->growth = m->unstable ? sqrt(-m->omega2[0]) : 0.0;
  for (size_t i = m->unstable; i < m->count && out->count < wanted; i++, out->count++) {
    out->frequencies[out->count] = sqrt(m->omega2[i]) / TWO_PI;
    if (out->shapes)
      sw_system_shifts(system, w, m->shapes + i * m->unknowns, out->shapes + out->count * n);
  }
}

static sw_status find(sw_scene *s, size_t w, const sw_modes_args *args, int (*interrupted)(void),
                      sw_modes_result *out, sw_error *err) {
  sw_modes modes;
  sw_error why = {""};
  SW_TRY(sw_scene_check_line(sw_scene_wire_in(s, w), "frequencies", err));
  SW_TRY(check_joins(s, w, args->alone, err));
  SW_TRY(sw_scene_linearise(s, NULL, 0, err));
  SW_TRY(check_rest(s, w, args->tolerance, err));
  const double rate = 1.0 / (SLOWEST_GROWTH * time_scale(s, w));
  const sw_status status = sw_modal_solve(sw_scene_system(s), w, (size_t)args->modes, rate * rate,
                                          interrupted, &modes, &why);
  if (status == SW_OK) hand_over(s, w, &modes, (size_t)args->modes, out);
  sw_modes_free(&modes);
  return status == SW_OK ? status
                         : sw_fail(err, status, "wire '%s': %.400s", sw_scene_wire_in(s, w)->name,
                                   why.text[0] ? why.text : sw_status_text(status));
}

sw_status sw_scene_wire_modes(sw_scene *s, sw_handle wire, const sw_modes_args *args,
                              int (*interrupted)(void), sw_modes_result *out, sw_error *err) {
  out->count = out->unstable = 0;
  out->growth = 0;
  SW_TRY(sw_scene_measurable(s, err));
  if (!sw_scene_find_wire(s, wire, err)) return SW_EDEAD;
  SW_TRY(sw_scene_build(s, err));
  sw_scene_enter(s, 1); /* a force may be a user's function */
  const sw_status status = find(s, wire.slot, args, interrupted, out, err);
  sw_scene_enter(s, -1);
  sw_system_refresh(sw_scene_system(s));
  return status;
}
