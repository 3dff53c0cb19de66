/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Depth at which drawn wires lose tension (touch/drawn.h). */
#include "touch/drawn.h"

#include <math.h>
#include <stdint.h>

#include "system/join.h"

/* Share of an edge's stretch by which a touch may shorten the wire's way. The tension is too low by
 * that share at most. With the usual depth the pull of cables led round a peg by half a turn was
 * too low by up to 100 times (spec/contact/round_spec) [-]. */
static const double SHORTENS = 0.01;
void sw_drawn_take(sw_drawn *d, size_t node) {
  if (node < d->first) d->first = node;
  if (node > d->last) d->last = node;
}

/* 1 if the wire slides through one of its holds: its length gives way. */
static int passes(const sw_system *s, size_t body) {
  size_t held = 0, slides = 0;
  for (size_t k = 0; k < s->held_count; k++)
    if (s->held[k].body == body) held++, slides += s->held[k].slides != 0;
  return held > 1 && slides;
}

sw_drawn sw_drawn_between(const sw_system *s, size_t body) {
  const sw_body *b = &s->bodies[body];
  const sw_plan *p = b->plan;
  sw_drawn d = {SIZE_MAX, 0, 0};
  size_t i = 0, end = p->nodes;
  if (p->web) return d;
  while (i < end && p->held[i] == SW_FREE) i++;
  while (end > i && p->held[end - 1] == SW_FREE) end--;
  if (i < end) d = (sw_drawn){b->first_node + i, b->first_node + end - 1, 0};
  for (size_t k = 0; s->joins && k < s->joins->spring_count; k++) {
    const sw_join_spring *spring = &s->joins->springs[k];
    if (spring->i - b->first_node < p->nodes) sw_drawn_take(&d, spring->i);
    if (spring->j - b->first_node < p->nodes) sw_drawn_take(&d, spring->j);
  }
  return d;
}

sw_drawn sw_drawn_of(const sw_system *s, size_t body) {
  return passes(s, body) ? (sw_drawn){SIZE_MAX, 0, 0} : sw_drawn_between(s, body);
}

/* In poses, wires that touch each other are drawn if the tension is above this multiple of the
 * weight, or of EI / length^2. Below it they hang, and their pull follows from their sag. Without
 * the limit poses of two wires that hang on each other need a hundred times the iterations; with 5,
 * 15 and 50 taut pairs have the same pull within 0.5 % [-]. */
static const double TAUT = 10.0;

int sw_drawn_is_taut(const sw_system *s, size_t body, size_t node, double taken, double usual) {
  const sw_body *b = &s->bodies[body];
  const size_t i = node - b->first_node, e = i < b->plan->edges ? i : i - 1;
  return s->tension[b->first_edge + e] + taken > TAUT * usual;
}

static sw_vec tangent(const sw_body *b, size_t e) { return sw_vec_across(b->field.tangent, e); }

double sw_drawn_depth(const sw_system *s, size_t body, size_t node, size_t end, sw_vec normal,
                      double least) {
  const sw_body *b = &s->bodies[body];
  const size_t first = node < end ? node : end, last = node < end ? end : node;
  const size_t i = first - b->first_node, after = last - b->first_node, edges = b->plan->edges;
  if (i == 0 || after >= edges) return HUGE_VAL;
  const size_t other = after > i ? i : i - 1; /* a node has two edges: the same from both ends */
  const double *tension = s->tension + b->first_edge, *rest = b->plan->rest;
  const double stretch = 0.5 * (tension[i] * rest[i] + tension[other] * rest[other]) / b->EA;
  const sw_vec turns = sw_sub(tangent(b, after), tangent(b, i - 1));
  const double turn = fabs(sw_dot(turns, normal)) / (double)(after - i + 1);
  return turn > 0 && stretch > 0 ? fmax(SHORTENS * stretch / turn, least) : HUGE_VAL;
}
