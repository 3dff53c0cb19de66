/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Holds and joins as the built scene sees them, and wires as links see them. */
#include <math.h>

#include "body/hold.h"
#include "body/join.h"
#include "body/spin.h"
#include "link/hold.h"
#include "link/joint.h"
#include "scene/course.h"
#include "scene/ledger.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "state/mesh.h"
#include "system/system.h"

static void reshaped(void *user, size_t wire, size_t node) {
  const sw_scene *s = user;
  sw_scene_unloaded_near(s, wire, sw_scene_system(s)->bodies[wire].plan, node);
}

sw_link_wire sw_scene_link_wire(const sw_scene *s, size_t wire) {
  sw_scene_wire *w = sw_scene_wire_in(s, wire);
  return (sw_link_wire){.name = w->name,
                        .mesh = &w->mesh,
                        .beam = &w->beam,
                        .time = sw_scene_time(s),
                        .system = (sw_system *)sw_scene_system(s),
                        .body = wire,
                        .user = (void *)s,
                        .reshaped = reshaped};
}

void sw_scene_follow_holds(sw_scene *s) {
  sw_books *b = sw_scene_books(s);
  SW_EACH(hold, h, s) {
    if (!h->alive || !h->cls->hold->follow) continue; /* the wire of a released hold may be gone */
    const sw_link_wire w = sw_scene_link_wire(s, h->wire);
    const double before = b->step.to.kinetic;
    if (!h->cls->hold->follow(h, &w)) continue;
    sw_course_jump(sw_scene_course(s));
    b->step.to.kinetic = sw_system_kinetic(sw_scene_system(s), 0);
    b->step.impact += before - b->step.to.kinetic;
  }
}

void sw_scene_take_rails(sw_scene *s, size_t wire) {
  SW_EACH(hold, h, s) {
    if (!h->alive || h->wire != wire || !h->cls->hold->rail) continue;
    const sw_link_wire w = sw_scene_link_wire(s, wire);
    h->cls->hold->undo(h, &w);
  }
}

void sw_scene_undo_holds(sw_scene *s) {
  SW_EACH(hold, h, s) {
    if (!h->alive || !h->cls->hold->undo) continue;
    const sw_link_wire w = sw_scene_link_wire(s, h->wire);
    h->cls->hold->undo(h, &w);
  }
}

sw_hold_way sw_hold_way_of(const sw_scene *s, const sw_hold *h, double t, const double *x) {
  const sw_link_wire w = sw_scene_link_wire(s, h->wire);
  return h->cls->hold->passes(h, &w, t, x);
}

const sw_joint *sw_scene_joined(const sw_scene *s, size_t wire) {
  SW_EACH(join, j, s)
    for (size_t i = 0; j->alive && i < j->count; i++)
      if (j->ends[i].wire == wire) return j;
  return NULL;
}

size_t sw_scene_join_places(const sw_scene *s, size_t wire, double *out) {
  size_t n = 0;
  SW_EACH(join, j, s)
    for (size_t i = 0; j->alive && i < j->count; i++) {
      if (j->ends[i].wire != wire) continue;
      if (out) out[n] = j->ends[i].s;
      n++;
    }
  return n;
}

void sw_scene_joint_wires(const sw_scene *s, const sw_joint *j, sw_link_wire out[SW_JOIN_ENDS]) {
  for (size_t k = 0; k < j->count; k++) {
    const sw_scene_wire *w = sw_scene_wire_in(s, j->ends[k].wire);
    sw_recipe recipe;
    w->cls->recipe(&w->beam, &recipe);
    out[k] = sw_scene_link_wire(s, j->ends[k].wire);
    out[k].bends = recipe.push != 0;
  }
}

/* 1 if spans of the wire's twist end at this joint: of a straight wire, without material frames,
 * that is fixed to others that bend too. */
static int stops_twist(const sw_scene *s, const sw_joint *j, const sw_link_wire *wires, size_t k) {
  const sw_scene_wire *w = sw_scene_wire_in(s, j->ends[k].wire);
  sw_recipe recipe;
  size_t arms = 0;
  w->cls->recipe(&w->beam, &recipe);
  for (size_t i = 0; i < j->count; i++) arms += wires[i].bends && wires[i].beam->EI > 0;
  return wires[k].bends && w->beam.EI > 0 && arms > 1 && recipe.twist && w->beam.GJ > 0 &&
         !w->beam.framed && !w->mesh.rest && w->beam.rest_twist == 0;
}

size_t sw_scene_number_stops(sw_scene *s) {
  sw_link_wire wires[SW_JOIN_ENDS];
  size_t count = sw_scene_living_holds(s);
  SW_EACH(join, j, s) {
    for (size_t k = 0; k < j->count; k++) j->ends[k].stop = 0;
    if (!j->alive || !j->rigid || !isnan(j->slack)) continue;
    sw_scene_joint_wires(s, j, wires);
    for (size_t k = 0; k < j->count; k++)
      if (stops_twist(s, j, wires, k)) j->ends[k].stop = ++count;
  }
  return count;
}

size_t sw_scene_stops(const sw_scene *s, size_t wire, sw_hold_place *out) {
  const sw_mesh *m = &sw_scene_wire_in(s, wire)->mesh;
  size_t n = 0;
  SW_EACH(join, j, s)
    for (size_t k = 0; k < j->count; k++) {
      const sw_joint_end *e = &j->ends[k];
      if (!e->stop || e->wire != wire) continue;
      const double at = m->s[sw_mesh_node(m, e->s)];
      out[n++] =
          (sw_hold_place){.s1 = at, .s2 = at, .clamped = SW_STOPS, .hold = (int)(e->stop - 1)};
    }
  return n;
}

int sw_scene_stop_at(const sw_scene *s, size_t wire, double at) {
  SW_EACH(join, j, s)
    for (size_t k = 0; j->alive && k < j->count; k++)
      if (j->ends[k].stop && j->ends[k].wire == wire && j->ends[k].s == at) return 1;
  return 0;
}

/* Forgets the number of a place that is not in the plan: a hold keeps the wire from turning there.
 */
static void drop_stop(const sw_scene *s, sw_joint_end *e) {
  const sw_plan *p = sw_scene_system(s)->bodies[e->wire].plan;
  for (size_t c = p->clamp_count; c < p->clamp_count + p->stops; c++)
    if ((size_t)p->clamps[c].hold + 1 == e->stop) return;
  e->stop = 0;
}

/* Adds the places of a released join. */
static sw_status add_parted(sw_scene *s, const sw_joint *j) {
  uint32_t nodes[SW_JOIN_ENDS];
  size_t n = 0;
  for (size_t k = 0; k < j->count; k++) {
    const sw_joint_end *e = &j->ends[k];
    if (e->wire == SIZE_MAX || sw_scene_wire_in(s, e->wire)->cls->mesh) continue;
    const sw_link_wire w = sw_scene_link_wire(s, e->wire);
    const double at = sw_mesh_snap(w.mesh, e->asked * w.mesh->scale / e->scale);
    const sw_joint_end here = {.wire = e->wire, .s = at};
    nodes[n++] = sw_joint_node(&here, &w);
  }
  for (size_t k = 1; k < n; k++)
    for (size_t i = 0; i < k; i++)
      SW_TRY(sw_system_add_parted(sw_scene_system(s), nodes[i], nodes[k]));
  return SW_OK;
}

sw_status sw_scene_add_joins(sw_scene *s) {
  sw_link_wire wires[SW_JOIN_ENDS];
  SW_EACH(join, j, s) {
    if (!j->alive && !j->cls->joint->apart) SW_TRY(add_parted(s, j));
    if (!j->alive) continue;
    for (size_t k = 0; k < j->count; k++) drop_stop(s, &j->ends[k]);
    sw_scene_joint_wires(s, j, wires);
    SW_TRY(j->cls->joint->add(j, wires));
  }
  return sw_joins_link(sw_scene_system(s));
}
