/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Freezes a grip: a wire that pads have squeezed becomes a rod that the tool holds rigidly. The
 * pressed rings move with the tool, like the grip that replaces the pads; the rings beside them
 * turn with the rod. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "body/body.h"
#include "body/build.h"
#include "body/touching.h"
#include "contact/contact.h"
#include "edit/links.h"
#include "grip/frozen.h"
#include "grip/jaws.h"
#include "remodel/exchange.h"
#include "remodel/remodel.h"
#include "scene/drive.h"
#include "scene/gripper.h"
#include "scene/lookup.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "state/hinge.h"

/* Finds the rings that the tool presses; 0: there are none. */
static int pressed_rings(const sw_scene *s, const sw_tool *t, const sw_body *b, sw_frozen *f) {
  f->first = SIZE_MAX, f->last = 0;
  for (size_t k = 0; sw_scene_contact(s) && k < sw_contact_touches(sw_scene_contact(s)); k++) {
    sw_contact_push p;
    if (!sw_contact_push_at(sw_scene_contact(s), sw_scene_system(s), k, &p) ||
        !sw_tool_is_pad(t, p.obstacle))
      continue;
    if (p.node < b->first_node || p.node >= b->first_node + b->plan->nodes) continue;
    const size_t r = sw_web_ring_of(b->plan->web, p.node - b->first_node);
    if (r < f->first) f->first = r;
    if (r > f->last) f->last = r;
  }
  return f->first <= f->last;
}

static sw_status keep_stations(const sw_web *web, const sw_mesh *mesh, sw_stations *out) {
  out->n = web->rings;
  SW_TRY(SW_ALLOC_ALL(SW_ROOM(out->s, web->rings), SW_ROOM(out->ring, web->rings)));
  for (size_t r = 0; r < web->rings; r++) {
    out->s[r] = mesh->s[r] - mesh->s[0];
    out->ring[r] = (unsigned char)sw_web_is_ring(web, r);
  }
  return SW_OK;
}

static sw_status keep_memory(const sw_scene *s, const sw_body *b, sw_frozen *f) {
  const void *memory = sw_contact_memory(sw_scene_contact(s), &f->bytes);
  f->memory = sw_alloc(f->bytes, 1);
  if (!f->memory) return SW_ENOMEM;
  if (f->bytes) memcpy(f->memory, memory, f->bytes);
  f->node = b->first_node, f->nodes = b->plan->nodes;
  return SW_OK;
}
/* Keeps all that the way back needs. */
static sw_status keep(sw_scene *s, const sw_tool *t, sw_handle wire, sw_frozen *f, sw_line *line,
                      sw_grip_end ends[2], sw_error *err) {
  sw_system *system = sw_scene_system(s);
  sw_scene_wire *w = sw_scene_wire_in(s, wire.slot);
  const sw_body *b = &system->bodies[wire.slot];
  sw_motion_state now;
  SW_TRY(sw_drive_eval(s, &t->drive, sw_scene_time(s), &now, err));
  f->pose = now.pose;
  f->wire = wire, f->cls = w->cls, f->jaw = t->jaw;
  SW_TRY(sw_body_class_of(w)->take(s, wire.slot));
  SW_TRY(sw_mesh_copy(&w->mesh, &f->mesh));
  SW_TRY(sw_strand_copy(&w->strand, &f->strand));
  SW_TRY(keep_stations(w->strand.web, &w->mesh, &f->stations));
  SW_TRY(keep_memory(s, b, f));
  SW_TRY(sw_frozen_keep_touches(s, t, f, err));
  SW_TRY(sw_line_read(s, wire, f->stations.n, f->stations.s, line, err));
  SW_TRY(SW_ALLOC_ALL(SW_ROOM(f->frame, 6 * f->stations.n), SW_ROOM(f->rod, 3 * f->stations.n)));
  memcpy(f->frame, line->frame, 6 * f->stations.n * sizeof *f->frame);
  return sw_frozen_condense(s, t, f, ends, err);
}

/* Sets the line's twist between each end of the grip and the ring from which outwards it lies like
 * the mesh: the torque there times the length over GJ. */
static void take_turns(sw_line *line, const sw_grip_end ends[2]) {
  const double turn[2] = {line->turn[ends[0].ring] - ends[0].turn,
                          line->turn[ends[1].ring] - ends[1].turn};
  for (size_t i = ends[0].ring + 1; i < ends[1].ring; i++) {
    const int side = line->s[i] > 0.5 * (ends[0].s + ends[1].s);
    const double whole = line->s[ends[side].ring] - ends[side].s;
    const double share = whole != 0 ? (line->s[i] - ends[side].s) / whole : 0.0;
    line->turn[i] = turn[side] + fmin(1.0, fmax(0.0, share)) * ends[side].turn;
  }
}

/* Makes the rod from the line. */
static sw_status become_rod(sw_scene *s, sw_handle wire, const sw_line *line, sw_error *err) {
  sw_scene_wire next = {.cls = sw_wire_find("rod")};
  sw_status status = sw_line_mesh(sw_scene_wire_in(s, wire.slot), line, &next.mesh);
  if (status == SW_OK) status = sw_line_twist(line, &next);
  if (status == SW_OK) status = sw_scene_unbuild(s);
  if (status == SW_OK) return sw_scene_replace_wire(s, wire.slot, &next, err);
  sw_mesh_free(&next.mesh);
  sw_free(next.twisted);
  return status;
}

/* Adds the tool's grip on the rod. */
static sw_status grip(sw_scene *s, sw_handle tool, const sw_frozen *f, const sw_grip_end ends[2],
                      sw_freeze_report *out, sw_error *err) {
  const sw_link_class *cls = sw_link_find("grip");
  sw_hold_args args = {0};
  sw_params_default(&cls->params, &args);
  out->s1 = ends[0].s, out->s2 = ends[1].s;
  args.s = 0.5 * (out->s1 + out->s2);
  args.width = out->s2 - out->s1;
  args.direction = sw_v(NAN, NAN, NAN);
  args.formed = 1;
  SW_TRY(sw_scene_add_hold(s, cls, f->wire, &args, &out->hold, err));
  sw_hold *h = sw_scene_hold_in(s, out->hold.slot);
  for (size_t k = 0; k < 2; k++) {
    const sw_vec at = sw_sub(ends[k].at, h->drive.pose.p);
    sw_store(h->local + 3 * (k ? h->count - 1 : 0), at);
    h->director[k] = ends[k].director;
    h->give[k] = ends[k].give;
  }
  return sw_scene_tool_hold(s, tool, out->hold, err);
}

/* Keeps the rod's places at the mesh's rings, and its frames: the directions across it are carried
 * over from the mesh. */
static sw_status keep_rod(sw_scene *s, sw_frozen *f, sw_error *err) {
  sw_line rod = {0};
  const sw_status status = sw_line_read(s, f->wire, f->stations.n, f->stations.s, &rod, err);
  for (size_t r = 0; r < rod.n && status == SW_OK; r++) {
    const sw_vec was = sw_load(f->frame + 6 * r), across = sw_load(f->frame + 6 * r + 3);
    const sw_vec is = sw_load(rod.frame + 6 * r);
    sw_store(f->rod + 3 * r, sw_vec_at(rod.x, r));
    sw_store(f->frame + 6 * r, is);
    sw_store(f->frame + 6 * r + 3, sw_carry_unit(across, was, is));
  }
  sw_line_free(&rod);
  return status;
}

static sw_status change_to_rod(sw_scene *s, const sw_exchange *x, const double *a, size_t count,
                               sw_freeze_report *out, sw_error *err) {
  sw_frozen *f = x->frozen;
  sw_vec about;
  take_turns(x->line, x->ends);
  sw_momentum_of(s, f->wire.slot, &about, out->before);
  out->energy_before = sw_scene_total_energy(s, err);
  SW_TRY(become_rod(s, f->wire, x->line, err));
  SW_TRY(grip(s, x->tool, f, x->ends, out, err));
  f->hold = out->hold;
  SW_TRY(sw_scene_tool_pads_on(s, x->tool, 0, err));
  SW_TRY(sw_scene_build(s, err));
  const sw_vec along = sw_sub(x->ends[1].at, x->ends[0].at);
  const sw_match match = {.hold = out->hold,
                          .wire = f->wire.slot,
                          .along = sw_unit_or(sw_unrotate(f->pose.q, along), sw_v(1, 0, 0)),
                          .q = f->pose.q,
                          .about = f->pose.p,
                          .was = out,
                          .rings = a,
                          .count = count,
                          .balance = x->balance};
  SW_TRY(sw_frozen_match(s, &match));
  SW_TRY(sw_momentum_match(s, f->wire.slot, about, out->before));
  sw_momentum_about(s, f->wire.slot, about, out->after);
  out->energy_after = sw_scene_total_energy(s, err);
  SW_TRY(keep_rod(s, f, err));
  sw_hold *h = sw_scene_hold_in(s, out->hold.slot);
  sw_motion_state at;
  SW_TRY(sw_drive_eval(s, &h->drive, sw_scene_time(s), &at, err));
  h->force = out->force; /* the pads' force, until a step gives the grip's own */
  h->moment = sw_sub(out->moment, sw_cross(sw_sub(at.pose.p, f->pose.p), out->force));
  h->end_force = h->force, h->end_moment = h->moment;
  return SW_OK;
}

static sw_status check_freeze(const sw_scene *s, const sw_tool *t, sw_handle wire, sw_error *err) {
  SW_FIND(const sw_scene_wire, w, sw_scene_find_wire(s, wire, err));
  if (t->frozen)
    return sw_fail(err, SW_EINVAL, "gripper '%s' holds its wire rigidly already", t->name);
  if (!sw_scene_has_sections(w))
    return sw_fail(err, SW_EINVAL,
                   "gripper '%s': wire '%s' is a %s; only a mesh has sections that pads deform",
                   t->name, w->name, w->cls->name);
  return sw_remodel_check_forces(s, wire.slot, sw_wire_find("rod"), err);
}

sw_status sw_scene_tool_freeze(sw_scene *s, sw_handle tool, sw_handle wire, sw_balance *balance,
                               sw_freeze_report *out, sw_error *err) {
  sw_line line = {0};
  sw_grip_end ends[2];
  *out = (sw_freeze_report){0};
  SW_TRY(sw_scene_ready(s, err));
  SW_FIND(const sw_tool, t, sw_scene_find_tool(s, tool, err));
  SW_TRY(check_freeze(s, t, wire, err));
  SW_TRY(sw_scene_build(s, err));
  sw_frozen *f = sw_alloc(1, sizeof *f);
  if (!f) return sw_fail(err, SW_ENOMEM, "gripper: out of memory");
  f->references = 1;
  const sw_status found = sw_scene_find_touches(s, err);
  if (found != SW_OK) {
    sw_frozen_release(f);
    return found;
  }
  if (!pressed_rings(s, t, &sw_scene_system(s)->bodies[wire.slot], f)) {
    sw_frozen_release(f);
    return sw_fail(err, SW_EINVAL, "gripper '%s' does not press on wire '%s'", t->name,
                   sw_scene_wire_in(s, wire.slot)->name);
  }
  sw_status status = sw_scene_tool_force(s, tool, NULL, &out->force, &out->moment, err);
  if (status == SW_OK) status = keep(s, t, wire, f, &line, ends, err);
  const sw_exchange exchange = {tool, wire.slot, f, &line, ends, balance, change_to_rod};
  if (status == SW_OK) status = sw_frozen_exchange(s, &exchange, out, err);
  sw_line_free(&line);
  if (status == SW_OK) {
    sw_scene_tool_in(s, tool.slot)->frozen = f;
    sw_tool_state *now = &sw_scene_tool_in(s, tool.slot)->now;
    now->margin = sw_frozen_margin(f, sw_unrotate(f->pose.q, out->force),
                                   sw_unrotate(f->pose.q, out->moment));
    now->lost_time = NAN;
  } else {
    sw_frozen_release(f);
  }
  return status == SW_ENOMEM ? sw_fail(err, status, "gripper: out of memory") : status;
}
