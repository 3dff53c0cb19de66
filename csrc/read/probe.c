/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Evaluates all forces of one class on one wire, at the present state or at given positions and
 * velocities: energy, node forces, and stiffness times a direction. For specs and for
 * inspection. */
#include "body/build.h"
#include "read/reading.h"
#include "scene/lookup.h"
#include "scene/parts.h"
#include "scene/review.h"

/* Copies the node forces that the terms have left in the field. */
static void gather_force(const sw_field *f, double *out) {
  for (size_t i = 0; i < f->plan->nodes; i++)
    for (size_t k = 0; k < 3; k++) out[3 * i + k] = sw_field_force(f, i, k);
}

static sw_status add_terms(const sw_body *b, const sw_force_class *cls, sw_field *f,
                           sw_probe_result *out, sw_error *err) {
  out->terms = 0;
  for (size_t k = 0; k < b->term_count; k++) {
    if (b->terms[k].cls != cls) continue;
    SW_TRY(sw_term_eval(&b->terms[k], f, err));
    out->terms++;
  }
  return SW_OK;
}

static void aim(sw_scene *s, sw_body *b, const sw_probe *at) {
  sw_system *system = sw_scene_system(s);
  sw_field *f = &b->field;
  f->want = SW_WANT_FORCE | SW_WANT_ENERGY | (at->direction ? SW_WANT_STIFFNESS : 0);
  f->time = sw_scene_time(s);
  f->velocity_rate = at->rate;
  f->statics = at->statics;
  f->tension = NULL; /* from positions and velocities, not the solver's own unknowns */
  sw_body_aim(system, b, at->positions ? at->positions : system->x + 3 * b->first_node,
              at->velocities ? at->velocities : system->v + 3 * b->first_node);
  f->cautious = 0;
  sw_body_begin(b);
  if (b->spin_block) {
    sw_system_begin_step(system);
    sw_system_measure(system, b);
  }
}

sw_status sw_scene_probe(sw_scene *s, sw_handle wire, const sw_force_class *cls, const sw_probe *at,
                         sw_probe_result *out, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  SW_TRY(sw_scene_measurable(s, err));
  if (!sw_scene_find_body(s, wire, err)) return SW_EDEAD;
  SW_TRY(sw_scene_build(s, err));
  SW_TRY(sw_system_place_holds(system, sw_scene_time(s), NULL, NULL, NULL, err));
  sw_body *b = &system->bodies[wire.slot];
  aim(s, b, at);
  sw_scene_enter(s, 1); /* the force may be a user's function */
  const sw_status status = add_terms(b, cls, &b->field, out, err);
  sw_scene_enter(s, -1);
  out->energy = b->field.energy;
  if (out->force) gather_force(&b->field, out->force);
  if (at->direction && out->product) sw_body_stiffness_times(b, at->direction, out->product);
  sw_system_refresh(system);
  return status;
}
