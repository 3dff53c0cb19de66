/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Particles that springs, folds and solid elements hold together: the inside of a wire that is a
 * mesh (a tube of rings, layers around a line, voxels) or of any other soft object. A web is
 * immutable once made, and reference-counted; the places of its particles are in the body's state.
 */
#ifndef SW_STATE_WEB_H
#define SW_STATE_WEB_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"
#include "base/vec.h"

/* A spring between two particles. */
typedef struct sw_web_link {
  uint32_t a, b;
  double k;    /* [N/m] */
  double rest; /* unstressed length [m] */
} sw_web_link;

/* A spring against the angle at b by which a, b and c deviate from a straight line. */
typedef struct sw_web_fold {
  uint32_t a, b, c;
  double k;    /* moment per angle [N m] */
  double rest; /* the angle without moment, 0 or well inside (0, pi) [rad] */
} sw_web_fold;

/* A spring against the angle by which the strip from b to c is turned against the strip from a to
 * b, about the edge from b to d: see state/crease.h. */
typedef struct sw_web_crease {
  uint32_t a, b, c, d;
  double k;    /* moment per angle [N m] */
  double rest; /* the angle without moment [rad] */
} sw_web_crease;

enum { SW_WEB_SOLID_NODES = 8 }; /* most nodes of a solid element [-] */

/* Corners of a solid element; its other data are in the web's shapes. */
typedef struct sw_web_solid {
  uint32_t count; /* [-] */
  uint32_t shape; /* number of its shape */
  uint32_t node[SW_WEB_SOLID_NODES];
} sw_web_solid;

enum { SW_SLIDE_NODES = 4 };

/* Two facing edges of parts that slide on each other: see state/slide.h. */
typedef struct sw_web_slide {
  uint32_t node[SW_SLIDE_NODES]; /* of one part in a ring and in the next, then of the other part */
  double press, stick;           /* stiffness across and, until they slip, along [N/m] */
  double apart, along;           /* offset at rest across and along [m] */
  double grip;                   /* initial force that presses them together [N] */
} sw_web_slide;

typedef struct sw_web {
  int references;
  size_t particles;
  size_t rings, per_ring; /* particles ring by ring along a wire; per_ring 0: no order [-] */
  size_t *first; /* (rings + 1) first particle of each ring. Where the wire is a line, each ring is
                    one particle */
  int banded;    /* 1: nothing reaches further than the next ring */
  sw_web_link *link;
  size_t links;
  sw_web_fold *fold;
  size_t folds;
  sw_web_crease *crease;
  size_t creases;
  sw_web_solid *solid;
  size_t solids;
  sw_web_slide *slide;
  size_t slides;
  double friction;    /* between parts that slide [-] */
  double slide_rate2; /* the same as rate2, for the springs that press and stick them [1/s2] */
  double *yield, *hardening; /* (links) yield strain, and slope of the yield force over the
                                stiffness; NAN: never [-]; or NULL */
  size_t shape_count;
  void *shapes;          /* (shape_count) prepared by the solids' force, or NULL */
  size_t clamped_shapes; /* offset to an element's shape with one held ring; 0: the same shape */
  size_t *ring_links, *ring_solids; /* (rings + 1) first link and solid that start at each ring */
  double *mass;                     /* (particles) [kg] */
  double *s;     /* (particles) arc length; without rings, place along length [m] */
  double length; /* without rings: size of the whole [m] */
  double *along; /* (particles) unstressed distance to the same one in the next ring; 0: none [m] */
  double *share; /* (per_ring) share of a slice's mass [-] */
  double *section;  /* (per_ring x 2) their places across the wire [m] */
  uint32_t *around; /* (around_count) particles of a section's surface, in order */
  size_t around_count;
  uint32_t *face; /* (faces x 3) triangles of a section of springs, anticlockwise */
  size_t faces;
  uint32_t axis;      /* a section's particle on the axis; per_ring: none */
  double solid_rate2; /* the same as rate2, for the solid elements [1/s2] */
  double rate2;   /* largest, over particles, of twice the springs' stiffness over mass [1/s2] */
  double *behind; /* (particles) bound on the stiffness that connects each to others [N/m] */
  double repel_distance, repel_stiffness; /* particles nearer than this repel each other; stiffness
                                             0: they do not [m], [N/m] */
  double wall;          /* bending stiffness of a ring's wall per length, 0: none [N m] */
  double line_skin;     /* distance of the surface from the particles of a line [m] */
  double skin;          /* distance of the surface from the particles at the surface [m] */
  double proud;         /* how far that surface lies outside the section's own [m] */
  unsigned char *outer; /* (particles) 1: at the surface */
  size_t *side_first;   /* (particles + 1) first side of each particle */
  uint32_t *side;       /* other ends of the surface's edges, each edge once */
} sw_web;

/* Makes an empty web for this many particles, with one reference. SW_ENOMEM. */
sw_status sw_web_new(size_t particles, size_t links, size_t folds, size_t solids, sw_web **out);
sw_web *sw_web_retain(sw_web *web);
void sw_web_release(sw_web *web); /* NULL is allowed */

/* 0: ring number r is a single particle of a line. */
static inline int sw_web_is_ring(const sw_web *web, size_t r) {
  return web->first[r + 1] - web->first[r] == web->per_ring;
}

/* 1: some rings are single particles of a line. */
static inline int sw_web_has_lines(const sw_web *web) {
  return web->per_ring && web->particles != web->rings * web->per_ring;
}

/* Returns the ring of a particle. */
size_t sw_web_ring_of(const sw_web *web, size_t particle);

/* When particles, rings and around are known: finds the particles and edges of a wire's surface.
 * SW_ENOMEM. */
sw_status sw_web_add_surface(sw_web *web);

/* When springs and masses are known: computes rate2, the square of a bound on their angular
 * frequency. SW_ENOMEM. */
sw_status sw_web_bound_rate(sw_web *web);

/* The same for the springs that press and stick sliding parts (slide_rate2). SW_ENOMEM. */
sw_status sw_web_bound_slides(sw_web *web);

/* Computes the mass-weighted middle of ring i, for positions or any other values of particles
 * (particles x 3). */
void sw_web_middle(const sw_web *web, const double *x, size_t ring, double out[3]);
/* The same as a vector, for particles at x [m]. */
sw_vec sw_web_centre(const sw_web *web, const double *x, size_t ring);
/* Returns the normal of the area that the surface of ring i encloses; at a particle of a line, the
 * line's direction [-]. */
sw_vec sw_web_facing(const sw_web *web, const double *x, size_t ring);

#endif
