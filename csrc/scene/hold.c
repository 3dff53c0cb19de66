/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Holds of the scene: taking hold of a wire, driving, releasing. */
#include "link/hold.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "link/joint.h"
#include "scene/hold.h"
#include "scene/jaws.h"
#include "scene/join.h"
#include "scene/line.h"
#include "scene/links.h"
#include "scene/obstacle.h"
#include "scene/world.h"
#include "state/field.h"
#include "state/hinge.h"
#include "state/mesh.h"
#include "system/system.h"

static size_t kept_places(const sw_scene *s, size_t wire, double *out) {
  size_t n = 0;
  for (size_t k = 0; k < s->hold_count; k++) {
    if (!s->holds[k].alive || s->holds[k].wire != wire) continue;
    out[n++] = s->holds[k].s1;
    out[n++] = s->holds[k].s2;
  }
  return n + sw_scene_join_places(s, wire, out + n);
}

/* Room for them and one more, to be freed; NULL: out of memory. */
static double *new_places(const sw_scene *s, size_t wire) {
  return sw_alloc(2 * s->hold_count + sw_scene_join_places(s, wire, NULL) + 2, sizeof(double));
}

/* The interval a hold takes, in the mesh's arc lengths. */
static void held_interval(const sw_mesh *m, const sw_hold_args *a, double *s1, double *s2) {
  *s1 = sw_mesh_snap(m, a->s - 0.5 * a->width);
  *s2 = sw_mesh_snap(m, a->s + 0.5 * a->width);
}

static sw_status check_place(const sw_scene *s, const sw_link_class *cls, size_t wire,
                             const sw_hold_args *a, sw_error *err) {
  const sw_scene_wire *w = &s->wires[wire];
  const double start = w->mesh.s[0], length = w->mesh.s[w->mesh.n - 1] - start;
  if (a->s - start > length * (1 + 1e-9))
    return sw_fail(err, SW_EINVAL, "%s: s = %.6g m is not on wire '%s', which ends at %.6g m",
                   cls->name, a->s - start, w->name, length);
  double s1, s2;
  held_interval(&w->mesh, a, &s1, &s2);
  if (w->strand.web) sw_strand_rings(&w->mesh, &s1, &s2);
  return sw_scene_check_clear(s, wire, NULL, cls->name, s1, s2, err);
}

/* Fewest edges between two holds: with four the bending stiffness between two
 * clamps is 2 to 5 % low, with three 5 to 10 %, and one edge would be rigid. No
 * more than needed, because a bent wire's energy grows when edges are halved. */
enum { LEAST_EDGES = 4 };

/* Halve every edge between the nodes at arc lengths low and high. */
static sw_status halve_edges(sw_mesh *m, double low, double high) {
  const size_t first = sw_mesh_node(m, low), count = sw_mesh_node(m, high) - first + 1;
  double placed, *nodes = sw_alloc(count, sizeof *nodes);
  if (!nodes) return SW_ENOMEM;
  memcpy(nodes, m->s + first, count * sizeof *nodes);
  sw_status status = SW_OK;
  for (size_t i = 0; i + 1 < count && status == SW_OK; i++)
    status = sw_mesh_place(m, 0.5 * (nodes[i] + nodes[i + 1]), nodes, count, &placed);
  sw_free(nodes);
  return status;
}

/* Enough edges between h and the holds beside it. */
static sw_status refine_gaps(const sw_scene *s, size_t wire, const sw_hold *h, sw_mesh *m) {
  for (size_t k = 0; k < s->hold_count; k++) {
    const sw_hold *o = &s->holds[k];
    if (!o->alive || o->wire != wire || o == h) continue;
    const double low = o->s2 < h->s1 ? o->s2 : h->s2, high = o->s2 < h->s1 ? h->s1 : o->s1;
    for (size_t before = 0; low < high && before < m->n;) { /* ends when nothing is halved */
      before = m->n;
      if (sw_mesh_node(m, high) - sw_mesh_node(m, low) < LEAST_EDGES)
        SW_TRY(halve_edges(m, low, high));
    }
  }
  return SW_OK;
}

/* How far arc length s is from the nearest node [m]. */
static double off_nodes(const sw_mesh *m, double s) {
  const size_t i = sw_mesh_node(m, s);
  return i > 0 ? fmin(fabs(m->s[i] - s), s - m->s[i - 1]) : fabs(m->s[i] - s);
}

static sw_status place_nodes(sw_scene *s, size_t wire, sw_hold *h, const sw_hold_args *a) {
  sw_mesh *m = &s->wires[wire].mesh;
  if (s->wires[wire].strand.web) {
    held_interval(m, a, &h->s1, &h->s2);
    sw_strand_rings(m, &h->s1, &h->s2);
    return SW_OK;
  }
  double ends[2], placed[2], *keep = new_places(s, wire);
  if (!keep) return SW_ENOMEM;
  size_t n = kept_places(s, wire, keep);
  held_interval(m, a, &ends[0], &ends[1]);
  /* an end that is nearer to a node takes it first, from whichever end arc length counts */
  const int order = off_nodes(m, ends[1]) < off_nodes(m, ends[0]);
  sw_status status = sw_mesh_place(m, ends[order], keep, n, &placed[order]);
  placed[!order] = placed[order];
  if (status == SW_OK && a->width > 0) {
    keep[n++] = placed[order];
    status = sw_mesh_place(m, ends[!order], keep, n, &placed[!order]);
  }
  h->s1 = placed[0], h->s2 = placed[1];
  sw_free(keep);
  return status;
}

/* Where the held places are in the hold's frame, whose origin is the point at
 * s and whose axes are the world's at this moment. */
static sw_status take_hold(const sw_mesh *m, sw_hold *h, const sw_hold_args *a) {
  const size_t first = sw_mesh_node(m, h->s1), last = sw_mesh_node(m, h->s2);
  h->count = last - first + 1;
  h->s = sw_alloc(h->count, sizeof *h->s);
  h->local = sw_alloc(3 * h->count, sizeof *h->local);
  if (!h->s || !h->local) return SW_ENOMEM;
  sw_vec origin = sw_vec_at(m->x, first);
  for (size_t i = first; i < last; i++)
    if (m->s[i + 1] >= a->s && m->s[i] <= a->s)
      origin = sw_lerp(sw_vec_at(m->x, i), sw_vec_at(m->x, i + 1),
                       (a->s - m->s[i]) / (m->s[i + 1] - m->s[i]));
  for (size_t i = first; i <= last; i++) {
    h->s[i - first] = m->s[i];
    sw_store(h->local + 3 * (i - first), sw_sub(sw_vec_at(m->x, i), origin));
  }
  h->drive.pose = (sw_pose){origin, sw_quat_identity()};
  h->last_pose = h->drive.pose;
  h->turn = h->drive.pose.q;
  return SW_OK;
}

/* The same of the particles of a mesh. With a direction given the hold's pose is turned to it,
 * while the wire is not yet. */
static sw_status take_particles(const sw_scene_wire *w, sw_hold *h, const sw_hold_args *a) {
  const sw_web *web = w->strand.web;
  const sw_mesh *m = &w->mesh;
  const size_t first = sw_mesh_node(m, h->s1), last = sw_mesh_node(m, h->s2);
  const size_t room = web->first[last + 1] - web->first[first];
  h->s = sw_alloc(room, sizeof *h->s);
  h->local = sw_alloc(3 * room, sizeof *h->local);
  h->particle = sw_alloc(room, sizeof *h->particle);
  if (!h->s || !h->local || !h->particle) return SW_ENOMEM;
  size_t i = first < last ? first : first + 1 < m->n ? first : first - 1;
  while (i + 2 < m->n && m->s[i + 1] < a->s) i++;
  const double f = fmin(1.0, fmax(0.0, (a->s - m->s[i]) / (m->s[i + 1] - m->s[i])));
  const sw_vec origin = sw_lerp(sw_vec_at(m->x, i), sw_vec_at(m->x, i + 1), f);
  const sw_quat turn = sw_quat_between(sw_mesh_tangent_at(m, a->s), h->director[1]);
  for (size_t p = web->first[first]; p < web->first[last + 1]; p++) {
    if (!sw_strand_holds(web, h->cls, p)) continue;
    h->s[h->count] = web->s[p];
    h->particle[h->count] = (uint32_t)p;
    sw_store(h->local + 3 * h->count++, sw_sub(sw_vec_at(w->strand.x, p), origin));
  }
  h->drive.pose = (sw_pose){origin, turn};
  h->last_pose = h->drive.pose;
  h->turn = sw_quat_identity();
  return SW_OK;
}

/* The held directions, taken before nodes move: a moved node turns the edges
 * beside it. */
static void take_directions(const sw_mesh *m, sw_hold *h, const sw_hold_args *a) {
  double s[2];
  held_interval(m, a, &s[0], &s[1]);
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

static sw_status check_axis(const sw_scene_wire *w, const sw_link_class *cls, const char *what,
                            sw_error *err) {
  const sw_web *web = w->strand.web;
  if (!web || cls->hold->direction || web->axis != web->per_ring) return SW_OK;
  return sw_fail(err, SW_EINVAL,
                 "%s: wire '%s' has no particle on its axis to be held; give the mesh a middle "
                 "(tube: core = true; cubic: across even)",
                 what, w->name);
}

sw_status sw_scene_add_hold(sw_scene *s, const sw_link_class *cls, sw_handle wire,
                            const sw_hold_args *given, sw_handle *out, sw_error *err) {
  sw_hold_args own = *given;
  const sw_hold_args *args = &own;
  const sw_hold_acts *acts = cls->hold;
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_scene_readable(s, err));
  if (!sw_scene_find_wire(s, wire, err)) return SW_EDEAD;
  own.s += s->wires[wire.slot].mesh.s[0];
  SW_TRY(check_place(s, cls, wire.slot, args, err));
  if (acts->lines) SW_TRY(sw_scene_check_line(&s->wires[wire.slot], cls->name, err));
  SW_TRY(check_axis(&s->wires[wire.slot], cls, cls->name, err));
  const sw_link_wire on_wire = sw_scene_link_wire(s, wire.slot);
  if (acts->check) SW_TRY(acts->check(&on_wire, &own, err));
  const sw_joint *join = acts->passes ? sw_scene_joined(s, wire.slot) : NULL;
  if (join)
    return sw_fail(err, SW_EINVAL, "feed: wire '%s' is joined to others by '%s': it cannot be fed",
                   s->wires[wire.slot].name, join->name);
  SW_TRY(sw_scene_thaw(s));
  SW_TRY(sw_grow((void **)&s->holds, &s->hold_capacity, s->hold_count + 1, sizeof *s->holds));
  sw_hold h = {.generation = s->serial + 1, .alive = 1, .cls = cls, .wire = wire.slot};
  h.args = *args, h.scale = s->wires[wire.slot].mesh.scale, h.shape = s->serial + 1;
  if (args->name[0])
    memcpy(h.name, args->name, sizeof h.name);
  else
    snprintf(h.name, sizeof h.name, "%s%zu", cls->name, s->hold_count + 1);
  take_directions(&s->wires[wire.slot].mesh, &h, args);
  sw_status status = place_nodes(s, wire.slot, &h, args);
  const sw_scene_wire *on = &s->wires[wire.slot];
  if (status == SW_OK && on->strand.web)
    status = take_particles(on, &h, args);
  else if (status == SW_OK)
    status = take_hold(&on->mesh, &h, args);
  if (status == SW_OK && !on->strand.web)
    status = refine_gaps(s, wire.slot, &h, &s->wires[wire.slot].mesh);
  if (status == SW_OK && acts->begin) {
    const sw_link_wire of = sw_scene_link_wire(s, wire.slot);
    status = acts->begin(&h, &of);
  }
  sw_hold_forget(&h.args);
  if (status != SW_OK) {
    sw_hold_clear(&h);
    return sw_fail(err, status, "%s: out of memory", cls->name);
  }
  *out = (sw_handle){(uint32_t)s->hold_count, ++s->serial};
  s->holds[s->hold_count++] = h;
  return SW_OK;
}

/* Places and directions as they are now, in a frame at a pose. */
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

/* Can a hold take the wire that has become another one? Those that are alive have done so. */
static sw_status check_again(const sw_scene *s, const sw_hold *h, const sw_hold_args *a,
                             sw_error *err) {
  const sw_scene_wire *w = &s->wires[h->wire];
  const sw_web *web = w->strand.web;
  char what[4 * SW_NAME_SIZE];
  double s1, s2;
  held_interval(&w->mesh, a, &s1, &s2);
  if (web) sw_strand_rings(&w->mesh, &s1, &s2);
  snprintf(what, sizeof what, "remodel to '%s', %s '%s'", w->cls->name, h->cls->name, h->name);
  SW_TRY(check_axis(w, h->cls, what, err));
  return sw_scene_check_clear(s, h->wire, h, what, s1, s2, err);
}

sw_status sw_scene_rehold(sw_scene *s, sw_hold *h, sw_pose pose, sw_error *err) {
  const sw_scene_wire *w = &s->wires[h->wire];
  sw_hold_args a = h->args;
  sw_hold new = *h;
  a.s = 0.5 * (h->s1 + h->s2), a.direction = sw_v(NAN, NAN, NAN);
  new.s = new.local = NULL, new.particle = NULL, new.count = 0;
  h->alive = 0; /* its own places are not in its way */
  take_directions(&w->mesh, &new, &a);
  for (int k = 0; k < 2; k++) new.give[k].axis = sw_rotate(pose.q, h->give[k].axis);
  sw_status status = check_again(s, h, &a, err);
  if (status == SW_OK) status = place_nodes(s, h->wire, &new, &a);
  if (status == SW_OK)
    status = w->strand.web ? take_particles(w, &new, &a) : take_hold(&w->mesh, &new, &a);
  if (status == SW_OK && !w->strand.web)
    status = refine_gaps(s, h->wire, &new, &s->wires[h->wire].mesh);
  h->alive = 1;
  if (status != SW_OK) {
    sw_free(new.s);
    sw_free(new.local);
    sw_free(new.particle);
    return status;
  }
  seen_from(&new, pose);
  new.alive = 1, new.drive = h->drive, new.last_pose = h->last_pose, new.turn = pose.q;
  new.shape = ++s->serial;
  sw_free(h->s);
  sw_free(h->local);
  sw_free(h->particle);
  *h = new;
  return SW_OK;
}

/* --- another mesh ------------------------------------------------------------------ */

sw_status sw_scene_copy_shape(const sw_hold *from, sw_hold *to) {
  double *s = sw_alloc(from->count, sizeof *s), *local = sw_alloc(3 * from->count, sizeof *local);
  uint32_t *particle = from->particle ? sw_alloc(from->count, sizeof *particle) : NULL;
  if (!s || !local || (from->particle && !particle)) {
    sw_free(s);
    sw_free(local);
    sw_free(particle);
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
  sw_mesh *m = &s->wires[h->wire].mesh;
  sw_hold_args a = h->args;
  sw_hold new = *h;
  a.s = fmin(a.s * m->scale / h->scale, m->s[m->n - 1]);
  new.s = new.local = NULL;
  take_directions(m, &new, &a);
  sw_status status = place_nodes(s, h->wire, &new, &a);
  if (status == SW_OK) status = take_hold(m, &new, &a);
  if (status == SW_OK) status = refine_gaps(s, h->wire, &new, m);
  if (status != SW_OK) {
    sw_free(new.s);
    sw_free(new.local);
    return status;
  }
  new.drive = h->drive, new.last_pose = h->last_pose, new.turn = h->turn;
  new.alive = 1, new.shape = ++s->serial;
  sw_free(h->s);
  sw_free(h->local);
  *h = new;
  return SW_OK;
}

/* Make s a node of the mesh, of exactly this arc length. */
static sw_status place_exactly(sw_mesh *m, double s, const double *keep, size_t count) {
  double placed;
  SW_TRY(sw_mesh_place(m, s, keep, count, &placed));
  m->s[sw_mesh_node(m, placed)] = s;
  return SW_OK;
}

sw_status sw_scene_make_places(const sw_scene *s, size_t wire, sw_mesh *m) {
  double *keep = new_places(s, wire);
  if (!keep) return SW_ENOMEM;
  const size_t n = kept_places(s, wire, keep);
  sw_status status = SW_OK;
  for (size_t k = 0; k < n && status == SW_OK; k++) status = place_exactly(m, keep[k], keep, n);
  sw_free(keep);
  for (size_t k = 0; k < s->hold_count && status == SW_OK; k++)
    if (s->holds[k].alive && s->holds[k].wire == wire)
      status = refine_gaps(s, wire, &s->holds[k], m);
  return status;
}

sw_status sw_scene_release_hold(sw_scene *s, sw_handle hold, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  sw_hold *h = sw_scene_find_hold(s, hold, err);
  if (!h) return SW_EDEAD;
  if (!h->alive) return SW_OK;
  sw_motion_state now;
  SW_TRY(sw_drive_eval(s, &h->drive, s->time, &now, err));
  SW_TRY(sw_scene_thaw(s));
  h->last_pose = now.pose;
  h->alive = 0;
  sw_drive_free(&h->drive);
  return SW_OK;
}

sw_status sw_scene_follow(sw_scene *s, sw_handle hold, sw_motion *motion, int relative,
                          sw_error *err) {
  sw_hold *h = sw_scene_living_hold(s, hold, err);
  if (!h) return SW_EDEAD;
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_drive_follow(s, &h->drive, h->name, motion, relative, err));
  sw_course_jump(&s->course);
  return SW_OK;
}

sw_status sw_scene_set_pose(sw_scene *s, sw_handle hold, sw_pose pose, sw_error *err) {
  sw_hold *h = sw_scene_living_hold(s, hold, err);
  if (!h) return SW_EDEAD;
  SW_TRY(sw_scene_editable(s, err));
  if (h->drive.tool)
    return sw_fail(err, SW_EINVAL, "'%s' goes with gripper '%s'; move that", h->name,
                   s->tools[h->drive.tool - 1].name);
  sw_drive_free(&h->drive);
  h->drive = (sw_drive){.pose = pose};
  sw_course_jump(&s->course);
  return SW_OK;
}

sw_status sw_scene_hold_pose(sw_scene *s, sw_handle hold, sw_pose *out, sw_error *err) {
  sw_motion_state now;
  sw_hold *h = sw_scene_find_hold(s, hold, err);
  if (!h) return SW_EDEAD;
  *out = h->last_pose;
  if (!h->alive) return SW_OK;
  SW_TRY(sw_drive_eval(s, &h->drive, s->time, &now, err));
  *out = now.pose;
  return SW_OK;
}

sw_status sw_scene_hold_force(sw_scene *s, sw_handle hold, const sw_vec *about, sw_vec *force,
                              sw_vec *moment, sw_error *err) {
  sw_pose pose;
  SW_TRY(sw_scene_readable(s, err));
  sw_hold *h = sw_scene_living_hold(s, hold, err);
  if (!h) return SW_EDEAD;
  if (about) SW_TRY(sw_scene_hold_pose(s, hold, &pose, err));
  *force = h->force;
  *moment = about ? sw_add(h->moment, sw_cross(sw_sub(pose.p, *about), h->force)) : h->moment;
  return SW_OK;
}

sw_status sw_scene_hold_args(const sw_scene *s, sw_handle hold, const sw_params **rows,
                             sw_hold_args *out, sw_error *err) {
  const sw_hold *h = sw_scene_living_hold(s, hold, err);
  if (!h) return SW_EDEAD;
  *rows = &h->cls->params;
  *out = h->args;
  out->s -= s->wires[h->wire].mesh.s[0];
  memcpy(out->name, h->name, sizeof out->name);
  if (h->cls->hold->get) h->cls->hold->get(h, out);
  return SW_OK;
}

sw_status sw_scene_set_hold(sw_scene *s, sw_handle hold, const sw_hold_args *args, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  sw_hold *h = sw_scene_living_hold(s, hold, err);
  if (!h) return SW_EDEAD;
  SW_TRY(sw_scene_thaw(s));
  if (h->cls->hold->set) h->cls->hold->set(h, args);
  return SW_OK;
}

sw_status sw_scene_slide_state(sw_scene *s, sw_handle hold, sw_slide_state *out, sw_error *err) {
  SW_TRY(sw_scene_readable(s, err));
  const sw_hold *h = sw_scene_living_hold(s, hold, err);
  if (!h) return SW_EDEAD;
  if (!h->cls->hold->rail)
    return sw_fail(err, SW_EINVAL, "%s '%s' has no rail: wires slide along those of scene:slider",
                   h->cls->name, h->name);
  *out = (sw_slide_state){h->slider.p, h->slider.v, h->slider.force};
  return SW_OK;
}

sw_status sw_scene_hold_log(sw_scene *s, sw_handle hold, const double **rows, size_t *count,
                            sw_error *err) {
  SW_TRY(sw_scene_readable(s, err));
  const sw_hold *h = sw_scene_find_hold(s, hold, err);
  if (!h) return SW_EDEAD;
  *rows = h->log.rows;
  *count = h->log.count / SW_LOG_SIZE;
  return SW_OK;
}

sw_status sw_scene_obstacle_log(sw_scene *s, sw_handle obstacle, const double **rows, size_t *count,
                                sw_error *err) {
  SW_TRY(sw_scene_readable(s, err));
  const char *kind;
  int present; /* a removed obstacle's series can still be read */
  if (!sw_scene_obstacle_name(s, obstacle, &kind, &present))
    return sw_fail(err, SW_EDEAD, "this obstacle is not of scene '%s' any more", s->name);
  sw_scene_obstacle *o = &s->obstacles[obstacle.slot];
  if (sw_obstacle_log_fill(s, o) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "out of memory for the series of '%s'", o->name);
  *rows = o->log.rows;
  *count = o->log.count / SW_LOG_OBSTACLE_SIZE;
  return SW_OK;
}
