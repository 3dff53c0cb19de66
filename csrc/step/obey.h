/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rungs for drives that obey a force. Each trial corrects a drive until its force at the end of the
 * step is the wanted one (see base/root.h). Private to this room. */
#ifndef SW_STEP_OBEY_H
#define SW_STEP_OBEY_H

#include "step/ladder.h"

typedef struct sw_obeyer {
  /* Call before the first trial of a step of size h. Returns 0 if no drive obeys a force; the step
   * is then tried once. */
  int (*begin)(sw_scene *scene, double h);
  /* Call after a trial. Returns 1 if the force is as wanted or cannot be reached; 0: another trial
   * follows. */
  int (*correct)(sw_scene *scene, double h, int first);
  /* NULL, or: goes_on returns 0 if a further trial of this size is impossible; give_up ends the
   * search then, and after a failed trial. */
  int (*goes_on)(const sw_scene *scene, double h);
  void (*give_up)(sw_scene *scene);
  size_t most;         /* most trials; 0: correct ends the search [-] */
  const char *failure; /* message when the search ends */
} sw_obeyer;

/* SW_ENOCONV: the wanted force was not found. */
sw_status sw_obey(sw_ladder *p, const sw_rung *below, double h, const sw_obeyer *what,
                  sw_error *err);

#endif
