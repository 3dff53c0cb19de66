/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kinks of tubes whose wall is known. A bent tube flattens by a^2 of its radius, with a = curvature
 * R^2/t. Its moment has its maximum at a = sqrt(2)/3 (Brazier). The compressed side, which is less
 * curved the flatter it is, buckles in short waves a little earlier, at a (1 - a^2) = (1 - 3 a^2) /
 * sqrt 3. Beyond either limit the only state is a tube that is folded at one place. */
#include <math.h>

#include "body/section.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/values.h"
#include "scene/wire.h"
#include "strand/ring.h"
#include "system/axial.h"
#include "watch/observe.h"

static const double LIMIT = 0.4714, BUCKLES = 0.381; /* maximum of the moment; buckling [-] */
/* A fold has a curvature over the limit above the first value, and an ovalisation above the second,
 * that of an endless tube shortly before it buckles [-]. Rings of few particles fold gradually, or
 * bear more than a tube can: they are bent beyond the limit all the same. Walls meet above the
 * third. */
static const double BEYOND = 1.2, FLAT = 0.12, NEAR = 0.35;

static double radius2(const sw_beam *beam) { return 2.0 * beam->EI_axis[0] / beam->EA; }

/* Returns the wall's thickness, from its bending stiffness and axial stiffness per length of
 * circumference [m]. */
static double thickness(const sw_beam *beam, double wall) {
  const double Et = beam->EA / (2.0 * M_PI * sqrt(radius2(beam)));
  return sqrt(12.0 * wall / Et);
}

/* Returns the curvature at a = 1 [1/m]. */
static double unit_curvature(const sw_beam *beam, double wall) {
  return thickness(beam, wall) / radius2(beam);
}

/* Reports a tube that is pressed or bent flat. Nothing keeps its walls from passing through each
 * other, so its further behaviour is wrong. */
static void watch_walls(sw_scene *s, size_t wire, const sw_wire_extremes *now) {
  sw_system *system = sw_scene_system(s);
  const sw_scene_wire *w = sw_scene_wire_in(s, wire);
  const sw_body *b = &system->bodies[wire];
  const sw_web *web = w->strand.web;
  const double *x = system->x + 3 * b->first_node, at = now->ovalisation.s;
  const double apart = sw_strand_walls_apart(web, x, at);
  const double wall = web->wall > 0 ? thickness(&w->beam, web->wall) : 0.0;
  if (!(apart <= wall)) return;
  sw_event *known = sw_events_go_on(sw_scene_events_of(s), "walls", w->name, sw_scene_time(s));
  if (known) known->count++;
  if (known) return;
  sw_scene_tell(s, "walls", w->name, at - w->mesh.s[0], apart,
                "tube '%s' is flat at s = %.4g m: the middles of opposite walls are %.3g m apart, "
                "the walls %.3g m thick; in the model walls do not touch each other, so it is too "
                "soft there from now on",
                w->name, at - w->mesh.s[0], apart, wall);
}

void sw_scene_watch_kink(sw_scene *s, size_t wire, const sw_wire_extremes *now) {
  sw_system *system = sw_scene_system(s);
  const sw_scene_wire *w = sw_scene_wire_in(s, wire);
  const sw_web *web = w->strand.web;
  if (!web || !web->per_ring || !(now->ovalisation.value > FLAT)) return;
  if (now->ovalisation.value > NEAR) watch_walls(s, wire, now);
  if (!(web->wall > 0)) return;
  const double unit = unit_curvature(&w->beam, web->wall);
  if (!(now->curvature.value > BEYOND * LIMIT * unit)) return;
  const sw_body *b = &system->bodies[wire];
  const double moment = sw_strand_moment(b->plan, system->x + 3 * b->first_node,
                                         sw_system_elastic(system, b), now->curvature.s);
  const double most = w->beam.EI_axis[0] * BUCKLES * unit * (1.0 - 1.5 * BUCKLES * BUCKLES);
  sw_event *known = sw_events_go_on(sw_scene_events_of(s), "kink", w->name, sw_scene_time(s));
  if (known) known->count++;
  if (known) return;
  sw_scene_tell(s, "kink", w->name, now->curvature.s - w->mesh.s[0], now->curvature.value,
                "tube '%s' kinks at s = %.4g m: its curvature there is %.3g 1/m and its moment "
                "%.3g N m; its wall buckles at about %.3g 1/m and %.3g N m",
                w->name, now->curvature.s - w->mesh.s[0], now->curvature.value, moment,
                BUCKLES * unit, most);
}
