/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solves an iterate's equations again, for other forces and with the same factors. */
#include "solve/band3.h"
#include "solve/band4.h"
#include "system/bridge.h"
#include "system/system.h"
#include "system/twist.h"

int sw_body_solves_again(const sw_system *s, const sw_body *b) {
  return !(b->bridged && sw_bridges_any(s)) && !b->spin_block && !b->plan->web;
}

int sw_body_rolls_again(const sw_system *s, const sw_body *b) {
  return b->roll_block && !(b->bridged && sw_bridges_any(s)) && !s->rail_count;
}

void sw_body_solve_rolling_again(const sw_body *b, double *more) {
  sw_band4_solve(b->spin_rows, b->plan->nodes, more);
}

void sw_body_solve_again(const sw_body *b, double *more) {
  sw_band3_solve(b->field.rows, b->plan->nodes, more);
  if (b->has_twist) (void)sw_twist_correct_again(b, more);
}

void sw_body_take_solution(sw_body *b, const double *delta) {
  if (b->has_twist) sw_twist_gain(b, delta);
}

void sw_system_push_held(sw_system *s, size_t node, sw_vec force) {
  for (size_t i = 0; i < s->held_count; i++)
    if (s->held[i].node == node) s->held[i].own_force = sw_sub(s->held[i].own_force, force);
}
