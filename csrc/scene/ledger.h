/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The energy ledger of a run. The scene keeps it, steps write it. */
#ifndef SW_SCENE_LEDGER_H
#define SW_SCENE_LEDGER_H

#include "base/log.h"
#include "base/tape.h"
#include "scene/account.h"
#include "system/energy.h"

/* A worker can do work: a hold, or an obstacle that moves. */
typedef struct sw_worker {
  sw_pose pose;         /* of a hold, at the step's start */
  sw_vec force, moment; /* on wires, about the pose's place (obstacles: the origin) [N], [N m] */
  double fed, drive;    /* of a feed: length paid out, force [m], [N] */
  double slipped;       /* length fed beyond the asked length [m] */
} sw_worker;

/* Energies of a step, as far as they are known. */
typedef struct sw_step_energy {
  sw_energies to;                         /* at its end */
  double contact;                         /* stored in touches at its end [J] */
  sw_powers powers;                       /* at its end */
  double holds, obstacles, feeds, forces; /* work [J] */
  double slipping;                  /* size of the work of slipping feeds along their slip [J] */
  double let_in;                    /* part of the feeds' work: height of wire from spools [J] */
  double damping, friction, impact; /* lost [J] */
  double gain;    /* gain beyond the upper bound of outer work; below 0: a loss [J] */
  double work;    /* sum of the sizes of all work [J] */
  double dead;    /* part of it by forces with a potential: exact [J] */
  double let_out; /* most energy given by letting wires out of obstacles in which they began [J] */
  int steady;     /* 1: no touch began or ended */
  int touching;   /* 1: something touches */
  int changed;    /* 1: the scene was changed just before */
} sw_step_energy;

/* What steps missed of a force from outside that changes within them. */
typedef struct sw_outer_sum {
  double missed, all;       /* impulse missed or counted twice; size of its whole impulse [N s] */
  double worst, step, time; /* largest missed impulse of a step; its size and start [N s], [s] */
} sw_outer_sum;
enum { SW_OUTER_SUMS = 8 }; /* forces from this number on share the last sum */

typedef struct sw_books {
  sw_ledger sums;
  sw_energies now;                     /* of the state at which the next step starts */
  double contact;                      /* stored in touches at that state [J] */
  sw_powers powers;                    /* at that state [W] */
  double dissipated;                   /* lost by histories so far [J] */
  double highest;                      /* highest potential energy so far [J] */
  double most_kinetic, work, released; /* largest kinetic energy, sum of work, largest fall from
                                          `highest` [J] */
  double made;                         /* energy gained by steps in which something touched [J] */
  double rise, lowest; /* net energy that the method made by itself; its least value [J] */
  double highest_rise; /* largest rise above the least value [J] */
  double rubbed_off;   /* friction's part of dissipated [J] */
  double mass;         /* of the wires [kg] */
  double longest;      /* length of the longest wire [m] */
  double weight;       /* sum of the wires' weights times their radii [J] */
  double bending;      /* sum of the wires' EI / L [J] */
  sw_outer_sum outer[SW_OUTER_SUMS]; /* of this run, anew after a file was read */
  int put;                           /* 1: a hold was put elsewhere since the last step */
  int has_powers;                    /* 1: there are forces without a potential */
  size_t in_each_other;              /* places of released joins where wires still are so [-] */
  int known;                         /* 1: all of the above belongs to the present state */
  int begun;                         /* 1: at_start is known */
  sw_step_energy step;               /* the step judged last */
  sw_worker *holds, *obstacles;      /* (system.hold_count), (obstacle slots) */
  size_t hold_room, obstacle_room;
  sw_log log; /* rows of SW_LOG_ENERGY_SIZE */
} sw_books;

void sw_ledger_free(sw_books *books);
void sw_tape_ledger(sw_tape *tape, sw_books *books);

#endif
