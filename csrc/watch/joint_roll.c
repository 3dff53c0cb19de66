/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports rigid joints that have rolled about a wire that a hold keeps from rolling, where the
 * joint passes no twist: of wires with material frames, or to wires that leave it nearly in line.
 * Wires that leave such a trunk sideways swing about it freely, and stay behind when a hand turns
 * the trunk. A wire that passed twist would resist by GJ/L times the angle, where L is the way to
 * the hold. At no angle both are the same, whatever loads there are. */
#include <math.h>
#include <stdio.h>

#include "body/build.h"
#include "link/hold.h"
#include "link/joint.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "state/hinge.h"
#include "watch/observe.h"

/* Least reported error of the place of the branch's end, over the branch's length [-]. */
static const double TOLD = 0.05;
/* Wires that leave the joint by less than this sine from the trunk's line are in line with it:
 * their places hardly change when they roll [-]. */
static const double ASIDE = 0.05;
/* Bending stiffness of a wire that is held at its far end, over EI/L [-]. */
static const double HELD = 4.0;

/* A wire at a joint, kept from rolling by the hold nearest to it; and the wire that leaves the
 * joint most to its side. */
typedef struct roll {
  const sw_hold *hold;
  size_t slot; /* of the hold, plus 1 */
  const sw_body *body;
  size_t node;  /* of the joint, in the wire */
  double way;   /* to the hold [m] */
  int before;   /* 1: the hold is before the joint */
  sw_vec aside; /* across the wire when the joint was made, towards the other one [-] */
  double sine;  /* of the angle between them [-] */
  int shown;    /* 1: the body's field is that of the state */
} roll;

/* Returns the slot of the hold nearest to the joint that keeps the wire's direction, plus 1, and
 * the way to it; 0: there is none [m]. */
static size_t nearest_hold(const sw_scene *s, const sw_joint_end *e, double *way) {
  size_t best = 0;
  *way = HUGE_VAL;
  for (size_t k = 0; k < sw_scene_hold_slots(s); k++) {
    const sw_hold *h = sw_scene_hold_in((sw_scene *)s, k);
    if (!h->alive || h->wire != e->wire || !h->cls->hold->direction) continue;
    const double to = fmax(0.0, fmax(h->s1 - e->s, e->s - h->s2));
    if (to < *way) *way = to, best = k + 1;
  }
  return best;
}

/* Returns 0 if no hold keeps the wire from rolling, or no other wire leaves the joint sideways. */
static int find(const sw_scene *s, const sw_joint *j, size_t k, roll *out) {
  const sw_joint_end *e = &j->ends[k];
  const sw_scene_wire *w = sw_scene_wire_in(s, e->wire);
  *out = (roll){.body = &sw_scene_system(s)->bodies[e->wire]};
  if (w->strand.web || !(w->beam.GJ > 0)) return 0;
  for (size_t i = 0; i < j->count; i++) {
    const sw_vec to = j->ends[i].rest, off = sw_madd(to, e->rest, -sw_dot(to, e->rest));
    if (i == k || !(sw_norm(off) > out->sine)) continue;
    out->sine = sw_norm(off), out->aside = sw_scale(off, 1.0 / out->sine);
  }
  if (!(out->sine > ASIDE) || !(out->slot = nearest_hold(s, e, &out->way))) return 0;
  out->hold = sw_scene_hold_in((sw_scene *)s, out->slot - 1);
  out->node = sw_plan_first(out->body->plan, e->s);
  out->before = out->hold->s1 < e->s;
  return out->node < out->body->plan->nodes;
}

static sw_vec edge_of(const sw_scene *s, const roll *r, size_t e) {
  const sw_body *b = r->body;
  if (r->shown) return sw_field_tangent(&b->field, e);
  const double *x = sw_scene_system(s)->x + 3 * (b->first_node + e);
  return sw_unit_or(sw_sub(sw_load(x + 3), sw_load(x)), sw_v(1, 0, 0));
}

/* Returns a direction across the wire that goes with the hold, carried to the joint's tangent t. */
static sw_vec carried(const sw_scene *s, const roll *r, sw_vec t) {
  const sw_hold *h = r->hold;
  const sw_plan *p = r->body->plan;
  const sw_vec local = h->director[r->before];
  const sw_quat q = sw_scene_system(s)->hold_states[h->number].pose.q;
  sw_vec at = sw_rotate(q, local), v = sw_rotate(q, sw_perpendicular(local));
  const size_t from = sw_plan_first(p, r->before ? h->s2 : h->s1);
  for (size_t e = from; r->before && e < r->node; e++) {
    const sw_vec next = edge_of(s, r, e);
    v = sw_carry_unit(v, at, next), at = next;
  }
  for (size_t e = from; !r->before && e > r->node; e--) {
    const sw_vec next = edge_of(s, r, e - 1);
    v = sw_carry_unit(v, at, next), at = next;
  }
  return sw_carry_unit(v, at, t);
}

/* Finds the joint's hub by one of its nodes; NULL: there is none. */
static const sw_join_hub *hub_of(const sw_scene *s, const roll *r) {
  const struct sw_joins *all = sw_scene_system(s)->joins;
  for (size_t k = 0; all && k < all->hub_count; k++)
    for (size_t a = 0; a < all->hubs[k].count; a++)
      if (all->hubs[k].arms[a].node == r->body->first_node + r->node) return &all->hubs[k];
  return NULL;
}

/* Finds the angle of the joint about the wire against the hold [rad]; 0: the joint passes twist. */
static int angle_of(const sw_scene *s, const sw_joint_end *e, const roll *r, double *out) {
  const sw_join_hub *hub = hub_of(s, r);
  if (!hub || (e->stop && !hub->line)) return 0;
  const sw_quat q = sw_join_hub_turn(hub, sw_scene_system(s)->x);
  const sw_vec t = sw_rotate(q, e->rest), u = sw_rotate(q, r->aside), v = carried(s, r, t);
  *out = atan2(sw_dot(sw_cross(v, u), t), sw_dot(v, u));
  return 1;
}

/* Returns the stiffness with which the other wires resist a roll: by their weight, which hangs
 * straight down, and where they are held by their bending [N m]. */
static double others(const sw_scene *s, const sw_joint *j, size_t k) {
  double sum = 0, way;
  for (size_t i = 0; i < j->count; i++) {
    const sw_scene_wire *w = sw_scene_wire_in(s, j->ends[i].wire);
    const double length = w->mesh.s[w->mesh.n - 1] - w->mesh.s[0];
    if (i == k || w->strand.web) continue;
    sum += 0.5 * w->beam.mass * length * length * sw_norm(sw_scene_gravity(s));
    if (nearest_hold(s, &j->ends[i], &way)) sum += HELD * w->beam.EI / fmax(way, 1e-3 * length);
  }
  return sum;
}

static void tell(sw_scene *s, const sw_joint *j, const roll *r, const sw_joint_end *e,
                 double angle) {
  char names[SW_JOIN_ENDS * (SW_NAME_SIZE + 4)] = "";
  size_t at = 0;
  for (size_t i = 0; i < j->count; i++)
    if (&j->ends[i] != e)
      at += (size_t)snprintf(names + at, sizeof names - at, "%s'%s'", at ? ", " : "",
                             sw_scene_wire_in(s, j->ends[i].wire)->name);
  const char *name = sw_scene_wire_in(s, e->wire)->name;
  sw_events_go_on(sw_scene_events_of(s), "joint", j->name, sw_scene_time(s));
  sw_scene_tell(s, "joint", j->name, NAN, angle,
                "'%s' passes no twist: it has rolled by %.3g degrees about wire '%s' against '%s', "
                "which a real wire resists. Places, bends and forces of '%s' and %s may be off",
                j->name, 180.0 / M_PI * angle, name, r->hold->name, name, names);
}

/* judges: 0: only takes the angles of joints as they are now, where a hold is new. */
static void look(sw_scene *s, sw_joint *j, size_t k, int judges) {
  sw_joint_end *e = &j->ends[k];
  roll r;
  double angle;
  const int found = find(s, j, k, &r);
  r.shown = judges;
  if (!found || !angle_of(s, e, &r, &angle)) {
    e->kept_by = 0;
    return;
  }
  const uint32_t by = r.hold->generation;
  if (e->kept_by != r.slot || e->kept_of != by) {
    e->kept_by = r.slot, e->kept_of = by, e->roll = angle;
    return;
  }
  const double off = fabs(remainder(angle - e->roll, 2 * M_PI));
  const double GJ = r.body->plan->beam.GJ, K = others(s, j, k) * r.way;
  if (judges && off * r.sine * GJ / (GJ + K) > TOLD) tell(s, j, &r, e, off);
}

void sw_scene_watch_rolls(sw_scene *s, int judges) {
  SW_EACH(join, j, s) {
    if (!j->alive || !j->rigid || !isnan(j->slack)) continue;
    for (size_t k = 0; k < j->count; k++) look(s, j, k, judges);
  }
}
