/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Particles that springs, folds and solid elements hold together: the inside of a wire that is
 * a mesh (a tube of rings, layers around a line, voxels) or of anything else that is soft. A web
 * is immutable once made and reference-counted; where its particles are is the body's state. */
#ifndef SW_STATE_WEB_H
#define SW_STATE_WEB_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

/* A spring between two particles. */
typedef struct sw_web_link {
  uint32_t a, b;
  double k;    /* [N/m] */
  double rest; /* unstressed length [m] */
} sw_web_link;

/* A spring against the angle at b by which a, b and c are off a straight line. */
typedef struct sw_web_fold {
  uint32_t a, b, c;
  double k;    /* moment per angle [N m] */
  double rest; /* the angle without moment, 0 or well inside (0, pi) [rad] */
} sw_web_fold;

/* A spring against the angle by which the strip from b to c is turned from that from a to b, about
 * the edge from b to d: see state/crease.h. */
typedef struct sw_web_crease {
  uint32_t a, b, c, d;
  double k;    /* moment per angle [N m] */
  double rest; /* the angle without moment [rad] */
} sw_web_crease;

enum { SW_WEB_SOLID_NODES = 8 }; /* most of one solid element [-] */

/* Corners of a solid element; its other data are in the web's shapes. */
typedef struct sw_web_solid {
  uint32_t count; /* [-] */
  uint32_t shape; /* which one of these it has */
  uint32_t node[SW_WEB_SOLID_NODES];
} sw_web_solid;

enum { SW_SLIDE_NODES = 4 };

/* Two edges that face each other, of parts that slide on each other: see state/slide.h. */
typedef struct sw_web_slide {
  uint32_t node[SW_SLIDE_NODES]; /* of one part, in a ring and in the next, then of the other */
  double press, stick;           /* stiffness across and, before they slip, along [N/m] */
  double apart, along;           /* their offset at rest across and along [m] */
  double grip;                   /* presses them together from the start [N] */
} sw_web_slide;

typedef struct sw_web {
  int references;
  size_t particles;
  size_t rings, per_ring; /* particles ring by ring along a wire; per_ring 0: in no order [-] */
  size_t *first;          /* (rings + 1) particle that each ring begins with; those of rings that
                           * are one particle, where the wire is a line, are one apart */
  int banded;             /* 1: nothing reaches further than to the next ring */
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
  double friction;           /* between parts that slide [-] */
  double slide_rate2;        /* the same as rate2 of what presses and sticks them [1/s2] */
  double *yield, *hardening; /* (links) strain at which they yield, and gain of that force
                                over their stiffness, NAN: never [-]; or NULL */
  size_t shape_count;
  void *shapes;          /* (shape_count) prepared by the force of the solids, or NULL */
  size_t clamped_shapes; /* number of shapes from here to the shape of an element with one held
                            ring; 0: the same shape */
  size_t *ring_links, *ring_solids; /* (rings + 1) where those begin that start at each ring */
  double *mass;                     /* (particles) [kg] */
  double *s;                        /* (particles) arc length; place along the size [m] */
  double length;                    /* without rings: size of the whole [m] */
  double *along; /* (particles) unstressed distance of the same one in the next ring; 0: none [m] */
  double *share; /* (per_ring) of the mass of a slice [-] */
  double *section;  /* (per_ring x 2) where they are across the wire [m] */
  uint32_t *around; /* (around_count) of a section's surface, in their order */
  size_t around_count;
  uint32_t *face; /* (faces x 3) triangles of a section of springs, anticlockwise */
  size_t faces;
  uint32_t axis;      /* a section's particle on the axis; per_ring: there is none */
  double solid_rate2; /* the same of the solid elements [1/s2] */
  double rate2;       /* most of twice the springs of a particle over its mass [1/s2] */
  double *behind;     /* (particles) bound on the stiffness that ties each to others [N/m] */
  double repel_distance, repel_stiffness; /* particles nearer than that push each other apart;
                                             stiffness 0: they do not [m], [N/m] */
  double wall;          /* bending stiffness of a ring's wall per length, 0: none [N m] */
  double line_skin;     /* distance of the surface from particles of a line [m] */
  double skin;          /* distance of the surface from the particles there [m] */
  double proud;         /* how far that surface is outside of the section's own [m] */
  unsigned char *outer; /* (particles) 1: at the surface */
  size_t *side_first;   /* (particles + 1) where the sides of each begin */
  uint32_t *side;       /* other ends of the surface's edges, each edge once */
} sw_web;

/* An empty web for so many particles, of one reference. SW_ENOMEM. */
sw_status sw_web_new(size_t particles, size_t links, size_t folds, size_t solids, sw_web **out);
sw_web *sw_web_retain(sw_web *web);
void sw_web_release(sw_web *web); /* NULL is allowed */

/* 0: ring number r is a single particle of a line. */
static inline int sw_web_is_ring(const sw_web *web, size_t r) {
  return web->first[r + 1] - web->first[r] == web->per_ring;
}

/* The ring that has a particle. */
size_t sw_web_ring_of(const sw_web *web, size_t particle);

/* Once particles, rings and around are known: which particles and edges are the surface of a
 * wire. SW_ENOMEM. */
sw_status sw_web_add_surface(sw_web *web);

/* Once springs and masses are known: the square of a bound on how fast they swing. SW_ENOMEM. */
sw_status sw_web_bound_rate(sw_web *web);

/* The same of the springs that press and stick parts that slide. SW_ENOMEM. */
sw_status sw_web_bound_slides(sw_web *web);

/* Mass-weighted middle of ring i, of positions or anything else that particles have
 * (particles x 3). */
void sw_web_middle(const sw_web *web, const double *x, size_t ring, double out[3]);

#endif
