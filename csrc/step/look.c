/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Observers: they read a scene between two steps of a run and do not change it. */
#include <math.h>
#include <time.h>

#include "scene/parts.h"
#include "step/run.h"

double sw_wall_clock(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

sw_status sw_scene_look(sw_scene *s, sw_observer *observer, double slack, sw_error *err) {
  const int due = sw_scene_time(s) >= observer->at - slack ||
                  (isfinite(observer->wall) && sw_wall_clock() >= observer->wall);
  if (!due) return SW_OK;
  const int running = sw_scene_begin_look(s);
  const sw_status status = observer->look(observer, err);
  sw_scene_end_look(s, running);
  return status;
}
