/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports wires that break loose within a step from obstacles whose friction of sliding is less
 * than that of sticking. Touches that begin to slide have the friction of sticking for all of that
 * step, although they lose it at once. */
#include <math.h>

#include "contact/contact.h"
#include "contact/jolt.h"
#include "scene/course.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/system.h"
#include "watch/observe.h"

/* Friction lost too late, as a mean over the window of peaks, over the wire's usual force. Cables
 * drawn off a table (0.4, sliding 0.2) had peaks of 1.2 to 1.6 times those of steps of 0.2 ms
 * above this share, and of 1.15 times below [-]. */
static const double LATE = 0.03;
/* Shorter parts, as those of a blow, resolve it [s]. */
static const double SHORT = 3e-4;

void sw_scene_watch_loose(sw_scene *s, size_t wire) {
  const sw_course *course = sw_scene_course(s);
  const sw_system *system = sw_scene_system(s);
  if (!sw_scene_contact(s) || !(course->span > SHORT)) return;
  const sw_body *b = &system->bodies[wire];
  const double share = course->window > course->span ? course->span / course->window : 1.0;
  const double lost = share * sw_contact_lost(sw_scene_contact(s), b);
  if (!(lost > LATE * sw_contact_usual_force(system, b->plan))) return;
  const char *name = sw_scene_wire_in(s, wire)->name;
  sw_events_go_on(sw_scene_events_of(s), "coarse", name, sw_scene_time(s)); /* one in a run */
  sw_scene_tell(
      s, "coarse", name, (double)NAN, lost,
      "wire '%s' breaks loose within a step of %.3g ms, and keeps the friction of sticking "
      "for all of it: peaks of forces may be too large by up to %.3g N; run again with "
      "dt = %.3g s and compare them",
      name, 1e3 * course->span, lost, 0.1 * course->span);
}
