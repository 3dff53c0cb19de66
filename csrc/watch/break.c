/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports wires that are pulled harder than they bear, and obstacles that press hard, as possible
 * reasons when a run fails. Nothing breaks here. */
#include <math.h>
#include <stdio.h>

#include "body/obstacle_log.h"
#include "edit/wires.h"
#include "read/reading.h"
#include "scene/events.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "scene/values.h"
#include "scene/wire.h"
#include "watch/observe.h"

typedef struct amount {
  double value;
  const char *unit;
} amount;

static amount force(double F) { return F < 1e4 ? (amount){F, "N"} : (amount){1e-3 * F, "kN"}; }

static void tell(sw_scene *s, const sw_scene_wire *w, double s_from_start, double pull) {
  const amount F = force(pull), most = force(w->drawing.breaking_load);
  sw_events_go_on(sw_scene_events_of(s), "breaking", w->name, sw_scene_time(s));
  sw_scene_tell(s, "breaking", w->name, s_from_start, pull,
                "wire '%s' is pulled by %.4g %s near s = %.4g m, more than its breaking load of "
                "%.4g %s (%s); the simulation goes on as if the wire held",
                w->name, F.value, F.unit, s_from_start, most.value, most.unit,
                sw_breaking_flags[w->drawing.breaking_flag]);
}

void sw_scene_watch_breaking(sw_scene *s, size_t wire, const sw_wire_extremes *now) {
  const sw_scene_wire *w = sw_scene_wire_in(s, wire);
  const sw_extreme *pull = &w->extremes.tension;
  const double most = w->drawing.breaking_load;
  if (pull->value > most && now->tension.value > most)
    tell(s, w, pull->s - w->mesh.s[0], pull->value);
}

void sw_scene_end_breaking(sw_scene *s) {
  sw_wire_extremes now, run;
  sw_error ignored;
  for (size_t k = 0; k < sw_scene_wire_slots(s); k++) {
    const sw_scene_wire *w = sw_scene_wire_in(s, k);
    const sw_handle h = {(uint32_t)k, w->generation};
    if (!(w->drawing.breaking_load > 0) || w->extremes.tension.value > w->drawing.breaking_load)
      continue;
    if (sw_scene_is_loose(w) || sw_scene_wire_extremes(s, h, &now, &run, &ignored) != SW_OK)
      continue;
    if (run.tension.value > w->drawing.breaking_load) tell(s, w, run.tension.s, run.tension.value);
  }
}

void sw_scene_tell_broken(const sw_scene *s, char *out, size_t size) {
  out[0] = 0;
  for (size_t k = 0; k < sw_scene_wire_slots(s) && !out[0]; k++) {
    const sw_scene_wire *w = sw_scene_wire_in(s, k);
    const amount F = force(w->extremes.tension.value), most = force(w->drawing.breaking_load);
    if (w->extremes.tension.value > w->drawing.breaking_load)
      snprintf(out, size, "; wire '%s' was pulled by %.4g %s, its breaking load is %.4g %s",
               w->name, F.value, F.unit, most.value, most.unit);
  }
}

/* Presses below this are not reported as a reason, over the wire's weight on earth [-]. */
static const double HARD = 20.0;

/* Time since which wires have touched the obstacle without a break; NAN if it is not known [s]. */
static double touched_since(sw_scene *s, sw_scene_obstacle *o) {
  double since = (double)NAN;
  if (sw_obstacle_log_fill(s, o) != SW_OK) return since;
  for (size_t end = o->log.count; end >= SW_LOG_OBSTACLE_SIZE; end -= SW_LOG_OBSTACLE_SIZE) {
    const double *row = o->log.rows + end - SW_LOG_OBSTACLE_SIZE;
    if (sw_norm2(sw_load(row + 1)) == 0) break;
    since = row[0];
  }
  return since;
}

void sw_scene_tell_pressed(sw_scene *s, char *out, size_t size) {
  sw_system *system = sw_scene_system(s);
  sw_contact_push now, most = {.normal_force = 0};
  size_t wire = 0;
  out[0] = 0;
  for (size_t i = 0; sw_scene_contact(s) && i < sw_contact_touches(sw_scene_contact(s)); i++)
    if (sw_contact_push_at(sw_scene_contact(s), system, i, &now) && isfinite(now.normal_force) &&
        now.normal_force > most.normal_force)
      most = now;
  while (wire + 1 < system->body_count && system->bodies[wire + 1].first_node <= most.node) wire++;
  if (!(most.normal_force > 0) || most.obstacle < 0 ||
      (size_t)most.obstacle >= sw_scene_obstacle_slots(s))
    return;
  const sw_scene_wire *w = sw_scene_wire_in(s, wire);
  const double weight = 9.81 * w->beam.mass * (w->mesh.s[w->mesh.n - 1] - w->mesh.s[0]);
  if (!(most.normal_force > HARD * weight)) return;
  const amount N = force(most.normal_force);
  sw_scene_obstacle *o = sw_scene_obstacle_in(s, most.obstacle);
  const double since = touched_since(s, o);
  const int n = snprintf(out, size, "; obstacle '%s' presses '%s' with %.4g %s near s = %.3g m",
                         o->name, w->name, N.value, N.unit, most.place - w->mesh.s[0]);
  if (!isnan(since) && n > 0 && (size_t)n < size)
    snprintf(out + n, size - (size_t)n, ", after touching since t = %.4g s", since);
}
