/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports rods that turn about their axes where they press on obstacles. Friction acts at the axis
 * of a rod that does not roll: it has no moment about the axis, and the torsion between two holds
 * is even. On a real wire friction bears up to mu N r of it at each touch. Only turns count, as
 * seen from the obstacle: a twisted wire that is laid down, or slides along itself, has the
 * torsion of a real one as far as friction goes. */
#include "record/spun.h"

#include <math.h>

#include "base/alloc.h"
#include "contact/contact.h"
#include "scene/drive.h"
#include "scene/events.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "state/hinge.h"
#include "system/axial.h"
#include "watch/observe.h"
#include "watch/wear.h"

/* Smaller turns at a touch are left out [rad]. */
static const double TOLD = 0.2;
/* So are moments that are a smaller share of the wire's, or would turn the wire back by less at
 * the touch [-], [rad]. */
static const double SHARE = 0.05, BACK = 0.02;
/* Turns are followed from the first state on with as much twist [rad], or with a hold that turns
 * as fast about the wire [rad/s]. */
static const double TWISTED = 0.01, TURNS = 1e-6;
/* Friction turns into the direction of the slide over this share of the radius [-]. */
static const double TAKES = 0.2;
/* Two normals are the same if their cosine is above this [-]. */
static const double ALIKE = 0.95;

/* What friction may bear at the touches between two holds. */
typedef struct loss {
  size_t from, to; /* its edges, both included */
  double turn;     /* largest turn [rad] */
  double at;       /* where, as arc length [m] */
  int obstacle;    /* there */
  double most;     /* sum of mu N r of turned touches [N m] */
  double kept;     /* sum of this times the moment that keeps the wire from turning there [N2 m2] */
  double back;     /* sum of this times the angle that a moment there turns the wire by [rad N m] */
} loss;

/* 1 if the wire can turn at touches without that friction resists. */
static int is_free(const sw_plan *p) {
  return !p->web && p->beam.GJ > 0 && !p->beam.rolls && p->clamp_count > 0;
}

/* 1 if the wire is twisted, or a hold turns about it. */
static int begins(const sw_system *s, const sw_plan *p, double torsion) {
  if (torsion * p->length > TWISTED) return 1;
  for (size_t c = 0; c < p->clamp_count; c++) {
    const sw_vec along = sw_vec_at(s->directors_now, sw_clamp_place(&p->clamps[c]));
    if (fabs(sw_dot(s->hold_states[p->clamps[c].hold].omega, along)) > TURNS) return 1;
  }
  return 0;
}

/* Makes room for a place of each edge. A wire with other edges begins anew. SW_ENOMEM. */
static sw_status make_room(sw_spun *x, size_t edges) {
  if (x->count != edges) sw_spun_free(x);
  if (!x->places) x->places = sw_alloc(edges, sizeof *x->places);
  if (!x->across) x->across = sw_alloc(edges, sizeof *x->across);
  x->count = x->places ? edges : 0;
  return x->places && x->across ? SW_OK : SW_ENOMEM;
}

/* Reads a touch that presses with friction; 0: it does not, or it is a pad, of which grippers
 * tell (grip/untwisted.lua). */
static int read(const sw_scene *s, const sw_contact *c, size_t k, sw_contact_push *out) {
  if (!sw_contact_push_at(c, sw_scene_system((sw_scene *)s), k, out)) return 0;
  if (out->obstacle < 0 || !(out->friction > 0) || !(out->normal_force > 0)) return 0;
  return !sw_scene_obstacle_in(s, (size_t)out->obstacle)->drive.tool;
}

static size_t edge_of(const sw_body *b, const sw_contact_push *p) {
  const size_t e = p->node - b->first_node;
  return e < b->plan->edges ? e : b->plan->edges - 1;
}

/* A touch that moves along the wire comes to an edge from its neighbour. */
static void begin(sw_spun *x, size_t e) {
  sw_spun_place *p = &x->places[e];
  const sw_spun_place *from = NULL;
  if (e > 0 && p[-1].seen > 0) from = p - 1;
  if (!from && e + 1 < x->count && p[1].seen > 0) from = p + 1;
  p->turn = from ? from->turn : 0, p->share = from ? from->share : 0;
}

/* Returns the turn of an edge in the step, as seen from the obstacle [rad]. */
static double turned(const sw_contact *c, const sw_spun_place *p, int obstacle, sw_vec tangent,
                     sw_vec across) {
  sw_pose from, to;
  sw_vec t = p->tangent, u = p->across;
  if (sw_contact_poses(c, obstacle, &from, &to)) {
    t = sw_rotate(to.q, sw_unrotate(from.q, t)), u = sw_rotate(to.q, sw_unrotate(from.q, u));
  }
  u = sw_carry_unit(u, t, tangent);
  return atan2(sw_dot(sw_cross(u, across), tangent), sw_dot(u, across));
}

/* Follows the edge of a touch to the present state. known: 1 if its direction was given by the
 * same holds before. Edges with several touches are followed once: seen is then 2. */
static void follow(const sw_contact *c, const sw_body *b, sw_spun *x, const sw_contact_push *push,
                   int known) {
  const size_t e = edge_of(b, push);
  sw_spun_place *p = &x->places[e];
  const sw_vec tangent = sw_field_tangent(&b->field, e), across = x->across[e];
  if (p->seen > 1) return;
  if (!(p->seen > 0)) begin(x, e);
  const double turn = p->seen > 0 && known ? turned(c, p, push->obstacle, tangent, across) : 0.0;
  const double r = b->plan->beam.radius, way = hypot(r * turn, sw_norm(push->slip));
  if (way > 0) {
    const double part = fmin(1.0, way / (TAKES * r));
    p->share += part * (r * fabs(turn) / way - p->share);
  }
  p->turn += turn, p->tangent = tangent, p->across = across, p->seen = 2;
}

/* Returns the stiffness with which a stretch from a hold resists a push across its other end, as
 * a taut string and as a beam [N/m]. */
static double aside(const sw_plan *p, double length, double tension) {
  return fmax(0.0, tension) / length + 12.0 * p->beam.EI / (length * length * length);
}

/* Finds the edges next to the holds beside edge e, and the ways to these [m]. */
static void between(const sw_plan *p, size_t e, size_t *from, size_t *to, double way[2]) {
  const double at = 0.5 * (p->s[e] + p->s[e + 1]);
  *from = 0, *to = p->edges - 1, way[0] = way[1] = HUGE_VAL;
  for (size_t c = 0; c < p->clamp_count; c++) {
    const sw_clamp_hinge *h = &p->clamps[c];
    if (h->side > 0 && h->edge <= e && h->edge >= *from)
      *from = h->edge, way[0] = at - p->s[h->node];
    if (h->side < 0 && h->edge >= e && h->edge <= *to) *to = h->edge, way[1] = p->s[h->node] - at;
  }
}

/* 1 if the same edge touches in another direction too, as in a groove: it cannot roll aside. */
static int is_wedged(const sw_scene *s, const sw_body *b, size_t k, const sw_contact_push *p) {
  const sw_contact *c = sw_scene_contact((sw_scene *)s);
  sw_contact_push other;
  for (int side = -1; side <= 1; side += 2) {
    const size_t at = k + (size_t)side;
    if (at >= sw_contact_touches(c) || !read(s, c, at, &other)) continue;
    const size_t node = other.node - b->first_node; /* of another body: too large */
    if (node >= b->plan->nodes || edge_of(b, &other) != edge_of(b, p)) continue;
    if (sw_dot(other.normal, p->normal) < ALIKE) return 1;
  }
  return 0;
}

/* Adds a touch that has turned. If friction kept it from turning, the wire would roll aside on the
 * obstacle: it resists by its twist stiffness in series with that across it. */
static void add(const sw_scene *s, const sw_body *b, const sw_spun_place *x, size_t k,
                const sw_contact_push *p, loss *out) {
  const sw_plan *plan = b->plan;
  const double r = plan->beam.radius, most = p->friction * p->normal_force * r * x->share;
  double way[2];
  size_t from, to;
  between(plan, edge_of(b, p), &from, &to, way);
  if (from != out->from || to != out->to) return;
  const double T = sw_system_pull(sw_scene_system((sw_scene *)s), b)[edge_of(b, p)];
  const double twist = plan->beam.GJ * (1.0 / way[0] + 1.0 / way[1]);
  const double roll = r * r * (aside(plan, way[0], T) + aside(plan, way[1], T));
  const double keeps = is_wedged(s, b, k, p) ? twist : twist * roll / (twist + roll);
  out->most += most, out->kept += most * keeps * fabs(x->turn), out->back += most / twist;
}

/* Sums what friction may bear between the holds beside the touch that has turned most. */
static void sum_up(const sw_scene *s, const sw_body *b, const sw_spun *x, loss *out) {
  const sw_contact *c = sw_scene_contact((sw_scene *)s);
  size_t first, end, best = 0;
  double way[2];
  sw_contact_push p;
  sw_contact_touches_of(c, b->first_node, b->first_node + b->plan->nodes, &first, &end);
  for (size_t k = first; k < end; k++) {
    const double turn = read(s, c, k, &p) ? fabs(x->places[edge_of(b, &p)].turn) : 0.0;
    if (!(turn > out->turn)) continue;
    out->turn = turn, out->obstacle = p.obstacle, out->at = p.place, best = edge_of(b, &p);
  }
  if (!(out->turn > TOLD)) return;
  between(b->plan, best, &out->from, &out->to, way);
  for (size_t k = first; k < end; k++) {
    if (!read(s, c, k, &p)) continue;
    const sw_spun_place *place = &x->places[edge_of(b, &p)];
    if (fabs(place->turn) > TOLD) add(s, b, place, k, &p, out);
  }
}

static void tell(sw_scene *s, const sw_scene_wire *w, const loss *l, double moment) {
  if (!(l->most > 0)) return;
  const double missing = fmin(l->most, l->kept / l->most);
  if (!(missing > SHARE * moment) || !(missing * l->back > BACK * l->most)) return;
  sw_events_go_on(sw_scene_events_of(s), "spun", w->name, sw_scene_time(s)); /* one in a run */
  sw_scene_tell(s, "spun", w->name, l->at - w->mesh.s[0], missing,
                "wire '%s' turns on '%s' by %.3g degrees about its axis. Friction acts on a rod's "
                "axis and does not resist: its torsion may be off by about %.2g N m. Give the wire "
                "rolls = true",
                w->name, sw_scene_obstacle_in(s, (size_t)l->obstacle)->name, 180.0 / M_PI * l->turn,
                missing);
}

/* Follows all touches. Returns 1 if there are any. */
static int follow_all(const sw_scene *s, const sw_body *b, sw_spun *x, int known) {
  const sw_contact *c = sw_scene_contact((sw_scene *)s);
  size_t first, end;
  int any = 0;
  sw_contact_push p;
  sw_contact_touches_of(c, b->first_node, b->first_node + b->plan->nodes, &first, &end);
  for (size_t k = first; k < end; k++)
    if (read(s, c, k, &p)) follow(c, b, x, &p, known), any = 1;
  for (size_t e = 0; e < x->count; e++) x->places[e].seen = x->places[e].seen > 1;
  return any;
}

sw_status sw_scene_watch_spun(sw_scene *s, size_t wire, const sw_wire_extremes *now,
                              sw_error *err) {
  const sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[wire];
  sw_scene_wire *w = sw_scene_wire_in(s, wire);
  sw_spun *x = &w->spun;
  if (!sw_scene_contact(s) || !is_free(b->plan)) return SW_OK;
  if (!x->places) {
    if (!sw_contact_may_press(sw_scene_contact(s), wire, 0)) return SW_OK;
    if (!begins(system, b->plan, now->torsion.value)) return SW_OK;
  }
  if (make_room(x, b->plan->edges) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "out of memory for the turns of '%s'", w->name);
  const uint64_t holds = sw_wear_holds(b);
  sw_wear_axes(system, b, sw_v(0, 0, 1), x->across); /* a clamp gives the first direction */
  const int any = follow_all(s, b, x, x->holds == holds);
  x->holds = holds;
  loss l = {.obstacle = -1};
  if (any) sum_up(s, b, x, &l);
  if (l.turn > TOLD) tell(s, w, &l, now->torsion.value * b->plan->beam.GJ);
  return SW_OK;
}
