/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The plan of a wire: everything that does not change during a step. Node and edge lists, masses,
 * held nodes, bending hinges. A plan is reference-counted and immutable, with one exception: the
 * wire may slide through a node that is held by a guide. Adding or removing a clamp makes a new
 * plan between two steps. */
#ifndef SW_STATE_PLAN_H
#define SW_STATE_PLAN_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"
#include "base/vec.h"
#include "state/web.h"

/* A section's data as a beam. */
typedef struct sw_beam {
  double EA;           /* axial stiffness [N] */
  double EI;           /* bending stiffness, the smaller of two [N m2] */
  double GJ;           /* twist stiffness [N m2] */
  double mass;         /* mass per length [kg/m] */
  double radius;       /* outer radius [m] */
  double E;            /* of the material, for stresses [Pa] */
  double rest_twist;   /* twist of the unloaded wire [rad/m] */
  double EI_axis[2];   /* in the plane of the normal and across it [N m2] */
  double spin_inertia; /* of turning about the axis, per length [kg m] */
  int rolls;           /* 1: it has that inertia, and contact acts on its surface */
  int curved;          /* 1: not straight when unloaded */
  int framed;          /* 1: needs material frames (two stiffnesses, curved at rest, rolls) */
} sw_beam;

/* How a node is held. */
enum { SW_FREE = 0, SW_HELD = 1 };

/* Give of a hold on one side that is no rigid clamp, expressed in lengths of wire. 0: none. */
typedef struct sw_clamp_give {
  double shorter; /* how much further out than the held place the bending wire begins [m] */
  double softer;  /* how much further in than that it begins to bend about the axis [m] */
  double twist;   /* added length of wire for twist [m] */
  sw_vec axis;    /* across the director, in the hold's frame [-] */
} sw_clamp_give;

/* A place where a hold fixes the wire's direction: the hinge between the held director and one
 * edge. */
typedef struct sw_clamp_hinge {
  size_t node;   /* held node */
  size_t edge;   /* edge that starts or ends there */
  int side;      /* +1: the edge leaves the node, -1: it arrives there */
  int hold;      /* index of the hold that owns the director */
  double length; /* hinge length: angle = curvature * length [m] */
  double softer; /* added length about the axis of the hold's give [m] */
  double twist;  /* added length of its span for twist [m] */
} sw_clamp_hinge;
/* Returns the place of the hinge's directors among those of all holds [-]. */
static inline size_t sw_clamp_place(const sw_clamp_hinge *h) {
  return 2 * (size_t)h->hold + (h->side > 0 ? 1 : 0);
}

/* A stretch of wire between two holds or rigid joints that both keep it from turning about its
 * axis. Only there can a straight wire of equal bending stiffness be twisted; elsewhere it unwinds
 * through a free end. */
typedef struct sw_span {
  size_t first, last; /* its edges, both included */
  size_t left, right; /* its clamp hinges or stops, indices into clamps */
  double length;      /* for twist, with the give of its clamps [m] */
} sw_span;

/* For a wire that is a mesh of particles, these are the nodes. It has no edges, hinges, clamps and
 * spans, and its mass is lumped. */
typedef struct sw_plan {
  int references;
  uint32_t stops; /* ends of spans at rigid joints, after the clamps in the list */
  size_t nodes;   /* n */
  size_t edges;   /* m = n - 1, or 0 with a web */
  sw_web *web;    /* connects the particles; NULL: nodes in a line */
  sw_beam beam;
  double length;          /* unstressed wire length [m] */
  double *s;              /* (n) arc length of each node [m] */
  double *rest;           /* (m) unstressed edge lengths [m] */
  double *lumped;         /* (n) lumped node masses [kg] */
  double *mass_own;       /* (n) consistent mass, diagonal [kg] */
  double *mass_next;      /* (n) consistent mass, node i with i+1 [kg] */
  double *hinge;          /* (n) hinge lengths; 0 = no hinge at this node [m] */
  int *held;              /* (n) SW_FREE or SW_HELD */
  sw_clamp_hinge *clamps; /* (clamp_count + stops) */
  size_t clamp_count;
  sw_span *spans; /* (span_count) from the wire's start on */
  size_t span_count;
  double *rest_bend;  /* (n + clamps x 2) bend of the unloaded hinges, or NULL [rad] */
  double *rest_twist; /* (n + clamps) twist of the unloaded hinges, or NULL [rad] */
  double *drawn_arc;  /* (m) share by which an edge is shorter than the arc of a path that it was
                         drawn along, or NULL [-] */
} sw_plan;

/* Value of sw_hold_place.clamped: no hold, but a rigid joint that ends spans of twist at s1. */
enum { SW_STOPS = 2 };

/* What a hold requires of the mesh: nodes at s1 and s2 (equal for a point) and every node between
 * them held; the direction fixed too if clamped. */
typedef struct sw_hold_place {
  double s1, s2; /* [m] */
  int clamped;
  int hold;              /* the owner's index; joints come after all holds */
  sw_clamp_give give[2]; /* on the side where the wire arrives and where it leaves */
} sw_hold_place;

/* Makes a plan for nodes at arc lengths s (n values, increasing; the first is 0 unless wire was fed
 * at the start) under the given holds. Every s1 and s2 must be one of the nodes (see
 * sw_mesh_place). The result has one reference. SW_ENOMEM. */
sw_status sw_plan_new(const sw_beam *beam, const double *s, size_t n, const sw_hold_place *holds,
                      size_t hold_count, sw_plan **out);

/* Returns the first node at or after arc length s, or nodes if there is none [m]. */
size_t sw_plan_first(const sw_plan *plan, double s);

/* Returns the number of the shape, among its web's, that a solid element has. */
size_t sw_plan_shape(const sw_plan *plan, const sw_web_solid *element);

/* Makes a plan for particles, held where the flags (particles) say so; retains the web. SW_ENOMEM.
 */
sw_status sw_plan_of_web(const sw_beam *beam, sw_web *web, const int *held, sw_plan **out);

/* Returns the number of axial forces in the body's state: of its edges, or springs [-]. */
static inline size_t sw_plan_axial(const sw_plan *plan) {
  return plan->web ? plan->web->links : plan->edges;
}

/* Returns a node's arc length from the wire's present start; a particle's as in its web [m]. */
static inline double sw_plan_place(const sw_plan *plan, size_t node) {
  return plan->s[node] - (plan->web ? 0.0 : plan->s[0]);
}

/* Returns the distance of the surface from a node that touches something [m]. */
static inline double sw_plan_skin(const sw_plan *plan, size_t node) {
  const sw_web *web = plan->web;
  if (!web) return plan->beam.radius;
  return sw_web_has_lines(web) && !sw_web_is_ring(web, sw_web_ring_of(web, node)) ? web->line_skin
                                                                                  : web->skin;
}

/* Returns the shortest of its edges, of its links or, along a mesh of rings, of the distances
 * between rings; infinite if it has none [m]. */
double sw_plan_spacing(const sw_plan *plan);
/* Returns the distance of the outer particles from their wire's axis; 0 for nodes [m]. */
double sw_plan_lever(const sw_plan *plan);

/* The wire slides through a held node until the node's arc length is s: changes all that depends on
 * the edges beside it. spare: by how much the edges before and after are longer than their arc
 * lengths [m]. */
void sw_plan_slide(sw_plan *plan, size_t node, double s, const double spare[2]);

/* Computes the lengths of a clamp's hinge and the next hinge. first, second: lengths of the clamp's
 * first two edges; second 0: the wire ends after the first [m]. */
void sw_plan_clamp_lengths(double first, double second, double *clamp, double *next);

/* Returns by how much a clamp's hinge grows with its edge, over the hinge's length [1/m]. */
double sw_plan_clamp_growth(const sw_plan *plan, const sw_clamp_hinge *hinge);

/* Makes room for the unloaded shape of a wire with material frames. SW_ENOMEM. */
sw_status sw_plan_add_rest(sw_plan *plan);

/* Returns a span's torque for twist stiffness GJ, from its twist beyond that of the unloaded wire
 * [N m]. */
static inline double sw_span_torque(const sw_plan *plan, const sw_span *span, double GJ,
                                    double twist) {
  return GJ / span->length * twist - GJ * plan->beam.rest_twist;
}

sw_plan *sw_plan_retain(sw_plan *plan);
void sw_plan_release(sw_plan *plan); /* NULL is allowed */

/* Returns the edge (for a mesh of particles: the ring before) that contains arc length s; fraction:
 * the place within it in [0, 1]. */
size_t sw_plan_locate(const sw_plan *plan, double s, double *fraction);

#endif
