/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A tie of two wires: it pulls only when they are further apart than its slack, and breaks when the
 * pull exceeds its strength. A broken tie stays in the system with stiffness 0 until the system is
 * rebuilt. For a tie to a fixed point use the force tether. */
#include <math.h>

#include "link/joint.h"

static const sw_param rows[] = {SW_TIE_ROWS(sw_join_args)};

static sw_status add(sw_joint *j, const sw_link_wire *wires) {
  const sw_join_spring spring = {.i = sw_joint_node(&j->ends[0], &wires[0]),
                                 .j = sw_joint_node(&j->ends[1], &wires[1]),
                                 .k = j->fate[SW_TIE_BROKEN] > 0 ? 0.0 : j->stiffness,
                                 .tie = 1,
                                 .slack = j->slack};
  SW_TRY(sw_system_add_spring(wires->system, &spring));
  j->spring = wires->system->joins->spring_count - 1;
  return SW_OK;
}

static void force(const sw_joint *j, const sw_link_wire *wires, const double *x, size_t k,
                  sw_vec *force, sw_vec *moment) {
  const sw_vec f = sw_join_spring_force(&wires->system->joins->springs[j->spring], x);
  *force = k ? sw_neg(f) : f;
  *moment = sw_v(0, 0, 0);
}

static double pull(const sw_joint *j, const sw_system *s, const double *x, double *bears) {
  *bears = j->fate[SW_TIE_BROKEN] > 0 ? 0.0 : isnan(j->strength) ? HUGE_VAL : j->strength;
  return sw_norm(sw_join_spring_force(&s->joins->springs[j->spring], x));
}

static sw_tie_swing swing(const sw_joint *j, const sw_system *s, const double *x, const double *v) {
  const sw_join_spring *p = &s->joins->springs[j->spring];
  const uint32_t nodes[2] = {p->i, p->j};
  const sw_vec n = sw_unit_or(sw_sub(sw_vec_at(x, p->i), sw_vec_at(x, p->j)), sw_v(0, 0, 0));
  double inverse = 0;
  for (size_t k = 0; k < 2; k++) {
    const sw_body *b = &s->bodies[j->ends[k].wire];
    if (!b->plan->web) inverse += 1.0 / b->plan->lumped[nodes[k] - b->first_node];
  }
  return (sw_tie_swing){.stiffness = p->k,
                        .mass = 1.0 / inverse,
                        .peak = j->fate[SW_TIE_PEAK],
                        .rate = sw_dot(n, sw_sub(sw_vec_at(v, p->i), sw_vec_at(v, p->j)))};
}

static void breaks(sw_joint *j, sw_system *s) { s->joins->springs[j->spring].k = 0; }

static const char *const outputs[] = {"distance",    "tension",      "peak", "broken",
                                      "broken_time", "broken_force", NULL};

/* Distance of its places, present pull, largest pull [m], [N], [N]; 1 if broken, when and at which
 * pull [-], [s], [N]. */
static void read(const sw_joint *j, const sw_link_wire *wires, double *out) {
  const sw_system *s = wires ? wires->system : NULL;
  double bears;
  out[0] = s ? sw_dist(sw_vec_at(s->x, sw_joint_node(&j->ends[0], &wires[0])),
                       sw_vec_at(s->x, sw_joint_node(&j->ends[1], &wires[1])))
             : (double)NAN;
  out[1] = !s || !j->alive ? 0.0 : j->evened ? sw_norm(j->bears[0]) : pull(j, s, s->x, &bears);
  out[2] = j->fate[SW_TIE_PEAK];
  out[3] = j->fate[SW_TIE_BROKEN] > 0;
  out[4] = j->fate[SW_TIE_BROKEN_TIME], out[5] = j->fate[SW_TIE_BROKEN_FORCE];
}

static const sw_joint_acts acts = {.apart = 1,
                                   .outputs = outputs,
                                   .read = read,
                                   .add = add,
                                   .force = force,
                                   .pull = pull,
                                   .swing = swing,
                                   .breaks = breaks};

const sw_link_class sw_link_tie = {
    .name = "tie",
    .summary = "keeps the distance of places of two wires below its slack",
    .params = SW_PARAMS("tie", rows),
    .joint = &acts,
};
