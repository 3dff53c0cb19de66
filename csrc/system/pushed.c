/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "system/pushed.h"

#include <math.h>

/* Edges with at least this share of the largest push are pushed [-]. */
static const double PUSHED = 0.5;
/* Bend of a real wire over its length [-]. */
static const double CROOKED = 1e-3;

static double push_in(const sw_system *system, const sw_body *b, size_t e) {
  return fmax(0, -system->tension[b->first_edge + e]);
}

/* Returns the piece around the largest push from edge `first` to the next held node; *end: the edge
 * after that. */
static sw_pushed next_piece(const sw_system *system, const sw_body *b, size_t first, size_t *end) {
  const sw_plan *p = b->plan;
  size_t most = first, e = first;
  for (; e < p->edges; e++) {
    if (e > first && p->held[e] != SW_FREE) break;
    if (push_in(system, b, e) > push_in(system, b, most)) most = e;
  }
  *end = e;
  const double least = PUSHED * push_in(system, b, most);
  size_t from = most, to = most + 1;
  while (from > first && push_in(system, b, from - 1) >= least) from--;
  while (to < *end && push_in(system, b, to) >= least) to++;
  sw_pushed out = {.edge = (from + to) / 2};
  for (size_t k = from; k < to; k++)
    out.push += push_in(system, b, k) * p->rest[k], out.length += p->rest[k];
  out.push /= out.length;
  return out;
}

/* Returns the rate at which the bend of a real wire grows; 0: it does not [1/s]. A wave of
 * wavenumber k grows at the rate r, m r^2 = k^2 (P - EI k^2): at most at k^2 = P/(2 EI), but no
 * wave is longer than a piece whose ends are held. On a table the weight must be lifted off the
 * bend that the wire has. */
static double rate_of(const sw_beam *beam, double gravity, const sw_pushed *p) {
  const double longest = 2 * M_PI / p->length;
  const double k2 = fmax(p->push / (2 * beam->EI), longest * longest);
  const double r2 = k2 * (p->push - beam->EI * k2) / beam->mass - gravity / (CROOKED * p->length);
  return r2 > 0 ? sqrt(r2) : 0;
}

/* 0 if no push is large enough for the wire's longest wave: most wires, at once. */
static int may_buckle(const sw_system *system, const sw_body *b) {
  const double *T = system->tension + b->first_edge, k = 2 * M_PI / b->plan->length;
  const double enough = -b->plan->beam.EI * k * k;
  int any = 0;
  for (size_t e = 0; e < b->plan->edges; e++) any |= T[e] < enough;
  return any;
}

double sw_pushed_rate(const sw_system *system, const sw_body *b, double gravity, sw_pushed *most) {
  double rate = 0;
  if (!may_buckle(system, b)) return 0;
  for (size_t e = 0; e < b->plan->edges;) {
    const sw_pushed p = next_piece(system, b, e, &e);
    const double r = p.push > 0 ? rate_of(&b->plan->beam, gravity, &p) : 0;
    if (r > rate) rate = r, *most = p;
  }
  return rate;
}
