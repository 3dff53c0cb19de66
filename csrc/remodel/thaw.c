/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Thaws a frozen grip: a wire that a tool held rigidly becomes a mesh between the tool's pads
 * again, as it was there when frozen, with the pads' friction. */
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
#include "scene/course.h"
#include "scene/drive.h"
#include "scene/events.h"
#include "scene/gripper.h"
#include "scene/lookup.h"
#include "scene/parts.h"
#include "scene/scene.h"
#include "scene/wire.h"
#include "state/hinge.h"

/* The start direction across the rod's line is arbitrary. Turns all of them so that the tool's ring
 * gets the direction that moved with the tool. */
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

/* Turns a vector from the frame (t, u) of one line into the frame of another. */
static sw_vec turned(const double *from, const double *to, sw_vec a) {
  const sw_vec t = sw_load(from), u = sw_load(from + 3), w = sw_cross(t, u);
  const sw_vec t2 = sw_load(to), u2 = sw_load(to + 3), w2 = sw_cross(t2, u2);
  return sw_madd(sw_madd(sw_scale(t2, sw_dot(a, t)), u2, sw_dot(a, u)), w2, sw_dot(a, w));
}

/* Length in radii, from the pads' face on, over which the line passes from the wire's kept shape to
 * the rod's [-]. The rod is held further inside than the face, so it lies near the face as no mesh
 * would. */
static const double SPREAD = 12.0;

/* One end of the pressed rings, and how the line outside it differs from the rod until the line
 * meets the rod. Edges turn and keep their lengths: a cable would pull with newtons for each micron
 * of stretch. */
typedef struct face {
  size_t ring;
  int step;     /* index step to the next ring outside */
  double reach; /* length of the difference along the wire [m] */
  sw_vec way;   /* from the rod to the kept wire at the face [m] */
  sw_vec turn;  /* the same as a turn [rad] */
  sw_vec back;  /* additional turn further out that brings the line back to the rod [rad] */
} face;

/* Returns the turn from one frame to another one, which has been moved by `moved`. */
static sw_quat between(const double *from, sw_quat moved, const double *to) {
  const sw_vec t = sw_rotate(moved, sw_load(to)), across = sw_rotate(moved, sw_load(to + 3));
  const sw_quat bend = sw_quat_between(sw_load(from), t);
  const sw_vec u = sw_rotate(bend, sw_load(from + 3));
  const double twist = atan2(sw_dot(sw_cross(u, across), t), sw_dot(u, across));
  return sw_quat_mul(sw_quat_exp(sw_scale(t, twist)), bend);
}

/* Returns the distance from the face over the reach, at most 1 [-]. */
static double share_at(const face *e, const sw_line *l, double at) {
  return e->reach > 0 ? fmin(1.0, fabs(at - l->s[e->ring]) / e->reach) : 1.0;
}

/* Returns the line's turn there [rad]. */
static sw_vec turn_at(const face *e, const sw_line *l, double at) {
  const double u = share_at(e, l, at), left = (1.0 - u) * (1.0 - u);
  return sw_madd(sw_scale(e->turn, left * (1.0 + 2.0 * u)), e->back, left * u);
}

/* Next ring outside of ring r [-]; arc length at the middle between both [m]. */
static size_t next_to(const face *e, size_t r) { return (size_t)((long)r + e->step); }
static double middle_of(const face *e, const sw_line *l, size_t r) {
  return 0.5 * (l->s[r] + l->s[next_to(e, r)]);
}

/* Returns the rod's edge from ring r to the next one outside. gain: how far the edge's turn shifts
 * its end. */
static sw_vec edge_of(const face *e, const sw_line *l, size_t r, sw_vec *gain) {
  const sw_vec edge = sw_sub(sw_vec_at(l->x, next_to(e, r)), sw_vec_at(l->x, r));
  const sw_quat turn = sw_quat_exp(turn_at(e, l, middle_of(e, l, r)));
  *gain = sw_sub(sw_rotate(turn, edge), edge);
  return edge;
}

static int goes_on(const face *e, const sw_line *l, size_t r) {
  return e->step > 0 ? r + 1 < l->n : r > 0;
}

/* Returns the turn that brings the line back to the rod. Without it the line ends off the rod by
 * `off`; a turn `back` shifts the end by back x sum, the sum of all edges times their shares. */
static sw_vec back_of(const face *e, const sw_line *l) {
  sw_vec off = e->way, sum = sw_v(0, 0, 0), gain;
  for (size_t r = e->ring; goes_on(e, l, r); r = next_to(e, r)) {
    const sw_vec edge = edge_of(e, l, r, &gain);
    const double u = share_at(e, l, middle_of(e, l, r));
    off = sw_add(off, gain);
    sum = sw_madd(sum, edge, u * (1.0 - u) * (1.0 - u));
  }
  return sw_scale(sw_cross(off, sum), 1.0 / fmax(sw_norm2(sum), 1e-300));
}

static face face_of(const sw_frozen *f, const sw_motion_state *tool, const sw_line *l, int after,
                    double radius) {
  face out = {.ring = after ? f->last : f->first, .step = after ? 1 : -1};
  const double end = l->s[after ? l->n - 1 : 0];
  const sw_quat moved = sw_quat_mul(tool->pose.q, sw_quat_conj(f->pose.q));
  const sw_vec was = sw_pose_local(f->pose, sw_vec_at(f->rod, out.ring));
  out.reach = fmin(SPREAD * radius, fabs(end - l->s[out.ring]));
  out.way = sw_sub(sw_pose_point(tool->pose, was), sw_vec_at(l->x, out.ring));
  out.turn = sw_quat_log(between(l->frame + 6 * out.ring, moved, f->frame + 6 * out.ring));
  if (out.reach > 0) out.back = back_of(&out, l);
  return out;
}

/* Shifts and turns the line outside a face. */
static void lead_out(const face *e, sw_line *l) {
  sw_vec off = e->way, gain;
  for (size_t r = e->ring; goes_on(e, l, r); r = next_to(e, r)) {
    const size_t next = next_to(e, r);
    (void)edge_of(e, l, r, &gain); /* before ring r is shifted */
    if (r != e->ring) sw_store(l->x + 3 * r, sw_add(sw_vec_at(l->x, r), off));
    off = sw_add(off, gain);
    const sw_quat turn = sw_quat_exp(turn_at(e, l, l->s[next]));
    for (size_t k = 6 * next; k < 6 * next + 6; k += 3)
      sw_store(l->frame + k, sw_rotate(turn, sw_load(l->frame + k)));
    if (!goes_on(e, l, next)) sw_store(l->x + 3 * next, sw_add(sw_vec_at(l->x, next), off));
  }
}

/* Leads the line through the pads as the wire was there. */
static void lead(const sw_frozen *f, const sw_motion_state *tool, sw_line *l, double radius) {
  for (int after = 0; after < 2; after++) {
    const face e = face_of(f, tool, l, after, radius);
    lead_out(&e, l);
  }
  for (size_t r = f->first; r <= f->last; r++)
    sw_store(l->x + 3 * r, sw_pose_point(tool->pose, sw_pose_local(f->pose, sw_vec_at(f->rod, r))));
}

/* Returns a ring's frame on a line at x. The ring faces along the chord between its neighbours.
 * Next to a part that is a line, it faces along that edge alone, since both are tied to each
 * other. */
static void frame_at(const sw_web *web, const double *x, const double *frame, size_t r,
                     double out[6]) {
  const sw_vec t = sw_load(frame + 6 * r), across = sw_load(frame + 6 * r + 3);
  const int ties = r + 1 < web->rings && !sw_web_is_ring(web, r + 1);
  const int tied = r > 0 && !sw_web_is_ring(web, r - 1);
  const size_t a = r > 0 && !ties ? r - 1 : r, b = r + 1 < web->rings && !tied ? r + 1 : r;
  const sw_vec facing = sw_unit_or(sw_sub(sw_vec_at(x, b), sw_vec_at(x, a)), t);
  sw_store(out, facing);
  sw_store(out + 3, sw_carry_unit(across, t, facing));
}

/* Moves the strand's particles from their places at the freeze to their present places: between the
 * pads rigidly with the tool, beside them with the line. */
static void place(const sw_frozen *f, const sw_motion_state *tool, const sw_line *l,
                  sw_strand *strand) {
  const sw_web *web = strand->web;
  double *x = strand->x, *v = strand->v;
  for (size_t r = 0; r < web->rings; r++) {
    const int pressed = r >= f->first && r <= f->last;
    double then[6], now[6];
    frame_at(web, f->rod, f->frame, r, then);
    frame_at(web, l->x, l->frame, r, now);
    for (size_t p = web->first[r]; p < web->first[r + 1]; p++) {
      const sw_vec at = sw_vec_at(x, p), off = sw_sub(at, sw_vec_at(f->rod, r));
      sw_store(x + 3 * p, pressed ? sw_pose_point(tool->pose, sw_pose_local(f->pose, at))
                                  : sw_add(sw_vec_at(l->x, r), turned(then, now, off)));
    }
  }
  sw_line_spin(l, web, x, v);
  for (size_t p = web->first[f->first]; p < web->first[f->last + 1]; p++) {
    const sw_vec arm = sw_sub(sw_vec_at(x, p), tool->pose.p);
    sw_store(v + 3 * p, sw_add(tool->v, sw_cross(tool->omega, arm)));
  }
  memset(strand->a, 0, 3 * web->particles * sizeof *strand->a);
  sw_free(strand->rate); /* it belongs to the time of the freeze */
  strand->rate = NULL;
  for (size_t e = 0; e < web->links; e++) {
    const sw_web_link *k = &web->link[e];
    const double length = sw_dist(sw_vec_at(x, k->a), sw_vec_at(x, k->b));
    if (!sw_web_is_ring(web, sw_web_ring_of(web, k->a)))
      strand->axial[e] = k->k * (length - k->rest); /* of a line: from its present length */
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
  lead(f, &now, line, sw_scene_wire_in(s, f->wire.slot)->beam.radius);
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

/* The wire became a mesh elsewhere, between the pads of another gripper, while this one held it; or
 * other pads press on it as a rod; or this one lets go, and another hold has taken it since. It
 * stays as it is, and the pads of this one press on the rod. */
static sw_status change_to_pads(sw_scene *s, const sw_exchange *x, const double *a, size_t count,
                                sw_freeze_report *out, sw_error *err) {
  const size_t wire = x->frozen->wire.slot;
  sw_vec about;
  sw_momentum_of(s, wire, &about, out->before);
  out->energy_before = sw_scene_total_energy(s, err);
  SW_TRY(sw_scene_release_hold(s, x->frozen->hold, err));
  SW_TRY(sw_scene_tool_pads_on(s, x->tool, 1, err));
  SW_TRY(sw_scene_build(s, err));
  (void)a, (void)count; /* not moved into balance: the jaws must close on the rod first */
  sw_momentum_about(s, wire, about, out->after);
  out->energy_after = sw_scene_total_energy(s, err);
  return SW_OK;
}

/* Reports if the pads do not bear the rigid grip's load. */
static sw_status tell_jump(sw_scene *s, sw_handle tool, const sw_handle wire,
                           const sw_freeze_report *was, sw_error *err) {
  sw_vec force, moment;
  SW_TRY(sw_scene_tool_force(s, tool, NULL, &force, &moment, err));
  sw_frozen_tell_jump(s, wire.slot, was, force, moment, "pads");
  return SW_OK;
}

/* The jaws close on the rod with the force that they had on the mesh. */
static void close_again(sw_jaw *j) {
  if (!(j->now > 0)) return;
  j->mode = SW_JAW_FORCE, j->status = SW_JAW_MOVES;
  j->force = j->now, j->now = 0, j->stiffness = 0;
}

/* The tool has its pads again. */
static sw_status take_pads(sw_scene *s, sw_handle tool, int on_rod, sw_thaw then,
                           const sw_freeze_report *was, sw_error *err) {
  sw_tool *t = sw_scene_tool_in(s, tool.slot);
  sw_frozen *f = t->frozen;
  const sw_handle wire = f->wire;
  t->jaw = f->jaw;
  t->jaw.since = sw_scene_time(s), t->jaw.speed = 0;
  t->frozen = NULL;
  t->now.lost_time = NAN;
  sw_frozen_release(f);
  if (!on_rod) return tell_jump(s, tool, wire, was, err);
  if (then != SW_THAW_HOLDS) return sw_jaws_clear(s, t, wire.slot, err);
  close_again(&t->jaw);
  return tell_jump(s, tool, wire, was, err);
}

/* Share of the wire's length within which a hold's end lies at a station [-]. */
static const double SAME_PLACE = 1e-9;

static int is_station(const sw_stations *at, double s, double length) {
  for (size_t r = 0; r < at->n; r++)
    if (fabs(at->s[r] - s) <= SAME_PLACE * length) return 1;
  return 0;
}

/* 1 if another hold has taken the wire since the freeze, where the mesh has no nodes for its ends.
 * On the mesh it would hold a place, but no direction: a wire hung from the rigid grip of a second
 * gripper like from a pin (spec/physics/mixed_again_spec). */
static int is_held_between(const sw_scene *s, const sw_frozen *f) {
  const sw_mesh *m = &sw_scene_wire_in(s, f->wire.slot)->mesh;
  const sw_hold *own = sw_scene_find_hold(s, f->hold, NULL);
  const double length = f->stations.s[f->stations.n - 1];
  SW_EACH(hold, h, s)
    if (h->alive && h->wire == f->wire.slot && h != own &&
        (!is_station(&f->stations, h->s1 - m->s[0], length) ||
         !is_station(&f->stations, h->s2 - m->s[0], length)))
      return 1;
  return 0;
}

sw_status sw_scene_tool_thaw(sw_scene *s, sw_handle tool, sw_thaw then, sw_balance *balance,
                             sw_freeze_report *out, sw_error *err) {
  sw_line line = {0};
  *out = (sw_freeze_report){0};
  SW_TRY(sw_scene_ready(s, err));
  SW_FIND(const sw_tool, t, sw_scene_find_tool(s, tool, err));
  sw_frozen *f = t->frozen;
  if (!f) return sw_fail(err, SW_EINVAL, "gripper '%s' does not hold its wire rigidly", t->name);
  f->wire = sw_scene_body_now(s, f->wire); /* others may have left */
  const int on_rod = then == SW_THAW_LEAVES ||
                     sw_scene_wire_in(s, f->wire.slot)->strand.web != NULL ||
                     (then != SW_THAW_HOLDS && is_held_between(s, f));
  if (!on_rod) SW_TRY(sw_remodel_check_forces(s, f->wire.slot, f->cls, err));
  SW_TRY(sw_scene_build(s, err));
  const sw_exchange exchange = {
      tool, f->wire.slot, f, &line, NULL, balance, on_rod ? change_to_pads : change_to_mesh};
  sw_status status = sw_scene_tool_force(s, tool, NULL, &out->force, &out->moment, err);
  if (status == SW_OK) status = sw_frozen_exchange(s, &exchange, out, err);
  sw_line_free(&line);
  out->on_rod = status == SW_OK && on_rod;
  if (status == SW_OK) status = take_pads(s, tool, on_rod, then, out, err);
  return status == SW_ENOMEM ? sw_fail(err, status, "gripper: out of memory") : status;
}
