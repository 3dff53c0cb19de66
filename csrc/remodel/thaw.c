/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A wire that a tool held rigidly in place of its pads is given back to them: a mesh as it was
 * between the pads, with their friction. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "body/build.h"
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
#include "scene/scene.h"
#include "scene/wire.h"
#include "state/hinge.h"

/* Directions across the rod's line start anywhere: turn them so that the ring that the tool holds
 * has the one that went with the tool. */
static void align(const sw_frozen *f, const sw_pose *now, sw_line *l) {
  const size_t r = f->first;
  const sw_quat moved = sw_quat_mul(now->q, sw_quat_conj(f->pose.q));
  const sw_vec t = sw_load(l->frame + 6 * r), u = sw_load(l->frame + 6 * r + 3);
  const sw_vec true_t = sw_rotate(moved, sw_load(f->frame + 6 * r));
  const sw_vec true_u = sw_carry_unit(sw_rotate(moved, sw_load(f->frame + 6 * r + 3)), true_t, t);
  const double angle = atan2(sw_dot(sw_cross(u, true_u), t), sw_dot(u, true_u));
  for (size_t k = 0; k < l->n; k++) {
    const sw_vec axis = sw_load(l->frame + 6 * k), v = sw_load(l->frame + 6 * k + 3);
    sw_store(l->frame + 6 * k + 3, sw_rotate(sw_quat_exp(sw_scale(axis, angle)), v));
  }
}

/* a, known in the frame (t, u) of one line, in that of another. */
static sw_vec turned(const double *from, const double *to, sw_vec a) {
  const sw_vec t = sw_load(from), u = sw_load(from + 3), w = sw_cross(t, u);
  const sw_vec t2 = sw_load(to), u2 = sw_load(to + 3), w2 = sw_cross(t2, u2);
  return sw_madd(sw_madd(sw_scale(t2, sw_dot(a, t)), u2, sw_dot(a, u)), w2, sw_dot(a, w));
}

/* Particles that pads press on stay where they were between them. The middle goes with the rod
 * that stands for it, and the particles between both shear. */
static void place_pressed(const sw_frozen *f, const sw_motion_state *tool, const sw_line *l,
                          size_t r, const sw_web *web, double *x) {
  const sw_vec middle = sw_pose_local(f->pose, sw_vec_at(f->rod, r));
  const sw_vec off = sw_sub(sw_vec_at(l->x, r), sw_pose_point(tool->pose, middle));
  double widest = 0;
  for (size_t p = web->first[r]; p < web->first[r + 1]; p++) {
    const sw_vec at = sw_pose_local(f->pose, sw_vec_at(x, p));
    widest = fmax(widest, fabs(sw_dot(sw_sub(at, middle), f->across)));
  }
  for (size_t p = web->first[r]; p < web->first[r + 1]; p++) {
    const sw_vec at = sw_pose_local(f->pose, sw_vec_at(x, p));
    const double far = fabs(sw_dot(sw_sub(at, middle), f->across));
    const double share = widest > 0 ? 1.0 - far / widest : 0.0;
    sw_store(x + 3 * p, sw_madd(sw_pose_point(tool->pose, at), off, share));
  }
}

/* Move the particles of the strand from their places at the freeze to their present places. */
static void place(const sw_frozen *f, const sw_motion_state *tool, const sw_line *l,
                  sw_strand *strand) {
  const sw_web *web = strand->web;
  double *x = strand->x, *v = strand->v;
  for (size_t r = 0; r < web->rings; r++) {
    if (r >= f->first && r <= f->last) {
      place_pressed(f, tool, l, r, web, x);
      continue;
    }
    for (size_t p = web->first[r]; p < web->first[r + 1]; p++) {
      const sw_vec off = sw_sub(sw_vec_at(x, p), sw_vec_at(f->rod, r));
      sw_store(x + 3 * p,
               sw_add(sw_vec_at(l->x, r), turned(f->frame + 6 * r, l->frame + 6 * r, off)));
    }
  }
  sw_line_spin(l, web, x, v);
  for (size_t p = web->first[f->first]; p < web->first[f->last + 1]; p++) {
    const sw_vec arm = sw_sub(sw_vec_at(x, p), tool->pose.p);
    sw_store(v + 3 * p, sw_add(tool->v, sw_cross(tool->omega, arm)));
  }
  memset(strand->a, 0, 3 * web->particles * sizeof *strand->a);
  sw_free(strand->rate); /* that of long ago */
  strand->rate = NULL;
  for (size_t e = 0; e < web->links; e++) {
    const sw_web_link *k = &web->link[e];
    const double length = sw_dist(sw_vec_at(x, k->a), sw_vec_at(x, k->b));
    if (!sw_web_is_ring(web, sw_web_ring_of(web, k->a)))
      strand->axial[e] = k->k * (length - k->rest); /* of a line: as it lies now */
  }
}

static sw_status become_mesh(sw_scene *s, const sw_frozen *f, const sw_motion_state *tool,
                             const sw_line *line, sw_error *err) {
  sw_scene_wire next = {.cls = f->cls};
  sw_status status = sw_mesh_copy(&f->mesh, &next.mesh);
  if (status == SW_OK) status = sw_strand_copy(&f->strand, &next.strand);
  if (status == SW_OK) status = sw_scene_unbuild(s);
  if (status != SW_OK) {
    sw_mesh_free(&next.mesh);
    sw_strand_free(&next.strand);
    return status;
  }
  memcpy(next.mesh.x, line->x, 3 * line->n * sizeof *line->x);
  memcpy(next.mesh.v, line->v, 3 * line->n * sizeof *line->v);
  place(f, tool, line, &next.strand);
  return sw_scene_replace_wire(s, f->wire.slot, &next, err);
}

static sw_status change_to_mesh(sw_scene *s, const sw_exchange *x, const double *a, size_t count,
                                sw_freeze_report *out, sw_error *err) {
  const sw_tool *t = sw_scene_tool_in(s, x->tool.slot);
  const sw_frozen *f = x->frozen;
  sw_line *line = x->line;
  size_t pads[SW_TOOL_PADS];
  sw_motion_state now;
  sw_vec about;
  SW_TRY(sw_drive_eval(s, &t->drive, sw_scene_time(s), &now, err));
  SW_TRY(sw_line_read(s, f->wire, f->stations.n, f->stations.s, line, err));
  align(f, &now.pose, line);
  sw_momentum_of(s, f->wire.slot, &about, out->before);
  out->energy_before = sw_scene_total_energy(s, err);
  SW_TRY(sw_scene_release_hold(s, f->hold, err));
  SW_TRY(become_mesh(s, f, &now, line, err));
  SW_TRY(sw_scene_tool_pads_on(s, x->tool, 1, err));
  SW_TRY(sw_scene_build(s, err));
  for (size_t k = 0; k < t->pads; k++) pads[k] = t->pad[k].obstacle;
  const size_t first = sw_scene_system(s)->bodies[f->wire.slot].first_node;
  SW_TRY(sw_contact_add_memory(sw_scene_contact(s), f->memory, f->bytes, f->node,
                               f->node + f->nodes, first, pads, t->pads));
  SW_TRY(sw_frozen_balance(s, f->wire.slot, a, count, x->balance));
  SW_TRY(sw_momentum_match(s, f->wire.slot, about, out->before));
  sw_momentum_about(s, f->wire.slot, about, out->after);
  out->energy_after = sw_scene_total_energy(s, err);
  return SW_OK;
}

sw_status sw_scene_tool_thaw(sw_scene *s, sw_handle tool, sw_balance *balance,
                             sw_freeze_report *out, sw_error *err) {
  sw_line line = {0};
  *out = (sw_freeze_report){0};
  SW_TRY(sw_scene_ready(s, err));
  SW_FIND(const sw_tool, t, sw_scene_find_tool(s, tool, err));
  sw_frozen *f = t->frozen;
  if (!f) return sw_fail(err, SW_EINVAL, "gripper '%s' does not hold its wire rigidly", t->name);
  f->wire = sw_scene_body_now(s, f->wire); /* others may have left */
  if (sw_scene_wire_in(s, f->wire.slot)->strand.web)
    return sw_fail(err, SW_EINVAL, "gripper '%s': wire '%s' was remodelled while it was held",
                   t->name, sw_scene_wire_in(s, f->wire.slot)->name);
  SW_TRY(sw_scene_build(s, err));
  const sw_exchange exchange = {tool, f->wire.slot, f, &line, NULL, balance, change_to_mesh};
  sw_status status = sw_scene_tool_force(s, tool, NULL, &out->force, &out->moment, err);
  if (status == SW_OK) status = sw_frozen_exchange(s, &exchange, out, err);
  sw_line_free(&line);
  if (status == SW_OK) {
    sw_tool *thawed = sw_scene_tool_in(s, tool.slot);
    thawed->jaw = f->jaw;
    thawed->jaw.since = sw_scene_time(s), thawed->jaw.speed = 0;
    thawed->frozen = NULL;
    thawed->now.lost_time = NAN;
    sw_frozen_release(f);
  }
  return status == SW_ENOMEM ? sw_fail(err, status, "gripper: out of memory") : status;
}
