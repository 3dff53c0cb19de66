/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Energies and powers of the system's state, or of a trial state. */
#ifndef SW_SYSTEM_ENERGY_H
#define SW_SYSTEM_ENERGY_H

#include "system/system.h"

/* Saved by sw_system_look_at for sw_system_look_back. */
typedef struct sw_glance {
  double *x, *v, *rates;
} sw_glance;

/* Until sw_system_look_back, read-outs see a system with nodes at x and velocities v (freedoms
 * each), strain rates (edges; NULL: from the velocities), holds as last placed and axial forces as
 * stored. */
void sw_system_look_at(sw_system *system, sw_glance *glance, const double *x, const double *v,
                       const double *rates);
void sw_system_look_back(sw_system *system, const sw_glance *glance);

typedef struct sw_energies {
  double kinetic, gravity, stored; /* [J] */
  double loads;                    /* potential of dead loads, counted as outside work [J] */
} sw_energies;

/* A trial, evaluated as after its commit. */
typedef struct sw_committed {
  double time; /* at its end [s] */
  double lost; /* out: dissipation in that commit by forces with a history [J] */
} sw_committed;

/* Computes all energies but those of contact and joins. lumped: masses of explicit methods, with
 * axial forces from the edges' lengths alone. committed: of a trial; NULL: of the state. */
void sw_system_energies(sw_system *system, int lumped, sw_committed *committed, sw_energies *out);

/* Returns the part of friction in sw_system_dissipated [J]. */
double sw_system_rubbed(const sw_system *system);

typedef struct sw_powers {
  double damping; /* taken by forces that only brake [W] */
  double given;   /* by forces without potential [W] */
} sw_powers;

/* 1 if the system has forces without a potential. */
int sw_system_has_powers(const sw_system *system);
/* Computes their powers at the state. Call just after sw_system_energies has measured its
 * fields. */
sw_status sw_system_powers(sw_system *system, double time, sw_powers *out, sw_error *err);

#endif
