/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rungs for what obeys a force: something is set so that a force at the step's end is as wanted,
 * trial by trial (see base/root.h). Shared by the files of this room only. */
#ifndef SW_STEP_OBEY_H
#define SW_STEP_OBEY_H

#include "step/ladder.h"

typedef struct sw_obeyer {
  /* Before the first trial of a step of size h: 0, nothing obeys; the step is tried once. */
  int (*begin)(sw_scene *scene, double h);
  /* After a trial: 1, the force is as wanted or cannot be; else there is another one. */
  int (*correct)(sw_scene *scene, double h, int first);
  /* NULL, or: may there be one of this size? And what if not, or if a trial failed. */
  int (*goes_on)(const sw_scene *scene, double h);
  void (*give_up)(sw_scene *scene);
  size_t most;         /* trials; 0: correct sees to it that there is an end [-] */
  const char *failure; /* why there were no more */
} sw_obeyer;

/* SW_ENOCONV: it was not found. */
sw_status sw_obey(sw_ladder *p, const sw_rung *below, double h, const sw_obeyer *what,
                  sw_error *err);

#endif
