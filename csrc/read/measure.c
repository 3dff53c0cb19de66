/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Read-outs of wires and of the whole scene. */
#include <string.h>

#include "body/body.h"
#include "body/build.h"
#include "body/hold.h"
#include "body/touching.h"
#include "read/extremes.h"
#include "read/kept_frames.h"
#include "scene/course.h"
#include "scene/lookup.h"
#include "scene/parts.h"
#include "scene/values.h"
#include "scene/wire.h"
#include "state/clamp.h"
#include "system/join.h"
#include "system/rail.h"
#include "system/system.h"

sw_status sw_scene_wire_length(sw_scene *s, sw_handle h, double *length, sw_error *err) {
  SW_FIND(const sw_scene_wire, w, sw_scene_find_wire(s, h, err));
  *length = w->mesh.s[w->mesh.n - 1] - w->mesh.s[0];
  return SW_OK;
}

sw_status sw_scene_wire_nodes(sw_scene *s, sw_handle h, size_t *nodes, sw_error *err) {
  SW_FIND(const sw_scene_wire, w, sw_scene_find_wire(s, h, err));
  *nodes = w->mesh.n;
  return SW_OK;
}

sw_status sw_scene_wire_particles(sw_scene *s, sw_handle h, size_t *particles, sw_error *err) {
  SW_FIND(const sw_scene_wire, w, sw_scene_find_body(s, h, err));
  *particles = sw_body_state_of(w).points;
  return SW_OK;
}

sw_status sw_scene_wire_particle_copy(sw_scene *s, sw_handle h, double *positions, double *arc,
                                      double *velocities, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  sw_scene_wire *w;
  SW_TRY(sw_scene_open_body(s, h, &w, err));
  const sw_body *b = &system->bodies[h.slot];
  const size_t at = 3 * b->first_node, size = 3 * b->plan->nodes * sizeof(double);
  if (positions) memcpy(positions, system->x + at, size);
  if (velocities) memcpy(velocities, system->v + at, size);
  for (size_t i = 0; arc && i < b->plan->nodes; i++) arc[i] = b->plan->s[i] - b->plan->s[0];
  return SW_OK;
}

sw_status sw_scene_wire_beam(sw_scene *s, sw_handle h, sw_beam *out, sw_error *err) {
  SW_FIND(const sw_scene_wire, w, sw_scene_find_wire(s, h, err));
  *out = w->beam;
  return SW_OK;
}

static sw_status state_at(const sw_scene *s, sw_handle h, const sw_scene_wire *w, double place,
                          sw_point_state *out, sw_error *err) {
  SW_TRY(sw_scene_check_place(w, place, err));
  sw_body_class_of(w)->at(s, w, &sw_scene_system(s)->bodies[h.slot], place + w->mesh.s[0], out);
  return SW_OK;
}

sw_status sw_scene_wire_at(sw_scene *s, sw_handle h, double place, sw_point_state *out,
                           sw_error *err) {
  sw_scene_wire *w;
  SW_TRY(sw_scene_open_wire(s, h, &w, err));
  return state_at(s, h, w, place, out, err);
}

sw_status sw_scene_wire_motion(sw_scene *s, sw_handle h, double place, sw_point_state *out,
                               sw_error *err) {
  sw_scene_wire *w;
  SW_TRY(sw_scene_open_places(s, h, &w, err));
  return state_at(s, h, w, place, out, err);
}

sw_status sw_scene_wire_copy(sw_scene *s, sw_handle h, double *positions, double *arc,
                             double *velocities, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  sw_scene_wire *w;
  SW_TRY(sw_scene_open_wire(s, h, &w, err));
  const sw_body *b = &system->bodies[h.slot];
  const sw_body_class *body = sw_body_class_of(w);
  const size_t at = 3 * b->first_node;
  if (positions) body->middles(b->plan, system->x + at, positions);
  if (velocities) body->middles(b->plan, system->v + at, velocities);
  for (size_t i = 0; arc && i < w->mesh.n; i++) arc[i] = body->arc(w, b->plan, i);
  return SW_OK;
}

sw_status sw_scene_wire_set_velocity(sw_scene *s, sw_handle h, sw_vec v, sw_vec omega, sw_vec about,
                                     sw_error *err) {
  sw_system *system = sw_scene_system(s);
  sw_scene_wire *w;
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_scene_open_body(s, h, &w, err));
  const sw_body *b = &system->bodies[h.slot];
  for (size_t i = 0; i < b->plan->nodes; i++) {
    const sw_vec arm = sw_sub(sw_vec_at(system->x, b->first_node + i), about);
    SW_TRY(sw_scene_check_speed(s, w, sw_norm(sw_add(v, sw_cross(omega, arm))), err));
  }
  for (size_t i = 0; i < b->plan->nodes; i++) {
    const size_t k = 3 * (b->first_node + i);
    if (b->plan->held[i] != SW_FREE) continue;
    const sw_vec arm = sw_sub(sw_load(system->x + k), about);
    sw_store(system->v + k, sw_add(v, sw_cross(omega, arm)));
  }
  sw_rails_launch(system, h.slot, v, omega, about);
  sw_scene_take_rails(s, h.slot);
  sw_system_rate_from_velocity(system, h.slot);
  sw_system_held_from_velocity(system);
  sw_system_forget_turning(system);
  for (size_t e = 0; b->roll_block && e < b->plan->edges; e++)
    system->v[3 * system->nodes + b->first_roll + e] =
        sw_dot(omega, sw_field_tangent(&b->field, e));
  sw_course_jump(sw_scene_course(s));
  return SW_OK;
}

/* Turns arc lengths of the mesh into distances from the wire's present start. */
static void measure_from_start(sw_wire_extremes *e, double start) {
  e->curvature.s -= start;
  e->tension.s -= start;
  e->raw.s -= start;
  e->strain.s -= start;
  e->ovalisation.s -= start;
  e->torsion.s -= start;
  e->folding.s -= start;
}

sw_status sw_scene_wire_extremes(sw_scene *s, sw_handle h, sw_wire_extremes *now,
                                 sw_wire_extremes *run, sw_error *err) {
  sw_scene_wire *w;
  SW_TRY(sw_scene_open_wire(s, h, &w, err));
  sw_scene_wire_now(s, h.slot, now);
  *run = w->extremes;
  sw_scene_keep_extremes(run, now);
  sw_scene_run_tension(s, h.slot, now, run);
  measure_from_start(now, w->mesh.s[0]);
  measure_from_start(run, w->mesh.s[0]);
  return SW_OK;
}

static void add_energy(sw_energy *out, const char *kind, double value) {
  for (size_t i = 0; i < out->count; i++)
    if (strcmp(out->kind[i], kind) == 0) {
      out->value[i] += value;
      return;
    }
  out->kind[out->count] = kind;
  out->value[out->count++] = value;
}

/* Adds the energies of the forces on one body. */
static void add_terms(sw_scene *s, size_t body, sw_energy *out) {
  sw_system *system = sw_scene_system(s);
  sw_system_show(system, body);
  for (size_t k = 0; k < system->bodies[body].term_count; k++) {
    const sw_term *term = &system->bodies[body].terms[k];
    double other;
    const double energy = sw_system_term_energy(system, body, k, &other);
    add_energy(out, term->cls->stores ? term->cls->stores : term->cls->name, energy - other);
    if (other != 0) add_energy(out, term->cls->corrects ? term->cls->corrects : "bend", other);
  }
}

static void collect_energy(sw_scene *s, sw_energy *out) {
  sw_crowd *crowd = sw_scene_crowd(s);
  sw_system *system = sw_scene_system(s);
  out->count = 0;
  add_energy(out, "kinetic", sw_system_kinetic(system, sw_course_lumps(sw_scene_course(s))));
  for (size_t b = 0; b < system->body_count; b++) add_terms(s, b, out);
  out->dissipated = sw_system_dissipated(system, &out->has_dissipated);
  if (sw_scene_has_contact(s)) add_energy(out, "contact", sw_scene_contact_energy(s));
  if (crowd) add_energy(out, "repel", sw_crowd_energy(crowd, system));
  if (system->joins) add_energy(out, "join", sw_joins_energy(system));
}

sw_status sw_scene_energy(sw_scene *s, sw_energy *out, sw_error *err) {
  SW_TRY(sw_scene_readable(s, err));
  SW_TRY(sw_scene_still(s, err));
  SW_TRY(sw_scene_build(s, err));
  SW_TRY(sw_system_place_holds(sw_scene_system(s), sw_scene_time(s), NULL, NULL, NULL, err));
  collect_energy(s, out);
  return SW_OK;
}

sw_status sw_scene_body_energy(sw_scene *s, sw_handle h, sw_energy *out, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  sw_scene_wire *w;
  SW_TRY(sw_scene_still(s, err));
  SW_TRY(sw_scene_open_body(s, h, &w, err));
  *out = (sw_energy){0};
  add_energy(out, "kinetic", sw_body_kinetic(system, h.slot, sw_course_lumps(sw_scene_course(s))));
  add_terms(s, h.slot, out);
  for (size_t k = 0; k < system->bodies[h.slot].term_count; k++) {
    const double *history = system->bodies[h.slot].terms[k].history;
    if (history) out->dissipated += history[0], out->has_dissipated = 1;
  }
  return SW_OK;
}

sw_status sw_scene_penetration(sw_scene *s, double *now, sw_extreme *deepest, sw_error *err) {
  SW_TRY(sw_scene_readable(s, err));
  *now = sw_scene_is_built(s) ? sw_scene_deepest(s, NULL) : 0.0;
  *deepest = *sw_scene_penetrated(s);
  return SW_OK;
}

/* --- frames ------------------------------------------------------------------ */

void sw_scene_frame_energies(sw_scene *s, double out[SW_FRAME_ENERGIES]) {
  sw_energy e;
  collect_energy(s, &e);
  memset(out, 0, SW_FRAME_ENERGIES * sizeof *out);
  for (size_t i = 0; i < e.count; i++) {
    const int kind = strcmp(e.kind[i], "kinetic") == 0   ? 0
                     : strcmp(e.kind[i], "gravity") == 0 ? 2
                                                         : 1;
    out[kind] += e.value[i];
  }
}

size_t sw_scene_touches(sw_scene *s) {
  sw_presses list[SW_SCENE_PRESSES];
  const size_t n = sw_scene_is_built(s) ? sw_scene_presses(s, list) : 0;
  size_t count = 0;
  for (size_t k = 0; k < n; k++) count += sw_presses_count(list[k]);
  return count;
}
