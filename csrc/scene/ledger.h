/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The energy ledger of a run, as the scene keeps it. Steps write it. Of the scene's inside. */
#ifndef SW_SCENE_LEDGER_H
#define SW_SCENE_LEDGER_H

#include "base/log.h"
#include "base/tape.h"
#include "scene/account.h"
#include "system/energy.h"

/* Something that can do work: a hold, or an obstacle that moves. */
typedef struct sw_worker {
  sw_pose pose;         /* of a hold, at the step's start */
  sw_vec force, moment; /* on wires, about that place or, of obstacles, the origin [N], [N m] */
  double fed, drive;    /* of a feed: length paid out, force [m], [N] */
  double slipped;       /* beyond what was asked for [m] */
} sw_worker;

/* What a step does, as far as is known. */
typedef struct sw_step_energy {
  sw_energies to;                         /* at its end */
  double contact;                         /* stored in touches then [J] */
  sw_powers powers;                       /* at its end */
  double holds, obstacles, feeds, forces; /* work [J] */
  double slipping; /* force of slipping feeds times the way that they slip, in size [J] */
  double let_in;   /* the part of the feeds' that is the height of wire from spools [J] */
  double damping, friction, impact; /* lost [J] */
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

void sw_ledger_free(sw_books *books);
void sw_tape_ledger(sw_tape *tape, sw_books *books);

#endif
