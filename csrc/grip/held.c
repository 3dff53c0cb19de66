/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums a tool's touches for each wire: force, margin to slip, slip and turn between the pads. */
#include "grip/held.h"

#include <math.h>

#include "base/alloc.h"
#include "grip/frozen.h"
#include "scene/drive.h"
#include "scene/parts.h"
#include "solve/dense.h"
#include "system/system.h"

/* Touches of all wires, in the order of wires; vectors in the tool's axes. */
typedef struct list {
  sw_frozen_touch *touch;
  sw_vec *friction, *slip; /* on the wire [N]; in the last step [m] */
  sw_vec *axle;            /* see sw_touches_margin [m] */
  size_t *body;
  size_t count;
} list;

int sw_held_finger(const sw_contact *c, const sw_tool *t, size_t k) {
  const int obstacle = sw_contact_pusher(c, k);
  for (size_t i = 0; obstacle >= 0 && i < t->pads; i++)
    if (t->pad[i].obstacle == (size_t)obstacle) return t->pad[i].finger;
  return -1;
}

/* Makes an empty list for the touches of the pads, in the tool's room. */
static sw_status make_list(const sw_contact *c, sw_tool *t, list *l) {
  size_t most = 0;
  const size_t touches = c && t->pads ? sw_contact_touches(c) : 0;
  *l = (list){0};
  for (size_t k = 0; k < touches; k++) most += sw_held_finger(c, t, k) >= 0;
  if (!most) return SW_OK;
  const size_t each = sizeof *l->touch + 3 * sizeof(sw_vec) + sizeof(size_t);
  SW_TRY(sw_grow_empty(&t->room, &t->room_size, most * each, 1));
  l->touch = t->room;
  l->friction = (sw_vec *)(void *)(l->touch + most);
  l->slip = l->friction + most;
  l->axle = l->slip + most;
  l->body = (size_t *)(void *)(l->axle + most);
  return SW_OK;
}

/* Returns the axle of a touch, see sw_touches_margin. */
static sw_vec axle_at(const sw_system *system, const sw_contact_push *p, const sw_body *b) {
  if (b->plan->web) return sw_v(0, 0, 0);
  const size_t last = b->first_node + b->plan->nodes - 1;
  const size_t one = p->node < p->other ? p->node : p->other;
  const size_t first = one < last ? one : last - 1;
  const sw_vec edge = sw_sub(sw_vec_at(system->x, first + 1), sw_vec_at(system->x, first));
  return sw_scale(sw_unit_or(edge, sw_v(0, 0, 0)), sw_norm(sw_sub(p->point, p->acts)));
}

static void add(list *l, const sw_tool *t, const sw_contact_push *p, const sw_system *system) {
  const size_t body = sw_system_body_of(system, p->node);
  const sw_quat q = t->now.q;
  const sw_vec friction = sw_madd(p->force, p->normal, -p->normal_force);
  const size_t k = l->count++;
  l->touch[k] = (sw_frozen_touch){.at = sw_unrotate(q, sw_sub(p->acts, t->now.centre)),
                                  .normal = sw_unrotate(q, p->normal),
                                  .force = p->normal_force,
                                  .friction = p->friction};
  l->friction[k] = sw_unrotate(q, friction);
  l->slip[k] = sw_unrotate(q, p->slip);
  l->axle[k] = sw_unrotate(q, axle_at(system, p, &system->bodies[body]));
  l->body[k] = body;
}

static void collect(sw_scene *s, const sw_tool *t, list *l, sw_held *out) {
  const sw_contact *contact = sw_scene_contact(s);
  const sw_system *system = sw_scene_system(s);
  for (size_t k = 0; k < sw_contact_touches(contact); k++) {
    sw_contact_push p;
    const int finger = sw_held_finger(contact, t, k);
    if (finger < 0) continue;
    sw_contact_push_at(contact, system, k, &p);
    out->press |= 1u << finger;
    out->normal += p.normal_force;
    out->most += p.friction * p.normal_force;
    out->sliding += p.slides ? p.normal_force : 0.0;
    out->place += p.normal_force * p.place;
    add(l, t, &p, system);
  }
  if (out->normal > 0) out->place /= out->normal;
}

/* Sums that give the turn between the pads: the moment of slips about the middle of their wire, and
 * the inertia of the touches, both weighted by normal forces. */
typedef struct turning {
  double moment[3], inertia[3][3]; /* [N m2] */
} turning;

static void add_turn(turning *w, double N, sw_vec arm, sw_vec slip) {
  double r[3];
  sw_store(r, arm);
  sw_accumulate(w->moment, sw_scale(sw_cross(arm, slip), N));
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      w->inertia[i][j] += N * ((i == j ? sw_norm2(arm) : 0.0) - r[i] * r[j]);
}

/* Touches of a wire within this share of its radius do not show a turn: pads that touch it with one
 * edge or corner each. The arms are rounding, and a turn of 1e35 rad came from them [-]. */
static const double ONE_PLACE = 0.05;

/* Adds the turn that the touches from first to end of one wire show. middle: of them. */
static void look_for_turn(const list *l, size_t first, size_t end, sw_vec middle, double radius,
                          turning *w) {
  double normal = 0, wide = 0;
  for (size_t k = first; k < end; k++) {
    normal += l->touch[k].force;
    wide += l->touch[k].force * sw_norm2(sw_sub(l->touch[k].at, middle));
  }
  if (!(wide > normal * ONE_PLACE * ONE_PLACE * radius * radius)) return;
  for (size_t k = first; k < end; k++)
    add_turn(w, l->touch[k].force, sw_sub(l->touch[k].at, middle), l->slip[k]);
}

/* Looks at the touches from first to end, of one wire: its margin, its slip and turn. */
static void look_at_wire(const sw_system *system, const list *l, size_t first, size_t end,
                         sw_held *out, turning *w) {
  sw_vec force = sw_v(0, 0, 0), moment = force, middle = force, axle = force;
  double normal = 0;
  for (size_t k = first; k < end; k++) {
    const sw_frozen_touch *t = &l->touch[k];
    force = sw_add(force, l->friction[k]);
    moment = sw_add(moment, sw_cross(t->at, l->friction[k]));
    middle = sw_madd(middle, t->at, t->force), axle = sw_madd(axle, l->axle[k], t->force);
    out->slip = sw_madd(out->slip, l->slip[k], t->force / out->normal);
    normal += t->force;
  }
  middle = sw_scale(middle, 1.0 / normal), axle = sw_scale(axle, 1.0 / normal);
  look_for_turn(l, first, end, middle, system->bodies[l->body[first]].plan->beam.radius, w);
  out->margin =
      fmax(out->margin, sw_touches_margin(l->touch + first, end - first, axle, force, moment));
  for (size_t k = first; k < end; k++) l->touch[k].at = sw_sub(l->touch[k].at, middle);
}

/* Turns that move the touches by less than a tenth of the widest one's move are left out: those of
 * a nearly straight line of touches about itself. Slips do not determine them, and the arms of a
 * line that bends change from step to step. This is the share of the largest inertia [-]. */
static const double IDLE = 1e-2;

/* Reads the touches and their sums; l->touch is NULL if nothing presses. */
static sw_status read_touches(sw_scene *s, sw_tool *t, list *l, sw_held *out, sw_error *err) {
  *out = (sw_held){0};
  turning w = {{0}, {{0}}};
  if (make_list(sw_scene_contact(s), t, l) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "gripper '%s': out of memory for its touches", t->name);
  if (!l->touch) return SW_OK;
  collect(s, t, l, out);
  for (size_t first = 0, end; first < l->count; first = end) {
    for (end = first + 1; end < l->count && l->body[end] == l->body[first];) end++;
    look_at_wire(sw_scene_system(s), l, first, end, out, &w);
  }
  if (sw_dense_least(&w.inertia[0][0], 3, w.moment, IDLE)) out->turn = sw_load(w.moment);
  return SW_OK;
}

sw_status sw_held_search(sw_scene *s, sw_tool *t, sw_error *err) {
  list l;
  sw_held sum;
  sw_motion_state at;
  const sw_tool_state now = t->now;
  SW_TRY(sw_drive_eval(s, &t->drive, sw_scene_time(s), &at, err));
  t->now.centre = at.pose.p, t->now.q = at.pose.q;
  const sw_status status = read_touches(s, t, &l, &sum, err);
  t->now = now;
  t->way = sw_add(t->way, sum.slip), t->swing = sw_add(t->swing, sum.turn);
  t->searched = 1;
  return status;
}

sw_status sw_held_look(sw_scene *s, sw_tool *t, sw_held *out, sw_vec *slipped, sw_vec *turned,
                       double *furthest, sw_error *err) {
  list l;
  SW_TRY(read_touches(s, t, &l, out, err));
  if (!l.touch) return SW_OK;
  if (t->searched) out->slip = t->way, out->turn = t->swing;
  *slipped = sw_add(*slipped, out->slip), *turned = sw_add(*turned, out->turn);
  *furthest = 0;
  for (size_t k = 0; k < l.count; k++)
    *furthest = fmax(*furthest, sw_norm(sw_add(*slipped, sw_cross(*turned, l.touch[k].at))));
  return SW_OK;
}
