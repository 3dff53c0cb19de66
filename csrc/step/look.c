/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Observers: who looks at a scene between two steps of a run, and leaves it as it is. */
#include <math.h>
#include <time.h>

#include "scene/world.h"
#include "step/run.h"

double sw_wall_clock(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

sw_status sw_scene_look(sw_scene *s, sw_observer *observer, double slack, sw_error *err) {
  const int due = s->time >= observer->at - slack ||
                  (isfinite(observer->wall) && sw_wall_clock() >= observer->wall);
  if (!due) return SW_OK;
  const int running = s->running;
  s->running = 0, s->looking = 1;
  const sw_status status = observer->look(observer, err);
  s->running = running, s->looking = 0;
  return status;
}
