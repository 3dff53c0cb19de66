/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wires that an obstacle carries round. Where they stick, friction bears their inertia, and so must
 * not see the error of a stage (system/inner.h): a wire kept on the obstacle's path in an inner
 * stage would need 0.5 times the force of turning there and 3.4 times in the last stage, or -0.7
 * and 5.1 times in further such steps. It would slide outwards in each step. */
#include <stdint.h>

#include "base/each.h"
#include "contact/touch.h"
#include "system/inner.h"

/* Slower turns are rounding of a trajectory without turns [rad/s]. */
static const double TURNS = 1e-9;

static int turns(sw_vec omega) { return sw_norm2(omega) > TURNS * TURNS; }

/* 1 if some obstacle turns at the step's start. */
static int any_turns(const sw_contact *c) {
  for (size_t k = 0; k < c->broad.mover_count; k++)
    if (turns(c->start[c->broad.mover[k]].omega)) return 1;
  return 0;
}

/* Normals of one flat surface differ by less than this [-]. */
static const double FLAT = 1e-6;

void sw_contact_find_carried(const sw_contact *c, sw_system *s) {
  SW_ITEMS(sw_body, b, s->bodies, s->body_count) b->carried = 0, b->lies_flat = 1;
  if (!any_turns(c)) return;
  size_t last = SIZE_MAX;
  sw_vec first = {0, 0, 0};
  for (size_t i = 0; i < c->memory_count; i++) {
    const sw_memory *m = &c->memory[i];
    const size_t o = sw_contact_index(c, m->obstacle);
    if (o == c->count || !(m->kept.normal_force > 0)) continue;
    const size_t at = sw_system_body_of(s, m->node);
    const sw_vec normal = sw_rotate(c->start[o].pose.q, m->normal);
    if (at != last) first = normal, last = at;
    if (sw_norm2(sw_cross(first, normal)) > FLAT * FLAT) s->bodies[at].lies_flat = 0;
    s->bodies[at].carried = sw_larger(s->bodies[at].carried, sw_norm(c->start[o].omega));
  }
}

sw_vec sw_contact_carried(const sw_contact *c, const sw_system *s, const sw_touch *t, sw_vec from) {
  const sw_contact_at *start = &c->start[t->obstacle], *now = &c->now[t->obstacle];
  const sw_vec to = sw_pose_point(now->pose, sw_pose_local(start->pose, from));
  if (!(s->inner > 0) || !turns(now->omega)) return to;
  if (!sw_inner_goes_inside(s, &s->bodies[t->body])) return to;
  const sw_vec turn = sw_quat_log(sw_quat_mul(now->pose.q, sw_quat_conj(start->pose.q)));
  const sw_vec inward = sw_scale(sw_cross(turn, sw_sub(to, from)), 0.5);
  return sw_add(to, sw_madd(inward, sw_cross(turn, inward), 1.0 / 6.0));
}
