/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arguments of a run, and checks of a scene before it runs. */
#include "step/run_check.h"

#include <math.h>

#include "body/join.h"
#include "link/hold.h"
#include "link/joint.h"
#include "scene/course.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "step/slip.h"
#include "system/system.h"

static const char *const *integrator_names(void) {
  static const char *names[32];
  for (size_t i = 0; i + 1 < sizeof names / sizeof names[0] && sw_integrator_all()[i]; i++)
    names[i] = sw_integrator_all()[i]->name;
  return names;
}

static sw_param run_rows[] = {
    {"duration", SW_PARAM_NUMBER, "s", NAN, 0, 1e9, 0, NULL, offsetof(sw_run_args, duration),
     "simulated time; without it the run lasts until the processes end"},
    {"dt", SW_PARAM_NUMBER, "s", 0.01, 0, 1e3, SW_PARAM_ABOVE_MIN, NULL, offsetof(sw_run_args, dt),
     "time step; with tolerance the largest time step"},
    {"tolerance", SW_PARAM_NUMBER, "m", NAN, 0, 1e3, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(sw_run_args, tolerance),
     "allowed error of one step, which sets the step size (or quantities, see help 'tolerance')"},
    {"integrator", SW_PARAM_CHOICE, "-", 0, 0, 0, 0, NULL, offsetof(sw_run_args, integrator),
     "time integration method"},
    {"frame", SW_PARAM_NUMBER, "s", NAN, 0, 1e9, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(sw_run_args, frame), "time between stored frames (default 1/30 s)"},
    {"frames", SW_PARAM_OTHER, "-", 0, 0, 0, 0, NULL, 0,
     "{ memory = [B] } that frames may take (default 256e6); when it is full, every second frame "
     "is dropped; false: none"},
    {"parts", SW_PARAM_BOOLEAN, "-", 1, 0, 1, 0, NULL, offsetof(sw_run_args, parts),
     "false: steps are not divided where wires move too fast for dt, as in runs for error bars; "
     "see help 'peaks'"},
    {"quasistatic", SW_PARAM_BOOLEAN, "-", 0, 0, 1, 0, NULL, offsetof(sw_run_args, quasistatic),
     "true: equilibrium at every step instead of motion; dt is then the time between poses, less "
     "where pads hold a wire"},
    {"unsettled", SW_PARAM_BOOLEAN, "-", 1, 0, 1, 0, NULL, offsetof(sw_run_args, unsettled),
     "false: a quasi-static run ends where no equilibrium is found, instead of moving the wires "
     "until there is one"},
    {"window", SW_PARAM_NUMBER, "s", SW_WINDOW, 0, 1e9, 0, NULL, offsetof(sw_run_args, window),
     "peaks of forces and tensions are those of means over this time; 0: of single steps; see help "
     "'peaks'"},
    {"max_steps", SW_PARAM_INTEGER, "-", 1e15, 1, 1e15, 0, NULL, offsetof(sw_run_args, max_steps),
     "largest number of steps, parts of divided steps included; a divided step is finished before "
     "the stop"},
    {"unstable", SW_PARAM_BOOLEAN, "-", 0, 0, 1, 0, NULL, offsetof(sw_run_args, unstable),
     "true: allow an explicit integrator steps above its stability limit"},
    {"wear", SW_PARAM_BOOLEAN, "-", 0, 0, 1, 0, NULL, offsetof(sw_run_args, wear),
     "true: record wear in all steps, for run:check of fatigue and abrasion"},
    {"check", SW_PARAM_OTHER, "-", 0, 0, 0, 0, NULL, 0,
     "arguments of run:check; the run is refined until error bars decide its rows, see help "
     "'check'"},
    {"progress", SW_PARAM_OTHER, "-", 0, 0, 0, 0, NULL, 0,
     "true: show a progress bar (default: on a terminal, if the run takes longer than a second)"},
    {"save", SW_PARAM_OTHER, "-", 0, 0, 0, 0, NULL, 0,
     "file to which the scene is written after every step of a process, see help 'save'"},
    {"resume", SW_PARAM_OTHER, "-", 0, 0, 0, 0, NULL, 0,
     "file from which the run goes on, if the file exists, see help 'save'"},
};
const sw_params sw_run_params = SW_PARAMS("scene:run", run_rows);

/* Fills the choice row with names of the registry, when the program starts. */
__attribute__((constructor)) static void fill_choices(void) {
  for (size_t i = 0; i < sizeof run_rows / sizeof run_rows[0]; i++)
    if (run_rows[i].type == SW_PARAM_CHOICE) run_rows[i].choices = integrator_names();
}

/* SW_EINVAL if the method cannot treat a rail with a sliding wire, which may stick and has ends. */
static sw_status check_rails(const sw_scene *s, const sw_integrator *m, sw_error *err) {
  SW_EACH(hold, h, s) {
    if (!h->alive || !h->cls->hold->rail) continue;
    sw_rail rail;
    h->cls->hold->rail(h, &rail);
    const int jumps = rail.friction > 0 || isfinite(rail.to - rail.from);
    if (!(m->flags & SW_INTEGRATOR_IMPLICIT) || (jumps && m->flags & SW_INTEGRATOR_NO_CONTACT))
      return sw_fail(err, SW_EINVAL,
                     "scene:run: integrator '%s' is %s; %s '%s' needs another one, such as tr-bdf2",
                     m->name, jumps ? "not suitable for sticking or stops" : "explicit",
                     h->cls->name, h->name);
  }
  return SW_OK;
}

sw_status sw_run_check(const sw_scene *s, const sw_run_args *args, sw_error *err) {
  const sw_integrator *m = sw_integrator_all()[args->integrator];
  if (!sw_scene_bodies_made(s))
    return sw_fail(err, SW_EINVAL, "scene '%s': there is no wire", sw_scene_name(s));
  SW_EACH(wire, wire, s)
    if (wire->beam.framed && !args->quasistatic && !(m->flags & SW_INTEGRATOR_IMPLICIT))
      return sw_fail(
          err, SW_EINVAL,
          "scene:run: integrator '%s' is explicit; wire '%s', which is curved at rest, has two "
          "values of EI or rolls, needs an implicit one",
          m->name, wire->name);
  if (!args->quasistatic) SW_TRY(check_rails(s, m, err));
  const sw_joint *join = NULL;
  for (size_t w = 0; w < sw_scene_wire_slots(s) && !join; w++) join = sw_scene_joined(s, w);
  if (join && !args->quasistatic && !(m->flags & SW_INTEGRATOR_IMPLICIT))
    return sw_fail(err, SW_EINVAL,
                   "scene:run: integrator '%s' is explicit; '%s', which joins wires, needs an "
                   "implicit one",
                   m->name, join->name);
  if (args->quasistatic && sw_slip_any(s))
    return sw_fail(
        err, SW_EINVAL,
        "scene:run: a feed with force or force_limit needs motion; give it a speed for a "
        "quasi-static run");
  if (args->quasistatic && isfinite(args->tolerance))
    return sw_fail(err, SW_EINVAL,
                   "scene:run: tolerance controls the time step of motion; give a quasi-static run "
                   "dt, the time between two poses");
  if (isfinite(args->tolerance) && !(m->flags & SW_INTEGRATOR_EMBEDDED))
    return sw_fail(err, SW_EINVAL,
                   "scene:run: integrator '%s' has no error estimate; give dt instead of "
                   "tolerance, or integrator = 'tr-bdf2'",
                   m->name);
  return SW_OK;
}

/* Spacing of the clock's values at t, over t [-]. A step must be at least TICKS such spacings. */
static const double CLOCK = 2.3e-16, TICKS = 64;
static const double MOST_STEPS = 1e15; /* [-] */

sw_status sw_run_check_clock(const sw_scene *s, const sw_run_args *args, double until,
                             sw_error *err) {
  const double latest = fmax(fabs(sw_scene_time(s)), fabs(until)), span = until - sw_scene_time(s);
  const double least = fmax(SW_SHORTEST_STEP, fmax(TICKS * CLOCK * latest, span / MOST_STEPS));
  if (args->dt >= least || !(span > 0)) return SW_OK;
  return sw_fail(err, SW_EINVAL,
                 "scene:run: dt = %g s is too short for t = %.6g to %.6g s; it must be at least "
                 "%.2g s, or the clock would not advance or never reach the end",
                 args->dt, sw_scene_time(s), until, least);
}

sw_status sw_scene_check_step(const sw_scene *s, const sw_run_args *args, double until,
                              sw_error *err) {
  const sw_integrator *m = sw_integrator_all()[args->integrator];
  if (args->quasistatic || args->unstable || !(m->leapfrog_limit > 0)) return SW_OK;
  const double most = 0.5 * m->leapfrog_limit * sw_system_stable_dt(sw_scene_system(s));
  const double h = fmin(args->dt, until - sw_scene_time(s));
  if (!(h > most * (1.0 + 1e-9))) return SW_OK;
  return sw_fail(err, SW_EINVAL,
                 "scene:run: dt = %.3g s is above %.3g s, up to which integrator '%s' is stable "
                 "here (%.3g times scene:stable_dt()); give a smaller dt [s], an implicit "
                 "integrator, or unstable = true to try this dt",
                 h, most, m->name, 0.5 * m->leapfrog_limit);
}
