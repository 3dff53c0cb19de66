/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A point where wires are fixed to each other. Springs far stiffer than the wires keep their nodes
 * together. In a rigid join a hub, in which the wires are clamped, keeps the angles between
 * them. */
#include <math.h>

#include "link/joint.h"

static const sw_param rows[] = {
    {"ends", SW_PARAM_OTHER, "m", 0, 0, 0, 0, NULL, 0,
     "list of { wire, s = arc length } that meet in the point"},
    {"rigid", SW_PARAM_BOOLEAN, "-", 1, 0, 1, 0, NULL, offsetof(sw_join_args, rigid),
     "true: the angles between the wires are kept; false: they turn freely"},
    {"name", SW_PARAM_TEXT, "-", 0, 0, 0, 0, NULL, offsetof(sw_join_args, name),
     "name used in messages"},
    {"slack", SW_PARAM_NUMBER, "m", NAN, 0, HUGE_VAL, 0, NULL, offsetof(sw_join_args, slack),
     "with it a tie: two wires that need not meet, whose places stay within this distance"},
    {"stiffness", SW_PARAM_NUMBER, "N/m", SW_TIE_STIFFNESS, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(sw_join_args, stiffness), "stiffness of a taut tie"},
    {"strength", SW_PARAM_NUMBER, "N", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(sw_join_args, strength), "pull at which a tie breaks (default: never)"},
};

/* Stiffness of a join's springs over the stiffness of the stiffest edge there [-]. The ends move
 * apart by the inverse share of that edge's stretch. At twice the value they move apart half as
 * far, and the forces lose one more digit to rounding. */
static const double STIFFER = 100.0;

typedef sw_joint_end end;

static size_t mesh_node(const end *e, const sw_link_wire *w) { return sw_mesh_node(w->mesh, e->s); }

static uint32_t system_node(const sw_link_wire *w, size_t node) {
  return (uint32_t)(w->system->bodies[w->body].first_node + node);
}

uint32_t sw_joint_node(const end *e, const sw_link_wire *w) {
  return system_node(w, mesh_node(e, w));
}

/* Nodes between which the wire's direction at the join is taken: the nodes of the last edge at a
 * wire's end, the two neighbours in mid-wire. */
static void arm_of(const end *e, const sw_link_wire *w, size_t nodes[2]) {
  const size_t i = mesh_node(e, w), last = w->mesh->n - 1;
  nodes[0] = i == 0 ? 0 : i - 1;
  nodes[1] = i == last ? last : i + 1;
}

/* --- springs and hubs ------------------------------------------------------------- */

/* Returns the wire's direction at the join: the mesh's tangent for a wire that is straight at rest,
 * the chord between the arm's nodes for a curved one. */
static sw_vec direction_of(const end *e, const sw_link_wire *w) {
  size_t nodes[2];
  arm_of(e, w, nodes);
  if (!w->beam->curved) return sw_mesh_tangent(w->mesh, mesh_node(e, w));
  return sw_unit_or(sw_sub(sw_vec_at(w->mesh->x, nodes[1]), sw_vec_at(w->mesh->x, nodes[0])),
                    sw_v(1, 0, 0));
}

static sw_vec place_of(const end *e, const sw_link_wire *w) {
  return sw_vec_at(w->mesh->x, mesh_node(e, w));
}

static void measure(sw_joint *j, const sw_link_wire *wires) {
  for (size_t k = 0; k < j->count; k++) {
    end *e = &j->ends[k];
    e->offset = sw_sub(place_of(e, &wires[k]), place_of(&j->ends[0], &wires[0]));
    e->rest = direction_of(e, &wires[k]);
  }
}

/* --- into the system -------------------------------------------------------------- */

/* Stiffness of the stiffest edge beside the join [N/m]. */
static double stiffest(const sw_joint *j, const sw_link_wire *wires) {
  double most = 0;
  for (size_t k = 0; k < j->count; k++) {
    const sw_link_wire *w = &wires[k];
    size_t nodes[2];
    arm_of(&j->ends[k], w, nodes);
    for (size_t i = nodes[0]; i < nodes[1]; i++)
      most = fmax(most, w->beam->EA / (w->mesh->s[i + 1] - w->mesh->s[i]));
  }
  return most;
}

static sw_status add_springs(const sw_joint *j, const sw_link_wire *wires) {
  const double k = STIFFER * stiffest(j, wires);
  for (size_t a = 0; a < j->count; a++)
    for (size_t b = a + 1; b < j->count; b++) {
      const end *p = &j->ends[a], *q = &j->ends[b];
      const sw_join_spring spring = {.i = sw_joint_node(p, &wires[a]),
                                     .j = sw_joint_node(q, &wires[b]),
                                     .k = k,
                                     .offset = sw_sub(p->offset, q->offset)};
      SW_TRY(sw_system_add_spring(wires->system, &spring));
    }
  return SW_OK;
}

/* Returns the bending stiffness between the wire and the hub [N m]: EI over half an edge, from the
 * join to the middle of the edge. In mid-wire both sides count: the wire's own hinge keeps the
 * angle between the two edges, and the hub keeps their mean direction. */
static double arm_stiffness(const sw_link_wire *w, const size_t nodes[2]) {
  double sum = 0;
  if (!w->bends) return 0; /* a string */
  for (size_t i = nodes[0]; i < nodes[1]; i++)
    sum += 2.0 * w->beam->EI / (w->mesh->s[i + 1] - w->mesh->s[i]);
  return sum;
}

/* Wires that leave the joint by less than this sine from one line do not tell how it turns about
 * that line: their edges bend as much at the joint [-]. */
static const double ASIDE = 0.17;

static void set_line(sw_join_hub *h) {
  h->line = 1;
  for (size_t a = 0; a < h->count; a++) {
    h->arms[a].along = sw_dot(h->arms[0].rest, h->arms[a].rest) < 0 ? -1 : 1;
    for (size_t b = 0; b < a; b++)
      if (sw_norm(sw_cross(h->arms[a].rest, h->arms[b].rest)) > ASIDE) h->line = 0;
  }
}

static sw_status add_hub(const sw_joint *j, const sw_link_wire *wires) {
  sw_join_hub hub = {0};
  for (size_t k = 0; k < j->count; k++) {
    const sw_link_wire *w = &wires[k];
    size_t nodes[2];
    arm_of(&j->ends[k], w, nodes);
    const double stiffness = arm_stiffness(w, nodes);
    if (!(stiffness > 0)) continue;
    hub.arms[hub.count++] = (struct sw_join_arm){.from = system_node(w, nodes[0]),
                                                 .to = system_node(w, nodes[1]),
                                                 .node = sw_joint_node(&j->ends[k], w),
                                                 .k = stiffness,
                                                 .rest = j->ends[k].rest,
                                                 .stop = j->ends[k].stop};
  }
  set_line(&hub);
  return hub.count > 1 ? sw_system_add_hub(wires->system, &hub) : SW_OK;
}

static sw_status add(sw_joint *j, const sw_link_wire *wires) {
  SW_TRY(add_springs(j, wires));
  return j->rigid ? add_hub(j, wires) : SW_OK;
}

/* --- loads -------------------------------------------------------------------------- */

static void force(const sw_joint *j, const sw_link_wire *wires, const double *x, size_t k,
                  sw_vec *force, sw_vec *moment) {
  const sw_link_wire *w = &wires[k];
  const struct sw_joins *all = w->system->joins;
  const uint32_t node = sw_joint_node(&j->ends[k], w);
  size_t nodes[2];
  arm_of(&j->ends[k], w, nodes);
  for (size_t i = 0; i < all->spring_count; i++) {
    const sw_vec f = sw_join_spring_force(&all->springs[i], x);
    if (all->springs[i].i == node) *force = sw_add(*force, f);
    if (all->springs[i].j == node) *force = sw_sub(*force, f);
  }
  for (size_t i = 0; i < all->hub_count; i++)
    for (size_t a = 0; a < all->hubs[i].count; a++)
      if (all->hubs[i].arms[a].from == system_node(w, nodes[0]) &&
          all->hubs[i].arms[a].to == system_node(w, nodes[1])) {
        sw_vec bending, twisting;
        sw_join_hub_moment(w->system, &all->hubs[i], a, x, &bending, &twisting);
        *moment = sw_add(*moment, sw_add(bending, twisting));
      }
}

static const sw_joint_acts acts = {.measure = measure, .add = add, .force = force};

const sw_link_class sw_link_join = {
    .name = "join",
    .summary = "fixes wires to each other where they meet",
    .params = SW_PARAMS("scene:join", rows),
    .joint = &acts,
};
