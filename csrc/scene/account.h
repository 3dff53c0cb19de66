/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The account of a run: its energy and its events. */
#ifndef SW_SCENE_ACCOUNT_H
#define SW_SCENE_ACCOUNT_H

#include "scene/scene.h"

/* --- energy ------------------------------------------------------------------- */

/* Counts retries because a step made energy, and holds the worst one. */
typedef struct sw_retries {
  size_t count;
  double largest;            /* most energy made by such a step [J] */
  double time, s;            /* its time, and where nodes gained most [s], [m] */
  char object[SW_NAME_SIZE]; /* the wire at that place */
} sw_retries;

/* Where the energy of a run came from and went. The remainder of each step,
 *   change of energy - work + losses,
 * is booked: below 0 as lost by the integrator (or by contact, in steps in which touches began or
 * ended), above 0 as gap. Where nothing touches, energy that a method gives back after taking it is
 * no gap. */
typedef struct sw_ledger {
  double kinetic, stored, gravity;                                   /* now [J] */
  double at_start;                                                   /* sum at the start [J] */
  double by_holds, by_obstacles, by_feeds, by_forces;                /* work done [J] */
  double by_changes;                                                 /* by edits [J] */
  double damping, friction, plasticity, impact, contact, integrator; /* lost [J] */
  double jumps;                  /* lost by equilibria that jumped, of quasi-static runs [J] */
  double gap;                    /* energy from nowhere [J] */
  double gained;                 /* sum of the steps' gains beyond the work [J] */
  double most_gained, most_time; /* largest gain of a step, and its time [J], [s] */
  double play;         /* energy in play: largest kinetic energy + work (also of slipping feeds) +
                          energy released; at least the wires' weight times their radius [J] */
  sw_retries redone;   /* steps redone with implicit Euler */
  sw_retries halved;   /* steps then halved */
  sw_retries accepted; /* steps then accepted, because they could not be smaller */
  size_t steps;        /* accepted steps [-] */
} sw_ledger;

/* Copies the ledger of the last or present run. */
sw_status sw_scene_ledger(sw_scene *scene, sw_ledger *out, sw_error *err);
/* Returns rows, one per step (*rows: their number): time [s], kinetic, stored and gravity energy,
 * gap and all losses so far [J]. */
const double *sw_scene_energy_log(const sw_scene *scene, size_t *rows);
enum { SW_LOG_ENERGY_SIZE = 6 };

/* --- events ------------------------------------------------------------------- */

/* An event, merged with its repeats. */
typedef struct sw_event {
  char kind[SW_NAME_SIZE], object[SW_NAME_SIZE];
  char text[224];           /* one sentence, for readers */
  double time, first, last; /* of the largest value; of the first and of the last occurrence [s] */
  double s;                 /* arc length; NAN = none [m] */
  double value;             /* in the text's unit; NAN = none */
  size_t count;             /* occurrences, each soon after the one before [-] */
} sw_event;
size_t sw_scene_events_dropped(const sw_scene *scene); /* because the list was full [-] */
/* Returns event number k of the last run, or NULL if there are no more. */
const sw_event *sw_scene_event(const sw_scene *scene, size_t k);
/* Books an event; value and arc may be NAN. time: NAN = the scene's; SW_EINVAL if it is later [s].
 */
sw_status sw_scene_book_event(sw_scene *scene, const char *kind, const char *object, double arc,
                              double value, double time, const char *text, sw_error *err);

#endif
