/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The energy ledger of a run and the referee, which finds steps that make energy. A step is opened
 * before it is tried, judged as a trial, and closed once it is accepted. Shared by the files of
 * this room only. */
#ifndef SW_STEP_ENERGY_H
#define SW_STEP_ENERGY_H

#include "scene/ledger.h"

/* Call when a run begins. */
void sw_ledger_begin_run(sw_scene *scene);
/* Call when the scene may have changed since the last step: energy is measured anew before the next
 * step. */
void sw_ledger_forget(sw_scene *scene);
/* Opens a step at the present state. SW_ENOMEM, SW_ECALLBACK. */
sw_status sw_ledger_open(sw_scene *scene, sw_error *err);
/* Judges the trial of size h that ends at t1. changed: the scene was changed just before, so the
 * forces at the start are unknown. */
sw_status sw_ledger_judge(sw_scene *scene, double t1, double h, int changed, sw_error *err);
/* 1 if the run's method is judged. Energy of methods without damping oscillates; energy that they
 * make is only reported. */
int sw_ledger_referees(const sw_scene *scene);
/* Returns the energy that the judged trial makes; 0: it is within the allowance of a step of size h
 * in a run of whole steps `whole` [J]. */
double sw_ledger_excess(const sw_scene *scene, double h, double whole);
/* Books the judged step, which was accepted, committed and observed. SW_ENOMEM. */
sw_status sw_ledger_close(sw_scene *scene);
/* Books a pose that was reached from the opened state at t0 [s]. *jumped: the equilibrium jumped;
 * it is also set if wires moved far beyond their holds (far) and most of their energy went nowhere.
 * rubbed: lost by friction before the last solve; outer: work of forces without potential [J]. */
sw_status sw_ledger_pose(sw_scene *scene, double t0, int far, int *jumped, double rubbed,
                         double outer, sw_error *err);
/* Counts a retry of the trial that was judged last. */
void sw_ledger_retry(const sw_scene *scene, sw_retries *retries, double time, double excess);

/* Adds the work of holds, feeds and obstacles in the judged step to books->step. Returns the upper
 * bound of that work, because forces change within the step [J]. */
double sw_ledger_work(sw_scene *scene, double t1, int changed);
/* Returns the sum of the sizes of a step's work, independent of the world's origin [J]. */
double sw_ledger_effort(const sw_step_energy *step);
/* Notes forces and poses at the state for the next step. logged: the holds' forces at the state are
 * in their logs. SW_ENOMEM. */
sw_status sw_ledger_note_workers(sw_scene *scene, int logged);

/* Returns the energy over a step of size h from the powers at its ends: the trapezoid, or the
 * geometric mean where a damped motion dies out within the step [J]. */
double sw_ledger_over_step(double before, double after, double h);

/* Returns the energy stored between bodies and obstacles, between bodies, and in ties [J]. */
double sw_ledger_contact(sw_scene *scene);
static inline double sw_ledger_potential(const sw_energies *e, double contact) {
  return e->gravity + e->stored + contact;
}

#endif
