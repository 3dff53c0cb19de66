/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks a scene read from a file. Objects name each other by numbers. Whatever the file says, no
 * number may lead to an object that does not exist. */
#include <stdint.h>
#include <string.h>

#include "base/alloc.h"
#include "body/hold.h"
#include "body/touching.h"
#include "edit/edit.h"
#include "edit/leave.h"
#include "grip/frozen.h"
#include "link/joint.h"
#include "save/save.h"
#include "scene/forces.h"
#include "scene/gripper.h"
#include "scene/values.h"
#include "scene/wire.h"
#include "scene/world.h"
#include "strand/ring.h"

static int is_node(const sw_mesh *m, double s) { return m->s[sw_mesh_node(m, s)] == s; }

static void check_strand(sw_tape *t, const sw_scene_wire *w) {
  const sw_web *web = w->strand.web;
  const int loose = w->cls == sw_scene_body_class("particles");
  sw_tape_expect(t, !w->mesh.rest && loose == !web->per_ring, "a mesh");
  sw_tape_expect(t, loose ? w->mesh.n == 3 : w->mesh.n == web->rings, "the rings of a mesh");
  sw_tape_expect(t, !w->beam.rolls, "a mesh that rolls as rods do");
  sw_tape_expect(t, loose || w->strand.calibrated, "a mesh without calibration");
  sw_tape_expect(t, web->around_count <= SW_OUTLINE && web->skin > 0, "the surface of a mesh");
}

static void check_wire(sw_tape *t, const sw_scene *s, size_t number) {
  const sw_scene_wire *w = &s->wires[number];
  sw_tape_expect(t, (w->strand.web != NULL) == (w->cls->mesh != NULL), "a mesh");
  sw_tape_expect(t, w->beam.mass > 0 && w->beam.radius > 0, "a wire's values");
  const double all = w->beam.EA + w->beam.EI + w->beam.GJ + w->beam.mass + w->beam.radius +
                     w->beam.EI_axis[0] + w->beam.EI_axis[1] + w->beam.spin_inertia;
  sw_tape_expect(t, isfinite(all), "a wire's values");
  if (!sw_tape_good(t)) return;
  if (w->strand.web) {
    check_strand(t, w);
  } else {
    sw_tape_expect(t, (w->mesh.rest != NULL) == (w->beam.framed != 0), "a wire's frames");
    sw_tape_expect(t, w->beam.framed || !(w->beam.rolls || w->beam.curved), "a wire's frames");
    sw_tape_expect(t, !w->beam.framed || w->cls == sw_wire_find("rod"), "a wire's frames");
    sw_tape_expect(t, w->drawing.count >= 2, "a wire without its drawing");
  }
  for (size_t k = 0; k < w->twisted_count; k++)
    sw_tape_expect(t, isfinite(w->twisted[k].s1 + w->twisted[k].s2 + w->twisted[k].twist),
                   "a wire's twist");
  if (sw_tape_good(t) && sw_scene_check_rules(s, number, w, NULL) != SW_OK)
    sw_tape_damaged(t, "a force on a wire that it does not go with");
}

/* --- holds ------------------------------------------------------------------------- */

/* Checks that no particle of a mesh is held twice, and that all held ones exist. */
static void check_particles(sw_tape *t, const sw_scene *s, size_t wire) {
  const sw_web *web = s->wires[wire].strand.web;
  unsigned char *taken SW_LOCAL = sw_alloc(web->particles, 1);
  if (!taken) sw_tape_fail(t, SW_ENOMEM);
  for (size_t k = 0; k < s->hold_count && sw_tape_good(t); k++) {
    const sw_hold *h = &s->holds[k];
    if (!h->alive || h->wire != wire) continue;
    sw_tape_expect(t, h->particle && !h->cls->hold->lines, "a clamp on a mesh");
    for (size_t i = 0; taken && h->particle && i < h->count && sw_tape_good(t); i++)
      sw_tape_expect(t, h->particle[i] < web->particles && !taken[h->particle[i]]++,
                     "a clamp's particles");
  }
}

static void check_crash(sw_tape *t, const sw_scene *s, const sw_hold *h) {
  const int fine = !(h->watch.crash.depth > 0) || h->watch.crash.obstacle < s->obstacle_count;
  sw_tape_expect(t, fine && isfinite(h->watch.looked), "what a clamp ran into");
}

static void check_places(sw_tape *t, const sw_scene *s, const sw_hold *h) {
  const sw_scene_wire *w = &s->wires[h->wire];
  sw_tape_expect(t, h->s1 <= h->s2 && is_node(&w->mesh, h->s1) && is_node(&w->mesh, h->s2),
                 "where a clamp is");
  for (size_t i = 0; i + 1 < h->count; i++)
    sw_tape_expect(t, h->s[i] < h->s[i + 1], "where a clamp is");
  for (const sw_hold *o = s->holds; o < h; o++)
    if (o->alive && o->wire == h->wire)
      sw_tape_expect(t, o->s2 < h->s1 || h->s2 < o->s1, "two clamps at one place");
  const sw_link_wire on = sw_scene_link_wire(s, h->wire);
  const int fits = !h->cls->hold->fits || h->cls->hold->fits(h, &on);
  sw_tape_expect(t, fits, "what a clamp is like");
}

static void check_hold(sw_tape *t, const sw_scene *s, const sw_hold *h) {
  const int of_none = !h->alive && h->wire == SIZE_MAX;
  sw_tape_expect(t, (h->wire < s->wire_count || of_none) && h->log.count % SW_LOG_SIZE == 0,
                 "a clamp");
  if (!sw_tape_good(t) || !h->alive) return;
  sw_tape_expect(t, h->count > 0 && h->scale > 0, "a clamp that holds nothing");
  check_crash(t, s, h);
  sw_tape_finite(t, h->s, h->count, "where a clamp is");
  sw_tape_finite(t, h->local, 3 * h->count, "where a clamp is");
  const sw_vec sum = sw_add(h->director[0], h->director[1]);
  sw_tape_expect(t, sw_finite(sum), "where a clamp points");
  if (sw_tape_good(t) && !s->wires[h->wire].strand.web) check_places(t, s, h);
}

/* --- all else ---------------------------------------------------------------------- */

static void check_join(sw_tape *t, const sw_scene *s, const sw_joint *j) {
  for (size_t k = 0; k < j->count && sw_tape_good(t); k++) {
    const sw_joint_end *e = &j->ends[k];
    const int of_none = !j->alive && e->wire == SIZE_MAX;
    sw_tape_expect(t, (e->wire < s->wire_count || of_none) && e->scale > 0, "a join");
    if (!sw_tape_good(t) || !j->alive) continue;
    const sw_scene_wire *w = &s->wires[e->wire];
    sw_tape_expect(t, !w->cls->mesh && is_node(&w->mesh, e->s), "the place of a join");
    sw_tape_expect(t, isfinite(e->asked + e->scale) && sw_finite(sw_add(e->offset, e->rest)),
                   "a join");
  }
}

static void check_force(sw_tape *t, const sw_scene *s, const sw_scene_force *f) {
  sw_tape_expect(t, f->wire >= -1 && f->wire < (long)s->wire_count, "a force");
  if (!sw_tape_good(t) || !f->alive) return;
  const int at_place = (f->cls->flags & SW_FORCE_AT_PLACE) != 0;
  const int some = (f->cls->flags & SW_FORCE_ON_SOME) != 0;
  sw_tape_expect(t, f->wire >= 0 || !(at_place || some), "a force without its wire");
  sw_tape_expect(t, !at_place || isfinite(f->args[0]), "the place of a force");
  if (!some || !sw_tape_good(t)) return;
  sw_force_some list;
  memcpy(&list, f->args, sizeof list);
  const sw_web *web = s->wires[f->wire].strand.web;
  sw_tape_expect(t, web && list.count > 0, "a force on particles");
  for (size_t i = 0; web && i < list.count && sw_tape_good(t); i++)
    sw_tape_expect(t, list.particle[i] < web->particles, "a force on particles");
}

/* Checks that the tool that carries something exists, and that nothing is driven twice. */
static void check_drive(sw_tape *t, const sw_scene *s, const sw_drive *d) {
  sw_tape_expect(t, d->tool <= s->tool_count && !(d->tool && d->motion), "what a gripper carries");
}

static void check_tool(sw_tape *t, const sw_scene *s, const sw_tool *tool) {
  sw_tape_expect(t, !tool->drive.tool && tool->log.count % SW_LOG_TOOL_SIZE == 0, "a gripper");
  for (size_t k = 0; k < tool->pads; k++)
    sw_tape_expect(t, tool->pad[k].obstacle < s->obstacle_count, "the pads of a gripper");
  if (tool->crash.depth > 0)
    sw_tape_expect(t,
                   tool->crash.part < s->obstacle_count && tool->crash.obstacle < s->obstacle_count,
                   "what a gripper ran into");
  if (tool->frozen) sw_tape_expect(t, sw_frozen_fits(tool->frozen, s), "what a gripper has frozen");
}

static void check_rule(sw_tape *t, const sw_scene *s, const sw_scene_rule *r) {
  for (size_t i = 0; i < r->count; i++)
    sw_tape_expect(t, r->wires[i] < s->wire_count, "contact of wires");
}

static void check_kept(sw_tape *t, const sw_scene *s) {
  const size_t *first = s->kept.first, *now = s->kept.now;
  if (!s->kept.memory) return;
  sw_tape_expect(t, s->kept.wires <= sw_scene_bodies_made(s) && first[0] == 0, "contact");
  for (size_t w = 0; w < s->kept.wires && sw_tape_good(t); w++) {
    sw_tape_expect(t, first[w] <= first[w + 1], "contact");
    sw_tape_expect(t, now[w] < s->wire_count || now[w] == SIZE_MAX, "contact");
    if (!sw_tape_good(t) || now[w] == SIZE_MAX) continue;
    const sw_web *web = s->wires[now[w]].strand.web;
    if (web && s->kept.changed != w + 1)
      sw_tape_expect(t, first[w + 1] - first[w] <= web->particles, "contact");
  }
  if (!sw_tape_good(t)) return;
  const size_t nodes = first[s->kept.wires];
  sw_tape_finite(t, s->kept.s, nodes, "contact");
  sw_tape_expect(
      t,
      sw_contact_memory_fits(s->kept.memory, s->kept.bytes, nodes, s->obstacle_count) &&
          sw_mutual_memory_fits(s->kept.pairs, s->kept.pair_bytes, first, s->kept.wires) &&
          sw_mutual_memory_fits(s->kept.grains, s->kept.grain_bytes, first, s->kept.wires),
      "contact");
}

void sw_tape_check_scene(sw_tape *t, sw_scene *s) {
  sw_tape_check_numbers(t, s);
  for (size_t k = 0; k < s->rules.count; k++) check_rule(t, s, &s->rules.list[k]);
  SW_EACH(force, f, s) check_force(t, s, f);
  for (size_t w = 0; w < s->wire_count && sw_tape_good(t); w++) check_wire(t, s, w);
  for (size_t k = 0; k < s->hold_count && sw_tape_good(t); k++) check_hold(t, s, &s->holds[k]);
  for (size_t w = 0; w < s->wire_count && sw_tape_good(t); w++)
    if (s->wires[w].strand.web) check_particles(t, s, w);
  SW_EACH(join, j, s) check_join(t, s, j);
  SW_EACH(tool, tool, s) check_tool(t, s, tool);
  SW_EACH(hold, h, s) check_drive(t, s, &h->drive);
  SW_EACH(obstacle, o, s) check_drive(t, s, &o->drive);
  SW_EACH(obstacle, o, s)
    sw_tape_expect(t, o->log.count % SW_LOG_OBSTACLE_SIZE == 0, "an obstacle's log");
  if (sw_tape_good(t)) check_kept(t, s);
  sw_tape_expect(t, isfinite(s->time) && sw_finite(s->gravity), "the time of a scene");
}
