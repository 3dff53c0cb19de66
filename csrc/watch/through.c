/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports lines that pass through each other, or through themselves. Without scene:wire_contact
 * nothing stops them: a coil that is pulled straight then loses two turns at each pass. */
#include "mutual/through.h"

#include <math.h>

#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/system.h"
#include "watch/observe.h"

static double place_on(const sw_system *s, const sw_pass *p, int k) {
  return p->s[k] - s->bodies[p->body[k]].plan->s[0];
}

static void tell(sw_scene *s, const sw_pass *p) {
  const sw_system *system = sw_scene_system(s);
  const char *one = sw_scene_wire_in(s, p->body[0])->name;
  const char *two = sw_scene_wire_in(s, p->body[1])->name;
  const double here = place_on(system, p, 0), there = place_on(system, p, 1);
  if (p->body[0] == p->body[1])
    sw_scene_tell(s, "through", one, here, NAN,
                  "wire '%s' passed through itself at s = %.4g and %.4g m: no contact keeps it "
                  "apart, so a coil loses turns, and a knot opens. It touches itself after "
                  "scene:wire_contact{}",
                  one, here, there);
  else
    sw_scene_tell(s, "through", two, there, NAN,
                  "wires '%s' and '%s' passed through each other at s = %.4g and %.4g m: no "
                  "contact keeps them apart. They touch after scene:wire_contact{}",
                  one, two, here, there);
}

sw_status sw_scene_watch_through(sw_scene *s, sw_error *err) {
  sw_through *t = sw_scene_through(s);
  sw_pass pass;
  if (sw_through_follow(t, sw_scene_system(s), sw_scene_pairs(s), sw_scene_time(s)) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "out of memory for the passes of wires in scene '%s'",
                   sw_scene_name(s));
  while (sw_through_next(t, sw_scene_system(s), &pass)) tell(s, &pass);
  return SW_OK;
}
