/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports sliders whose friction locks as they slide (dynamic jamming). A wire that swings about a
 * node on a rail changes the force across the rail as the node slides. Where the friction of this
 * change grows faster than what drives the node, no smooth slide exists: the node sticks and slips
 * at the rate of waves along the wire, and small differences decide its way. Long steps go on
 * smoothly there, short ones do not. */
#include <math.h>

#include "contact/contact.h"
#include "link/hold.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/rail.h"
#include "watch/observe.h"

/* Share of the stiffness along the rail that friction takes; from 1 on it locks. Of 60 random
 * slides those whose force or way depended on the step came above 1 in short steps, and nearly all
 * of them above TAKES in steps of 2 to 10 ms [-]. */
static const double TAKES = 0.8;
/* Least force across the rail, over the wire's usual force. Nothing depends on a weaker one [-]. */
static const double FELT = 0.1;

void sw_hold_watch_jam(sw_scene *s, const sw_hold *h) {
  const sw_system *system = sw_scene_system(s);
  const sw_rail *rail = &system->rails[h->rail];
  const double taken = 1.0 - rail->left;
  if (!(taken > TAKES) || system->v[sw_rail_freedom(system, h->rail)] == 0) return;
  const sw_scene_wire *wire = sw_scene_wire_in(s, h->wire);
  const double usual = sw_contact_usual_force(system, system->bodies[h->wire].plan);
  const double across = sw_norm(sw_madd(h->force, rail->along, -sw_dot(h->force, rail->along)));
  if (!(across > FELT * usual)) return;
  sw_scene_tell(s, "jam", h->name, h->s1 - wire->mesh.s[0], taken,
                "slider '%s' of wire '%s': its friction of %.3g %s as it slides at t = %.6g s, "
                "pressed by %.3g N: small differences, and the step, decide its force and its way "
                "from there on",
                h->name, wire->name, rail->friction, taken < 1 ? "nearly locks" : "locks",
                sw_scene_time(s), across);
}
