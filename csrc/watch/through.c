/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports lines that pass through each other, or through themselves. Without scene:wire_contact
 * nothing stops them: a coil that is pulled straight then loses two turns at each pass. */
#include "mutual/through.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/system.h"
#include "watch/observe.h"

static double place_on(const sw_system *s, const sw_pass *p, int k) {
  return p->s[k] - s->bodies[p->body[k]].plan->s[0];
}

/* Returns the wire that the event of this pair names: the second one, or the first one if the
 * second has passed through another wire. Repeats keep one text, so each pair needs its own event.
 */
static const char *object_of(const sw_scene *s, const char *one, const char *two) {
  char quoted[SW_NAME_SIZE + 2];
  const sw_event *e;
  snprintf(quoted, sizeof quoted, "'%s'", one);
  for (size_t k = 0; (e = sw_scene_event(s, k)); k++)
    if (!strcmp(e->kind, "through") && !strcmp(e->object, two) && !strstr(e->text, quoted))
      return one;
  return two;
}

static void tell(sw_scene *s, const sw_pass *p) {
  const sw_system *system = sw_scene_system(s);
  const char *one = sw_scene_wire_in(s, p->body[0])->name;
  const char *two = sw_scene_wire_in(s, p->body[1])->name;
  const char *object = object_of(s, one, two);
  const double here = place_on(system, p, 0), there = place_on(system, p, 1);
  if (p->body[0] == p->body[1])
    sw_scene_tell(s, "through", one, here, NAN,
                  "wire '%s' passed through itself at s = %.4g and %.4g m: no contact keeps it "
                  "apart, so a coil loses turns, and a knot opens. It touches itself after "
                  "scene:wire_contact{}",
                  one, here, there);
  else
    sw_scene_tell(s, "through", object, object == two ? there : here, NAN,
                  "wires '%s' and '%s' passed through each other at s = %.4g and %.4g m: no "
                  "contact keeps them apart. They touch after scene:wire_contact{}",
                  one, two, here, there);
}

/* A line that passes through itself keeps its twist and gains or loses two turns of writhe. Twists
 * along two paths to one place, of which one leads through the line, so differ by two turns. Other
 * differences come from holds that were changed [rad]. */
static const double TWO_TURNS = 4 * M_PI, SURE = 0.05;

/* Returns the passes of a span on the way since the last state beyond those of the straight one
 * [-]. */
static double passes_of(const sw_system *s, const sw_body *b, size_t span,
                        const sw_through_state *last) {
  const size_t k = b->first_span + span;
  const double back = s->twist[k] + sw_system_twist_change(s, b, span, last->x);
  const double passes = (back - last->twist[k]) / TWO_TURNS, whole = nearbyint(passes);
  return fabs(passes - whole) < SURE ? fabs(whole) : 0.0;
}

static void tell_leap(sw_scene *s, const sw_through_state *last) {
  const sw_system *system = sw_scene_system(s);
  const sw_mutual *contact = sw_scene_pairs(s);
  for (size_t w = 0; w < system->body_count; w++) {
    const sw_body *b = &system->bodies[w];
    double passes = 0;
    if (!b->has_twist || b->plan->web || b->plan->stops || b->plan->beam.framed) continue;
    if (contact && sw_mutual_keeps_apart(contact, w, w)) continue;
    for (size_t k = 0; k < b->plan->span_count; k++) passes += passes_of(system, b, k, last);
    if (passes > 0)
      sw_scene_tell(s, "through", sw_scene_wire_in(s, w)->name, NAN, passes,
                    "wire '%s' passed through itself on its way to rest, %.0f times: no contact "
                    "keeps it apart, so a coil loses turns, and a knot opens. It touches itself "
                    "after scene:wire_contact{}",
                    sw_scene_wire_in(s, w)->name, passes);
  }
}

sw_status sw_scene_watch_leap(sw_scene *s, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  sw_through_state last;
  if (!sw_through_last(sw_scene_through(s), system, &last) || !last.twist) return SW_OK;
  SW_TRY(sw_system_place_holds(system, last.time, NULL, NULL, NULL, err));
  tell_leap(s, &last);
  return sw_system_place_holds(system, sw_scene_time(s), NULL, NULL, NULL, err);
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
