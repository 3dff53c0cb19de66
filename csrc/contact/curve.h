/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The smooth curve of a wire, and the places where it is near edges, corners and thin round
 * obstacles. */
#ifndef SW_CONTACT_CURVE_H
#define SW_CONTACT_CURVE_H

#include "contact/touch.h"

/* Four nodes in a row of a smooth wire, in an obstacle's coordinates. u counts edges from the
 * second node. */
typedef struct sw_piece {
  sw_vec p[4];      /* [m] */
  int starts, ends; /* 1: the wire ends at p[1] or p[2] */
  double bulge;     /* largest distance of the curve from the chords [m] */
  const sw_shape *shape;
  double firm, firm_beside[2]; /* the candidate's firmness [-] */
} sw_piece;

/* A place where a wire is near an obstacle. */
typedef struct sw_place {
  sw_closest near; /* in the obstacle's coordinates */
  sw_sharp sharp;
  int known;    /* 1: it touched in the last iterate or step */
  sw_vec edge;  /* unit direction of the edge, or 0 [-] */
  sw_vec along; /* unit direction of the curve there [-] */
  sw_vec wire;  /* without an edge: the wire's position, in the obstacle's coordinates [m] */
  double faint; /* missing share of its stiffness, because another place is about as near [-] */
} sw_place;

/* Returns the place's share of the stiffness: at least 1e-3, so that it still counts as a place
 * [-]. */
static inline double sw_place_share(const sw_place *place) {
  const double faintest = 1e-3;
  return place->faint < 1.0 - faintest ? 1.0 - place->faint : faintest;
}

/* Places of a segment: the nearest ones on its curve, all on its chord, or its samples. */
enum { SW_PLACES_MOST = 6 * SW_CLOSEST_MAX };
typedef struct sw_places {
  size_t count;
  sw_place place[SW_SAMPLES_MOST];
} sw_places;
_Static_assert(SW_PLACES_MOST + SW_CLOSEST_MAX <= SW_SAMPLES_MOST, "room for those of a chord");

/* Lists the places where the candidate's wire is within reach of its obstacle [m], with nodes at x
 * and obstacles at `at`: first on edges and corners along its smooth curve, then elsewhere. */
void sw_contact_near(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                     const sw_contact_at *at, const double *x, double reach, sw_places *list);

/* Makes the curve's piece of a segment with nodes at x. 0: no edge or corner within reach. */
int sw_contact_piece(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                     const sw_contact_at *at, const double *x, double reach, sw_piece *out);
/* Lists the piece's places less than reach away [m]. */
void sw_contact_places(const sw_contact *c, const sw_candidate *k, const sw_piece *piece,
                       double reach, sw_places *list);
/* Position of the piece's curve at u, and its derivative by u [m]. */
sw_vec sw_contact_curve(const sw_piece *piece, double u, sw_vec *along);
/* Moves a known place on an edge or corner to the piece. 0: no place nearby. */
int sw_contact_follow(const sw_piece *piece, sw_place *place);
/* 1 if the node's nearest place is on an edge across the wire; then the node's segments touch
 * it. */
int sw_contact_is_segments(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                           const sw_contact_at *at, const double *x, const sw_closest *near);
/* 1 if the wire's direction is across the edge, not along it. */
int sw_contact_goes_across(sw_vec along, sw_vec edge);
/* Returns the place of a touch. */
sw_place sw_contact_place_of(const sw_contact *c, const sw_touch *t);
/* World normal of a place, for a touch with this steady normal force [N]. The normal leans, see
 * touch/lean.h. */
sw_vec sw_contact_leaning(const sw_contact *c, const sw_system *s, const sw_candidate *k,
                          const sw_place *place, double steady);
/* Steady normal force of a touch after a step of h [N]. */
double sw_contact_steady_force(const sw_system *s, const sw_touch *t, double h);

#endif
