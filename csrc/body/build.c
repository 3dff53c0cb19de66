/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Builds the edited scene into a system that can be advanced, and takes it back. */
#include "body/build.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "base/interrupt.h"
#include "body/body.h"
#include "body/history.h"
#include "body/hold.h"
#include "body/join.h"
#include "body/spin.h"
#include "body/touching.h"
#include "body/twist.h"
#include "link/hold.h"
#include "mutual/through.h"
#include "scene/drive.h"
#include "scene/forces.h"
#include "scene/gripper.h"
#include "scene/obstacle.h"
#include "scene/wire.h"
#include "scene/world.h"
#include "state/mesh.h"

static void drop(sw_scene *s) {
  sw_stepper_free(&s->course.stepper);
  s->course.has_stepper = 0;
  s->course.method = NULL;
  sw_system_free(&s->system);
  sw_contact_free(s->contact);
  s->contact = NULL;
  sw_mutual_free(s->pairs);
  s->pairs = NULL;
  sw_mutual_free(s->grains);
  s->grains = NULL;
  sw_crowd_free(s->crowd);
  s->crowd = NULL;
  SW_FREE_ALL(s->hold_slot, s->hold_loads);
  s->hold_slot = NULL, s->hold_loads = NULL;
  s->built = s->waiting = 0;
}

void sw_scene_forget_contact(sw_scene *s) {
  SW_FREE_ALL(s->kept.memory, s->kept.pairs, s->kept.grains, s->kept.s, s->kept.first, s->kept.now);
  memset(&s->kept, 0, sizeof s->kept);
}

void sw_scene_let_out(sw_scene *s) {
  if (s->kept.memory && !s->kept.fresh) s->kept.fresh = SW_CONTACT_EMERGING;
}

/* Keeps friction anchors and sides for the next system. */
static sw_status keep_contact(sw_scene *s) {
  sw_scene_forget_contact(s);
  if (!sw_scene_has_contact(s)) return SW_OK;
  const void *memory = NULL, *pairs = NULL, *grains = NULL;
  s->kept.fresh = s->contact ? sw_contact_is_fresh(s->contact) : SW_CONTACT_FRESH;
  if (s->contact) memory = sw_contact_memory(s->contact, &s->kept.bytes);
  if (s->pairs) pairs = sw_mutual_memory(s->pairs, &s->kept.pair_bytes);
  if (s->grains) grains = sw_mutual_memory(s->grains, &s->kept.grain_bytes);
  const sw_status status =
      SW_ALLOC_ALL({&s->kept.grains, s->kept.grain_bytes, 1}, {&s->kept.memory, s->kept.bytes, 1},
                   {&s->kept.pairs, s->kept.pair_bytes, 1}, SW_ROOM(s->kept.s, s->system.nodes),
                   SW_ROOM(s->kept.first, s->wire_count + 1), SW_ROOM(s->kept.now, s->wire_count));
  if (status != SW_OK) {
    sw_scene_forget_contact(s);
    return SW_ENOMEM;
  }
  if (memory && s->kept.bytes) memcpy(s->kept.memory, memory, s->kept.bytes);
  if (grains && s->kept.grain_bytes) memcpy(s->kept.grains, grains, s->kept.grain_bytes);
  if (pairs && s->kept.pair_bytes) memcpy(s->kept.pairs, pairs, s->kept.pair_bytes);
  s->kept.wires = s->system.body_count;
  for (size_t w = 0; w < s->system.body_count; w++) {
    const sw_body *b = &s->system.bodies[w];
    memcpy(s->kept.s + b->first_node, b->plan->s, b->plan->nodes * sizeof(double));
    s->kept.first[w] = b->first_node;
    s->kept.now[w] = w;
  }
  s->kept.first[s->kept.wires] = s->system.nodes;
  return SW_OK;
}

sw_status sw_scene_unbuild(sw_scene *s) {
  if (!s->built) return SW_OK;
  sw_scene_undo_holds(s);
  SW_TRY(keep_contact(s));
  SW_TRY(sw_scene_keep_histories(s));
  for (size_t w = 0; w < s->wire_count; w++) SW_TRY(sw_body_class_of(&s->wires[w])->take(s, w));
  SW_TRY(sw_scene_keep_twist(s));
  drop(s);
  sw_course_jump(&s->course);
  return SW_OK;
}

void sw_scene_await_forces(sw_scene *s) {
  if (!s->built) return;
  s->waiting = 1;
  sw_course_jump(&s->course);
}

/* SW_EINTR if the user interrupts, between long parts of building. Restoring a snapshot is not
 * interrupted. */
static sw_status stopped(const sw_scene *s) {
  return sw_interrupted() && !s->restoring ? SW_EINTR : SW_OK;
}

static sw_status new_plans(sw_scene *s, sw_plan **plans) {
  sw_hold_place *places SW_LOCAL = sw_alloc(sw_scene_number_stops(s), sizeof *places);
  if (!places) return SW_ENOMEM;
  for (size_t w = 0; w < s->wire_count; w++) {
    const sw_scene_wire *wire = &s->wires[w];
    size_t n = sw_scene_stops(s, w, places);
    int number = 0;
    SW_EACH(hold, h, s) {
      if (!h->alive) continue;
      if (h->wire == w)
        places[n++] = (sw_hold_place){
            h->s1, h->s2, h->cls->hold->direction, number, {h->give[0], h->give[1]}};
      number++;
    }
    SW_TRY(sw_body_class_of(wire)->plan(s, w, places, n, &plans[w]));
    SW_TRY(stopped(s));
    if (wire->mesh.rest) SW_TRY(sw_scene_unloaded(s, w, plans[w]));
  }
  return SW_OK;
}

static sw_status add_terms(sw_scene *s, size_t w) {
  sw_recipe recipe;
  sw_body *b = &s->system.bodies[w];
  s->wires[w].cls->recipe(&s->wires[w].beam, &recipe);
  for (size_t k = 0; k < recipe.count; k++) {
    const sw_force_class *cls = sw_force_find(recipe.terms[k].force);
    if (cls->applies && !cls->applies(b->plan)) continue;
    SW_TRY(sw_system_add_term(&s->system, w, cls, recipe.terms[k].args, sizeof recipe.terms[k].args,
                              -1));
  }
  b->EA = s->wires[w].beam.EA;
  b->EA_push = recipe.push ? b->EA : 0.0;
  if (recipe.twist && !b->spin_block) SW_TRY(sw_system_enable_twist(&s->system, w));
  for (size_t k = 0; k < s->force_count; k++) {
    const sw_scene_force *f = &s->forces[k];
    double args[SW_FORCE_ARGS_MAX / sizeof(double)];
    if (!f->alive || (f->wire >= 0 && f->wire != (long)w)) continue;
    memcpy(args, f->args, sizeof args);
    if (f->cls->flags & SW_FORCE_AT_PLACE) args[0] *= s->wires[w].mesh.scale / f->scale;
    SW_TRY(sw_system_add_term(&s->system, w, f->cls, args, sizeof args, (int)k));
  }
  return SW_OK;
}

static sw_status put_holds(sw_scene *s, sw_rail *rails) {
  size_t rail_count = 0;
  int number = 0;
  for (size_t k = 0; k < s->hold_count; k++) {
    sw_hold *h = &s->holds[k];
    if (!h->alive) continue;
    const sw_body *b = &s->system.bodies[h->wire];
    h->node = sw_mesh_node(&s->wires[h->wire].mesh, h->s1);
    h->number = (size_t)number;
    for (size_t side = 0; side < 2; side++) {
      const size_t at = 3 * (2 * (size_t)number + side);
      sw_store(s->system.directors + at, h->director[side]);
      sw_store(s->system.normals + at,
               h->give[side].softer > 0 ? h->give[side].axis : h->frame[side].normal);
    }
    sw_held_node node = {.body = h->wire, .hold = number, .slides = sw_hold_passes(h)};
    sw_body_class_of(&s->wires[h->wire])->add_held(b, h, node, &s->system);
    if (h->cls->hold->rail) {
      h->rail = rail_count;
      h->cls->hold->rail(h, &rails[rail_count]);
      rails[rail_count++].held = s->system.held_count - 1;
    }
    s->hold_slot[number++] = (int)k;
  }
  return sw_system_set_rails(&s->system, rails, rail_count);
}

static sw_status add_holds(sw_scene *s, size_t alive) {
  sw_rail *rails SW_LOCAL = NULL;
  SW_TRY(SW_ALLOC_ALL(SW_ROOM(s->hold_slot, alive), SW_ROOM(s->hold_loads, alive),
                      SW_ROOM(rails, alive)));
  return put_holds(s, rails);
}

static sw_pose part_way(const sw_pose *from, const sw_pose *to, double share) {
  const sw_vec turn = sw_quat_log(sw_quat_mul(to->q, sw_quat_conj(from->q)));
  return (sw_pose){sw_lerp(from->p, to->p, share),
                   sw_quat_unit(sw_quat_mul(sw_quat_exp(sw_scale(turn, share)), from->q))};
}

static sw_status place_hold(void *user, int hold, double t, sw_hold_state *out, sw_error *err) {
  sw_scene *s = user;
  sw_motion_state m;
  sw_hold *h = &s->holds[s->hold_slot[hold]];
  SW_TRY(sw_drive_place(s, &h->drive, t, &m, err));
  *out = (sw_hold_state){m.pose, m.v, m.a, m.omega, m.alpha, {0, 0, 0}, 0};
  if (h->cls->hold->place) {
    const sw_link_wire w = sw_scene_link_wire(s, h->wire);
    h->cls->hold->place(h, &w, t, s->system.inner, out);
  }
  if (s->part_from) out->pose = part_way(&s->part_from[hold], &m.pose, s->part);
  return SW_OK;
}

static sw_status place_obstacle(void *user, int o, double t, sw_motion_state *out, sw_error *err) {
  sw_scene *s = user;
  return sw_drive_place(s, &s->obstacles[o].drive, t, out, err);
}

static sw_status add_contact(sw_scene *s) {
  size_t n = 0;
  sw_contact_obstacle *list SW_LOCAL = sw_alloc(s->obstacle_count, sizeof *list);
  if (!list) return SW_ENOMEM;
  for (size_t k = 0; k < s->obstacle_count; k++) {
    const sw_scene_obstacle *o = &s->obstacles[k];
    const double grips = o->drive.tool ? s->tools[o->drive.tool - 1].jaw.force : 0.0;
    if (o->alive && !o->off)
      list[n++] = (sw_contact_obstacle){o->shape, o->friction, o->kinetic, o->restitution,
                                        grips,    (int)k,      0};
  }
  return n ? sw_contact_new(list, n, place_obstacle, s, &s->contact) : SW_OK;
}

/* Takes over strains and their rates. Where rates are not known, they follow from the nodes'
 * velocities. */
static void inherit_strains(sw_scene *s) {
  sw_system_strain_from_state(&s->system);
  for (size_t w = 0; w < s->wire_count; w++) {
    const sw_body *b = &s->system.bodies[w];
    const double *known = sw_body_state_of(&s->wires[w]).rate;
    if (!(b->axial_time > 0)) continue;
    if (known)
      memcpy(s->system.strain_rate + b->first_edge, known, sw_plan_axial(b->plan) * sizeof *known);
    else
      sw_system_rate_from_velocity(&s->system, w);
  }
}

static sw_status fill(sw_scene *s, size_t alive) {
  for (size_t w = 0; w < s->wire_count; w++) {
    const sw_body *b = &s->system.bodies[w];
    const sw_body_state from = sw_body_state_of(&s->wires[w]);
    const size_t at = 3 * b->first_node, size = 3 * b->plan->nodes * sizeof(double);
    const size_t axial = sw_plan_axial(b->plan) * sizeof(double);
    memcpy(s->system.x + at, from.x, size);
    memcpy(s->system.v + at, from.v, size);
    memcpy(s->system.a + at, from.a, size);
    memcpy(s->system.tension + b->first_edge, from.axial, axial);
    SW_TRY(stopped(s));
    SW_TRY(add_terms(s, w));
  }
  SW_TRY(sw_system_add_histories(&s->system));
  inherit_strains(s);
  SW_TRY(add_holds(s, alive));
  SW_TRY(sw_scene_add_joins(s));
  SW_TRY(add_contact(s));
  SW_TRY(sw_scene_new_pairs(s));
  SW_TRY(sw_crowd_new(&s->system, &s->crowd));
  SW_TRY(sw_scene_inherit_contact(s));
  s->system.coupling = (sw_coupling){.user = s, .place = place_hold};
  sw_scene_couple(s);
  return SW_OK;
}

sw_status sw_scene_build(sw_scene *s, sw_error *err) {
  if (s->waiting) SW_TRY(sw_scene_unbuild(s));
  if (!s->built) {
    size_t alive = 0, rails = 0;
    SW_TRY(sw_scene_check_holds(s, err));
    SW_EACH(hold, h, s) {
      alive += h->alive != 0;
      rails += h->alive && h->cls->hold->rail;
    }
    sw_plan **plans = sw_alloc(s->wire_count, sizeof(sw_plan *));
    sw_status status = plans ? new_plans(s, plans) : SW_ENOMEM;
    if (status == SW_OK) status = stopped(s);
    if (status == SW_OK) status = sw_system_new(&s->system, plans, s->wire_count, alive, rails);
    if (status == SW_OK) status = stopped(s);
    if (status == SW_OK) status = fill(s, alive);
    if (status == SW_OK) status = stopped(s);
    for (size_t w = 0; plans && w < s->wire_count; w++) sw_plan_release(plans[w]);
    sw_free(plans);
    if (status != SW_OK) {
      drop(s);
      return sw_fail(err, status, "scene '%s': %s", s->name, sw_status_text(status));
    }
    status = sw_system_place_holds(&s->system, s->time, NULL, NULL, NULL, err);
    if (status != SW_OK) {
      drop(s);
      return status;
    }
    status = sw_through_begin(&s->through, &s->system, s->pairs, s->time);
    if (status != SW_OK) {
      drop(s);
      return sw_fail(err, status, "scene '%s': %s", s->name, sw_status_text(status));
    }
    sw_system_held_from_velocity(&s->system);
    sw_scene_inherit_twist(s);
    sw_scene_frame_in(s);
    s->built = 1;
    s->build = ++s->builds;
    sw_scene_forget_contact(s);
    sw_scene_inherit_histories(s);
    sw_scene_forget_histories(s);
    sw_course_jump(&s->course);
  }
  s->system.gravity[0] = s->gravity.x;
  s->system.gravity[1] = s->gravity.y;
  s->system.gravity[2] = s->gravity.z;
  return SW_OK;
}
