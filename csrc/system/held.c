/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Held nodes in a body's equations: takes them out and computes their reactions. */
#include <string.h>

#include "solve/band3.h"
#include "system/assemble.h"
#include "system/join_twist.h"
#include "system/rail.h"
#include "system/spin.h"
#include "system/stage_parts.h"
#include "system/twist.h"
#include "system/web.h"

static void transpose(const double *u, double *out) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) out[3 * i + j] = u[3 * j + i];
}

/* Takes a held node out of the equations and keeps its couplings for the reaction. */
static void hold_row(sw_held_node *h, double *rows, size_t n, size_t i, double *right) {
  const double *row = rows + SW_ROW_SIZE * i;
  memset(h->saved, 0, sizeof h->saved);
  memset(h->own, 0, sizeof h->own); /* rails keep their own block */
  if (!h->rail) memcpy(h->own, row + SW_ROW_OWN, sizeof h->own);
  if (i >= 2) transpose(rows + SW_ROW_SIZE * (i - 2) + SW_ROW_SECOND, h->saved);
  if (i >= 1) transpose(rows + SW_ROW_SIZE * (i - 1) + SW_ROW_NEXT, h->saved + 9);
  if (i + 1 < n) memcpy(h->saved + 18, row + SW_ROW_NEXT, 9 * sizeof *row);
  if (i + 2 < n) memcpy(h->saved + 27, row + SW_ROW_SECOND, 9 * sizeof *row);
  sw_drop_row(rows, i);
  h->own_force = sw_neg(sw_load(right + 3 * i));
  sw_store(right + 3 * i, sw_v(0, 0, 0));
}

static void add_block(sw_vec *f, const double *u, const double *d) {
  f->x += u[0] * d[0] + u[1] * d[1] + u[2] * d[2];
  f->y += u[3] * d[0] + u[4] * d[1] + u[5] * d[2];
  f->z += u[6] * d[0] + u[7] * d[1] + u[8] * d[2];
}

static void add_own(sw_vec *f, const double *u, const double *d) {
  f->x += u[0] * d[0] + u[1] * d[1] + u[2] * d[2];
  f->y += u[1] * d[0] + u[3] * d[1] + u[4] * d[2];
  f->z += u[2] * d[0] + u[4] * d[1] + u[5] * d[2];
}

/* Computes the reaction after the update delta, with the solve's linearisation. */
static void update_reaction(sw_held_node *h, const sw_body *b, const double *delta) {
  const size_t i = h->node - b->first_node, n = b->plan->nodes;
  const double *d = delta + 3 * h->node;
  sw_vec f = h->own_force;
  add_own(&f, h->own, d);
  if (i >= 2) add_block(&f, h->saved, d - 6);
  if (i >= 1) add_block(&f, h->saved + 9, d - 3);
  if (i + 1 < n) add_block(&f, h->saved + 18, d + 3);
  if (i + 2 < n) add_block(&f, h->saved + 27, d + 6);
  h->reaction = f;
}

void sw_held_take_out(sw_system *s, const sw_body *b) {
  double *right = s->delta + 3 * b->first_node;
  for (size_t k = b->held; k; k = s->held[k - 1].next) {
    sw_held_node *h = &s->held[k - 1];
    if (h->rail) sw_rail_take(&s->rails[h->rail - 1], b, h->node - b->first_node);
    if (b->plan->web)
      sw_web_hold(h, b, right);
    else
      hold_row(h, b->field.rows, b->plan->nodes, h->node - b->first_node, right);
  }
}

void sw_held_react(sw_system *s, sw_held_node *h) {
  sw_body *b = &s->bodies[h->body];
  if (b->plan->web)
    h->reaction = sw_web_reaction(h, b, s->delta + 3 * b->first_node);
  else
    update_reaction(h, b, s->delta);
  if (b->has_twist) sw_twist_react(h, b);
  sw_join_twist_react(s, h);
  if (b->spin_block) sw_spin_react(h, b);
}
