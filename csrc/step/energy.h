/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The energy ledger of a run, and the referee: steps that make energy are told from those that do
 * not. A step is opened before it is tried, judged as a trial, and closed once it is accepted.
 * Shared by the files of this room only. */
#ifndef SW_STEP_ENERGY_H
#define SW_STEP_ENERGY_H

#include "scene/ledger.h"

/* A run begins. */
void sw_ledger_begin_run(sw_scene *scene);
/* The scene may have been changed since the last step: measure anew before the next. */
void sw_ledger_forget(sw_scene *scene);
/* A step begins at the state. SW_ENOMEM, SW_ECALLBACK. */
sw_status sw_ledger_open(sw_scene *scene, sw_error *err);
/* The trial of size h that ends at t1. changed: the scene was, just before; forces at the start are
 * not known then. */
sw_status sw_ledger_judge(sw_scene *scene, double t1, double h, int changed, sw_error *err);
/* 1: the run's method is judged. Methods that do not damp go to and fro in energy; what they make
 * is only told. */
int sw_ledger_referees(const sw_scene *scene);
/* Energy that the judged trial makes beyond what a step of size h is allowed, of whole ones of that
 * size [J]; 0: it is fine. */
double sw_ledger_excess(const sw_scene *scene, double h, double whole);
/* The judged step was accepted, committed and observed. SW_ENOMEM. */
sw_status sw_ledger_close(sw_scene *scene);
/* A pose was reached from the state that was opened; jumped: by a jump of equilibrium. */
sw_status sw_ledger_pose(sw_scene *scene, int jumped, sw_error *err);
/* Count a retry for the trial that was judged last. */
void sw_ledger_retry(const sw_scene *scene, sw_retries *retries, double time, double excess);

/* Work of holds, feeds and obstacles in the judged step, into step. Gives the most that it may
 * have been, as forces change within the step [J]. */
double sw_ledger_work(sw_scene *scene, double t1, int changed);
/* All of a step's work in size, wherever the world's origin is [J]. */
double sw_ledger_effort(const sw_step_energy *step);
/* Forces and poses at the state, for the next step. logged: holds' forces there are in their logs.
 * SW_ENOMEM. */
sw_status sw_ledger_note_workers(sw_scene *scene, int logged);

/* Energy over a step of size h by the powers at its ends [J]: the trapezoid, but where what is
 * damped dies out within the step. */
double sw_ledger_over_step(double before, double after, double h);

/* Stored between bodies, obstacles and ties [J]. */
double sw_ledger_contact(sw_scene *scene);
static inline double sw_ledger_potential(const sw_energies *e, double contact) {
  return e->gravity + e->stored + contact;
}

#endif
