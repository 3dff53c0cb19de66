/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Holds of the scene: grasping a wire, driving, releasing. */
#include "link/hold.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "body/body.h"
#include "body/build.h"
#include "body/hold.h"
#include "body/join.h"
#include "body/other_edges.h"
#include "edit/edit.h"
#include "edit/links.h"
#include "link/joint.h"
#include "scene/course.h"
#include "scene/drive.h"
#include "scene/driven.h"
#include "scene/lookup.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "state/hinge.h"
#include "state/mesh.h"

/* A place beyond a wire's end may be in millimetres from this multiple of its length on [-]. */
static const double FAR_BEYOND = 5.0;

static sw_status check_place(const sw_scene *s, const sw_link_class *cls, size_t wire,
                             const sw_hold_args *a, sw_error *err) {
  const sw_scene_wire *w = sw_scene_wire_in(s, wire);
  const double start = w->mesh.s[0], length = w->mesh.s[w->mesh.n - 1] - start;
  const int mm = a->s - start >= FAR_BEYOND * length && (a->s - start) / 1000 <= length;
  if (a->s - start > length * (1 + 1e-9))
    return sw_fail(err, SW_EINVAL,
                   "%s%s%s%s: s = %.6g m is not on wire '%s'; it must be in [0, %.6g] m%s",
                   cls->name, *a->name ? " '" : "", a->name, *a->name ? "'" : "", a->s - start,
                   w->name, length, mm ? "; is this in mm?" : "");
  double s1, s2;
  sw_body_interval(&w->mesh, a, &s1, &s2);
  sw_body_class_of(w)->widen(&w->mesh, &s1, &s2);
  return sw_scene_check_clear(s, wire, NULL, cls->name, s1, s2, err);
}

/* Finds the held directions, before nodes move: a moved node turns the edges beside it. */
static void take_directions(const sw_mesh *m, sw_hold *h, const sw_hold_args *a) {
  double s[2];
  sw_body_interval(m, a, &s[0], &s[1]);
  const int given = isfinite(a->direction.x) && sw_norm(a->direction) > 0;
  for (int side = 0; side < 2; side++) {
    h->director[side] =
        given ? sw_unit_or(a->direction, sw_v(1, 0, 0)) : sw_mesh_tangent_at(m, s[side]);
    if (!m->rest) continue;
    sw_mesh_frame *f = &h->frame[side];
    *f = sw_mesh_frame_at(m, s[side]);
    f->normal = sw_carry_unit(f->normal, f->tangent, h->director[side]);
    f->tangent = h->director[side];
  }
}

/* fresh: see sw_body_class. */
static sw_status take_places(sw_scene *s, sw_hold *h, const sw_hold_args *a, int fresh) {
  sw_scene_wire *w = sw_scene_wire_in(s, h->wire);
  const sw_body_class *body = sw_body_class_of(w);
  SW_TRY(body->place(s, h, a, fresh));
  SW_TRY(body->grasp(w, h, a));
  return body->refine ? body->refine(s, h, &w->mesh) : SW_OK;
}

static sw_status check_axis(const sw_scene_wire *w, const sw_link_class *cls, const char *what,
                            sw_error *err) {
  const sw_web *web = w->strand.web;
  if (!web || cls->hold->direction || web->axis != web->per_ring) return SW_OK;
  return sw_fail(err, SW_EINVAL,
                 "%s: wire '%s' has no particle on its axis to be held; give the mesh a middle "
                 "(tube: core = true; cubic: across even)",
                 what, w->name);
}

/* Keeps the mesh of a twisted wire, on which a hold of its direction comes or goes. SW_ENOMEM. */
static sw_status keep_mesh(const sw_scene *s, const sw_hold *h, sw_mesh *out) {
  const sw_scene_wire *w = sw_scene_wire_in(s, h->wire);
  if (!w->twisted_count || !h->cls->hold->direction) return SW_OK;
  return sw_mesh_copy(&w->mesh, out);
}

/* Takes the places of a hold that comes; other holds keep their turn. SW_ENOMEM. */
static sw_status take_new_places(sw_scene *s, sw_hold *h, const sw_hold_args *a) {
  sw_mesh before = {0};
  SW_TRY(keep_mesh(s, h, &before));
  const sw_status status = take_places(s, h, a, !a->formed);
  if (status == SW_OK && before.n) sw_scene_correct_hold(s, h, &before, 1);
  sw_mesh_free(&before);
  return status;
}

sw_status sw_scene_add_hold(sw_scene *s, const sw_link_class *cls, sw_handle wire,
                            const sw_hold_args *given, sw_handle *out, sw_error *err) {
  sw_hold_args own = *given;
  const sw_hold_args *args = &own;
  const sw_hold_acts *acts = cls->hold;
  SW_TRY(sw_scene_ready(s, err));
  if (!sw_scene_find_wire(s, wire, err)) return SW_EDEAD;
  own.s += sw_scene_wire_in(s, wire.slot)->mesh.s[0];
  SW_TRY(check_place(s, cls, wire.slot, args, err));
  if (acts->lines) SW_TRY(sw_scene_check_line(sw_scene_wire_in(s, wire.slot), cls->name, err));
  SW_TRY(check_axis(sw_scene_wire_in(s, wire.slot), cls, cls->name, err));
  const sw_link_wire on_wire = sw_scene_link_wire(s, wire.slot);
  if (acts->check) SW_TRY(acts->check(&on_wire, &own, err));
  const sw_joint *join = acts->passes ? sw_scene_joined(s, wire.slot) : NULL;
  if (join)
    return sw_fail(err, SW_EINVAL, "feed: wire '%s' is joined to others by '%s': it cannot be fed",
                   sw_scene_wire_in(s, wire.slot)->name, join->name);
  SW_TRY(sw_scene_unbuild(s));
  sw_hold h = {.alive = 1, .cls = cls, .wire = wire.slot, .formed = args->formed};
  h.args = *args, h.scale = sw_scene_wire_in(s, wire.slot)->mesh.scale;
  sw_scene_give_name(h.name, args->name, cls->name, sw_scene_hold_slots(s));
  take_directions(&sw_scene_wire_in(s, wire.slot)->mesh, &h, args);
  sw_status status = take_new_places(s, &h, args);
  if (status == SW_OK && acts->begin) {
    const sw_link_wire of = sw_scene_link_wire(s, wire.slot);
    status = acts->begin(&h, &of);
  }
  sw_hold_forget(&h.args);
  if (status == SW_OK) status = sw_scene_add(s, SW_OF_HOLD, &h, out);
  if (status != SW_OK) {
    sw_hold_clear(&h);
    return sw_fail(err, status, "%s: out of memory", cls->name);
  }
  sw_scene_hold_in(s, out->slot)->shape = out->generation;
  return SW_OK;
}

/* Transforms the hold's present places and directions to the frame of a pose. */
static void seen_from(sw_hold *h, sw_pose pose) {
  for (size_t i = 0; i < h->count; i++) {
    const sw_vec world = sw_add(sw_vec_at(h->local, i), h->drive.pose.p);
    sw_store(h->local + 3 * i, sw_pose_local(pose, world));
  }
  for (int side = 0; side < 2; side++) {
    h->director[side] = sw_unrotate(pose.q, h->director[side]);
    h->frame[side].tangent = sw_unrotate(pose.q, h->frame[side].tangent);
    h->frame[side].normal = sw_unrotate(pose.q, h->frame[side].normal);
    h->give[side].axis = sw_unrotate(pose.q, h->give[side].axis);
  }
}

void sw_scene_frame_holds(sw_scene *s, size_t wire) {
  const sw_mesh *m = &sw_scene_wire_in(s, wire)->mesh;
  SW_EACH(hold, h, s) {
    if (!h->alive || h->wire != wire) continue;
    for (int side = 0; side < 2; side++) {
      const sw_vec held = sw_rotate(h->turn, h->director[side]);
      sw_mesh_frame *f = &h->frame[side];
      *f = sw_mesh_frame_at(m, side ? h->s2 : h->s1);
      f->normal = sw_unrotate(h->turn, sw_carry_unit(f->normal, f->tangent, held));
      f->tangent = h->director[side];
    }
    h->shape = sw_scene_number(s);
  }
}

/* SW_EINVAL when a hold cannot grasp the wire after its change. Living holds have grasped it. */
static sw_status check_again(const sw_scene *s, const sw_hold *h, const sw_hold_args *a,
                             sw_error *err) {
  const sw_scene_wire *w = sw_scene_wire_in(s, h->wire);
  char what[4 * SW_NAME_SIZE];
  double s1, s2;
  sw_body_interval(&w->mesh, a, &s1, &s2);
  sw_body_class_of(w)->widen(&w->mesh, &s1, &s2);
  snprintf(what, sizeof what, "remodel to '%s', %s '%s'", w->cls->name, h->cls->name, h->name);
  SW_TRY(check_axis(w, h->cls, what, err));
  return sw_scene_check_clear(s, h->wire, h, what, s1, s2, err);
}

/* Returns a copy of a hold without its places, to grasp anew. */
static sw_hold without_places(const sw_hold *h) {
  sw_hold new = *h;
  new.s = new.local = NULL, new.particle = NULL, new.count = 0;
  return new;
}

static void drop_places(sw_hold *h) { SW_FREE_ALL(h->s, h->local, h->particle); }

/* Replaces hold h by the new one, which has grasped the wire; turn: the orientation that goes with
 * the wire's twist. */
static sw_status become(sw_scene *s, sw_hold *h, sw_hold *new, sw_quat turn) {
  new->drive = h->drive, new->last_pose = h->last_pose, new->turn = turn;
  new->alive = 1, new->shape = sw_scene_number(s);
  drop_places(h);
  *h = *new;
  return SW_OK;
}

sw_hold_args sw_scene_rehold_args(const sw_hold *h) {
  sw_hold_args a = h->args;
  a.s = 0.5 * (h->s1 + h->s2), a.direction = sw_v(NAN, NAN, NAN);
  return a;
}

sw_status sw_scene_rehold(sw_scene *s, sw_hold *h, sw_pose pose, sw_error *err) {
  const sw_scene_wire *w = sw_scene_wire_in(s, h->wire);
  sw_hold_args a = sw_scene_rehold_args(h);
  sw_hold new = without_places(h);
  h->alive = 0; /* its own places must not be in its way */
  take_directions(&w->mesh, &new, &a);
  for (int k = 0; k < 2; k++) new.give[k].axis = sw_rotate(pose.q, h->give[k].axis);
  sw_status status = check_again(s, h, &a, err);
  if (status == SW_OK) status = take_places(s, &new, &a, 0);
  h->alive = 1;
  if (status != SW_OK) return drop_places(&new), status;
  seen_from(&new, pose);
  if (h->cls->hold->direction) /* held directions stay, wherever edges lie */
    memcpy(new.director, h->director, sizeof new.director);
  return become(s, h, &new, pose.q);
}

/* --- another mesh ------------------------------------------------------------------ */

sw_status sw_scene_copy_shape(const sw_hold *from, sw_hold *to) {
  double *s = sw_alloc(from->count, sizeof *s), *local = sw_alloc(3 * from->count, sizeof *local);
  uint32_t *particle = from->particle ? sw_alloc(from->count, sizeof *particle) : NULL;
  if (!s || !local || (from->particle && !particle)) {
    SW_FREE_ALL(s, local, particle);
    return SW_ENOMEM;
  }
  if (particle) memcpy(particle, from->particle, from->count * sizeof *particle);
  memcpy(s, from->s, from->count * sizeof *s);
  memcpy(local, from->local, 3 * from->count * sizeof *local);
  to->shape = from->shape, to->s1 = from->s1, to->s2 = from->s2, to->count = from->count;
  memcpy(to->director, from->director, sizeof to->director);
  memcpy(to->frame, from->frame, sizeof to->frame);
  memcpy(to->give, from->give, sizeof to->give);
  to->formed = from->formed;
  to->s = s, to->local = local, to->particle = particle;
  return SW_OK;
}

sw_status sw_scene_retake_hold(sw_scene *s, sw_hold *h) {
  sw_mesh *m = &sw_scene_wire_in(s, h->wire)->mesh;
  sw_hold_args a = h->args;
  sw_hold new = without_places(h);
  a.s = fmin(a.s * m->scale / h->scale, m->s[m->n - 1]);
  take_directions(m, &new, &a);
  sw_status status = take_places(s, &new, &a, 1); /* as if it were made on it */
  if (status != SW_OK) return drop_places(&new), status;
  return become(s, h, &new, h->turn);
}

/* Lets the wire go: it keeps its bends, and the other holds their turn. SW_ENOMEM. */
static sw_status let_go(sw_scene *s, sw_hold *h) {
  const sw_body_class *body = sw_body_class_of(sw_scene_wire_in(s, h->wire));
  sw_mesh before = {0};
  h->alive = 0; /* its own places may move */
  if (!body->let_go) return SW_OK;
  SW_TRY(keep_mesh(s, h, &before));
  const sw_status status = body->let_go(s, h);
  if (status == SW_OK && before.n) sw_scene_correct_hold(s, h, &before, 0);
  sw_mesh_free(&before);
  return status;
}

sw_status sw_scene_release_hold(sw_scene *s, sw_handle hold, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  SW_FIND(sw_hold, h, sw_scene_find_hold(s, hold, err));
  if (!h->alive) return SW_OK;
  sw_motion_state now;
  SW_TRY(sw_drive_eval(s, &h->drive, sw_scene_time(s), &now, err));
  SW_TRY(sw_scene_unbuild(s));
  if (h->watch.crashing) sw_scene_let_out(s); /* as a wire that begins inside an obstacle */
  if (let_go(s, h) != SW_OK)
    return h->alive = 1, sw_fail(err, SW_ENOMEM, "%s: out of memory", h->name);
  h->last_pose = now.pose;
  sw_drive_free(&h->drive);
  return SW_OK;
}

sw_status sw_scene_hold_force(sw_scene *s, sw_handle hold, const sw_vec *about, sw_vec *force,
                              sw_vec *moment, sw_error *err) {
  sw_pose pose;
  SW_TRY(sw_scene_readable(s, err));
  SW_FIND(sw_hold, h, sw_scene_living_hold(s, hold, err));
  if (about) SW_TRY(sw_scene_object_pose(s, SW_OF_HOLD, hold, &pose, err));
  *force = h->force;
  *moment = about ? sw_add(h->moment, sw_cross(sw_sub(pose.p, *about), h->force)) : h->moment;
  return SW_OK;
}

sw_status sw_scene_hold_args(const sw_scene *s, sw_handle hold, const sw_params **rows,
                             sw_hold_args *out, sw_error *err) {
  SW_FIND(const sw_hold, h, sw_scene_living_hold(s, hold, err));
  *rows = &h->cls->params;
  *out = h->args;
  out->s -= sw_scene_wire_in(s, h->wire)->mesh.s[0];
  memcpy(out->name, h->name, sizeof out->name);
  if (h->cls->hold->get) h->cls->hold->get(h, out);
  return SW_OK;
}

sw_status sw_scene_set_hold(sw_scene *s, sw_handle hold, const sw_hold_args *args, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  SW_FIND(sw_hold, h, sw_scene_living_hold(s, hold, err));
  SW_TRY(sw_scene_unbuild(s));
  if (h->cls->hold->set) h->cls->hold->set(h, args);
  return SW_OK;
}

/* --- outputs and orders of classes -------------------------------------------------- */

static const sw_hold_order *order_of(const sw_link_class *cls, const char *name) {
  for (const sw_hold_order *o = cls->hold ? cls->hold->orders : NULL; o && o->name; o++)
    if (strcmp(o->name, name) == 0) return o;
  return NULL;
}

static const char *const *output_of(const sw_link_class *cls, const char *name) {
  for (const char *const *o = cls->hold ? cls->hold->outputs : NULL; o && *o; o++)
    if (strcmp(*o, name) == 0) return o;
  return NULL;
}

/* Fails: the hold has nothing of this name; the error names a class that has it. */
static sw_status lacks(const sw_hold *h, const char *name, sw_error *err) {
  const sw_link_class *const *all = sw_link_all();
  while (*all && !order_of(*all, name) && !output_of(*all, name)) all++;
  return sw_fail(err, SW_EINVAL, "%s '%s' has no %s; holds of scene:%s have it", h->cls->name,
                 h->name, name, *all ? (*all)->name : "nothing");
}

sw_status sw_scene_hold_outputs(const sw_scene *s, sw_handle hold, const char *const **names,
                                sw_error *err) {
  SW_FIND(const sw_hold, h, sw_scene_living_hold(s, hold, err));
  *names = h->cls->hold->outputs;
  return SW_OK;
}

sw_status sw_scene_read_hold(sw_scene *s, sw_handle hold, const char *name, double *out,
                             sw_error *err) {
  double values[SW_LINK_OUTPUTS];
  SW_TRY(sw_scene_readable(s, err));
  SW_FIND(const sw_hold, h, sw_scene_living_hold(s, hold, err));
  const char *const *at = output_of(h->cls, name);
  if (!at) return lacks(h, name, err);
  h->cls->hold->read(h, sw_scene_time(s), values);
  *out = values[at - h->cls->hold->outputs];
  return SW_OK;
}

sw_status sw_scene_order_hold(sw_scene *s, sw_handle hold, const char *name, double value,
                              sw_motion *motion, sw_error *err) {
  SW_FIND(sw_hold, h, sw_scene_living_hold(s, hold, err));
  const sw_hold_order *order = order_of(h->cls, name);
  if (!order) return lacks(h, name, err);
  SW_TRY(sw_scene_editable(s, err));
  const sw_link_wire wire = sw_scene_link_wire(s, h->wire);
  SW_TRY(order->give(h, &wire, value, motion, err));
  if (order->jumps) sw_course_jump(sw_scene_course(s));
  return SW_OK;
}
