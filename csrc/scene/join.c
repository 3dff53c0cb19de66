/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Joins: points where wires are fixed to each other. */
#include "system/join.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "scene/world.h"

static const sw_param rows[] = {
    {"ends", SW_PARAM_OTHER, "m", 0, 0, 0, 0, NULL, 0,
     "list of { wire, s = arc length } that meet in the point"},
    {"rigid", SW_PARAM_BOOLEAN, "-", 1, 0, 1, 0, NULL, offsetof(sw_join_args, rigid),
     "the angles between the wires are kept; false: they turn freely"},
    {"name", SW_PARAM_TEXT, "-", 0, 0, 0, 0, NULL, offsetof(sw_join_args, name),
     "name used in messages"},
    {"slack", SW_PARAM_NUMBER, "m", NAN, 0, HUGE_VAL, 0, NULL, offsetof(sw_join_args, slack),
     "a tie: two wires that only may not be further apart than this, and need not meet"},
    {"stiffness", SW_PARAM_NUMBER, "N/m", 1e5, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(sw_join_args, stiffness), "of a tie that is taut"},
    {"strength", SW_PARAM_NUMBER, "N", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(sw_join_args, strength), "pull at which a tie breaks (default: never)"},
};
const sw_params sw_join_params = SW_PARAMS("scene:join", rows);

/* How far from each other the ends may be, of the shortest segment there [-]. */
static const double LARGEST_GAP = 0.02;
/* A join's springs are this much stiffer than the stiffest segment there [-]. */
static const double STIFFER = 100.0;

typedef struct sw_scene_join_end end;

static size_t node_of(const sw_scene *s, const end *e) {
  return sw_mesh_node(&s->wires[e->wire].mesh, e->s);
}

static sw_vec place_of(const sw_scene *s, const end *e) {
  return sw_vec_at(s->wires[e->wire].mesh.x, node_of(s, e));
}

/* The nodes between which the wire's direction at the join is taken: the edge there where it
 * ends, the two beside it in mid-wire. */
static void arm_of(const sw_scene *s, const end *e, size_t nodes[2]) {
  const size_t i = node_of(s, e), last = s->wires[e->wire].mesh.n - 1;
  nodes[0] = i == 0 ? 0 : i - 1;
  nodes[1] = i == last ? last : i + 1;
}

/* --- what a join keeps ------------------------------------------------------------ */

/* Where a wire that is straight at rest goes there, or its edges where they are bent without
 * load. */
static sw_vec direction_of(const sw_scene *s, const end *e) {
  const sw_scene_wire *w = &s->wires[e->wire];
  size_t nodes[2];
  arm_of(s, e, nodes);
  if (!w->beam.curved) return sw_mesh_tangent(&w->mesh, node_of(s, e));
  return sw_unit_or(sw_sub(sw_vec_at(w->mesh.x, nodes[1]), sw_vec_at(w->mesh.x, nodes[0])),
                    sw_v(1, 0, 0));
}

static void measure(const sw_scene *s, sw_scene_join *j) {
  for (size_t k = 0; k < j->count; k++) {
    end *e = &j->ends[k];
    e->offset = sw_sub(place_of(s, e), place_of(s, &j->ends[0]));
    e->rest = direction_of(s, e);
  }
}

void sw_scene_measure_joins(sw_scene *s) {
  for (size_t k = 0; k < s->join_count; k++) {
    int drawn = s->joins[k].alive;
    for (size_t i = 0; i < s->joins[k].count; i++)
      drawn &= s->wires[s->joins[k].ends[i].wire].mesh.drawn;
    if (drawn) measure(s, &s->joins[k]);
  }
}

/* --- making ----------------------------------------------------------------------- */

static sw_status check_end(const sw_scene *s, const sw_join_end *ends, size_t k, sw_error *err) {
  const sw_scene_wire *w = sw_scene_find_wire(s, ends[k].wire, err);
  if (!w) return SW_EDEAD;
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
  for (size_t h = 0; h < s->hold_count; h++)
    if (s->holds[h].alive && s->holds[h].wire == ends[k].wire.slot && s->holds[h].cls->feeds)
      return sw_fail(err, SW_EINVAL, "scene:join: wire '%s' is fed by '%s': it cannot be joined",
                     w->name, s->holds[h].name);
  return SW_OK;
}

/* Where the wire is at arc length s. */
static sw_vec point_at(const sw_mesh *m, double s) {
  size_t i = 0;
  while (i + 2 < m->n && m->s[i + 1] <= s) i++;
  return sw_lerp(sw_vec_at(m->x, i), sw_vec_at(m->x, i + 1),
                 (s - m->s[i]) / (m->s[i + 1] - m->s[i]));
}

/* Before anything is changed: do the ends meet? */
static sw_status check_meeting(const sw_scene *s, const sw_join_end *ends, size_t count,
                               sw_error *err) {
  double least = HUGE_VAL;
  for (size_t k = 0; k < count; k++) {
    const sw_mesh *m = &s->wires[ends[k].wire.slot].mesh;
    least = fmin(least, (m->s[m->n - 1] - m->s[0]) / (double)(m->n - 1));
  }
  const sw_scene_wire *first = &s->wires[ends[0].wire.slot];
  const sw_vec at = point_at(&first->mesh, first->mesh.s[0] + ends[0].s);
  for (size_t k = 1; k < count; k++) {
    const sw_scene_wire *w = &s->wires[ends[k].wire.slot];
    const double gap = sw_dist(at, point_at(&w->mesh, w->mesh.s[0] + ends[k].s));
    if (!(gap <= LARGEST_GAP * least))
      return sw_fail(err, SW_EINVAL,
                     "scene:join: '%s' at s = %.6g m is %.4g m away from '%s' at s = %.6g m; ends "
                     "must meet, within %.2g m here",
                     w->name, ends[k].s, gap, first->name, ends[0].s, LARGEST_GAP * least);
  }
  return SW_OK;
}

/* Arc lengths that holds and joins of the wire need as nodes, with room for some more. */
static double *places_of(const sw_scene *s, size_t wire, size_t *count) {
  const size_t joins = sw_scene_join_places(s, wire, NULL);
  double *keep = sw_alloc(2 * s->hold_count + joins + SW_JOIN_ENDS, sizeof *keep);
  *count = 0;
  if (!keep) return NULL;
  for (size_t k = 0; k < s->hold_count; k++) {
    if (!s->holds[k].alive || s->holds[k].wire != wire) continue;
    keep[(*count)++] = s->holds[k].s1;
    keep[(*count)++] = s->holds[k].s2;
  }
  *count += sw_scene_join_places(s, wire, keep + *count);
  return keep;
}

static sw_status place_ends(sw_scene *s, sw_scene_join *j) {
  for (size_t k = 0; k < j->count; k++) {
    end *e = &j->ends[k];
    size_t count;
    double *keep = places_of(s, e->wire, &count);
    if (!keep) return SW_ENOMEM;
    for (size_t i = 0; i < k; i++)
      if (j->ends[i].wire == e->wire) keep[count++] = j->ends[i].s;
    const sw_status status = sw_mesh_place(&s->wires[e->wire].mesh, e->asked, keep, count, &e->s);
    sw_free(keep);
    if (status != SW_OK) return status;
  }
  return SW_OK;
}

sw_status sw_scene_add_join(sw_scene *s, const sw_join_args *args, const sw_join_end *ends,
                            size_t count, sw_handle *out, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_scene_readable(s, err));
  if (count < 2 || count > SW_JOIN_ENDS)
    return sw_fail(err, SW_EINVAL, "scene:join: ends lists %zu wires; it must be from 2 to %d",
                   count, SW_JOIN_ENDS);
  for (size_t k = 0; k < count; k++) {
    SW_TRY(check_end(s, ends, k, err));
    SW_TRY(sw_scene_check_line(&s->wires[ends[k].wire.slot], "scene:join", err));
  }
  const int tie = !isnan(args->slack);
  if (tie && count != 2)
    return sw_fail(err, SW_EINVAL, "scene:join: slack makes it a tie, of 2 wires; ends lists %zu",
                   count);
  SW_TRY(sw_scene_thaw(s));
  if (!tie) SW_TRY(check_meeting(s, ends, count, err));
  sw_scene_join j = {.alive = 1,
                     .rigid = args->rigid && !tie,
                     .count = count,
                     .slack = args->slack,
                     .stiffness = args->stiffness,
                     .strength = args->strength};
  for (size_t k = 0; k < count; k++) {
    const sw_mesh *m = &s->wires[ends[k].wire.slot].mesh;
    j.ends[k] = (end){.wire = ends[k].wire.slot,
                      .asked = sw_mesh_snap(m, m->s[0] + ends[k].s),
                      .scale = m->scale};
  }
  if (args->name[0])
    memcpy(j.name, args->name, sizeof j.name);
  else
    snprintf(j.name, sizeof j.name, "join%zu", s->join_count + 1);
  if (sw_grow((void **)&s->joins, &s->join_capacity, s->join_count + 1, sizeof *s->joins) !=
          SW_OK ||
      place_ends(s, &j) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "scene:join: out of memory");
  measure(s, &j);
  j.generation = ++s->serial;
  *out = (sw_handle){(uint32_t)s->join_count, j.generation};
  s->joins[s->join_count++] = j;
  return SW_OK;
}

/* --- another mesh ----------------------------------------------------------------- */

const sw_scene_join *sw_scene_joined(const sw_scene *s, size_t wire) {
  for (size_t k = 0; k < s->join_count; k++)
    for (size_t i = 0; s->joins[k].alive && i < s->joins[k].count; i++)
      if (s->joins[k].ends[i].wire == wire) return &s->joins[k];
  return NULL;
}

size_t sw_scene_join_places(const sw_scene *s, size_t wire, double *out) {
  size_t n = 0;
  for (size_t k = 0; k < s->join_count; k++)
    for (size_t i = 0; s->joins[k].alive && i < s->joins[k].count; i++) {
      if (s->joins[k].ends[i].wire != wire) continue;
      if (out) out[n] = s->joins[k].ends[i].s;
      n++;
    }
  return n;
}

sw_status sw_scene_retake_joins(sw_scene *s, size_t wire) {
  sw_mesh *m = &s->wires[wire].mesh;
  size_t count;
  double *keep = places_of(s, wire, &count);
  if (!keep) return SW_ENOMEM;
  sw_status status = SW_OK;
  count -= sw_scene_join_places(s, wire, NULL); /* those are of the mesh before */
  for (size_t k = 0; k < s->join_count; k++)
    for (size_t i = 0; s->joins[k].alive && i < s->joins[k].count && status == SW_OK; i++) {
      end *e = &s->joins[k].ends[i];
      if (e->wire != wire) continue;
      const double at = sw_mesh_snap(m, e->asked * m->scale / e->scale);
      status = sw_mesh_place(m, at, keep, count, &e->s);
      keep[count++] = e->s;
    }
  sw_free(keep);
  return status;
}

/* --- into the system -------------------------------------------------------------- */

static uint32_t system_node(const sw_scene *s, const end *e, size_t node) {
  return (uint32_t)(s->system.bodies[e->wire].first_node + node);
}

uint32_t sw_scene_join_node(const sw_scene *s, const end *e) {
  return system_node(s, e, node_of(s, e));
}

/* Stiffness of the stiffest edge beside the join [N/m]. */
static double stiffest(const sw_scene *s, const sw_scene_join *j) {
  double most = 0;
  for (size_t k = 0; k < j->count; k++) {
    const sw_scene_wire *w = &s->wires[j->ends[k].wire];
    size_t nodes[2];
    arm_of(s, &j->ends[k], nodes);
    for (size_t i = nodes[0]; i < nodes[1]; i++)
      most = fmax(most, w->beam.EA / (w->mesh.s[i + 1] - w->mesh.s[i]));
  }
  return most;
}

static sw_status add_springs(sw_scene *s, const sw_scene_join *j) {
  const double k = STIFFER * stiffest(s, j);
  for (size_t a = 0; a < j->count; a++)
    for (size_t b = a + 1; b < j->count; b++) {
      const end *p = &j->ends[a], *q = &j->ends[b];
      const sw_join_spring spring = {.i = system_node(s, p, node_of(s, p)),
                                     .j = system_node(s, q, node_of(s, q)),
                                     .k = k,
                                     .offset = sw_sub(p->offset, q->offset)};
      SW_TRY(sw_system_add_spring(&s->system, &spring));
    }
  return SW_OK;
}

/* From the join to the middles of the edges beside it a wire is bent by its own stiffness,
 * which sticks in the hub: EI over half an edge, of both sides in mid-wire. There the wire's
 * own hinge takes care of the angle between both, and the hub of their mean. [N m] */
static double arm_stiffness(const sw_scene *s, const end *e, const size_t nodes[2]) {
  const sw_scene_wire *w = &s->wires[e->wire];
  double sum = 0;
  sw_recipe recipe;
  w->cls->recipe(&w->beam, &recipe);
  if (!recipe.push) return 0; /* a string */
  for (size_t i = nodes[0]; i < nodes[1]; i++)
    sum += 2.0 * w->beam.EI / (w->mesh.s[i + 1] - w->mesh.s[i]);
  return sum;
}

static sw_status add_hub(sw_scene *s, const sw_scene_join *j) {
  sw_join_hub hub = {0};
  for (size_t k = 0; k < j->count; k++) {
    const end *e = &j->ends[k];
    size_t nodes[2];
    arm_of(s, e, nodes);
    const double stiffness = arm_stiffness(s, e, nodes);
    if (!(stiffness > 0)) continue;
    hub.arms[hub.count++] = (struct sw_join_arm){.from = system_node(s, e, nodes[0]),
                                                 .to = system_node(s, e, nodes[1]),
                                                 .k = stiffness,
                                                 .rest = e->rest};
  }
  return hub.count > 1 ? sw_system_add_hub(&s->system, &hub) : SW_OK;
}

sw_status sw_scene_add_joins(sw_scene *s) {
  for (size_t k = 0; k < s->join_count; k++) {
    if (!s->joins[k].alive) continue;
    if (!isnan(s->joins[k].slack)) {
      SW_TRY(sw_scene_add_tie(s, k));
      continue;
    }
    SW_TRY(add_springs(s, &s->joins[k]));
    if (s->joins[k].rigid) SW_TRY(add_hub(s, &s->joins[k]));
  }
  return SW_OK;
}

/* --- handles ---------------------------------------------------------------------- */

sw_scene_join *sw_scene_find_join(const sw_scene *s, sw_handle h, sw_error *err) {
  if (h.slot < s->join_count && s->joins[h.slot].generation == h.generation)
    return &s->joins[h.slot];
  sw_fail(err, SW_EDEAD, "this join is not of scene '%s' any more", s->name);
  return NULL;
}

const char *sw_scene_join_name(const sw_scene *s, sw_handle h, int *held, size_t *ends) {
  const sw_scene_join *j = sw_scene_find_join(s, h, NULL);
  if (!j) return NULL;
  *held = j->alive;
  *ends = j->count;
  return j->name;
}

sw_status sw_scene_release_join(sw_scene *s, sw_handle h, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  sw_scene_join *j = sw_scene_find_join(s, h, err);
  if (!j) return SW_EDEAD;
  if (!j->alive) return SW_OK;
  SW_TRY(sw_scene_thaw(s));
  j->alive = 0;
  return SW_OK;
}

/* The living join's springs and hub in the system, of its end e. */
static void add_up(const sw_scene *s, const end *e, sw_vec *force, sw_vec *moment) {
  const struct sw_joins *all = s->system.joins;
  const double *x = s->system.x;
  const uint32_t node = system_node(s, e, node_of(s, e));
  size_t nodes[2];
  arm_of(s, e, nodes);
  for (size_t i = 0; i < all->spring_count; i++) {
    const sw_vec f = sw_join_spring_force(&all->springs[i], x);
    if (all->springs[i].i == node) *force = sw_add(*force, f);
    if (all->springs[i].j == node) *force = sw_sub(*force, f);
  }
  for (size_t i = 0; i < all->hub_count; i++)
    for (size_t a = 0; a < all->hubs[i].count; a++)
      if (all->hubs[i].arms[a].from == system_node(s, e, nodes[0]) &&
          all->hubs[i].arms[a].to == system_node(s, e, nodes[1]))
        *moment = sw_add(*moment, sw_join_hub_moment(&all->hubs[i], a, x));
}

sw_status sw_scene_join_force(sw_scene *s, sw_handle h, size_t k, sw_vec *force, sw_vec *moment,
                              sw_error *err) {
  SW_TRY(sw_scene_readable(s, err));
  SW_TRY(sw_scene_still(s, err));
  const sw_scene_join *j = sw_scene_find_join(s, h, err);
  if (!j) return SW_EDEAD;
  *force = *moment = sw_v(0, 0, 0);
  if (k >= j->count)
    return sw_fail(err, SW_EINVAL, "join '%s': end %zu is not one of its %zu", j->name, k + 1,
                   j->count);
  if (!j->alive) return SW_OK;
  SW_TRY(sw_scene_build(s, err));
  add_up(s, &j->ends[k], force, moment);
  return SW_OK;
}
