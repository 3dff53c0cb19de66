/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Loads of the rings of a mesh, as its read-outs give them: values of slices, linear between the
 * slices' middles and extrapolated to the ends. The directions across are those of the sections, so
 * the history of the mesh's rotation need not be known.
 *
 * Where parts of the mesh are lines of particles, which carry no twist, the sections between them
 * can turn about the wire's axis at no cost; a real wire does not. There only the sections that
 * holds keep from turning give directions, and these are carried untwisted along the wire from the
 * nearer section. */
#include <math.h>

#include "body/section.h"
#include "state/hinge.h"
#include "strand/ring.h"
#include "system/axial.h"
#include "watch/wear.h"

static sw_vec section_axis(const sw_web *w, const double *x, size_t r) {
  const sw_vec t = sw_web_facing(w, x, r), u = sw_perpendicular(t);
  return sw_turned(u, t, sw_strand_turned(w, x, r, t, u));
}

static void carry(const sw_web *w, const double *x, size_t from, size_t to, sw_vec *across) {
  across[to] = sw_carry_unit(across[from], sw_web_facing(w, x, from), sw_web_facing(w, x, to));
}

/* Fills the directions from begin to before end, between two rings that have theirs, or beside
 * one. */
static void fill(const sw_web *w, const double *x, size_t begin, size_t end, sw_vec *across) {
  const int before = begin > 0, after = end < w->rings;
  const size_t middle = before && after ? begin + (end - begin) / 2 : before ? end : begin;
  for (size_t r = begin; r < middle; r++) carry(w, x, r - 1, r, across);
  for (size_t r = end; r > middle && after; r--) carry(w, x, r, r - 1, across);
}

static int has_lines(const sw_web *w) { return w->particles != w->rings * w->per_ring; }

/* 1 if the ring's surface is held, so the ring cannot turn. */
static int is_held(const sw_plan *p, size_t r) {
  return p->held[p->web->first[r] + p->web->around[0]] != SW_FREE;
}

/* 1 if ring r gives a direction. only_held = 1: only held sections do. */
static int gives(const sw_plan *p, size_t r, int only_held) {
  return sw_web_is_ring(p->web, r) && (!only_held || is_held(p, r));
}

static int any_gives(const sw_plan *p) {
  for (size_t r = 0; r < p->web->rings; r++)
    if (gives(p, r, 1)) return 1;
  return 0;
}

/* Finds the directions. Returns a number that tells which rings gave them. */
static uint64_t axes(const sw_plan *p, const double *x, sw_vec *across) {
  const sw_web *w = p->web;
  const int only_held = has_lines(w) && any_gives(p);
  uint64_t sum = sw_sum(SW_SUM_START, &only_held, sizeof only_held);
  size_t rest = 0; /* first ring without a direction so far */
  for (size_t r = 0; r < w->rings; r++) {
    if (!gives(p, r, only_held)) continue;
    across[r] = section_axis(w, x, r);
    if (only_held) sum = sw_sum(sum, &r, sizeof r);
    fill(w, x, rest, r, across);
    rest = r + 1;
  }
  fill(w, x, rest, w->rings, across);
  return sum | 1;
}

void sw_wear_count_mesh(const sw_system *s, const sw_body *b, int averaged, sw_wear *wear) {
  const sw_plan *p = b->plan;
  const sw_web *w = p->web;
  const double *x = s->x + 3 * b->first_node, *T = sw_system_elastic(s, b);
  const uint64_t holds = axes(p, x, wear->across);
  sw_slice near = sw_strand_slice(p, x, T, T, 0),
           next = w->rings > 2 ? sw_strand_slice(p, x, T, T, 1) : near;
  for (size_t r = 0; r < w->rings; r++) {
    const double f = r == 0 ? -0.5 : r > 1 && r + 1 == w->rings ? 1.5 : 0.5;
    const sw_vec t = sw_web_facing(w, x, r);
    const sw_vec bend = sw_lerp(sw_wear_towards(near.bend, t, sw_norm(near.bend)),
                                sw_wear_towards(next.bend, t, sw_norm(next.bend)), f);
    const sw_wear_load load = {.tangent = t,
                               .across = wear->across[r],
                               .bend = bend,
                               .tension = near.tension + f * (next.tension - near.tension),
                               .averaged = averaged};
    sw_wear_count(wear, r, &load, wear->holds != holds);
    if (r > 0 && r + 2 < w->rings) near = next, next = sw_strand_slice(p, x, T, T, r + 1);
  }
  wear->holds = holds;
}
