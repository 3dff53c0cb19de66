/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Joins: points where wires are fixed to each other. */
#include "body/join.h"

#include <math.h>
#include <stdint.h>

#include "base/alloc.h"
#include "body/build.h"
#include "edit/edit.h"
#include "edit/links.h"
#include "link/hold.h"
#include "link/joint.h"
#include "scene/lookup.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "state/mesh.h"

/* Largest distance of the ends from each other, over the shortest segment there [-]. */
static const double LARGEST_GAP = 0.02;
typedef sw_joint_end end;

static void measure(const sw_scene *s, sw_joint *j) {
  sw_link_wire wires[SW_JOIN_ENDS];
  sw_scene_joint_wires(s, j, wires);
  if (j->cls->joint->measure) j->cls->joint->measure(j, wires);
}

void sw_scene_measure_joins(sw_scene *s) {
  SW_EACH(join, j, s) {
    int drawn = j->alive;
    for (size_t i = 0; i < j->count && drawn; i++)
      drawn &= sw_scene_wire_in(s, j->ends[i].wire)->mesh.drawn;
    if (drawn) measure(s, j);
  }
}

/* --- making ----------------------------------------------------------------------- */

static sw_status check_end(const sw_scene *s, const sw_join_end *ends, size_t k, sw_error *err) {
  SW_FIND(const sw_scene_wire, w, sw_scene_find_wire(s, ends[k].wire, err));
  const double length = w->mesh.s[w->mesh.n - 1] - w->mesh.s[0];
  if (!(ends[k].s >= 0 && ends[k].s <= length * (1 + 1e-9)))
    return sw_fail(err, SW_EINVAL,
                   "scene:join: s = %.6g m is not on wire '%s', which goes from 0 to %.6g m",
                   ends[k].s, w->name, length);
  for (size_t i = 0; i < k; i++)
    if (ends[i].wire.slot == ends[k].wire.slot &&
        fabs(ends[i].s - ends[k].s) * (double)(w->mesh.n - 1) < 3.0 * length)
      return sw_fail(err, SW_EINVAL,
                     "scene:join: wire '%s' is joined to itself at s = %.6g and %.6g m, less than "
                     "three segments apart",
                     w->name, ends[i].s, ends[k].s);
  SW_EACH(hold, hold, s)
    if (hold->alive && hold->wire == ends[k].wire.slot && sw_hold_passes(hold))
      return sw_fail(err, SW_EINVAL, "scene:join: wire '%s' is fed by '%s': it cannot be joined",
                     w->name, hold->name);
  return SW_OK;
}

/* Returns the wire's place at arc length s. */
static sw_vec point_at(const sw_mesh *m, double s) {
  size_t i = 0;
  while (i + 2 < m->n && m->s[i + 1] <= s) i++;
  return sw_lerp(sw_vec_at(m->x, i), sw_vec_at(m->x, i + 1),
                 (s - m->s[i]) / (m->s[i + 1] - m->s[i]));
}

/* SW_EINVAL when the ends do not meet. Called before anything is changed. */
static sw_status check_meeting(const sw_scene *s, const sw_join_end *ends, size_t count,
                               sw_error *err) {
  double least = HUGE_VAL;
  for (size_t k = 0; k < count; k++) {
    const sw_mesh *m = &sw_scene_wire_in(s, ends[k].wire.slot)->mesh;
    least = fmin(least, (m->s[m->n - 1] - m->s[0]) / (double)(m->n - 1));
  }
  const sw_scene_wire *first = sw_scene_wire_in(s, ends[0].wire.slot);
  const sw_vec at = point_at(&first->mesh, first->mesh.s[0] + ends[0].s);
  for (size_t k = 1; k < count; k++) {
    const sw_scene_wire *w = sw_scene_wire_in(s, ends[k].wire.slot);
    const double gap = sw_dist(at, point_at(&w->mesh, w->mesh.s[0] + ends[k].s));
    if (!(gap <= LARGEST_GAP * least))
      return sw_fail(err, SW_EINVAL,
                     "scene:join: '%s' at s = %.6g m is %.4g m away from '%s' at s = %.6g m; ends "
                     "must meet within %.2g m",
                     w->name, ends[k].s, gap, first->name, ends[0].s, LARGEST_GAP * least);
  }
  return SW_OK;
}

/* Returns the arc lengths that holds and joins of the wire need as nodes, with room for more. */
static double *places_of(const sw_scene *s, size_t wire, size_t *count) {
  const size_t joins = sw_scene_join_places(s, wire, NULL);
  double *keep = sw_alloc(2 * sw_scene_living_holds(s) + joins + SW_JOIN_ENDS, sizeof *keep);
  *count = 0;
  if (!keep) return NULL;
  SW_EACH(hold, h, s) {
    if (!h->alive || h->wire != wire) continue;
    keep[(*count)++] = h->s1;
    keep[(*count)++] = h->s2;
  }
  *count += sw_scene_join_places(s, wire, keep + *count);
  return keep;
}

static sw_status place_ends(sw_scene *s, sw_joint *j) {
  for (size_t k = 0; k < j->count; k++) {
    end *e = &j->ends[k];
    size_t count;
    double *keep = places_of(s, e->wire, &count);
    if (!keep) return SW_ENOMEM;
    for (size_t i = 0; i < k; i++)
      if (j->ends[i].wire == e->wire) keep[count++] = j->ends[i].s;
    const sw_status status =
        sw_mesh_place(&sw_scene_wire_in(s, e->wire)->mesh, e->asked, keep, count, &e->s);
    sw_free(keep);
    if (status != SW_OK) return status;
  }
  return SW_OK;
}

sw_status sw_scene_add_join(sw_scene *s, const sw_join_args *args, const sw_join_end *ends,
                            size_t count, sw_handle *out, sw_error *err) {
  SW_TRY(sw_scene_ready(s, err));
  if (count < 2 || count > SW_JOIN_ENDS)
    return sw_fail(err, SW_EINVAL, "scene:join: ends lists %zu wire%s; it must be from 2 to %d",
                   count, count == 1 ? "" : "s", SW_JOIN_ENDS);
  for (size_t k = 0; k < count; k++) {
    SW_TRY(check_end(s, ends, k, err));
    SW_TRY(sw_scene_check_line(sw_scene_wire_in(s, ends[k].wire.slot), "scene:join", err));
  }
  const sw_link_class *cls = sw_joint_class(args->slack);
  if (cls->joint->apart && count != 2)
    return sw_fail(err, SW_EINVAL,
                   "scene:join: with slack it is a tie, which has 2 wires; ends lists %zu", count);
  SW_TRY(sw_scene_unbuild(s));
  if (!cls->joint->apart) SW_TRY(check_meeting(s, ends, count, err));
  sw_joint j = {.alive = 1,
                .rigid = args->rigid && !cls->joint->apart,
                .cls = cls,
                .count = count,
                .slack = args->slack,
                .stiffness = args->stiffness,
                .strength = args->strength};
  for (size_t k = 0; k < count; k++) {
    const sw_mesh *m = &sw_scene_wire_in(s, ends[k].wire.slot)->mesh;
    j.ends[k] = (end){.wire = ends[k].wire.slot,
                      .asked = sw_mesh_snap(m, m->s[0] + ends[k].s),
                      .scale = m->scale};
  }
  sw_scene_give_name(j.name, args->name, "join", sw_scene_join_slots(s));
  sw_status status = place_ends(s, &j);
  if (status == SW_OK) status = sw_scene_add(s, SW_OF_JOIN, &j, out);
  if (status != SW_OK) return sw_fail(err, status, "scene:join: out of memory");
  measure(s, sw_scene_join_in(s, out->slot));
  return SW_OK;
}

/* --- another mesh ----------------------------------------------------------------- */

sw_status sw_scene_retake_joins(sw_scene *s, size_t wire) {
  sw_mesh *m = &sw_scene_wire_in(s, wire)->mesh;
  size_t count;
  double *keep = places_of(s, wire, &count);
  if (!keep) return SW_ENOMEM;
  sw_status status = SW_OK;
  count -= sw_scene_join_places(s, wire, NULL); /* joins' places belong to the mesh before */
  SW_EACH(join, j, s)
    for (size_t i = 0; j->alive && i < j->count && status == SW_OK; i++) {
      end *e = &j->ends[i];
      if (e->wire != wire) continue;
      const double at = sw_mesh_snap(m, e->asked * m->scale / e->scale);
      status = sw_mesh_place(m, at, keep, count, &e->s);
      keep[count++] = e->s;
    }
  sw_free(keep);
  return status;
}

/* --- handles ---------------------------------------------------------------------- */

size_t sw_scene_join_ends(const sw_scene *s, sw_handle h) {
  const sw_joint *j = sw_scene_find_join(s, h, NULL);
  return j ? j->count : 0;
}

sw_status sw_scene_release_join(sw_scene *s, sw_handle h, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  SW_FIND(sw_joint, j, sw_scene_find_join(s, h, err));
  if (!j->alive) return SW_OK;
  SW_TRY(sw_scene_unbuild(s));
  j->alive = 0;
  return SW_OK;
}

sw_status sw_scene_join_force(sw_scene *s, sw_handle h, size_t k, sw_vec *force, sw_vec *moment,
                              sw_error *err) {
  SW_TRY(sw_scene_readable(s, err));
  SW_TRY(sw_scene_still(s, err));
  SW_FIND(const sw_joint, j, sw_scene_find_join(s, h, err));
  *force = *moment = sw_v(0, 0, 0);
  if (k >= j->count)
    return sw_fail(err, SW_EINVAL, "join '%s': there is no end %zu; it has %zu", j->name, k + 1,
                   j->count);
  if (!j->alive) return SW_OK;
  SW_TRY(sw_scene_build(s, err));
  sw_link_wire wires[SW_JOIN_ENDS];
  sw_scene_joint_wires(s, j, wires);
  j->cls->joint->force(j, wires, sw_scene_system(s)->x, k, force, moment);
  if (j->evened) *force = j->bears[k];
  return SW_OK;
}

sw_status sw_scene_read_join(sw_scene *s, sw_handle h, const char *const **names,
                             double out[SW_LINK_OUTPUTS], sw_error *err) {
  SW_TRY(sw_scene_readable(s, err));
  SW_TRY(sw_scene_still(s, err));
  SW_FIND(const sw_joint, j, sw_scene_find_join(s, h, err));
  const sw_joint_acts *acts = j->cls->joint;
  *names = acts->outputs;
  if (!acts->read)
    return sw_fail(err, SW_EINVAL, "join '%s' is not a tie: it was made without slack", j->name);
  int there = 1;
  for (size_t k = 0; k < j->count; k++) there &= j->ends[k].wire != SIZE_MAX;
  if (there) SW_TRY(sw_scene_build(s, err));
  sw_link_wire wires[SW_JOIN_ENDS];
  if (there) sw_scene_joint_wires(s, j, wires);
  acts->read(j, there ? wires : NULL, out);
  return SW_OK;
}
