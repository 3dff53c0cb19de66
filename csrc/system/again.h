/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solving an iterate's equations again with other forces, by the factors that there are. */
#ifndef SW_SYSTEM_AGAIN_H
#define SW_SYSTEM_AGAIN_H

#include "system/system.h"

/* 1: the body's equations can be solved again. */
int sw_body_solves_again(const sw_body *body);

/* By how much forces that are added change the solution: of the body's nodes (nodes x 3), zero
 * where held; in place. */
void sw_body_solve_again(sw_body *body, double *more);

/* The solution delta (nodes x 3) is the last one. */
void sw_body_take_solution(sw_body *body, const double *delta);

/* A force is added at a held node of the system's: its hold bears it. */
void sw_system_push_held(sw_system *system, size_t node, sw_vec force);

#endif
