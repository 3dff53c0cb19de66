/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run gives account of: where its energy went, and what happened in it. */
#ifndef SW_SCENE_ACCOUNT_H
#define SW_SCENE_ACCOUNT_H

#include "scene/scene.h"

/* --- energy ------------------------------------------------------------------- */

/* How often something had to be done because a step made energy, and the worst of it. */
typedef struct sw_retries {
  size_t count;
  double largest;            /* energy made by such a step [J] */
  double time, s;            /* when, and where nodes gained most [s], [m] */
  char object[SW_NAME_SIZE]; /* the wire there */
} sw_retries;

/* Where the energy of a run came from and went. The remainder of each step,
 *   change of energy - work + losses,
 * is booked: below 0 as lost by the integrator (or by contact, in steps in which touches began or
 * ended), above 0 as gap, but for what a method gives back that it took while nothing touched. */
typedef struct sw_ledger {
  double kinetic, stored, gravity;                                   /* now [J] */
  double at_start;                                                   /* their sum then [J] */
  double by_holds, by_obstacles, by_feeds, by_forces;                /* work [J] */
  double by_changes;                                                 /* of the scene itself [J] */
  double damping, friction, plasticity, impact, contact, integrator; /* lost [J] */
  double jumps;                  /* lost by equilibria that jumped, of quasi-static runs [J] */
  double gap;                    /* from nowhere [J] */
  double gained;                 /* sum of what steps gained beyond the work [J] */
  double most_gained, most_time; /* by one step, and when [J], [s] */
  double play;         /* energy that was in play: largest kinetic energy, work, that of slipping
                          feeds too, energy released; at least the wires' weight times their radius [J] */
  sw_retries redone;   /* steps redone with implicit Euler */
  sw_retries halved;   /* and then halved */
  sw_retries accepted; /* and accepted, because they could not be smaller */
  size_t steps;        /* accepted ones [-] */
} sw_ledger;

/* Of the last run, or the one under way. */
sw_status sw_scene_ledger(sw_scene *scene, sw_ledger *out, sw_error *err);
/* Rows (their number) of time [s], kinetic, stored and gravity energy, gap and all losses so
 * far [J], one a step. */
const double *sw_scene_energy_log(const sw_scene *scene, size_t *rows);
enum { SW_LOG_ENERGY_SIZE = 6 };

/* --- events ------------------------------------------------------------------- */

/* Something that happened, once or again and again. */
typedef struct sw_event {
  char kind[SW_NAME_SIZE], object[SW_NAME_SIZE];
  char text[224];           /* one sentence, for people */
  double time, first, last; /* of the largest value; of the first and the last time [s] */
  double s;                 /* arc length; NAN = none [m] */
  double value;             /* in the text's unit; NAN = none */
  size_t count;             /* how often it happened, one soon after the other [-] */
} sw_event;
size_t sw_scene_events_dropped(const sw_scene *scene); /* for want of room [-] */
/* Number k of the last run; NULL: it has no more. */
const sw_event *sw_scene_event(const sw_scene *scene, size_t k);
/* Book one at the scene's time; value and arc may be NAN. */
sw_status sw_scene_book_event(sw_scene *scene, const char *kind, const char *object, double arc,
                              double value, const char *text, sw_error *err);

#endif
