/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The plan of a wire: everything that does not change during a step. Node and
 * edge lists, masses, which nodes are held, where the bending hinges sit. A
 * plan is reference-counted and immutable but for one thing: through a node that is
 * held by a guide the wire may slide. A clamp put on or taken off makes a
 * new plan between two steps. */
#ifndef SW_STATE_PLAN_H
#define SW_STATE_PLAN_H

#include <stddef.h>

#include "base/status.h"
#include "base/vec.h"
#include "state/web.h"

/* A section in terms of beams. */
typedef struct sw_beam {
  double EA;           /* axial stiffness [N] */
  double EI;           /* bending stiffness, the smaller of two [N m2] */
  double GJ;           /* twist stiffness [N m2] */
  double mass;         /* mass per length [kg/m] */
  double radius;       /* outer radius [m] */
  double E;            /* of the material, for stresses [Pa] */
  double rest_twist;   /* of the unloaded wire [rad/m] */
  double EI_axis[2];   /* in the plane of the normal and across it [N m2] */
  double spin_inertia; /* of turning about the axis, per length [kg m] */
  int rolls;           /* 1: it has that inertia, and contact takes hold of its surface */
  int curved;          /* 1: not straight when unloaded */
  int framed;          /* 1: needs material frames (two stiffnesses, curved at rest, rolls) */
} sw_beam;

/* How a node is held. */
enum { SW_FREE = 0, SW_HELD = 1 };

/* Give of a hold on one side, where it is no rigid clamp, as other lengths of wire. 0: it has
 * none. */
typedef struct sw_clamp_give {
  double shorter; /* the bending wire begins so much further out than where it is held [m] */
  double softer;  /* but about the axis so much further in than that [m] */
  double twist;   /* longer by so much as to twist [m] */
  sw_vec axis;    /* across the director, in the hold's frame [-] */
} sw_clamp_give;

/* A place where a hold fixes the wire's direction: the hinge between the held
 * director and one edge. */
typedef struct sw_clamp_hinge {
  size_t node;   /* held node */
  size_t edge;   /* edge that starts or ends there */
  int side;      /* +1: the edge leaves the node, -1: it arrives there */
  int hold;      /* index of the hold that owns the director */
  double length; /* hinge length: angle = curvature * length [m] */
  double softer; /* more of it about the axis of the hold's give [m] */
  double twist;  /* what it adds to the length of its span [m] */
} sw_clamp_hinge;
/* Whose directors are those of the hinge, among all holds' [-]. */
static inline size_t sw_clamp_place(const sw_clamp_hinge *h) {
  return 2 * (size_t)h->hold + (h->side > 0 ? 1 : 0);
}

/* A stretch of wire between two holds that both keep it from turning about its
 * axis: the only place where a straight wire of equal bending stiffness can be
 * twisted, since anywhere else it unwinds through a free end. */
typedef struct sw_span {
  size_t first, last; /* its edges, both included */
  size_t left, right; /* its clamp hinges, indices into clamps */
  double length;      /* as to twist [m] */
} sw_span;

/* Of a wire that is a mesh of particles the nodes are these; it has no edges, hinges, clamps and
 * spans, and its mass is lumped. */
typedef struct sw_plan {
  int references;
  size_t nodes; /* n */
  size_t edges; /* m = n - 1, or 0 with a web */
  sw_web *web;  /* what the particles hang together by; NULL: nodes one after another */
  sw_beam beam;
  double length;          /* unstressed wire length [m] */
  double *s;              /* (n) arc length of each node [m] */
  double *rest;           /* (m) unstressed edge lengths [m] */
  double *lumped;         /* (n) lumped node masses [kg] */
  double *mass_own;       /* (n) consistent mass, diagonal [kg] */
  double *mass_next;      /* (n) consistent mass, node i with i+1 [kg] */
  double *hinge;          /* (n) hinge lengths; 0 = no hinge at this node [m] */
  int *held;              /* (n) SW_FREE or SW_HELD */
  sw_clamp_hinge *clamps; /* (clamp_count) */
  size_t clamp_count;
  sw_span *spans; /* (span_count) from the wire's start on */
  size_t span_count;
  double *rest_bend;  /* (n + clamps x 2) what a hinge is bent when unloaded, or NULL [rad] */
  double *rest_twist; /* (n + clamps) and twisted [rad] */
} sw_plan;

/* A hold's demands on the mesh: nodes at s1 and s2 (equal for a point) and every node between
 * them held; direction fixed too when clamped. */
typedef struct sw_hold_place {
  double s1, s2; /* [m] */
  int clamped;
  int hold;              /* the owner's index */
  sw_clamp_give give[2]; /* where the wire arrives, and where it leaves */
} sw_hold_place;

/* Build a plan for nodes at arc lengths s (n values, increasing; the first is 0 unless
 * wire was fed at the start) under
 * the given holds; every s1 and s2 must be one of the nodes (see
 * sw_mesh_place). The result has one reference. SW_ENOMEM. */
sw_status sw_plan_new(const sw_beam *beam, const double *s, size_t n, const sw_hold_place *holds,
                      size_t hold_count, sw_plan **out);

/* The first node at arc length s or after it; nodes when there is none [m]. */
size_t sw_plan_first(const sw_plan *plan, double s);

/* Which of its web's shapes a solid element has. */
size_t sw_plan_shape(const sw_plan *plan, const sw_web_solid *element);

/* The same for particles, held where the flags (particles) say so; retains the web. SW_ENOMEM. */
sw_status sw_plan_of_web(const sw_beam *beam, sw_web *web, const int *held, sw_plan **out);

/* Axial forces that the body's state has: of its edges, or springs [-]. */
static inline size_t sw_plan_axial(const sw_plan *plan) {
  return plan->web ? plan->web->links : plan->edges;
}

/* Arc length of a node from where the wire begins now; of a particle, as its web has it [m]. */
static inline double sw_plan_place(const sw_plan *plan, size_t node) {
  return plan->s[node] - (plan->web ? 0.0 : plan->s[0]);
}

/* How far the surface is from a node that touches something [m]. */
static inline double sw_plan_skin(const sw_plan *plan, size_t node) {
  const sw_web *web = plan->web;
  if (!web) return plan->beam.radius;
  const int lines = web->per_ring && web->particles != web->rings * web->per_ring;
  return lines && !sw_web_is_ring(web, sw_web_ring_of(web, node)) ? web->line_skin : web->skin;
}

/* The shortest of its edges, of its links or, along a mesh of rings, between these; infinite: it
 * has none [m]. */
double sw_plan_spacing(const sw_plan *plan);
/* How far out its particles are from the axis of its wire; of nodes 0 [m]. */
double sw_plan_lever(const sw_plan *plan);

/* Let the wire slide through a held node until its arc length there is s: changes all
 * that depends on the edges beside it. spare: how much longer than by their arc lengths the
 * edges before and after are [m]. */
void sw_plan_slide(sw_plan *plan, size_t node, double s, const double spare[2]);

/* Lengths of a clamp's hinge and the one after it, whose first two edges are first and
 * second long; second 0: the wire ends after the first [m]. */
void sw_plan_clamp_lengths(double first, double second, double *clamp, double *next);

/* Make room for the unloaded shape of a wire with material frames. SW_ENOMEM. */
sw_status sw_plan_add_rest(sw_plan *plan);

/* Torque of a span for twist stiffness GJ: of its twist beyond that of the unloaded wire
 * [N m]. */
static inline double sw_span_torque(const sw_plan *plan, const sw_span *span, double GJ,
                                    double twist) {
  return GJ / span->length * twist - GJ * plan->beam.rest_twist;
}

sw_plan *sw_plan_retain(sw_plan *plan);
void sw_plan_release(sw_plan *plan); /* NULL is allowed */

/* The edge (of a mesh of particles: the ring before it) that contains arc length s, and the
 * place within it in [0, 1]. */
size_t sw_plan_locate(const sw_plan *plan, double s, double *fraction);

#endif
