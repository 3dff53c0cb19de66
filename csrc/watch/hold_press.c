/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports holds that press a wire into an obstacle by less than a crash. The section of a rod does
 * not yield, so the wire beside the hold must bend out of the obstacle within its first edge: with
 * the force 3 EI d/h^3 for the depth d and the edge h. A tenth of a millimetre gives 0.2 to 20 N,
 * as the edges have it. */
#include "contact/contact.h"
#include "link/hold.h"
#include "scene/events.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/system.h"
#include "watch/observe.h"

/* The wire is pressed by the hold up to this many edges beside it [-]. */
static const double BESIDE = 2.0;

/* Returns the force of an obstacle on the wire at the hold and beside it [N]. */
static double force_beside(const sw_scene *s, const sw_hold *h, size_t obstacle) {
  const sw_contact *contact = sw_scene_contact(s);
  const sw_system *system = sw_scene_system((sw_scene *)s);
  const sw_body *b = &system->bodies[h->wire];
  const double reach = BESIDE * b->plan->length / (double)b->plan->edges;
  double force = 0;
  size_t k, end;
  sw_contact_push p;
  sw_contact_touches_of(contact, b->first_node, b->first_node + b->plan->nodes, &k, &end);
  for (; k < end; k++)
    if (sw_contact_push_at(contact, system, k, &p) && p.obstacle == (int)obstacle &&
        p.place >= h->s1 - reach && p.place <= h->s2 + reach)
      force += p.normal_force;
  return force;
}

void sw_hold_watch_press(sw_scene *s, const sw_hold *h, size_t obstacle, double gained) {
  const sw_system *system = sw_scene_system(s);
  const sw_plan *plan = system->bodies[h->wire].plan;
  if (!sw_scene_contact(s) || plan->web) return;
  const double force = force_beside(s, h, obstacle);
  if (!(force > sw_contact_usual_force(system, plan))) return;
  sw_scene_tell(
      s, "pressed", h->name, 0.5 * (h->s1 + h->s2) - plan->s[0], force,
      "%s '%s' presses wire '%s' %.3g mm into '%s' with %.3g N; a rod's section is rigid, "
      "so this force depends on its edges: lift the hold, or take pads or a mesh",
      h->cls->name, h->name, sw_scene_wire_in(s, h->wire)->name, 1e3 * gained,
      sw_scene_obstacle_in(s, obstacle)->name, force);
}
