/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "system/pushed.h"

#include <math.h>

#include "system/axis.h"

/* Edges with at least this share of the largest push are pushed [-]. */
static const double PUSHED = 0.5;
/* Bend of a real wire over its length [-]. */
static const double CROOKED = 1e-3;

/* A wire as a row of pieces: the edges of a line, or the slices of a mesh between two rings. */
typedef struct row {
  const sw_system *system;
  const sw_body *body;
  const double *x; /* of the body's nodes */
  size_t edges;    /* or slices [-] */
} row;

/* Share of the square of the turn between two chords by which a circle's arc is longer than a chord
 * [-]. */
static const double ARC = 1.0 / 24.0;

static double turn2(sw_vec a, sw_vec b) {
  const double both = sqrt(sw_norm2(a) * sw_norm2(b));
  return both > 0 ? 2.0 * (1.0 - sw_dot(a, b) / both) : 0.0;
}

/* Returns the push in slice e, from the distance of its rings' centres along the bent axis [N]. */
static double push_of_slice(const row *w, size_t e) {
  const sw_web *web = w->body->plan->web;
  const sw_vec from = sw_web_centre(web, w->x, e), to = sw_web_centre(web, w->x, e + 1);
  const sw_vec chord = sw_sub(to, from);
  const double rest = sw_axis_rest(w->body, e);
  double turns = 0, sides = 0;
  if (e > 0) turns += turn2(sw_sub(from, sw_web_centre(web, w->x, e - 1)), chord), sides++;
  if (e + 1 < w->edges) turns += turn2(chord, sw_sub(sw_web_centre(web, w->x, e + 2), to)), sides++;
  const double arc = sw_norm(chord) * (1.0 + ARC * (sides > 0 ? turns / sides : 0.0));
  return fmax(0, w->body->plan->beam.EA * (1.0 - arc / rest));
}

static double push_in(const row *w, size_t e) {
  if (w->body->plan->web) return push_of_slice(w, e);
  return fmax(0, -w->system->tension[w->body->first_edge + e]);
}

/* 1 if a hold is at the start of edge or slice e. */
static int is_held(const row *w, size_t e) {
  return w->body->plan->held[sw_axis_first(w->body, e)] != SW_FREE;
}

/* Returns the piece around the largest push from edge `first` to the next held node; *end: the edge
 * after that. */
static sw_pushed next_piece(const row *w, size_t first, size_t *end) {
  double largest = push_in(w, first);
  size_t most = first, e = first;
  for (; e < w->edges; e++) {
    if (e > first && is_held(w, e)) break;
    const double push = push_in(w, e);
    if (push > largest) most = e, largest = push;
  }
  *end = e;
  const double least = PUSHED * largest;
  size_t from = most, to = most + 1;
  while (from > first && push_in(w, from - 1) >= least) from--;
  while (to < *end && push_in(w, to) >= least) to++;
  sw_pushed out = {.edge = (from + to) / 2, .from = from, .to = to};
  for (size_t k = from; k < to; k++)
    out.push += push_in(w, k) * sw_axis_rest(w->body, k), out.length += sw_axis_rest(w->body, k);
  out.push /= out.length;
  return out;
}

/* A wave of wavenumber k grows at the rate r, m r^2 = k^2 (P - EI k^2): at most at k^2 = P/(2 EI),
 * but no wave is longer than a piece whose ends are held. On a table the weight must be lifted off
 * the bend that the wire has. */
double sw_pushed_rate_of(const sw_beam *beam, double gravity, const sw_pushed *p) {
  const double longest = 2 * M_PI / p->length;
  const double k2 = fmax(p->push / (2 * beam->EI), longest * longest);
  const double r2 = k2 * (p->push - beam->EI * k2) / beam->mass - gravity / (CROOKED * p->length);
  return r2 > 0 ? sqrt(r2) : 0;
}

/* 0 if no push is large enough for the wire's longest wave: most wires, at once. */
static int may_buckle(const row *w) {
  const sw_plan *p = w->body->plan;
  const double *T = w->system->tension + w->body->first_edge, k = 2 * M_PI / p->length;
  const double enough = p->beam.EI * k * k;
  int any = 0;
  for (size_t e = 0; !p->web && e < w->edges; e++) any |= T[e] < -enough;
  for (size_t e = 0; p->web && e < w->edges && !any; e++) any = push_of_slice(w, e) > enough;
  return any;
}

double sw_pushed_rate(const sw_system *system, const sw_body *b, const double *x, double gravity,
                      sw_pushed *most) {
  const row w = {
      .system = system, .body = b, .x = x + 3 * b->first_node, .edges = sw_axis_edges(b)};
  double rate = 0;
  if (!may_buckle(&w)) return 0;
  for (size_t e = 0; e < w.edges;) {
    const sw_pushed p = next_piece(&w, e, &e);
    const double r = p.push > 0 ? sw_pushed_rate_of(&b->plan->beam, gravity, &p) : 0;
    if (r > rate) rate = r, *most = p;
  }
  return rate;
}
