/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rules of which wires touch each other, and read-outs of where they do. */
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "base/tape.h"
#include "body/build.h"
#include "body/touching.h"
#include "edit/edit.h"
#include "scene/lists.h"
#include "scene/lookup.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "state/plan.h"
#include "system/system.h"

static const sw_param rows[] = {
    {"between", SW_PARAM_OTHER, "-", 0, 0, 0, 0, NULL, 0,
     "a wire, an object of particles or a list of these (default: all, also those made later)"},
    {"friction", SW_PARAM_NUMBER, "-", 0.3, 0, 100, 0, NULL,
     offsetof(sw_wire_contact_args, friction), "Coulomb friction coefficient"},
    {"self", SW_PARAM_BOOLEAN, "-", 1, 0, 1, 0, NULL, offsetof(sw_wire_contact_args, self),
     "false: without contact of a wire with itself"},
    {"on", SW_PARAM_BOOLEAN, "-", 1, 0, 1, 0, NULL, offsetof(sw_wire_contact_args, on),
     "false: from now on they pass through each other"},
};
const sw_params sw_wire_contact_params = SW_PARAMS("scene:wire_contact", rows);

sw_status sw_scene_wire_contact(sw_scene *s, const sw_wire_contact_args *args,
                                const sw_handle *wires, size_t count, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  for (size_t k = 0; k < count; k++)
    if (!sw_scene_find_body(s, wires[k], err)) return SW_EDEAD;
  SW_TRY(sw_scene_unbuild(s));
  uint32_t *slots = sw_alloc(count, sizeof *slots);
  if (!slots || SW_GROW(sw_scene_rules_of(s)->list, sw_scene_rules_of(s)->capacity,
                        sw_scene_rules_of(s)->count + 1) != SW_OK) {
    sw_free(slots);
    return sw_fail(err, SW_ENOMEM, "scene:wire_contact: out of memory");
  }
  for (size_t k = 0; k < count; k++) slots[k] = wires[k].slot;
  sw_scene_rules_of(s)->list[sw_scene_rules_of(s)->count++] =
      (sw_scene_rule){.wires = slots,
                      .count = count,
                      .self = args->self,
                      .rule = {.on = args->on, .friction = args->friction}};
  return SW_OK;
}

void sw_scene_drop_rules(sw_scene *s, size_t keep) {
  sw_rules *rules = sw_scene_rules_of(s);
  while (rules->count > keep) sw_free(rules->list[--rules->count].wires);
}

sw_status sw_scene_wire_touch_count(sw_scene *s, size_t *count, sw_error *err) {
  SW_TRY(sw_scene_readable(s, err));
  SW_TRY(sw_scene_still(s, err));
  *count = sw_scene_is_built(s) ? sw_scene_places(s) : 0;
  return SW_OK;
}

/* Returns the place of a touch on a body, and its arc length; for a particle its place along the
 * object. */
static sw_vec touched_at(const sw_scene *s, const sw_pair_place *p, int k, double *arc) {
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[p->body[k]];
  const size_t i = p->node[k] - b->first_node;
  *arc = sw_plan_place(b->plan, i);
  if (i < b->plan->edges) *arc += p->at[k] * b->plan->rest[i]; /* of a wire */
  return sw_lerp(sw_vec_at(system->x, p->node[k]), sw_vec_at(system->x, p->end[k]), p->at[k]);
}

static double touching_radius(const sw_scene *s, const sw_pair_place *p, int k) {
  const sw_body *b = &sw_scene_system(s)->bodies[p->body[k]];
  return sw_plan_skin(b->plan, p->node[k] - b->first_node);
}

/* Puts an object of particles before a wire, whichever of them has the edge there. */
static sw_pair_place loose_first(const sw_scene *s, sw_pair_place p) {
  if (sw_scene_system(s)->bodies[p.body[0]].plan->web ||
      !sw_scene_system(s)->bodies[p.body[1]].plan->web)
    return p;
  return (sw_pair_place){.body = {p.body[1], p.body[0]},
                         .node = {p.node[1], p.node[0]},
                         .end = {p.end[1], p.end[0]},
                         .at = {p.at[1], p.at[0]},
                         .normal = sw_neg(p.normal),
                         .normal_force = p.normal_force,
                         .friction = sw_neg(p.friction),
                         .gap = p.gap};
}

int sw_scene_next_touch(sw_scene *s, size_t next[2], sw_wire_touch *out) {
  sw_pair_place p;
  sw_vec at[2];
  if (!sw_scene_is_built(s) || !sw_scene_next_place(s, SIZE_MAX, next, &p)) return 0;
  p = loose_first(s, p);
  for (int k = 0; k < 2; k++) {
    at[k] = touched_at(s, &p, k, &out->s[k]);
    memcpy(out->wire[k], sw_scene_wire_in(s, p.body[k])->name, SW_NAME_SIZE);
  }
  const double r1 = touching_radius(s, &p, 0), r2 = touching_radius(s, &p, 1);
  out->point = sw_lerp(at[1], at[0], r2 / (r1 + r2));
  out->normal = p.normal;
  out->force = sw_madd(p.friction, p.normal, p.normal_force);
  out->normal_force = p.normal_force;
  out->friction = p.friction;
  return 1;
}
