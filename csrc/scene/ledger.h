/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The energy ledger of a run, and the referee: steps that make energy are told from those that do
 * not. A step is opened before it is tried, judged as a trial, and closed once it is accepted. */
#ifndef SW_SCENE_LEDGER_H
#define SW_SCENE_LEDGER_H

#include "base/log.h"
#include "base/tape.h"
#include "scene/scene.h"
#include "system/energy.h"

/* Something that can do work: a hold, or an obstacle that moves. */
typedef struct sw_worker {
  sw_pose pose;         /* of a hold, at the step's start */
  sw_vec force, moment; /* on wires, about that place or, of obstacles, the origin [N], [N m] */
  double fed, drive;    /* of a feed: length paid out, force [m], [N] */
} sw_worker;

/* What a step does, as far as is known. */
typedef struct sw_step_energy {
  sw_energies to;                         /* at its end */
  double contact;                         /* stored in touches then [J] */
  sw_powers powers;                       /* at its end */
  double holds, obstacles, feeds, forces; /* work [J] */
  double damping, friction, impact;       /* lost [J] */
  double gain;    /* beyond the most that outer work may have been; below 0: a loss [J] */
  double work;    /* in size, all kinds added up [J] */
  double let_out; /* at most given by letting wires out of what they began in [J] */
  int steady;     /* 1: no touch began or ended */
  int touching;   /* 1: something touches */
  int changed;    /* 1: the scene was, just before */
} sw_step_energy;

typedef struct sw_books {
  sw_ledger sums;
  sw_energies now;   /* of the state at which the next step starts */
  double contact;    /* [J] */
  sw_powers powers;  /* [W] */
  double dissipated; /* by histories so far [J] */
  double highest;    /* of potential energy so far, of what it was released from [J] */
  double most_kinetic, work, released; /* [J] */
  double made;                         /* gained by steps in which something touched [J] */
  double rise, lowest; /* energy that the method made by itself, netted; the least so far [J] */
  double highest_rise; /* from the least [J] */
  double rubbed_off;   /* the part of dissipated that is friction [J] */
  double mass;         /* of the wires [kg] */
  double longest;      /* of them [m] */
  double weight;       /* of the wires, times their radii [J] */
  double bending;      /* their EI / L [J] */
  int put;             /* 1: a hold was put elsewhere since the last step */
  int has_powers;      /* 1: there are forces without a potential */
  int known;           /* 1: all of the above is of the present state */
  int begun;           /* 1: at_start is known */
  sw_step_energy step; /* judged last */
  sw_worker *holds, *obstacles; /* (hold_count), (obstacle_count) as of the system */
  size_t hold_room, obstacle_room;
  sw_log log; /* rows of SW_LOG_ENERGY_SIZE */
} sw_books;

/* A run begins; the scene goes. */
void sw_ledger_begin_run(sw_scene *scene);
void sw_ledger_free(sw_books *books);
void sw_tape_ledger(sw_tape *tape, sw_books *books);

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
/* Forces and poses at the state, for the next step. logged: holds' forces there are in their logs.
 * SW_ENOMEM. */
sw_status sw_ledger_note_workers(sw_scene *scene, int logged);

#endif
