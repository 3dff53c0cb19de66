/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Slow handling where no equilibrium is found. The search for one goes from touch to touch, and may
 * go in circles where a wire snaps under friction, or where it has none at all, as one that swings
 * in the wind. Motion has no such trouble: the wires move until the pose's end, and rest is looked
 * for there again. Of 40 drawn processes of handling 7 ended in such a pose, and none does now;
 * spec/physics/unsettled_spec has one of them. */
#include "step/unsettled.h"

#include <math.h>

#include "body/touching.h"
#include "scene/course.h"
#include "scene/events.h"
#include "scene/parts.h"

/* Steps of motion: this share of the time between poses, and at most LONGEST. A model compares
 * poses with steps that are four times shorter, too (lua/softworld/model/motion.lua) [-], [s]. */
static const double SHORTER = 0.25, LONGEST = 0.01;

/* After k poses in a row without rest the wires move for 2^(k-1) poses, at most MOST_POSES, before
 * rest is looked for again: a search in vain costs as much as hundreds of steps [-]. */
enum { MOST_POSES = 16 };

static const double ROUNDING = 1e-9; /* of a pose's time [-] */

int sw_unsettled_moves(const sw_ladder *p, double t) {
  const double h = t - sw_scene_time(p->s);
  return p->unsettled && t < p->until && t < p->moves_until + ROUNDING * h;
}

void sw_unsettled_ends(sw_ladder *p) { p->unsettled = 0; }

static sw_status step(sw_ladder *q, double t, sw_error *err) {
  sw_status status = SW_OK;
  while (status == SW_OK && sw_scene_time(q->s) < t && !q->lost)
    status = sw_step_fixed(q, t - sw_scene_time(q->s), t, err);
  return status;
}

sw_status sw_unsettled_go(sw_ladder *p, double t, sw_error *err) {
  sw_scene *s = p->s;
  const double t0 = sw_scene_time(s), span = t - t0;
  sw_run_args args = *p->args;
  args.quasistatic = 0, args.integrator = 0;
  args.dt = fmin(SHORTER * args.dt, LONGEST);
  const double count = fmax(1.0, ceil(span / args.dt - ROUNDING));
  sw_ladder q = *p;
  q.args = &args;
  SW_TRY(sw_scene_clear_meshes(s, err)); /* poses leave obstacles in one step */
  SW_TRY(sw_ladder_method(s, &args, err));
  sw_course_jump(sw_scene_course(s));
  sw_status status = SW_OK;
  for (size_t k = 1; status == SW_OK && (double)k <= count && !q.lost; k++) {
    if (q.interrupted && q.interrupted()) status = SW_EINTR;
    if (status == SW_OK)
      status = step(&q, (double)k < count ? t0 + span * ((double)k / count) : t, err);
  }
  p->v_start = q.v_start, p->lost = q.lost; /* a feed may have made nodes */
  return status;
}

static void tell(sw_scene *s) {
  sw_scene_tell(s, "unsettled", "", (double)NAN, (double)NAN,
                "no equilibrium was found: the wires move until there is one. Forces and tensions "
                "contain their inertia; unsettled = false ends the run here instead");
}

sw_status sw_unsettled_begin(sw_ladder *p, double t, sw_status status, sw_error *err) {
  if (status != SW_ENOCONV || !p->args->unsettled || p->falls) return status;
  const double pose = t - sw_scene_time(p->s);
  const sw_error why = *err;
  if (!p->unsettled) tell(p->s);
  const double more = fmin(ldexp(1.0, p->unsettled), MOST_POSES);
  p->unsettled++;
  p->moves_until = t + (more - 1.0) * fmax(pose, p->args->dt);
  const sw_status moved = sw_unsettled_go(p, t, err);
  if (moved != SW_ENOCONV) return moved;
  *err = why;
  return status;
}
